// Looks at a state and says when it is ruined: the scheme survives tets turned inside out and a det F that parts from J, the reader should know (method, section 11).
#include "engine/watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/monitor.hpp"
#include "engine/parts.hpp"
#include "kernels/extrema_part.hpp"

namespace nanson {
namespace {

constexpr double parted = 2;            // [-] det F/J, or its inverse, from which on a run warns
constexpr long checkerboard_rows = 16;  // of history, from one measurement of the checkerboard to the next
constexpr double counted_size =
    0.01;  // [-] of the largest sum of squared differences, from which on a checkerboard counts

void take_least(Extreme& e, double value, double t) {
  if (!(value >= e.value)) e = {value, t};  // takes the first one too
}
void take_most(Extreme& e, double value, double t) {
  if (!(value <= e.value)) e = {value, t};
}

/// Early pressures are small and rough: a much larger pressure starts the search again.
void look_for_checkerboard(Simulation& s) {
  Watch& w = s.watch;
  const Checkerboard c = checkerboard(s);
  if (!(c.size > 0)) return;
  w.largest_size = std::max(w.largest_size, c.size);
  if (!(w.checkerboard_size >= counted_size * w.largest_size)) w.extremes.checkerboard = {};
  if (c.size < counted_size * w.largest_size || c.measure <= w.extremes.checkerboard.value) return;
  w.extremes.checkerboard = {c.measure, s.state.t};
  w.checkerboard_size = c.size;
}

double tet_ratio(const Simulation& s, const std::array<int, 4>& tet) {
  Vec3 X[4], x[4];
  for (std::size_t v = 0; v < 4; ++v) {
    X[v] = s.domain.mesh->X[static_cast<std::size_t>(tet[v])];
    x[v] = state_of(s, tet[v]).position();
  }
  return tet_volume(x[0], x[1], x[2], x[3]) / tet_volume(X[0], X[1], X[2], X[3]);
}

/// Names the worst of the tets that have turned.
Breakdown inverted_tet(const Simulation& s) {
  const Mesh& mesh = *s.domain.mesh;
  std::size_t worst = 0, turned = 0;
  double least = 1e300;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const double ratio = tet_ratio(s, mesh.tets[t]);
    if (ratio <= 0) ++turned;
    if (ratio < least) {
      least = ratio;
      worst = t;
    }
  }
  const auto& n = mesh.tets[worst];
  Vec3 X{}, x{};
  for (const int node : n) {
    add(X, scaled(mesh.X[static_cast<std::size_t>(node)], 0.25));
    add(x, scaled(state_of(s, node).position(), 0.25));
  }
  return {n[0],
          fmt::format("tet {} (nodes {}) in region {} is inside out, its volume {:.3g} of the undeformed one{}: at X = "
                      "({:.6g}, {:.6g}, {:.6g}), x = ({:.6g}, {:.6g}, {:.6g}) m, step {}, t = {:.6e} s. Stresses and "
                      "forces around it are wrong from here on; a finer or better shaped mesh there or a smaller load "
                      "may help, monitor.geometry = \"stop\" ends such a run",
                      worst, fmt::join(n, " "), mesh.region_names[static_cast<std::size_t>(mesh.tet_region[worst])],
                      least, turned > 1 ? fmt::format(" ({} more are)", turned - 1) : "", X[0], X[1], X[2], x[0], x[1],
                      x[2], s.state.step, s.state.t),
          "inverted_tet"};
}

}  // namespace

Extrema extrema(const Simulation& s) {
  constexpr std::size_t count = 9;
  const bool with_J = evolves_J(s.domain.scene->physics.formulation);
  const double* U = s.state.U[0].data();
  const TetArrays tets = s.domain.tets.arrays();
  for_parts(s, [&](int p, Scratch) {
    const Part& part = s.domain.order.parts[static_cast<std::size_t>(p)];
    const int* node_of = s.domain.order.node_of.data();
    const NodeExtrema e = with_J ? node_extrema_part<true>(part, U, node_of)
                                 : node_extrema_part<false>(part, U, node_of);
    double strain = 0;
    for (int n = part.node_begin; !s.state.plastic.empty() && n < part.node_end; ++n)
      if (node_of[n] >= 0) strain = std::max(strain, plastic_strain(s.domain.mixture, s.state.plastic, n));
    const double least_tet = s.domain.tets.first.empty()
                                 ? 1e300
                                 : least_tet_ratio(tets, s.domain.tets.first[static_cast<std::size_t>(p)],
                                                   s.domain.tets.first[static_cast<std::size_t>(p) + 1], U);
    const std::array<double, count> found{-e.detF.least,      e.detF.most, -e.J.least, e.J.most, -e.detF_over_J.least,
                                          e.detF_over_J.most, -least_tet,  e.speed2,   strain};
    std::copy(found.begin(), found.end(), s.team.part_rows[static_cast<std::size_t>(p)].begin());
  });
  std::array<double, count> most;
  most.fill(-1e300);
  for (const auto& found : s.team.part_rows)
    for (std::size_t i = 0; i < count; ++i) most[i] = std::max(most[i], found[i]);
  return {-most[0], most[1], -most[2], most[3], -most[4], most[5], -most[6], std::sqrt(most[7]), most[8]};
}

std::optional<std::string> cfl_warning(const Scene& scene) {
  const PhysicsSpec& p = scene.physics;
  if (scene.time.step != StepRule::dual) return std::nullopt;
  const bool three = scene.time.integrator == Integrator::ssp_rk3;
  const double sound = p.formulation == Formulation::pFp            ? (three ? 0.8 : 0.25)
                       : p.stabilisation == Stabilisation::jst      ? 0.3
                       : three                                      ? 0.7
                       : p.reconstruction == Reconstruction::linear ? 0.6
                                                                    : 0.5;
  if (scene.time.cfl <= sound) return std::nullopt;
  return fmt::format("time.cfl = {:g} is above {:g}, the largest that was sound on {}", scene.time.cfl, sound,
                     p.formulation == Formulation::pFp ? "Cook's membrane" : "a twisted column");
}

void look(Simulation& s) {
  Watch& w = s.watch;
  w.step = s.state.step;
  w.energies = energies(s);
  w.extrema = extrema(s);
  const Extrema& x = w.extrema;
  Extremes& e = w.extremes;
  take_least(e.least_detF, x.min_detF, s.state.t);
  take_most(e.most_detF, x.max_detF, s.state.t);
  take_most(e.speed, x.max_speed, s.state.t);
  if (!s.domain.tets.first.empty()) take_least(e.least_tet_ratio, x.min_tet_ratio, s.state.t);
  if (evolves_J(s.domain.scene->physics.formulation)) {
    take_least(e.least_detF_over_J, x.min_detF_over_J, s.state.t);
    take_most(e.most_detF_over_J, x.max_detF_over_J, s.state.t);
  }
  if (w.rows++ % checkerboard_rows == 0) look_for_checkerboard(s);
}

Seen seen(const Simulation& s) {
  if (s.watch.step == s.state.step) return {s.watch.energies, s.watch.extrema};
  return {energies(s), extrema(s)};
}

void warn(Simulation& s, std::string_view cause, std::string text) {
  const auto same = [&](const Warning& w) { return w.cause == cause; };
  if (std::ranges::none_of(s.watch.warnings, same)) s.watch.warnings.push_back({std::string(cause), std::move(text)});
}

std::optional<Breakdown> ruin(Simulation& s) {
  const MonitorSpec& monitor = s.domain.scene->monitor;
  if (auto grown = energy_growth(s)) {
    if (!monitor.energy || monitor.energy_growth == EnergyGrowth::stop) return Breakdown{-1, *grown, "energy_growth"};
    warn(s, "energy_growth", *grown);
  }
  if (monitor.geometry == GeometryWatch::off) return std::nullopt;
  const Extrema& x = s.watch.extrema;
  if (x.min_tet_ratio <= 0) {
    Breakdown turned = inverted_tet(s);
    if (monitor.geometry == GeometryWatch::stop) return turned;
    warn(s, "inverted_tet", std::move(turned.text));
  }
  if (!(x.min_detF_over_J >= 1 / parted && x.max_detF_over_J <= parted))
    warn(s, "parted",
         fmt::format("J and det F part: at step {}, t = {:.6e} s, det F/J ranges from {:.3g} to {:.3g}; a finer mesh, "
                     "physics.parting or formulation = \"pF\" may help",
                     s.state.step, s.state.t, x.min_detF_over_J, x.max_detF_over_J));
  return std::nullopt;
}

}  // namespace nanson
