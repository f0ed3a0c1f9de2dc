// States that the scheme must not disturb: rigid translation, homogeneous deformation; and rotated problems with rotated results.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scenes.hpp"

namespace nanson::method {
namespace {

TEST(Translation, OfAFreeBodyIsExact) {
  double worst = 0;
  for (const PhysicsSpec& physics : every_physics())
    for (auto integrator : integrators) {
      Scene scene = free_bar(3);
      scene.physics = physics;
      scene.time.integrator = integrator;
      scene.initial.field = InitialField::velocity;  // 1000 m/s
      scene.initial.v = {600, -640, 480};
      const Problem problem(scene);
      Simulation s = problem.start();
      march(s, 100);
      int disturbed = 0;  // nodes whose F is not bitwise I
      for (int n = 0; n < s.domain.order.nodes; ++n) {
        const double* U = U_of(s, n);
        const Vec3 &X = problem.mesh.X[n], &v = scene.initial.v;
        bool same = std::abs(U[3] - 1) < 1e-15;
        for (int k = 0; k < 3; ++k) {
          worst = std::max({worst, std::abs(U[k] - v[k]) / 1000,
                            std::abs(U[4 * (k + 1) + 3] - X[k] - v[k] * s.state.t) / (1000 * s.state.t)});
          for (int I = 0; I < 3; ++I) same = same && U[4 * (I + 1) + k] == (I == k);
        }
        disturbed += !same;
      }
      EXPECT_EQ(disturbed, 0) << name(physics);
      EXPECT_LT(energy_closure(s, energies(s)), 1e-14) << name(physics);
    }
  RecordProperty("worst", fmt::format("{:.3g}", worst));
  EXPECT_LT(worst, 1e-14);
}

constexpr Tensor<double> F_uniform{{{1.21, 0.17, -0.11}, {-0.23, 0.87, 0.31}, {0.05, -0.13, 1.08}}};
constexpr Tensor<double> L{{{13, -7, 4}, {5, 11, -9}, {-3, 8, 2}}};  // [1/s] dF/dt

std::vector<MaterialSpec> laws(const MaterialSpec& base) {
  std::vector<MaterialSpec> all(3, base);
  all[1].law = Law::mooney_rivlin;
  all[1].xi = 5e5;
  all[1].volumetric = Volumetric::barrier;
  all[2].law = Law::linear_elastic;
  return all;
}

struct PatchDefects {
  double gradient = 0, J_rate = 0, force_inside = 0, force_on_boundary = 0;  // relative
};

/// v = L X and F uniform: dF/dt = L and dJ/dt = H : L everywhere, no force inside, and what is missing on the boundary is P A.
/// The stabilisation is off: with constant reconstruction it acts on v, and a linear v is not a free one.
PatchDefects patch_defects(const Scene& scene) {
  const Problem problem(scene);
  Simulation s = problem.start_changed([](Domain& d) { d.coefficients.rho_cp = d.coefficients.rho_cs = 1e-200; });
  deform(s, F_uniform);
  for (int n : real_rows(s)) {
    const Vec3 v = times(L, problem.mesh.X[s.domain.order.node_of[n]]);
    for (int i = 0; i < 3; ++i) s.state.W[s.state.now][row::W * n + i] = v[i];
  }
  const Rates r = rates(s);
  const double* PH = s.state.PH[s.state.now].data();
  double P_size = 0;
  for (int m = 0; m < 9; ++m) P_size = std::max(P_size, std::abs(PH[8 * (m / 3) + m % 3]));
  const double L_size = 13, force = P_size / 9,
               J_rate = contract(scene.material.law == Law::linear_elastic ? identity<double>() : cofactor(F_uniform),
                                 L);
  PatchDefects worst;
  for (int n : real_rows(s)) {
    const double *rate = &r.U[row::U * n], mass = s.domain.coefficients.material.rho / s.domain.X[row::X * n + 3];
    for (int m = 0; m < 9; ++m)
      worst.gradient = std::max(worst.gradient, std::abs(rate[4 * (m / 3 + 1) + m % 3] - L[m % 3][m / 3]) / L_size);
    if (scene.physics.formulation != Formulation::pF)
      worst.J_rate = std::max(worst.J_rate, std::abs(rate[3] - J_rate) / L_size);
    const int begin = s.domain.order.corner[n], end = s.domain.order.corner[n + 1];
    double& of_force = begin == end ? worst.force_inside : worst.force_on_boundary;
    for (int i = 0; i < 3; ++i) {
      double missing = 0;
      for (int g = begin; g < end; ++g)
        for (int I = 0; I < 3; ++I) missing += PH[8 * I + i] * s.domain.order.corner_C[I][g];
      of_force = std::max(of_force, std::abs(mass * rate[i] + missing) / force);
    }
  }
  return worst;
}

TEST(Patch, RatesOfAHomogeneousDeformationAreExact) {
  PatchDefects all;
  for (const PhysicsSpec& physics : every_physics())
    for (auto boundary_flux : {BoundaryFlux::adjoint, BoundaryFlux::paper})
      for (const MaterialSpec& law : laws(free_bar(1).material)) {
        Scene scene = free_bar(3);
        scene.physics = physics;
        scene.physics.boundary_flux = boundary_flux;
        scene.material = law;
        const PatchDefects d = patch_defects(scene);
        EXPECT_LT(d.gradient, 1e-12) << name(physics);
        EXPECT_LT(d.J_rate, 1e-12) << name(physics);
        EXPECT_LT(d.force_inside, 1e-12) << name(physics);
        EXPECT_LT(d.force_on_boundary, 1e-12) << name(physics);
        all = {std::max(all.gradient, d.gradient), std::max(all.J_rate, d.J_rate),
               std::max(all.force_inside, d.force_inside), std::max(all.force_on_boundary, d.force_on_boundary)};
      }
  RecordProperty("defects", fmt::format("gradient {:.3g}, J rate {:.3g}, force inside {:.3g}, on the boundary {:.3g}",
                                        all.gradient, all.J_rate, all.force_inside, all.force_on_boundary));
}

/// Tractions P N on all six faces, from the stress of the homogeneous state itself.
TEST(Patch, HomogeneousStressUnderItsOwnTractionsStaysAtRest) {
  double worst = 0;
  for (const PhysicsSpec& base : every_physics())
    for (auto boundary_flux : {BoundaryFlux::adjoint, BoundaryFlux::paper})
      for (const MaterialSpec& law : laws(free_bar(1).material)) {
        Scene scene = free_bar(3);
        scene.physics = base;
        scene.physics.boundary_flux = boundary_flux;
        scene.material = law;
        scene.initial.field = InitialField::rest;
        for (const char* face : {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"})
          scene.boundary.push_back(condition({face}, BoundaryKind::traction));
        Problem problem(scene);
        {
          Simulation s = problem.start();
          deform(s, F_uniform);
          for (std::size_t face = 0; face < 6; ++face)
            for (std::size_t i = 0; i < 3; ++i)
              problem.scene.boundary[face].traction[i] = (face % 2 ? 1 : -1)
                                                         * s.state.PH[s.state.now][8 * (face / 2) + i];
        }
        Simulation s = problem.start();
        deform(s, F_uniform);
        double t_size = 0;
        for (const BoundarySpec& b : problem.scene.boundary)
          t_size = std::max(t_size, std::hypot(b.traction[0], b.traction[1], b.traction[2]));
        ASSERT_GT(t_size, 1e6);
        march(s, 3);
        const double speed = t_size * s.state.t
                             / (s.domain.coefficients.material.rho
                                / 3);  // [m/s] that one cell would reach under the traction alone
        worst = std::max(worst, extrema(s).max_speed / speed);
        EXPECT_LT(extrema(s).max_speed, 1e-12 * speed) << name(scene.physics) << ' ' << word(law.law);
      }
  RecordProperty("speed", fmt::format("{:.3g}", worst));
}

/// A bar with a roller and a skew face, its mesh and velocities turned or mirrored by Q: v, x and F turn with it.
double rotation_defect(const PhysicsSpec& physics, const Tensor<double>& Q) {
  Scene scene = free_bar(3);
  scene.physics = physics;
  scene.initial.field = InitialField::rest;
  scene.boundary = {condition({"xmin"}, BoundaryKind::symmetric), condition({"zmax"}, BoundaryKind::skew_symmetric)};
  RawMesh raw = make_box(scene.mesh);
  const Problem straight(scene, mesh_of(raw));
  for (Vec3& X : raw.X) X = times(Q, X);
  const Problem turned(scene, mesh_of(raw));
  Simulation s = straight.start(), q = turned.start();
  for (int n = 0; n < s.domain.order.nodes; ++n) {
    const Vec3& X = straight.mesh.X[n];
    const Vec3 v{40 * (X[0] + 0.5) * X[2], 25 * X[1] * X[2], X[2] < 1.99 && X[0] > -0.49 ? 30 * std::sin(3 * X[1]) : 0};
    const Vec3 free{X[0] < -0.49 ? 0 : v[0], X[2] > 1.99 ? 0 : v[1], v[2]},
        along = X[2] > 1.99 ? Vec3{0, 0, v[2]} : free, w = times(Q, along);
    for (std::size_t k = 0; k < 3; ++k) {
      U_of(s, n)[k] = along[k];
      U_of(q, n)[k] = w[k];
    }
  }
  adopt_state(s);
  adopt_state(q);
  const double dt = 0.8 * allowed_step(s);
  march(s, dt, 100);
  march(q, dt, 100);
  double worst = 0;
  for (int n = 0; n < s.domain.order.nodes; ++n) {
    const double *U = U_of(s, n), *V = U_of(q, n);
    const Vec3 v = times(Q, {U[0], U[1], U[2]}), x = times(Q, {U[7], U[11], U[15]});
    for (int k = 0; k < 3; ++k) {
      worst = std::max(worst, std::abs(V[k] - v[k]) / extrema(s).max_speed);
      worst = std::max(worst, std::abs(V[4 * (k + 1) + 3] - x[k]));
    }
    for (int i = 0; i < 3; ++i)
      for (int I = 0; I < 3; ++I) {
        double F = 0;
        for (int m = 0; m < 9; ++m) F += Q[i][m / 3] * U[4 * (m % 3 + 1) + m / 3] * Q[I][m % 3];
        worst = std::max(worst, std::abs(V[4 * (I + 1) + i] - F));
      }
  }
  EXPECT_GT(std::abs(extrema(s).max_detF - 1), 3e-3);
  return worst;
}

TEST(Frame, ATurnedOrMirroredProblemHasTheTurnedOrMirroredResult) {
  double worst = 0;
  Tensor<double> turn = random_rotation(3), mirror = turn;
  for (double& q : mirror.a[1]) q = -q;
  for (const PhysicsSpec& physics : every_physics())
    for (const Tensor<double>& Q : {turn, mirror}) {
      const double d = rotation_defect(physics, Q);
      EXPECT_LT(d, 1e-10) << name(physics);
      worst = std::max(worst, d);
    }
  RecordProperty("defect", fmt::format("{:.3g}", worst));
}

/// The same mesh, turned in space only: F = Q, x = Q X at the start. Objectivity of stress, fluxes and step.
TEST(Frame, ARotationOfTheBodyInSpaceTurnsTheResult) {
  double worst = 0;
  const Tensor<double> Q = random_rotation(4);
  for (const PhysicsSpec& physics : every_physics()) {
    Scene scene = free_bar(3);
    scene.physics = physics;
    const Problem problem(scene);
    Simulation s = problem.start(), q = problem.start();
    for (int n = 0; n < q.domain.order.nodes; ++n) {
      double* U = U_of(q, n);
      const Vec3 v = times(Q, {U[0], U[1], U[2]});
      for (std::size_t k = 0; k < 3; ++k) U[k] = v[k];
    }
    deform(q, Q);
    double step_defect = 0;
    for (int i = 0; i < 100; ++i) {
      step_defect = std::max(step_defect, std::abs(allowed_step(s) / allowed_step(q) - 1));
      march(s, 1);
      march(q, s.state.dt, 1);
    }
    EXPECT_LT(step_defect, 1e-8) << name(physics);  // the bound takes the root of a variance that is round-off at F = Q
    for (int n = 0; n < s.domain.order.nodes; ++n) {
      const double *U = U_of(s, n), *V = U_of(q, n);
      EXPECT_NEAR(U[3], V[3], 1e-10);
      for (int column = 0; column < 4; ++column) {  // v, then the columns of F
        const Vec3 turned = times(Q, {U[4 * column], U[4 * column + 1], U[4 * column + 2]});
        for (std::size_t k = 0; k < 3; ++k)
          worst = std::max(worst, std::abs(V[4 * column + k] - turned[k]) / (column == 0 ? extrema(s).max_speed : 1));
      }
    }
  }
  RecordProperty("defect", fmt::format("{:.3g}", worst));
  EXPECT_LT(worst, 1e-10);
}

}  // namespace
}  // namespace nanson::method
