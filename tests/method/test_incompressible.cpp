// {p, F, p} with several materials, whose densities and compressibilities meet at nodes, and with SSP-RK3, whose every stage is projected before it is averaged.
#include <gtest/gtest.h>

#include "tests/method/scenes.hpp"

namespace nanson::method {
namespace {

Scene projected(Scene scene) {
  scene.physics.formulation = Formulation::pFp;
  scene.projection.tolerance = 1e-10;
  scene.projection.max_iterations = 1000;
  return scene;
}

TEST(Incompressible, EqualMaterialsAreOne) {
  for (const double nu : {0.5, 0.45}) {
    Scene scene = projected(loaded_bar(4));
    scene.material.poissons_ratio = nu;
    const TwoMaterials two(scene, scene.material, scene.material);
    const Problem one(scene, two.mesh);
    Simulation a = one.start(), b = two.start();
    const double dt = allowed_step(a);
    EXPECT_NEAR(allowed_step(b), dt, 1e-13 * dt);
    march(a, dt, 20);
    march(b, dt, 20);
    ASSERT_FALSE(a.breakdown);
    double pressure = 0;
    for (int n = 0; n < a.domain.order.nodes; ++n) {
      pressure = std::max(pressure, std::abs(U_of(a, n)[3]));
      for (int k = 0; k < row::U; ++k)
        EXPECT_NEAR(U_of(a, n)[k], U_of(b, n)[k], k == 3 ? 0.1 : 1e-6) << k;  // [Pa] | [m/s], [-], [m]
    }
    EXPECT_GT(pressure, 1e4);
  }
}

/// det F + Q - 1 = p/kappa of a node's share in each material, one of them incompressible: kept by the projection, but for what the step adds.
TEST(Incompressible, NodesOfAnInterfaceGiveWayLikeTheirShares) {
  Scene scene = projected(loaded_bar(4));
  scene.projection.drift_control = 1;
  MaterialSpec stiff = scene.material, soft = scene.material;
  stiff.poissons_ratio = 0.5;
  soft.poissons_ratio = 0.3;
  const TwoMaterials two(scene, stiff, soft);
  Simulation s = two.start();
  EXPECT_FALSE(s.domain.projection.closed);
  const double kappa = s.domain.mixture.laws[1].constants.kappa;
  march(s, 5e-5, 200);
  ASSERT_FALSE(s.breakdown) << s.breakdown->text;
  double worst = 0, most = 0;
  for (const int n : real_rows(s)) {
    const double* U = &s.state.U[0][static_cast<std::size_t>(row::U * n)];
    const double share = s.domain.mixture.share[1][static_cast<std::size_t>(n)];
    Tensor<double> F;
    for (int m = 0; m < 9; ++m) F[m % 3][m / 3] = U[4 * (m / 3 + 1) + m % 3];
    const double change = determinant(F, cofactor(F)) + s.state.projection.volume[0][static_cast<std::size_t>(n)] - 1;
    worst = std::max(worst, std::abs(change - share * U[3] / kappa));
    most = std::max(most, std::abs(change));
  }
  EXPECT_GT(most, 1e-3);
  EXPECT_LE(worst, 0.02 * most);
}

TEST(Incompressible, EnergyNeverGrowsAcrossJumpsOfDensityAndStiffness) {
  for (const auto integrator : {Integrator::tvd_rk2, Integrator::ssp_rk3})
    for (const auto& [density, stiffness] : {std::pair{1.0, 1000.0}, {1000.0, 1.0}, {1e-3, 1e-3}}) {
      Scene scene = projected(free_bar(4));
      scene.projection.tolerance = 1e-6;
      scene.monitor.energy = true;
      scene.initial.twist_omega = 5;
      scene.time.integrator = integrator;
      const TwoMaterials two(scene, rubber(), times(rubber(), density, stiffness));
      Simulation s = two.start();
      double largest = 0;
      for (int i = 0; i < 20 && !s.breakdown; ++i) {
        march(s, 10);
        const Energies e = energies(s);
        largest = std::max(largest, (e.kinetic + e.strain) / s.books.initial_energy);
      }
      EXPECT_FALSE(s.breakdown) << s.breakdown->text;
      EXPECT_LE(largest, 1 + 1e-6) << density << " " << stiffness;
      EXPECT_LE(energy_closure(s, energies(s)), 1e-3) << density << " " << stiffness;
      EXPECT_LE(linear_momentum_drift(s), 1e-12);
    }
}

TEST(Incompressible, SeveralMaterialsAreBitwiseForAnyThreadCount) {
  for (const auto solver : {ProjectionSolver::cg, ProjectionSolver::pseudo_time}) {
    Scene scene = projected(loaded_bar(10));
    scene.projection.tolerance = 1e-3;
    scene.projection.solver = solver;
    const TwoMaterials two(scene, times(rubber(), 1, 10), times(rubber(), 3, 1));
    Simulation one = two.start(1), three = two.start(3);
    ASSERT_GT(one.domain.order.parts.size(), 1u);
    march(one, 3);
    march(three, 3);
    EXPECT_EQ(state_hash(one), state_hash(three));
  }
}

/// A constraint that follows F is kept at the end of every stage, its mean with the step's start is not: the pressure's own order is two, the motion's too.
TEST(Incompressible, RungeKuttaOfThreeStagesIsOfSecondOrderWithSmallerErrors) {
  const auto tips = [](Integrator integrator) {
    Scene scene = projected(column(3));
    scene.material.poissons_ratio = 0.5;
    scene.time.integrator = integrator;
    std::array<Vec3, 3> tip{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Problem problem(scene);
      Simulation s = problem.start();
      march(s, 5e-4 / (1 << k), 100 << k);
      EXPECT_FALSE(s.breakdown);
      for (int n = 0; n < s.domain.order.nodes; ++n)
        if (problem.mesh.X[n] == Vec3{0.5, 0.5, 6}) tip[k] = {U_of(s, n)[7], U_of(s, n)[11], U_of(s, n)[15]};
    }
    return tip;
  };
  const auto distance = [](const Vec3& p, const Vec3& q) { return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]); };
  const auto two = tips(Integrator::tvd_rk2), three = tips(Integrator::ssp_rk3);
  EXPECT_GT(distance(three[0], three[1]) / distance(three[1], three[2]), 3.2);
  EXPECT_LT(distance(three[0], three[1]), distance(two[0], two[1]));
  EXPECT_LT(distance(two[2], three[2]), distance(two[1], two[2]));
}

}  // namespace
}  // namespace nanson::method
