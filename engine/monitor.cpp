// Energies, momenta and the energy audit: sums over parts in a fixed order.
#include "engine/monitor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/angular_momentum.hpp"
#include "engine/parts.hpp"
#include "engine/step_bound.hpp"

namespace nanson {
namespace {

/// Sums over the nodes (padding left out) of what add(U row, mass, sums) adds, part by part.
template <std::size_t count, class Add>
std::array<double, count> sums_over_nodes(const Simulation& s, Add add) {
  return sums_over_parts<count>(s, [&](int p, double* sums) {
    const Part& part = s.domain.order.parts[static_cast<std::size_t>(p)];
    for (int n = part.node_begin; n < part.node_begin + nodes_of(s.domain, part); ++n)
      if (!is_padding(s.domain, n)) add(&s.state.U[0][static_cast<std::size_t>(row::U * n)], mass(s.domain, n), sums);
  });
}

/// What energies are compared with [J]: a body that starts at rest has no initial energy.
double energy_scale(const Simulation& s) { return std::max(s.books.initial_energy, s.books.largest_work); }

/// Energy of strains of size one [J], that noise is compared with.
double elastic_energy(const Simulation& s) { return s.domain.coefficients.material.mu * s.books.volume; }
constexpr double least_runaway = 1e-16;  // [-] of it, strains of 1e-8: less is the round-off of a body at rest

constexpr long settling_steps =
    20;  // a load that starts from nothing does work as small as its error in the first of them

double position(const double* U, int k) { return U[4 * (k + 1) + 3]; }
double norm3(double x, double y, double z) { return std::sqrt(x * x + y * y + z * z); }

double detF(const double* U) {
  Tensor<double> F;
  for (int m = 0; m < 9; ++m) F[m % 3][m / 3] = U[4 * (m / 3 + 1) + m % 3];
  return determinant(F, cofactor(F));
}

}  // namespace

Energies energies(const Simulation& s) {
  const Rows rows = present_rows(s.domain, s.state);
  Energies e;
  const Vec3& g = s.domain.scene->body_force;
  const auto sums = sums_over_nodes<2>(s, [&](const double* U, double m, double* sum) {
    sum[0] += 0.5 * m * (U[0] * U[0] + U[1] * U[1] + U[2] * U[2]);
    sum[1] += m * (g[0] * position(U, 0) + g[1] * position(U, 1) + g[2] * position(U, 2));
  });
  e.kinetic = sums[0];
  e.fallen = sums[1];
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
  return e;
}

Momenta momenta(const Simulation& s) {
  const auto sum = sums_over_nodes<8>(s, [](const double* U, double mass, double* out) {
    const double speed = norm3(U[0], U[1], U[2]);
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      out[k] += mass * U[k];
      out[3 + k] += mass * (position(U, i) * U[j] - position(U, j) * U[i]);
    }
    out[6] += mass * speed;
    out[7] += mass * speed * norm3(position(U, 0), position(U, 1), position(U, 2));
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
  if (!s.domain.manufactured.waves.empty())
    return std::numeric_limits<double>::quiet_NaN();  // the impulse of its body force is not booked
  const Momenta m = momenta(s);
  const Books& l = s.books;
  const double d = norm3(m.linear[0] - l.initial_momentum[0] - l.impulse[0],
                         m.linear[1] - l.initial_momentum[1] - l.impulse[1],
                         m.linear[2] - l.initial_momentum[2] - l.impulse[2]);
  return m.linear_scale > 0 ? d / m.linear_scale : 0;
}

std::optional<double> angular_momentum_drift(const Simulation& s) {
  const Vec3& g = s.domain.scene->body_force;
  if (!s.domain.manufactured.waves.empty()) return std::nullopt;
  const bool free = s.domain.boundary.constraints.empty() && s.domain.boundary.loaded.empty() && g[0] == 0 && g[1] == 0
                    && g[2] == 0;
  if (!free && s.domain.scene->time.integrator != Integrator::tvd_rk2) return std::nullopt;
  const Momenta m = momenta(s);
  const Vec3 &L = s.books.initial_angular_momentum, &I = s.books.angular_impulse;
  return m.angular_scale > 0 ? norm3(m.angular[0] - L[0] - I[0], m.angular[1] - L[1] - I[1], m.angular[2] - L[2] - I[2])
                                   / m.angular_scale
                             : 0;
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

namespace {

/// Power -sum p (S + theta-term) that the pressure's stabilisation and the drift control take [W]: p and S of the stage's start, the drift of the last projection.
double pressure_stabilisation_power(Simulation& s, const Rows& rows) {
  const Aligned<double>& taken = s.state.projection.taken[rows.U_stage == s.state.U[0].data() ? 0 : 1];
  return -sum_over_parts(s, [&](int p) {
    const Part& part = s.domain.projection.parts[static_cast<std::size_t>(p)];
    double sum = 0;
    for (int n = part.node_begin; n < part.node_end; ++n) {
      const std::size_t i = static_cast<std::size_t>(n);
      sum += rows.W[row::W * n + 3] * (taken[i] + (s.state.projection.fixed[i] - s.state.projection.lag[i]));
    }
    return sum;
  });
}

}  // namespace

void book_loads(Simulation& s, const Rows& rows, double weighted_dt) {
  double power = 0;
  for (std::size_t slot = 0; slot < s.domain.boundary.slot_nodes.size(); ++slot)
    for (int n : s.domain.boundary.slot_nodes[slot])
      for (int k = 0; k < 3; ++k)
        power += s.state.loads[4 * slot + static_cast<std::size_t>(k)] * rows.W[row::W * n + k];
  s.books.external_work += weighted_dt * power;
}

void audit_stage(Simulation& s, const Rows& rows, double weighted_dt) {
  s.books.dissipated += weighted_dt * tree_sum(s.team.part_sums);
  if (s.domain.scene->physics.formulation == Formulation::pFp)
    s.books.dissipated += weighted_dt * pressure_stabilisation_power(s, rows);
  const Vec3& g = s.domain.scene->body_force;
  if (g[0] == 0 && g[1] == 0 && g[2] == 0) return;
  s.books.external_work += weighted_dt * sum_over_parts(s, [&](int p) {
                             const Part& part = s.domain.order.parts[static_cast<std::size_t>(p)];
                             double sum = 0;
                             for (int n = part.node_begin; n < part.node_begin + nodes_of(s.domain, part);
                                  ++n) {  // padding falls too
                               if (is_padding(s.domain, n)) continue;
                               const double* v = rows.W + row::W * n;
                               sum += mass(s.domain, n) * (g[0] * v[0] + g[1] * v[1] + g[2] * v[2]);
                             }
                             return sum;
                           });
}

void book_stage(Simulation& s, const double* arms, double mean, bool first) {
  Books& l = s.books;
  const double dt = mean * s.state.dt;
  if (!s.domain.boundary.constraints.empty()) {
    const auto sum = sums_over_parts<4>(s, [&](int p, double* out) {
      const Part& part = s.domain.order.parts[static_cast<std::size_t>(p)];
      for (int i = part.constraint_begin; i < part.constraint_end; ++i) {
        const Constraint& h = s.domain.boundary.constraints[static_cast<std::size_t>(i)];
        const double* R = &s.state.reactions[static_cast<std::size_t>(reaction_row * i)];
        double* average = &s.state.mean_reactions[static_cast<std::size_t>(reaction_row * i)];
        for (int m = 0; m < reaction_row; ++m) average[m] = (first ? 0 : average[m]) + mean * R[m];
        for (int m = 0; m < h.count; ++m)
          for (int k = 0; k < 3; ++k) out[k] += R[m] * h.d[m][k];
        out[3] += R[3];
      }
    });
    for (int k = 0; k < 3; ++k) l.impulse[k] += dt * sum[k];
    l.external_work += dt * sum[3];
  }
  for (int k = 0; k < 3; ++k) l.impulse[k] += dt * l.mass * s.domain.scene->body_force[k];
  l.largest_work = std::max(l.largest_work, std::abs(l.external_work));
  if (s.domain.scene->time.integrator != Integrator::tvd_rk2) return;
  const Vec3 torque = external_torque(s, arms, {});
  for (int k = 0; k < 3; ++k) l.angular_impulse[k] += dt * torque[k];
}

void book_plastic_work(Simulation& s) {
  for (std::size_t p = 0; p < s.state.reports.size(); ++p) s.team.part_sums[p] = s.state.reports[p].plastic_work;
  s.books.dissipated += tree_sum(s.team.part_sums);
}

Vec3 reaction(const Simulation& s, int face) {
  Vec3 sum{};
  for (std::size_t i = 0; i < s.domain.boundary.constraints.size(); ++i) {
    const Constraint& h = s.domain.boundary.constraints[i];
    for (int m = 0; m < h.count; ++m)
      for (int k = 0; k < 3 && h.face[m] == face; ++k)
        sum[k] += s.state.mean_reactions[reaction_row * i + static_cast<std::size_t>(m)] * h.d[m][k];
  }
  return sum;
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
  const double* U =
      &s.state.U[0][static_cast<std::size_t>(row::U * s.domain.order.row_of[static_cast<std::size_t>(node)])];
  const Vec3& X = mesh.X[static_cast<std::size_t>(node)];
  return fmt::format(
      "node {} at X = ({:.6g}, {:.6g}, {:.6g}), x = ({:.6g}, {:.6g}, {:.6g}) m, det F = {:.6g}, J = {:.6g}, |v| = "
      "{:.6g} m/s, tets {}, region {}",
      node, X[0], X[1], X[2], position(U, 0), position(U, 1), position(U, 2), detF(U),
      evolves_J(s.domain.scene->physics.formulation) ? U[3] : detF(U), norm3(U[0], U[1], U[2]), fmt::join(tets, " "),
      fmt::join(regions, " "));
}

/// The cause as a word and in words; nothing where the row is sound.
std::pair<std::string_view, const char*> broken_by(const double* U, bool with_J) {
  const double d = detF(U);
  if (!std::isfinite(d) || !std::isfinite(norm3(U[0], U[1], U[2])))
    return {"not_finite", std::isfinite(d) ? "v is not finite" : "det F is not finite"};
  if (!(d > 0)) return {"detF", "det F is not positive"};
  if (with_J && std::isfinite(U[3]) && !(U[3] > 0)) return {"J", "J is not positive"};
  if (!std::isfinite(U[3])) return {"not_finite", with_J ? "J is not finite" : "the pressure is not finite"};
  return {"", nullptr};
}

}  // namespace

Breakdown locate_breakdown(const Simulation& s, int stage) {
  const bool with_J = evolves_J(s.domain.scene->physics.formulation);
  for (int node = 0; node < s.domain.order.nodes; ++node) {
    const double* U =
        &s.state.U[0][static_cast<std::size_t>(row::U * s.domain.order.row_of[static_cast<std::size_t>(node)])];
    const auto [cause, why] = broken_by(U, with_J);
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
  const double given = l.external_work + l.angular_momentum_work + (audited ? 0 : e.fallen - l.initial_fallen);
  if (!audited) l.largest_work = std::max(l.largest_work, std::abs(given));
  const double scale = energy_scale(s), excess = e.kinetic + e.strain - l.initial_energy - given;
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
