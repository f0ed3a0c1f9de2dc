// Energies, momenta and the energy audit: sums over parts in a fixed order.
#include "engine/monitor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/parts.hpp"
#include "engine/step_bound.hpp"
#include "kernels/springs.hpp"

namespace nanson {
namespace {

/// Sums over the nodes (padding left out) of what add(row, mass, sums) adds, part by part.
template <std::size_t count, class Add>
std::array<double, count> sums_over_nodes(const Simulation& s, Add add) {
  return sums_over_parts<count>(s, [&](int p, double* sums) {
    const Part& part = s.domain.order.parts[static_cast<std::size_t>(p)];
    for (int n = part.node_begin; n < part.node_begin + nodes_of(s.domain, part); ++n)
      if (!is_padding(s.domain, n)) add(state_of_row(s.state.U[0].data(), n), mass(s.domain, n), sums);
  });
}

/// What energies are compared with [J]: a body that starts at rest has no initial energy.
double energy_scale(const Simulation& s) { return std::max(s.books.initial_energy, s.books.largest_work); }

/// Energy of strains of size one [J], that noise is compared with.
double elastic_energy(const Simulation& s) { return s.domain.coefficients.material.mu * s.books.volume; }
constexpr double least_runaway = 1e-16;  // [-] of it, strains of 1e-8: less is the round-off of a body at rest

constexpr long settling_steps =
    20;  // a load that starts from nothing does work as small as its error in the first of them

}  // namespace

Energies energies(const Simulation& s) {
  const Rows rows = present_rows(s.domain, s.state);
  Energies e;
  e.kinetic = sums_over_nodes<1>(
      s, [](const NodeState& u, double m, double* sum) { *sum += 0.5 * m * dot(u.velocity(), u.velocity()); })[0];
  e.strain = sum_over_parts(s, [&](int p) {
    if (!s.domain.mixture.empty()) {
      double sum = 0;
      for (int i = s.domain.mixture.first_run[static_cast<std::size_t>(p)];
           i < s.domain.mixture.first_run[static_cast<std::size_t>(p) + 1]; ++i)
        sum += mixed_energy(s.domain.mixture, s.domain.mixture.runs[static_cast<std::size_t>(i)], rows,
                            s.domain.coefficients);
      return sum;
    }
    Part part = s.domain.order.parts[static_cast<std::size_t>(p)];
    part.node_end = part.node_begin + nodes_of(s.domain, part);
    return s.domain.functions.strain_energy(part, rows, s.domain.coefficients);
  });
  const EdgeArrays edges = s.domain.order.edges();
  if (edges.stiffness)
    e.strain += sum_over_parts(
        s, [&](int p) { return spring_energy_part(s.domain.order.parts[static_cast<std::size_t>(p)], edges, rows); });
  if (s.domain.scene->physics.tet_barrier > 0) e.strain += crushing_energy(s);
  return e;
}

Momenta momenta(const Simulation& s) {
  const auto sum = sums_over_nodes<8>(s, [](const NodeState& u, double mass, double* out) {
    const double speed = norm(u.velocity());
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      out[k] += mass * u.v(k);
      out[3 + k] += mass * (u.x(i) * u.v(j) - u.x(j) * u.v(i));
    }
    out[6] += mass * speed;
    out[7] += mass * speed * norm(u.position());
  });
  return {{sum[0], sum[1], sum[2]}, {sum[3], sum[4], sum[5]}, sum[6], sum[7]};
}

double energy_closure(const Simulation& s, const Energies& e) {
  const Books& l = s.books;
  const double residual = std::abs(e.kinetic + e.strain + l.dissipated - l.external_work - l.angular_momentum_work
                                   - l.initial_energy),
               scale = energy_scale(s);
  return scale > 0 ? residual / scale : 0;
}

double linear_momentum_drift(const Simulation& s) {
  const Momenta m = momenta(s);
  const Books& l = s.books;
  const double d = norm(m.linear - l.initial_momentum - l.impulse);
  return m.linear_scale > 0 ? d / m.linear_scale : 0;
}

std::optional<double> angular_momentum_drift(const Simulation& s) {
  if (!nothing_acts(s.domain) && s.domain.scene->time.integrator != Integrator::tvd_rk2) return std::nullopt;
  const Momenta m = momenta(s);
  const Vec3 &L = s.books.initial_angular_momentum, &I = s.books.angular_impulse;
  return m.angular_scale > 0 ? norm(m.angular - L - I) / m.angular_scale : 0;
}

namespace {

/// 1 at rows whose neighbours all see the same one material: elsewhere the pressure jumps by right, and the Green-Gauss gradient takes the jump for its own.
/// Empty with one material.
std::vector<char> inside_one_material(const Simulation& s) {
  if (s.domain.mixture.empty()) return {};
  std::vector<char> inside(static_cast<std::size_t>(s.domain.order.rows), 1);
  const auto edges = s.domain.order.edges();
  const auto group = [&](int n) { return s.domain.mixture.group[static_cast<std::size_t>(n)]; };
  for (const Part& part : s.domain.order.parts)
    for (std::int32_t e = part.edge_begin; e < part.edge_end; ++e) {
      const int a = edges.a[e], b = edges.b[e];
      if (group(a) == group(b) && s.domain.mixture.groups[static_cast<std::size_t>(group(a))].size() == 1) continue;
      inside[static_cast<std::size_t>(a)] = inside[static_cast<std::size_t>(b)] = 0;
    }
  return inside;
}

}  // namespace

Checkerboard checkerboard(const Simulation& s) {
  Aligned<double> G(row::G * static_cast<std::size_t>(s.domain.order.rows),
                    0.0);  // the state's own may be absent, or of an earlier stage
  Rows rows{};
  rows.X = s.domain.X.data();
  rows.W = s.state.W[s.state.now].data();
  rows.G = G.data();
  const auto edges = s.domain.order.edges();
  const auto corners = s.domain.order.corners();
  const auto lists = s.domain.order.lists();
  for_parts(s, [&](int p, Scratch) {
    gradient_part<false, false, NodeWeights::none>(s.domain.order.parts[static_cast<std::size_t>(p)], edges, corners,
                                                   lists, rows, s.domain.coefficients);
  });
  const std::vector<char> inside = inside_one_material(s);
  const auto counts = [&](int n) { return inside.empty() || inside[static_cast<std::size_t>(n)]; };
  const auto sum = [&](bool left_over) {
    return sum_over_parts(s, [&](int p) {
      const Part& part = s.domain.order.parts[static_cast<std::size_t>(p)];
      double part_sum = 0;
      for (std::int32_t e = part.edge_begin; e < part.edge_end; ++e) {
        const int a = edges.a[e], b = edges.b[e];
        if (b < a || !counts(a) || !counts(b)) continue;  // b < a: the other part's copy counts
        double d = rows.W[row::W * b + 3] - rows.W[row::W * a + 3], length2 = 0;
        for (int k = 0; k < 3; ++k) {
          const double D = rows.X[row::X * b + k] - rows.X[row::X * a + k];
          length2 += D * D;
          if (left_over) d -= 0.5 * D * (rows.G[row::G * a + 4 * k + 3] + rows.G[row::G * b + 4 * k + 3]);
        }
        part_sum += edge_size(edges, e) / std::sqrt(length2) * d * d;
      }
      return part_sum;
    });
  };
  const double all = sum(false);
  if (all > 0) return {std::sqrt(sum(true) / all), all};
  return {inside.empty() ? 0 : std::nan(""), 0};
}

std::vector<int> tets_around(const Mesh& mesh, int node) {
  std::vector<int> tets;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    if (std::find(mesh.tets[t].begin(), mesh.tets[t].end(), node) != mesh.tets[t].end())
      tets.push_back(static_cast<int>(t));
  return tets;
}

namespace {

std::string place(const Simulation& s, int node) {
  const Mesh& mesh = *s.domain.mesh;
  const std::vector<int> tets = tets_around(mesh, node);
  std::vector<std::string> regions;
  for (int t : tets) {
    const std::string& r = mesh.region_names[static_cast<std::size_t>(mesh.tet_region[static_cast<std::size_t>(t)])];
    if (std::find(regions.begin(), regions.end(), r) == regions.end()) regions.push_back(r);
  }
  const NodeState u = state_of(s, node);
  const Vec3& X = mesh.X[static_cast<std::size_t>(node)];
  return fmt::format(
      "node {} at X = ({:.6g}, {:.6g}, {:.6g}), x = ({:.6g}, {:.6g}, {:.6g}) m, det F = {:.6g}, J = {:.6g}, |v| = "
      "{:.6g} m/s, tets {}, region {}",
      node, X[0], X[1], X[2], u.x(0), u.x(1), u.x(2), u.detF(),
      evolves_J(s.domain.scene->physics.formulation) ? u.J() : u.detF(), norm(u.velocity()), fmt::join(tets, " "),
      fmt::join(regions, " "));
}

/// The cause as a word and in words; nothing where the row is sound.
std::pair<std::string_view, const char*> broken_by(const NodeState& u, bool with_J) {
  const double d = u.detF();
  if (!std::isfinite(d) || !std::isfinite(norm(u.velocity())))
    return {"not_finite", std::isfinite(d) ? "v is not finite" : "det F is not finite"};
  if (!(d > 0)) return {"detF", "det F is not positive"};
  if (with_J && std::isfinite(u.J()) && !(u.J() > 0)) return {"J", "J is not positive"};
  if (!std::isfinite(u.J())) return {"not_finite", with_J ? "J is not finite" : "the pressure is not finite"};
  return {"", nullptr};
}

}  // namespace

Breakdown locate_breakdown(const Simulation& s, int stage) {
  const bool with_J = evolves_J(s.domain.scene->physics.formulation);
  for (int node = 0; node < s.domain.order.nodes; ++node) {
    const auto [cause, why] = broken_by(state_of(s, node), with_J);
    if (why)
      return {node,
              fmt::format("{} in stage {} of step {}, t = {:.6e} s, dt = {:.3e} s: {}. A smaller time.cfl, a finer or "
                          "better shaped mesh there, or volumetric = \"barrier\" may help",
                          why, stage, s.state.step + 1, s.state.t + s.state.dt, s.state.dt, place(s, node)),
              cause};
  }
  return {-1,
          fmt::format("unphysical state in stage {} of step {}, t = {:.6e} s", stage, s.state.step + 1,
                      s.state.t + s.state.dt),
          "not_finite"};
}

Breakdown collapse(const Simulation& s, double allowed) {
  const auto worst = limiting_nodes(s, 1);
  return {worst[0].first,
          fmt::format("the step collapsed at step {}, t = {:.6e} s: dt = {:.3e} s is below time.dt_collapse = {:g} "
                      "times the first, {:.3e} s; set by {}",
                      s.state.step, s.state.t, allowed, s.domain.scene->time.dt_collapse, s.state.first_dt,
                      place(s, worst[0].first)),
          "dt_collapse"};
}

std::optional<std::string> energy_growth(Simulation& s) {
  const bool audited = s.domain.scene->monitor.energy;
  const Energies e = seen(s).energies;
  Books& l = s.books;
  const double given = l.external_work + l.angular_momentum_work, scale = energy_scale(s),
               excess = e.kinetic + e.strain - l.initial_energy - given;
  const double tolerance = audited ? s.domain.scene->monitor.energy_tolerance : 1;
  if (!(excess > tolerance * scale) || (!audited && excess < least_runaway * elastic_energy(s)))
    l.balanced_step = s.state.step;
  if (s.state.step - l.balanced_step < settling_steps) return std::nullopt;
  return fmt::format(
      "energy grew: at step {}, t = {:.6e} s, it exceeds initial energy and external work by {:.3g} of them "
      "({}); lower time.cfl",
      s.state.step, s.state.t, excess / scale,
      audited ? fmt::format("monitor.energy_tolerance = {:g}", tolerance) : "no sound run doubles them");
}

}  // namespace nanson
