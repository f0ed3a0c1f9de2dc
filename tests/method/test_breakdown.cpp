// A broken state is caught at the stage that makes it, named, and shown as the last frame.
#include <gtest/gtest.h>

#include <limits>

#include "engine/summarise.hpp"
#include "scenes.hpp"

namespace nanson::method {
namespace {

/// A block crushed far too fast, with a step far too large.
Scene crushed_block() {
  Scene s = free_bar(3);
  s.initial.field = InitialField::rest;
  s.boundary = {condition({"zmin"}, BoundaryKind::fixed), condition({"zmax"}, BoundaryKind::velocity)};
  s.boundary[1].velocity = {0, 0, -400};
  s.time.cfl = 3;
  return s;
}

struct Frames {
  int count = 0, rows = 0;  // frames and history rows told
  bool last_was_frame = false, last_broken = false;
  double last_t = -1;
};

std::string run_and_watch(Simulation& s, Frames& f, std::string& reason) {
  Observer observer;
  observer.on_step = [&](const Simulation&) { f.last_was_frame = false; };
  observer.on_history = [&](const Simulation&) { ++f.rows, f.last_was_frame = false; };
  observer.on_frame = [&](const Simulation& now) {
    ++f.count, f.last_was_frame = true, f.last_broken = now.breakdown.has_value(), f.last_t = now.state.t;
  };
  return run(s, observer, reason);
}

bool sound(const double* U, Formulation formulation) {
  Tensor<double> F;
  for (int m = 0; m < 9; ++m) F[m % 3][m / 3] = U[4 * (m / 3 + 1) + m % 3];
  return determinant(F, cofactor(F)) > 0 && (formulation == Formulation::pF || U[3] > 0)
         && std::isfinite(U[0] + U[1] + U[2]);
}

TEST(Breakdown, InversionEndsTheRunAndNamesTheNode) {
  for (auto formulation : formulations)
    for (auto integrator : integrators) {
      Scene scene = crushed_block();
      scene.physics.formulation = formulation;
      scene.time.integrator = integrator;
      const Problem problem(scene);
      Simulation s = problem.start();
      Frames frames;
      std::string reason;
      EXPECT_EQ(run_and_watch(s, frames, reason), "breakdown") << word(formulation);
      ASSERT_TRUE(s.breakdown);
      ASSERT_GE(s.breakdown->node, 0);
      EXPECT_FALSE(sound(U_of(s, s.breakdown->node), formulation)) << "the named node is sound";
      EXPECT_EQ(reason, s.breakdown->text);
      EXPECT_TRUE(s.breakdown->cause == "detF" || (s.breakdown->cause == "J" && formulation != Formulation::pF))
          << s.breakdown->cause;
      EXPECT_NE(reason.find("node " + std::to_string(s.breakdown->node) + " at X = ("), std::string::npos) << reason;
      char t[32];
      std::snprintf(t, sizeof t, "t = %.6e s", s.state.t);
      EXPECT_NE(reason.find(t), std::string::npos) << reason;
      EXPECT_NE(reason.find("step " + std::to_string(s.state.step)), std::string::npos) << reason;
      EXPECT_LT(s.state.t, scene.time.end);
      EXPECT_TRUE(frames.last_was_frame && frames.last_broken) << "the broken state is not the last frame";
      EXPECT_EQ(frames.last_t, s.state.t);
      EXPECT_EQ(frames.count, 2);
      EXPECT_EQ(frames.rows, s.state.step + 1);
    }
}

TEST(Breakdown, TheSameBlockEndsWellWithoutTheLargeStep) {
  Scene scene = crushed_block();
  scene.time.cfl = 0.3;
  scene.boundary[1].velocity[2] = -10;
  scene.material.volumetric = Volumetric::barrier;
  scene.time.end = 0.02;
  const Problem problem(scene);
  Simulation s = problem.start();
  Frames frames;
  std::string reason;
  EXPECT_EQ(run_and_watch(s, frames, reason), "done") << reason;
  EXPECT_FALSE(s.breakdown);
  EXPECT_TRUE(frames.last_was_frame && !frames.last_broken);
}

TEST(Breakdown, NaNInAnyQuantityIsCaughtInTheNextStep) {
  for (auto formulation : formulations)
    for (int lane = 0; lane < row::U; ++lane) {
      if (lane % 4 == 3 && lane != 3) continue;  // x: only following loads read it
      if (lane == 3 && formulation == Formulation::pF) continue;
      Scene scene = free_bar(3);
      scene.physics.formulation = formulation;
      scene.time.max_steps = 20;
      const Problem problem(scene);
      Simulation s = problem.start();
      march(s, 2);
      U_of(s, 17)[lane] = std::numeric_limits<double>::quiet_NaN();
      std::string reason;
      EXPECT_EQ(run(s, {}, reason), "breakdown") << word(formulation) << " lane " << lane;
      EXPECT_EQ(s.state.step, 3) << word(formulation) << " lane " << lane;
      ASSERT_TRUE(s.breakdown);
      EXPECT_EQ(s.breakdown->node, 17) << s.breakdown->text;
      EXPECT_EQ(s.breakdown->cause, "not_finite") << s.breakdown->text;
    }
}

TEST(Breakdown, InfiniteVelocityIsCaught) {
  Scene scene = free_bar(3);
  const Problem problem(scene);
  Simulation s = problem.start();
  U_of(s, 17)[0] = std::numeric_limits<double>::infinity();
  std::string reason;
  EXPECT_EQ(run(s, {}, reason), "breakdown");
  EXPECT_EQ(s.state.step, 1);
}

TEST(Breakdown, CollapseOfTheStepIsCaughtAndNamed) {
  Scene scene = free_bar(3);
  scene.initial.field = InitialField::rest;
  scene.boundary = {condition({"zmin"}, BoundaryKind::fixed), condition({"zmax"}, BoundaryKind::velocity)};
  scene.boundary[1].velocity = {0, 0, -20};
  scene.time.end = 0.1;
  scene.time.dt_collapse = 0.7;
  const Problem problem(scene);
  Simulation s = problem.start();
  Frames frames;
  std::string reason;
  EXPECT_EQ(run_and_watch(s, frames, reason), "breakdown");
  ASSERT_TRUE(s.breakdown);
  EXPECT_LT(allowed_step(s), 0.7 * s.state.first_dt);
  EXPECT_GT(allowed_step(s), 0.5 * s.state.first_dt) << "caught late";
  EXPECT_EQ(s.breakdown->node, limiting_nodes(s, 1)[0].first);
  EXPECT_NE(reason.find("collapsed"), std::string::npos) << reason;
  EXPECT_EQ(s.breakdown->cause, "dt_collapse");
  EXPECT_TRUE(sound(U_of(s, s.breakdown->node), scene.physics.formulation));
  EXPECT_TRUE(frames.last_was_frame && frames.last_broken);
}

TEST(Breakdown, AskedToStopIsNoBreakdown) {
  const Problem problem(free_bar(2));
  Simulation s = problem.start();
  Observer observer;
  observer.stop = [&] { return s.state.step == 4 ? std::string("signal") : std::string(); };
  std::string reason;
  EXPECT_EQ(run(s, observer, reason), "stopped");
  EXPECT_EQ(reason, "signal");
  EXPECT_EQ(summarise(s, {}, "stopped", reason).cause, "signal");
  EXPECT_EQ(s.state.step, 4);
  EXPECT_FALSE(s.breakdown);
}

}  // namespace
}  // namespace nanson::method
