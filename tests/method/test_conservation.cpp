// Linear momentum: constant without supports and loads, and changed by exactly what they are booked to give.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scenes.hpp"

namespace nanson::method {
namespace {

/// Of a pushed, twisted bar, relative to sum Omega |p| at the start (with constant reconstruction the motion dies out).
double drift(const PhysicsSpec& physics, Integrator integrator, int n, int steps) {
  Scene scene = free_bar(n);
  scene.physics = physics;
  scene.time.integrator = integrator;
  const Problem problem(scene);
  Simulation s = problem.start();
  push(s, {20, -7, 11});
  const double scale = momenta(s).linear_scale;
  march(s, steps);
  EXPECT_FALSE(s.breakdown) << name(physics);
  return linear_momentum_drift(s) * momenta(s).linear_scale / scale;
}

TEST(Momentum, IsConstantInAFreeNonlinearBar) {
  double worst = 0;
  for (const PhysicsSpec& physics : every_physics())
    for (auto integrator : integrators) {
      const double d = drift(physics, integrator, 3, 300);
      EXPECT_LT(d, 1e-13) << name(physics) << ' ' << word(integrator);
      worst = std::max(worst, d);
    }
  RecordProperty("drift", fmt::format("{:.3g}", worst));
}

TEST(Momentum, IsConstantAcrossTheCutEdgesOfParts) {
  double worst = 0;
  for (auto correction : corrections) {
    PhysicsSpec physics;
    physics.flux_correction = correction;
    worst = std::max(worst, drift(physics, Integrator::tvd_rk2, 12, 100));
  }
  RecordProperty("drift", fmt::format("{:.3g}", worst));
  EXPECT_LT(worst, 1e-13);
}

TEST(Momentum, ChangesByTheBookedImpulseUnderEverySupportAndLoad) {
  double worst = 0;
  for (const PhysicsSpec& physics : every_physics())
    for (auto integrator : integrators) {
      Scene scene = loaded_bar(3);
      scene.physics = physics;
      scene.time.integrator = integrator;
      const Problem problem(scene);
      Simulation s = problem.start();
      march(s, 300);
      const Vec3& I = s.books.impulse;
      EXPECT_FALSE(s.breakdown) << name(physics);
      EXPECT_GT(std::hypot(I[0], I[1], I[2]), 0.1 * momenta(s).linear_scale) << name(physics);
      EXPECT_LT(linear_momentum_drift(s), 1e-12) << name(physics) << ' ' << word(integrator);
      worst = std::max(worst, linear_momentum_drift(s));
    }
  RecordProperty("drift", fmt::format("{:.3g}", worst));
}

/// Here the test itself adds up reactions, tractions and weight; it asks the ledger nothing.
TEST(Momentum, ChangesByReactionsTractionsAndWeightStepByStep) {
  for (auto integrator : integrators) {
    Scene scene = loaded_bar(3);
    scene.boundary.erase(scene.boundary.begin() + 3);  // without the following pressure
    scene.time.integrator = integrator;
    scene.time.end = 0.02;
    const Problem problem(scene);
    Simulation s = problem.start();
    ASSERT_EQ(s.domain.boundary.held_faces, (std::vector<std::string>{"zmin", "xmin", "zmax"}));
    Vec3 p = momenta(s).linear, t = scene.boundary[2].traction;
    const double area = 2;  // [m^2] ymax
    double worst = 0;
    Observer observer;
    observer.on_step = [&](const Simulation& now) {
      Vec3 after = momenta(now).linear, change = t;
      for (int k = 0; k < 3; ++k) {
        change[k] = area * t[k] + now.books.mass * scene.body_force[k];
        for (int face = 0; face < 3; ++face) change[k] += reaction(now, face)[k];
        worst = std::max(worst, std::abs(after[k] - p[k] - now.state.dt * change[k]));
      }
      p = after;
    };
    std::string reason;
    EXPECT_EQ(run(s, observer, reason), "done") << reason;
    EXPECT_LT(worst, 1e-14 * momenta(s).linear_scale) << word(integrator);
    RecordProperty(std::string(word(integrator)), fmt::format("{:.3g}", worst / momenta(s).linear_scale));
  }
}

TEST(Momentum, PressureOnAllFacesOfABodyGivesNoResultant) {
  Scene scene = free_bar(3);
  scene.boundary = {condition({"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"}, BoundaryKind::pressure)};
  scene.boundary[0].pressure = 1e6;
  const Problem problem(scene);
  Simulation s = problem.start();
  march(s, 200);
  const Momenta m = momenta(s);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(m.linear[k], s.books.initial_momentum[k], 1e-13 * m.linear_scale);
}

}  // namespace
}  // namespace nanson::method
