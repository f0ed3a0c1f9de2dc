// Set-up of a simulation: dual, order, boundary, rows, initial state and its stress; and which nodes set the step.
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/compensated_sum.hpp"
#include "engine/initial.hpp"
#include "engine/material.hpp"
#include "engine/monitor.hpp"
#include "engine/parts.hpp"
#include "engine/solver.hpp"
#include "engine/time_function.hpp"

namespace nanson {
namespace {

constexpr double identity_tolerance = 1e-10;  // round-off on flat tets stays far below

Dual checked_dual(const Mesh& mesh) {
  Dual dual = make_dual(mesh);
  const DualDefects d = check_dual(mesh, dual);
  if (!(d.closure < identity_tolerance && d.volume < identity_tolerance && d.edge < identity_tolerance))
    throw std::runtime_error("the median dual of this mesh does not close: its tets are too flat for double precision");
  return dual;
}

Coefficients coefficients_of(const Scene& scene) {
  Coefficients k;
  k.material = constants_of(scene.material);
  k.material.parting = scene.physics.parting * k.material.mu;
  k.rho_cp = k.material.rho * k.material.cp;
  k.rho_cs = k.material.rho * k.material.cs;
  if (scene.physics.formulation == Formulation::pFp) k.rho_cp = k.rho_cs;  // the pressure waves are the projection's
  k.adjoint = scene.physics.boundary_flux == BoundaryFlux::adjoint;
  k.sweeps_J = scene.physics.stabilisation == Stabilisation::jst;
  k.deformed_metric = scene.physics.upwind_metric == UpwindMetric::deformed;
  for (int i = 0; i < 3; ++i) k.g[i] = scene.body_force[i];
  return k;
}

Vec3 centre_of_mass(const Simulation& s) {
  Vec3 sum{};
  double total = 0;
  for (std::size_t n = 0; n < s.volume.size(); ++n) {
    const double weight = s.mixture.empty() ? s.volume[n] : s.volume[n] * density(s, s.order.row_of[n]);
    total += weight;
    for (int k = 0; k < 3; ++k) sum[k] += weight * s.mesh->X[n][k];
  }
  return {sum[0] / total, sum[1] / total, sum[2] / total};
}

void set_initial_state(Simulation& s) {
  const Vec3 centre = centre_of_mass(s), middle = middle_of_box(*s.mesh);
  for (int n = 0; n < s.order.nodes; ++n) {
    const PointState p = initial_state(*s.scene, middle, s.mesh->X[static_cast<std::size_t>(n)], centre);
    const std::size_t r = static_cast<std::size_t>(s.order.row_of[static_cast<std::size_t>(n)]);
    double* U = &s.state.U[0][row::U * r];
    Tensor<double> F;
    for (int k = 0; k < 3; ++k) {
      U[k] = p.v[k];
      U[4 * (k + 1) + 3] += p.u[k];
      for (int I = 0; I < 3; ++I) U[4 * (I + 1) + k] = F[k][I] = p.F[k][I];
    }
    U[3] = s.scene->physics.formulation == Formulation::pFp ? 0.0
                                                            : initial_J(*s.scene, p.F);  // undeformed: no pressure
    if (s.state.H[0].empty()) continue;
    const Tensor<double> H = cofactor(F);
    for (int m = 0; m < 9; ++m) s.state.H[0][row::H * r + 4 * (m / 3) + m % 3] = H[m % 3][m / 3];
  }
}

/// Held directions take their prescribed velocity at t = 0; what kinetic energy that removes is kept for the report.
void constrain_start(Simulation& s) {
  for (const Constraint& h : s.boundary.constraints) {
    double* v = &s.state.U[0][static_cast<std::size_t>(row::U * h.node)];
    const double mass = density(s, h.node) / s.state.X[static_cast<std::size_t>(row::X * h.node + 3)];
    const double before = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    for (int m = 0; m < h.count; ++m) {
      double wanted = 0;
      for (int i = 0; i < 3; ++i)
        if (h.weight[m][i] != 0)
          wanted += h.weight[m][i] * value_at(s.boundary.conditions[static_cast<std::size_t>(h.source[m][i])].time, 0);
      const double change = wanted - (v[0] * h.d[m][0] + v[1] * h.d[m][1] + v[2] * h.d[m][2]);
      for (int k = 0; k < 3; ++k) v[k] += change * h.d[m][k];
    }
    s.ledger.lost_at_start += 0.5 * mass * (before - (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
  }
}

Rows start_rows(const Simulation& s, int to) {
  State& u = const_cast<State&>(s.state);
  Rows r{};
  r.X = u.X.data();
  r.U_new = u.U[0].data();
  r.H_new = u.H[0].data();
  r.W_new = u.W[to].data();
  r.PH_new = u.PH[to].data();
  r.plastic = u.plastic.data();
  return r;
}

void open_ledger(Simulation& s) {
  Ledger& l = s.ledger;
  CompensatedSum volume, mass;
  for (std::size_t n = 0; n < s.volume.size(); ++n) {
    volume += s.volume[n];
    mass += s.volume[n] * density(s, s.order.row_of[n]);
  }
  l.volume = volume;
  l.mass = s.mixture.empty() ? volume * s.coefficients.material.rho : mass;
  const Energies e = energies(s);
  const Momenta m = momenta(s);
  l.initial_energy = e.kinetic + e.strain;
  l.initial_fallen = e.fallen;
  l.initial_momentum = m.linear;
  l.initial_angular_momentum = m.angular;
}

/// Boundary, rows and everything else that the physics carries.
void allocate(Simulation& s, Dual dual, const NodeMaterials& materials) {
  const Scene& scene = *s.scene;
  const Mesh& mesh = *s.mesh;
  s.boundary = make_boundary(scene, mesh, s.order);
  s.state = make_state(scene, mesh, std::move(dual), s.order, s.boundary);
  s.mixture = make_mixture(scene, materials, s.order, s.state.step_length);
  s.functions = find_part_functions(scene.physics, scene.material, s.mixture.materials(), scene.monitor.energy);
  s.lagged_functions = find_part_functions(scene.physics, scene.material, s.mixture.materials(), scene.monitor.energy,
                                           true);
  s.coefficients = coefficients_of(scene);
  s.coefficients.streams = s.order.nodes >= streaming_nodes;
  s.manufactured = make_manufactured(scene, mesh, s.order);
  s.current = make_current_geometry(scene.physics.description, mesh, s.order);
  s.projection = make_projection(scene, s.order, s.boundary, s.state.X, s.coefficients.material);
  if (scene.monitor.geometry != GeometryWatch::off) s.tets = make_tets(mesh, s.order, s.state.X);
  s.reports.resize(s.order.parts.size());
  s.part_sums.resize(s.order.parts.size());
  s.part_rows.resize(s.order.parts.size());
  s.acceleration.assign(scene.boundary.size(), 0.0);
  s.scratch.resize(static_cast<std::size_t>(s.threads));
#pragma omp parallel for schedule(static) num_threads(s.threads)  // each by its own thread
  for (int t = 0; t < s.threads; ++t)
    s.scratch[static_cast<std::size_t>(t)].assign(std::max(part_scratch(s.order), mixture_scratch(s.order.most_nodes)),
                                                  0.0);
}

void start(Simulation& s) {
  set_initial_state(s);
  constrain_start(s);
  const Rows rows = start_rows(s, s.state.now);
  for_parts(s, [&](int p, Scratch scratch) {
    s.reports[static_cast<std::size_t>(p)] = stress_of_part(s, p, rows, s.coefficients, scratch);
  });
  open_ledger(s);
  if (s.scene->monitor.involutions) s.initial_mismatch = gradient_mismatch(s);
}

}  // namespace

Simulation make_simulation(const Scene& scene, const Mesh& mesh, int threads) {
  Simulation s;
  s.scene = &scene;
  s.mesh = &mesh;
  s.threads = std::max(1, threads);
  omp_set_num_threads(s.threads);  // of the threads that place large arrays
  Dual dual;
  s.setup.time("dual", [&] { dual = checked_dual(mesh); });
  NodeMaterials materials;
  s.setup.time("order", [&] {
    materials = node_materials(scene, mesh);
    s.order = make_order(dual, static_cast<int>(mesh.X.size()), true, materials.group);
  });
  s.setup.add("order", -s.order.metis_s);
  s.setup.add("metis", s.order.metis_s);
  s.volume = dual.volume;
  s.edges = static_cast<long>(dual.edges.size());
  s.setup.time("state", [&] { allocate(s, std::move(dual), materials); });
  s.setup.time("initial", [&] { start(s); });
  return s;
}

double bytes_per_node(const Simulation& s) {
  return bytes_per_node(s.state, s.order)
         + static_cast<double>(projection_bytes(s.projection) + current_geometry_bytes(s.current)
                               + mixture_bytes(s.mixture, s.order))
               / s.order.nodes;
}

std::vector<std::pair<int, double>> limiting_nodes(const Simulation& s, int count) {
  std::vector<std::pair<int, double>> steps;
  const int spare = s.state.W[1].empty() ? 0 : 1 - s.state.now;  // pFp keeps one set of rows
  const Rows rows = start_rows(
      s, spare);  // evaluates the present stress again, into the rows that the next stage overwrites
  Aligned<double> length(8, 1e300), scratch(mixture_scratch(8), 0.0);
  for (int n = 0; n < s.order.rows; ++n) {
    const int node = s.order.node_of[static_cast<std::size_t>(n)];
    if (node < 0) continue;
    Part eight{};
    eight.node_begin = n / 8 * 8;
    eight.node_end = eight.node_begin + 8;
    length[static_cast<std::size_t>(n % 8)] = s.state.step_length[static_cast<std::size_t>(n)];
    const double* lengths = length.data() - eight.node_begin;
    const PartReport report = s.mixture.empty() ? s.functions.stress(eight, rows, s.coefficients, lengths)
                                                : mixed_stress(s.mixture,
                                                               {eight.node_begin, eight.node_end, 8,
                                                                s.mixture.group[static_cast<std::size_t>(n)]},
                                                               rows, s.coefficients, lengths, scratch.data());
    steps.emplace_back(node, s.scene->time.cfl / report.fastest);
    length[static_cast<std::size_t>(n % 8)] = 1e300;
  }
  const auto keep = std::min(steps.size(), static_cast<std::size_t>(count));
  std::partial_sort(
      steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(keep), steps.end(),
      [](const auto& p, const auto& q) { return p.second < q.second || (p.second == q.second && p.first < q.first); });
  steps.resize(keep);
  return steps;
}

}  // namespace nanson
