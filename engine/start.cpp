// The initial state with its supports, its stress, and what the books start from.
#include "engine/start.hpp"

#include <omp.h>

#include <algorithm>

#include "engine/compensated_sum.hpp"
#include "engine/forces.hpp"
#include "engine/initial.hpp"
#include "engine/monitor.hpp"
#include "engine/parts.hpp"
#include "engine/time_function.hpp"

namespace nanson {
namespace {

Vec3 centre_of_mass(const Domain& d) {
  Vec3 sum{};
  double total = 0;
  for (std::size_t n = 0; n < d.volume.size(); ++n) {
    const double weight = d.mixture.empty() ? d.volume[n] : d.volume[n] * density(d, d.order.row_of[n]);
    total += weight;
    for (int k = 0; k < 3; ++k) sum[k] += weight * d.mesh->X[n][k];
  }
  return {sum[0] / total, sum[1] / total, sum[2] / total};
}

void set_initial_state(const Domain& d, State& s) {
  const Vec3 centre = centre_of_mass(d);
  const Extent box = extent_of(*d.mesh);
  for (int n = 0; n < d.order.nodes; ++n) {
    const PointState p = initial_state(*d.scene, box, d.mesh->X[static_cast<std::size_t>(n)], centre);
    const int r = d.order.row_of[static_cast<std::size_t>(n)];
    const auto u = state_of_row(s.U[0].data(), r);
    for (int k = 0; k < 3; ++k) {
      u.v(k) = p.v[k];
      u.x(k) += p.u[k];
      for (int I = 0; I < 3; ++I) u.F(k, I) = p.F[k][I];
    }
    u.J() = d.scene->physics.formulation == Formulation::pFp ? 0.0 : initial_J(*d.scene, p.F);  // no pressure
    if (s.H[0].empty()) continue;
    const Tensor<double> H = cofactor(u.gradient());
    for (int m = 0; m < 9; ++m) s.H[0][static_cast<std::size_t>(row::H * r + 4 * (m / 3) + m % 3)] = H[m % 3][m / 3];
  }
}

/// Held directions take their prescribed velocity at t = 0. Returns the kinetic energy that this removes [J].
double constrain_start(const Domain& d, State& s) {
  double lost = 0;
  for (const Constraint& h : d.boundary.constraints) {
    const auto u = state_of_row(s.U[0].data(), h.node);
    const double before = dot(u.velocity(), u.velocity());
    for (int m = 0; m < h.count; ++m) {
      double wanted = 0;
      for (int i = 0; i < 3; ++i)
        if (h.weight[m][i] != 0)
          wanted += h.weight[m][i] * value_at(d.boundary.conditions[static_cast<std::size_t>(h.source[m][i])].time, 0);
      const double change = wanted - (u.v(0) * h.d[m][0] + u.v(1) * h.d[m][1] + u.v(2) * h.d[m][2]);
      for (int k = 0; k < 3; ++k) u.v(k) += change * h.d[m][k];
    }
    lost += 0.5 * mass(d, h.node) * (before - dot(u.velocity(), u.velocity()));
  }
  return lost;
}

void open_books(Simulation& s) {
  const Domain& d = s.domain;
  Books& b = s.books;
  CompensatedSum volume, mass;
  for (std::size_t n = 0; n < d.volume.size(); ++n) {
    volume += d.volume[n];
    mass += d.volume[n] * density(d, d.order.row_of[n]);
  }
  b.volume = volume;
  b.mass = d.mixture.empty() ? volume * d.coefficients.material.rho : mass;
  const Energies e = energies(s);
  const Momenta m = momenta(s);
  b.initial_energy = e.kinetic + e.strain;
  b.initial_momentum = m.linear;
  b.initial_angular_momentum = m.angular;
}

void place_scratch(const Domain& d, Team& team) {
  team.part_sums.resize(d.order.parts.size());
  team.part_rows.resize(d.order.parts.size());
  team.scratch.resize(static_cast<std::size_t>(team.threads));
  const std::size_t size = std::max(part_scratch(d.order), mixture_scratch(d.order.most_nodes));
#pragma omp parallel for schedule(static) num_threads(team.threads)  // each by its own thread
  for (int t = 0; t < team.threads; ++t) team.scratch[static_cast<std::size_t>(t)].assign(size, 0.0);
}

}  // namespace

void find_stress(Simulation& s) {
  State& u = s.state;
  Rows rows = stage_rows(s.domain, u, 0, 0);
  rows.W_new = u.W[u.now].data();
  rows.PH_new = u.PH[u.now].data();
  for_parts(s, [&](int p, Scratch scratch) {
    u.reports[static_cast<std::size_t>(p)] = stress_of_part(s.domain, p, rows, s.domain.coefficients, scratch);
  });
}

Team make_team(int threads) {
  Team team;
  team.threads = std::max(1, threads);
  omp_set_num_threads(team.threads);  // of the threads that place large arrays
  return team;
}

Simulation start(Domain domain, Team team) {
  Simulation s{std::move(domain), {}, {}, std::move(team), {}, {}, {}};
  s.team.setup.time("state", [&] {
    s.state = make_state(s.domain);
    place_scratch(s.domain, s.team);
  });
  s.team.setup.time("initial", [&] {
    set_initial_state(s.domain, s.state);
    s.books.lost_at_start = constrain_start(s.domain, s.state);
    find_stress(s);
    if (s.domain.scene->physics.tet_barrier > 0) watch_tets(s);  // their energy is asked for before the first step
    open_books(s);
    find_forces(s, s.state.U[0].data(), 0, true);
    if (s.domain.scene->monitor.involutions) s.state.initial_mismatch = gradient_mismatch(s);
  });
  return s;
}

Simulation make_simulation(const Scene& scene, const Mesh& mesh, int threads) {
  Team team = make_team(threads);
  Domain domain = make_domain(scene, mesh, team.setup);
  return start(std::move(domain), std::move(team));
}

}  // namespace nanson
