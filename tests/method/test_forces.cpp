// Forces from outside: whoever writes them, they move the body, and stand in the books of momentum, angular momentum and energy.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "engine/forces.hpp"
#include "tests/method/scenes.hpp"

namespace nanson::method {
namespace {

/// A motion at finite strain that a body force makes exact.
Scene manufactured(int n) {
  Scene s;
  s.name = "manufactured";
  s.mesh.size = {1, 1, 1};
  s.mesh.cells = {n, n, n + 1};
  s.material.density = 1100;
  s.material.youngs_modulus = 17e6;
  s.material.poissons_ratio = 0.45;
  s.initial.field = InitialField::manufactured;
  s.initial.amplitudes = {0.06, -0.04, 0.05};
  s.initial.length = 1;
  s.initial.period = 0.008;
  s.boundary = {condition({"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"}, BoundaryKind::symmetric)};
  s.time.end = 0.003;
  return s;
}

TEST(Forces, AManufacturedBodyForceIsBookedInBothMomenta) {
  for (auto formulation : formulations)
    for (bool keep : {false, true}) {
      Scene scene = manufactured(4);
      scene.physics.formulation = formulation;
      scene.physics.keep_angular_momentum = keep;
      const Problem problem(scene);
      Simulation s = problem.start();
      EXPECT_EQ(run_quietly(s), "done");
      EXPECT_GT(norm(s.books.impulse), 1e-4 * momenta(s).linear_scale) << "no impulse that could be missed";
      EXPECT_LE(linear_momentum_drift(s), 1e-13) << word(formulation);
      const double drift = angular_momentum_drift(s).value();
      if (keep) EXPECT_LE(drift, 1e-13) << word(formulation);
      else EXPECT_GT(drift, 1e-10) << word(formulation);
    }
}

TEST(Forces, AManufacturedBodyForceIsAudited) {
  double closure[2];
  for (int half = 0; half < 2; ++half) {
    Scene scene = manufactured(5);
    scene.monitor.energy = true;
    scene.time.cfl = half ? 0.15 : 0.3;
    const Problem problem(scene);
    Simulation s = problem.start();
    EXPECT_EQ(run_quietly(s), "done");
    closure[half] = energy_closure(s, energies(s));
    EXPECT_GT(std::abs(s.books.external_work), 0.1 * s.books.initial_energy) << "no work that could be missed";
  }
  RecordProperty("closure", fmt::format("{:.2e}, {:.2e}", closure[0], closure[1]));
  EXPECT_LT(closure[0], 2e-3);  // measured 1.4e-3
  EXPECT_LT(closure[1], closure[0] / 3);
}

TEST(Forces, TheResultantIsThatOfAllThatActs) {
  Scene scene = loaded_bar(4);
  const Problem problem(scene);
  Simulation s = problem.start();
  march(s, 3);
  const Domain& d = s.domain;
  Vec3 force{}, torque{}, weight{};
  const Vec3 about{0.1, -0.2, 0.3};
  const auto count = [&](int n, const Vec3& f) {
    add(force, f);
    add(torque, cross(state_of_row(s.state.U[0].data(), n).position() - about, f));
  };
  for (std::size_t i = 0; i < d.boundary.constraints.size(); ++i) {
    const Constraint& h = d.boundary.constraints[i];
    for (int m = 0; m < h.count; ++m)
      count(h.node, scaled({h.d[m][0], h.d[m][1], h.d[m][2]}, s.state.reactions[reaction_row * i + m]));
  }
  for (std::size_t slot = 0; slot < d.boundary.slot_nodes.size(); ++slot)
    for (int n : d.boundary.slot_nodes[slot])
      count(n, {s.state.loads[4 * slot], s.state.loads[4 * slot + 1], s.state.loads[4 * slot + 2]});
  for (int n : real_rows(s)) {
    const Vec3 f = scaled(scene.body_force, mass(d, n));
    count(n, f);
    add(weight, f);
  }
  const Resultant all = resultant(s, s.state.U[0].data(), about);
  EXPECT_LE(norm(all.force - force), 1e-12 * norm(force));
  EXPECT_LE(norm(all.torque - torque), 1e-12 * norm(torque));
  EXPECT_NEAR(norm(weight), s.books.mass * norm(scene.body_force), 1e-12 * norm(weight));
}

TEST(Forces, ASceneWithoutThemOnNodesHasNoRow) {
  Scene scene = loaded_bar(2);
  scene.body_force = {};
  EXPECT_TRUE(Problem(scene).start().state.force.empty());
  EXPECT_FALSE(Problem(loaded_bar(2)).start().state.force.empty());
}

}  // namespace
}  // namespace nanson::method
