// Small problems for the tests of the scheme, and a way to its rows and rates.
#pragma once
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/book_stage.hpp"
#include "engine/current_areas.hpp"
#include "engine/fields.hpp"
#include "engine/monitor.hpp"
#include "engine/parts.hpp"
#include "engine/solver.hpp"

namespace nanson::method {

inline Mesh mesh_of(RawMesh raw) {
  std::vector<std::string> errors;
  Mesh mesh = finish_mesh(std::move(raw), errors);
  if (!errors.empty()) throw std::runtime_error(errors[0]);
  return mesh;
}

/// A scene with its mesh. Simulations point into both.
struct Problem {
  Scene scene;
  Mesh mesh;

  explicit Problem(const Scene& s) : scene(s), mesh(mesh_of(make_box(s.mesh))) {}
  Problem(const Scene& s, Mesh m) : scene(s), mesh(std::move(m)) {}
  Simulation start(int threads = 1) const { return make_simulation(scene, mesh, threads); }
  /// With constants that no scene has: change(domain) before it starts.
  template <class Change>
  Simulation start_changed(Change change) const {
    Team team = make_team(1);
    Domain domain = make_domain(scene, mesh, team.setup);
    change(domain);
    return nanson::start(std::move(domain), std::move(team));
  }
};

inline BoundarySpec condition(std::vector<std::string> faces, BoundaryKind kind) {
  BoundarySpec b;
  for (auto& f : faces) b.faces.push_back({std::move(f), "test"});
  b.kind = kind;
  return b;
}

/// Soft neo-Hookean bar, 1 x 1 x 2 m around the z axis, moved nodes, free everywhere, twisted: rotates and deforms by some 20 %.
/// The cells are such that some rows are padding.
inline Scene free_bar(int n, double nu = 0.3) {
  Scene s;
  s.name = "free_bar";
  s.mesh.origin = {-0.5, -0.5, 0};
  s.mesh.size = {1, 1, 2};
  s.mesh.cells = {n, n + 1, 2 * n};
  s.mesh.perturb = 0.2;
  s.material.density = 1100;
  s.material.youngs_modulus = 17e6;
  s.material.poissons_ratio = nu;
  s.initial.field = InitialField::twist;
  s.initial.twist_omega = 60;
  s.initial.height = 2;
  s.time.end = 0.05;
  return s;
}

/// The paper's twisting column (section 6.5): Z = 0 fixed.
inline Scene column(int n, double nu = 0.495) {
  Scene s;
  s.name = "twisting_column";
  s.mesh.origin = {-0.5, -0.5, 0};
  s.mesh.size = {1, 1, 6};
  s.mesh.cells = {n, n, 6 * n};
  s.material.density = 1100;
  s.material.youngs_modulus = 17e6;
  s.material.poissons_ratio = nu;
  s.initial.field = InitialField::twist;
  s.initial.twist_omega = 105;
  s.initial.height = 6;
  s.boundary = {condition({"zmin"}, BoundaryKind::fixed)};
  s.time.end = 0.1;
  return s;
}

/// The paper's low dispersion cube (section 6.1), as the prototype ran it (method, section 13).
inline Scene cube(int n, Split split = Split::kuhn) {
  Scene s;
  s.name = "low_dispersion_cube";
  s.mesh.size = {1, 1, 1};
  s.mesh.cells = {n, n, n};
  s.mesh.split = split;
  s.material.law = Law::linear_elastic;
  s.material.density = 1100;
  s.material.youngs_modulus = 17e6;
  s.material.poissons_ratio = 0.45;
  s.initial.field = InitialField::standing_wave;
  s.initial.amplitude = 5e-4;
  s.initial.J = InitialJ::det;
  s.boundary = {condition({"xmin", "ymin", "zmin"}, BoundaryKind::symmetric),
                condition({"xmax", "ymax", "zmax"}, BoundaryKind::skew_symmetric)};
  s.time.end = 0.002;
  s.time.step = StepRule::paper;
  return s;
}

/// Every kind of support and load at once, on a bar that starts with a twist.
inline Scene loaded_bar(int n) {
  Scene s = free_bar(n);
  s.name = "loaded_bar";
  s.boundary = {condition({"zmin"}, BoundaryKind::fixed), condition({"xmin"}, BoundaryKind::symmetric),
                condition({"ymax"}, BoundaryKind::traction), condition({"xmax"}, BoundaryKind::pressure),
                condition({"zmax"}, BoundaryKind::velocity)};
  s.boundary[2].traction = {2e5, -1e5, 3e5};
  s.boundary[3].pressure = 4e5;
  s.boundary[3].time.kind = TimeKind::ramp;
  s.boundary[3].time.until = 0.01;
  s.boundary[4].velocity = {0, 3, -6};
  s.boundary[4].held = {false, true, true};
  s.boundary[4].time.kind = TimeKind::sine;
  s.boundary[4].time.frequency = 30;
  s.boundary[4].time.phase = 0.3;
  s.body_force = {3, -5, -9.81};
  return s;
}

inline constexpr std::array formulations{Formulation::pF, Formulation::pFJ, Formulation::pFHJ};
inline constexpr std::array corrections{FluxCorrection::none, FluxCorrection::pressure, FluxCorrection::full};
inline constexpr std::array integrators{Integrator::tvd_rk2, Integrator::ssp_rk3};

/// Every row that some physics carries.
inline std::vector<Scene> scenes_with_all_rows() {
  std::vector<Scene> all;
  const auto add = [&](auto change) {
    Scene scene = loaded_bar(3);
    scene.monitor.energy = true;
    change(scene);
    all.push_back(scene);
  };
  for (auto correction : corrections)
    for (auto integrator : integrators)
      add([&](Scene& s) {
        s.physics.flux_correction = correction;
        s.time.integrator = integrator;
      });
  add([](Scene& s) { s.physics.formulation = Formulation::pFHJ; });
  add([](Scene& s) { s.physics.reconstruction = Reconstruction::limited; });
  add([](Scene& s) { s.physics.pressure_jump = PressureJump::tensor; });
  add([](Scene& s) { s.physics.keep_angular_momentum = true; });
  add([](Scene& s) { s.physics.formulation = Formulation::pFp; });
  for (auto description : {Description::updated, Description::pseudo_updated})
    add([&](Scene& s) { s.physics.description = description; });
  add([](Scene& s) {
    s.physics.stabilisation = Stabilisation::jst;
    s.monitor.energy = false;
  });
  add([](Scene& s) {
    s.material.law = Law::hencky_j2;
    s.material.yield_stress = 1e5;
    s.material.hardening_modulus = 1e6;
  });
  return all;
}

/// Every flux that is built: formulations x (constant; linear with no, pressure, full correction), and the tensor pressure jump where J is evolved.
inline std::vector<PhysicsSpec> every_physics() {
  std::vector<PhysicsSpec> all;
  for (auto formulation : formulations)
    for (auto jump : {PressureJump::scalar, PressureJump::tensor}) {
      if (jump == PressureJump::tensor && formulation == Formulation::pF) continue;
      PhysicsSpec p;
      p.formulation = formulation;
      p.pressure_jump = jump;
      p.reconstruction = Reconstruction::constant;
      all.push_back(p);
      p.reconstruction = Reconstruction::linear;
      for (auto correction : corrections) {
        p.flux_correction = correction;
        all.push_back(p);
      }
    }
  return all;
}

inline std::string name(const PhysicsSpec& p) {
  return std::string(word(p.formulation)) + " " + std::string(word(p.reconstruction)) + " "
         + std::string(word(p.flux_correction)) + " " + std::string(word(p.pressure_jump)) + " "
         + std::string(word(p.boundary_flux)) + " " + std::string(word(p.upwind_metric));
}

/// Steps of a fixed size.
inline void march(Simulation& s, double dt, int steps) {
  for (int i = 0; i < steps; ++i) {
    s.state.dt = dt;
    advance(s);
  }
}

/// Steps of the scene's rule, without its end.
inline void march(Simulation& s, int steps) {
  for (int i = 0; i < steps; ++i) {
    s.state.dt = allowed_step(s);
    advance(s);
  }
}

/// Runs to the end; the status.
inline std::string run_quietly(Simulation& s) {
  std::string reason;
  return run(s, {}, reason);
}

inline double* U_of(Simulation& s, int node) { return &s.state.U[0][row::U * s.domain.order.row_of[node]]; }

/// Takes a state that a test wrote into the rows: its stress, step bound and ledger.
inline void adopt_state(Simulation& s) {
  Rows r{};
  r.X = s.domain.X.data();
  r.U_new = s.state.U[0].data();
  r.H_new = s.state.H[0].data();
  r.W_new = s.state.W[s.state.now].data();
  r.PH_new = s.state.PH[s.state.now].data();
  r.detF = s.state.barrier.detF.data();
  for (std::size_t p = 0; p < s.domain.order.parts.size(); ++p)
    s.state.reports[p] = stress_of_part(s.domain, static_cast<int>(p), r, s.domain.coefficients, scratch_of(s, 0));
  s.state.has_lagged_correction = false;
  if (!s.state.barrier.parts.empty()) watch_tets(s);
  const Energies e = energies(s);
  const Momenta m = momenta(s);
  s.books.initial_energy = e.kinetic + e.strain;
  s.books.initial_momentum = m.linear;
  s.books.initial_angular_momentum = m.angular;
}

/// x = F X everywhere, J and H as F says; the velocities stay.
inline void deform(Simulation& s, const Tensor<double>& F) {
  const Tensor<double> H = cofactor(F);
  for (int n = 0; n < s.domain.order.nodes; ++n) {
    double* U = U_of(s, n);
    const Vec3& X = s.domain.mesh->X[n];
    U[3] = determinant(F, H);
    for (int i = 0; i < 3; ++i) {
      U[4 * (i + 1) + 3] = F[i][0] * X[0] + F[i][1] * X[1] + F[i][2] * X[2];
      for (int I = 0; I < 3; ++I) U[4 * (I + 1) + i] = F[i][I];
    }
    if (s.state.H[0].empty()) continue;
    for (int m = 0; m < 9; ++m) s.state.H[0][row::H * s.domain.order.row_of[n] + 4 * (m / 3) + m % 3] = H[m % 3][m / 3];
  }
  adopt_state(s);
}

/// Adds the same velocity to every node.
inline void push(Simulation& s, const Vec3& v) {
  for (int n = 0; n < s.domain.order.nodes; ++n)
    for (int k = 0; k < 3; ++k) U_of(s, n)[k] += v[k];
  adopt_state(s);
}

/// Power that the stabilisation takes out of the rows W and PH as they stand [W]; leaves their gradients in the state.
inline double dissipated_power(Simulation& s) {
  const PartFunctions functions = find_part_functions(s.domain.scene->physics, s.domain.scene->material, true,
                                                      s.state.has_lagged_correction);
  const Rows rows = stage_rows(s.domain, s.state, 0, 0);
  const auto edges = s.domain.order.edges();
  const auto corners = s.domain.order.corners();
  const auto lists = s.domain.order.lists();
  for (const Part& part : s.domain.order.parts)
    functions.gradient(part, edges, corners, lists, rows, s.domain.coefficients);
  Coefficients k = s.domain.coefficients;
  k.edge.audits = true;
  double power = 0;
  for (const Part& part : s.domain.order.parts)
    power += functions.edge_flux(part, flux_edges(s), flux_corners(s), lists, rows, k, scratch_of(s, 0));
  return power;
}

/// Rates of the rows W and PH as they stand, with the loads as they stand: dU/dt in rows of U, and the uncorrected gradient G. Crushed tets add to PH.
struct Rates {
  Aligned<double> U, G;
};

inline Rates rates(Simulation& s) {
  const std::size_t count = s.domain.order.rows;
  State& u = s.state;
  Rates out{Aligned<double>(row::U * count, 0.0), Aligned<double>(row::G * count, 0.0)};
  Aligned<double> H(u.H[0].size(), 0.0);
  Coefficients k = s.domain.coefficients;
  k.old_weight = 0;
  k.stage_weight = 0;
  k.dt = 1;
  k.acceleration = s.state.acceleration.data();
  Rows rows = stage_rows(s.domain, u, 0, 0);
  if (!u.barrier.parts.empty()) rows.crushing = resist_crushing(s, rows);
  find_current_areas(s, rows.U_stage);
  rows.G = out.G.data();
  rows.U_new = out.U.data();
  rows.H_new = H.data();
  rows.W_new = nullptr;
  const auto edges = s.domain.order.edges();
  const auto corners = s.domain.order.corners();
  const auto lists = s.domain.order.lists();
  const Scratch scratch = scratch_of(s, 0);
  for (const Part& part : s.domain.order.parts) s.domain.functions.gradient(part, edges, corners, lists, rows, k);
  if (s.domain.functions.corrects_stress) rows.PH = rows.PH_new;
  for (const Part& part : s.domain.order.parts) {
    s.domain.functions.edge_flux(part, flux_edges(s), flux_corners(s), lists, rows, k, scratch);
    s.domain.functions.accumulate_update(part, edges, lists, rows, k, s.domain.boundary.constraints.data(),
                                         u.reactions.data(), scratch);
  }
  return out;
}

/// Rows that belong to mesh nodes, not to padding.
inline std::vector<int> real_rows(const Simulation& s) {
  std::vector<int> rows;
  for (int n = 0; n < s.domain.order.rows; ++n)
    if (s.domain.order.node_of[n] >= 0) rows.push_back(n);
  return rows;
}

/// A rotation that turns no axis into another, by a fixed seed.
inline Tensor<double> random_rotation(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  double q[4], size = 0;
  for (double& c : q) {
    c = normal(random);
    size += c * c;
  }
  for (double& c : q) c /= std::sqrt(size);
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
           {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
           {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
}

inline Vec3 times(const Tensor<double>& A, const Vec3& v) {
  return {A[0][0] * v[0] + A[0][1] * v[1] + A[0][2] * v[2], A[1][0] * v[0] + A[1][1] * v[1] + A[1][2] * v[2],
          A[2][0] * v[0] + A[2][1] * v[1] + A[2][2] * v[2]};
}

inline MaterialSpec in_region(MaterialSpec m, const std::string& region) {
  m.regions = {{region, "test"}};
  return m;
}

/// A bar of two materials; the tets above and below a rough surface, so that an interface node sees any share of either.
struct TwoMaterials : Problem {
  static Scene scene_of(Scene s, const MaterialSpec& low, const MaterialSpec& high) {
    s.materials = {in_region(low, "low"), in_region(high, "high")};
    s.material = s.materials[0];
    return s;
  }
  static Mesh mesh_with_regions(const Scene& s) {
    RawMesh raw = make_box(s.mesh);
    raw.region_names = {"low", "high"};
    for (std::size_t t = 0; t < raw.tets.size(); ++t) {
      Vec3 middle{};
      for (const int n : raw.tets[t])
        for (int k = 0; k < 3; ++k) middle[k] += raw.X[n][k] / 4;
      raw.tet_region[t] = middle[2] > 0.9 + 0.3 * std::sin(5 * middle[0]) * std::cos(4 * middle[1]);
    }
    return mesh_of(std::move(raw));
  }
  TwoMaterials(const Scene& s, const MaterialSpec& low, const MaterialSpec& high)
      : Problem(scene_of(s, low, high), mesh_with_regions(s)) {}
};

inline MaterialSpec rubber() { return free_bar(1).material; }
inline MaterialSpec times(MaterialSpec m, double density, double stiffness) {
  m.density *= density;
  m.youngs_modulus *= stiffness;
  return m;
}

}  // namespace nanson::method
