// The size of the step: lengths of the three rules, growth, the scene's end, and who sets it.
#include <gtest/gtest.h>

#include <limits>

#include "engine/dual.hpp"
#include "scenes.hpp"

namespace nanson::method {
namespace {

TEST(Setup, ItsStepsAreTimedOneByOneWithMetisApart) {
  const Problem problem(free_bar(12));
  double largest_share = 0;  // of the whole; on a busy machine any one try may be held up between two of them
  for (int attempt = 0; attempt < 20 && largest_share <= 0.5; ++attempt) {
    const double start = wall_seconds();
    const Simulation s = problem.start();
    const double seconds = wall_seconds() - start;
    std::vector<std::string> names;
    for (const SweepTime& part : s.team.setup.sweeps) {
      names.push_back(part.sweep);
      EXPECT_GT(part.seconds, 0) << part.sweep;
    }
    EXPECT_EQ(names, (std::vector<std::string>{"dual", "order", "metis", "state", "initial"}));
    EXPECT_LE(s.team.setup.total(), seconds);
    largest_share = std::max(largest_share, s.team.setup.total() / seconds);
  }
  EXPECT_GT(largest_share, 0.5) << "nothing that takes long is left out";
}

/// min l/c_p times cfl at F = I, straight from the mesh: l = 6 Omega / sum |C|, the node's shortest edge, the mesh's shortest edge.
double expected_step(const Problem& p) {
  const Dual dual = make_dual(p.mesh);
  std::vector<double> area(p.mesh.X.size(), 0.0);
  double shortest_edge = std::numeric_limits<double>::max(), length = shortest_edge;
  for (const DualEdge& e : dual.edges) {
    const double A = std::sqrt(e.C[0] * e.C[0] + e.C[1] * e.C[1] + e.C[2] * e.C[2]);
    area[e.a] += A;
    area[e.b] += A;
    const Vec3 &a = p.mesh.X[e.a], &b = p.mesh.X[e.b];
    shortest_edge = std::min(shortest_edge, std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1])
                                                      + (a[2] - b[2]) * (a[2] - b[2])));
  }
  for (std::size_t n = 0; n < area.size(); ++n) length = std::min(length, 6 * dual.volume[n] / area[n]);
  if (p.scene.time.step != StepRule::dual) length = shortest_edge;
  const double E = p.scene.material.youngs_modulus, nu = p.scene.material.poissons_ratio,
               rho = p.scene.material.density;
  return p.scene.time.cfl * length / std::sqrt(E * (1 - nu) / ((1 + nu) * (1 - 2 * nu) * rho));
}

TEST(Step, IsTheRulesLengthOverTheWaveSpeedAtRest) {
  for (auto rule : {StepRule::dual, StepRule::edge, StepRule::paper})
    for (double perturb : {0.0, 0.3})
      for (auto law : {Law::neo_hookean, Law::linear_elastic}) {
        Scene scene = free_bar(3);
        scene.mesh.perturb = perturb;
        scene.material.law = law;
        scene.time.step = rule;
        scene.time.cfl = 0.25;
        const Problem problem(scene);
        Simulation s = problem.start();
        EXPECT_NEAR(allowed_step(s) / expected_step(problem), 1, 1e-12) << word(rule) << ' ' << word(law);
      }
}

TEST(Step, OfTheDualRuleIsTheCellOverTheWaveSpeedOnCubes) {
  for (auto split : {Split::kuhn, Split::alternating}) {
    Scene scene = cube(6, split);
    scene.time.step = StepRule::dual;
    const Problem problem(scene);
    Simulation s = problem.start();
    EXPECT_NEAR(allowed_step(s) * s.domain.coefficients.material.cp / 0.3, 1.0 / 6, 0.05 / 6) << word(split);
  }
}

TEST(Step, GrowsByFivePercentAtMost) {
  Scene scene = free_bar(3);
  scene.initial.field = InitialField::rest;
  scene.time.end = 0.02;
  const Problem problem(scene);
  Simulation s = problem.start();
  deform(s, {{{0.5, 0, 0}, {0, 0.6, 0}, {0, 0, 0.55}}});  // let go, it expands and its step grows
  double last = 0, largest = 0;
  int at_limit = 0;
  Observer observer;
  observer.on_step = [&](const Simulation& now) {
    if (last > 0) {
      largest = std::max(largest, now.state.dt / last);
      at_limit += now.state.dt == 1.05 * last;
    }
    last = now.state.dt;
  };
  std::string reason;
  EXPECT_EQ(run(s, observer, reason), "done") << reason;
  EXPECT_LE(largest, 1.05 * (1 + 1e-15));
  EXPECT_GT(at_limit, 3);
}

TEST(Step, NeverExceedsTheAllowedStepNorTheScenesLargest) {
  for (double dt_max : {1e3, 1e-4}) {
    Scene scene = free_bar(3);
    scene.time.dt_max = dt_max;
    const Problem problem(scene);
    Simulation s = problem.start();
    double allowed = allowed_step(s);
    Observer observer;
    observer.on_step = [&](const Simulation& now) {
      EXPECT_LE(now.state.dt, allowed);
      EXPECT_LE(now.state.dt, dt_max);
      allowed = allowed_step(now);
    };
    std::string reason;
    EXPECT_EQ(run(s, observer, reason), "done");
  }
}

TEST(Step, EndIsHitExactlyBySharingTheLastTwoSteps) {
  for (double end : {4e-3, 0.00777, 0.0123456789, 0.05, 1.0 / 30}) {
    Scene scene = free_bar(2);
    scene.time.end = end;
    const Problem problem(scene);
    Simulation s = problem.start();
    std::vector<double> steps;
    Observer observer;
    observer.on_step = [&](const Simulation& now) { steps.push_back(now.state.dt); };
    std::string reason;
    EXPECT_EQ(run(s, observer, reason), "done");
    EXPECT_EQ(s.state.t, end);
    ASSERT_GE(steps.size(), 3u);
    const double last = steps.back(), before = steps[steps.size() - 2], earlier = steps[steps.size() - 3];
    EXPECT_NEAR(last / before, 1, 1e-9) << end;
    EXPECT_GT(last / earlier, 0.49) << end << ": a splinter of a step at the end";
    EXPECT_EQ(s.state.dt_min, *std::min_element(steps.begin(), steps.end()));
    EXPECT_EQ(s.state.dt_max, *std::max_element(steps.begin(), steps.end()));
  }
}

TEST(Step, FramesDoNotCutIt) {
  Scene scene = free_bar(2);
  const Problem plain(scene);
  scene.output.every = 0.0047;
  const Problem framed(scene);
  Simulation a = plain.start(), b = framed.start();
  std::vector<double> frames;
  Observer observer;
  observer.on_frame = [&](const Simulation& now) { frames.push_back(now.state.t); };
  std::string reason;
  EXPECT_EQ(run_quietly(a), "done");
  EXPECT_EQ(run(b, observer, reason), "done");
  EXPECT_EQ(state_hash(a), state_hash(b));
  ASSERT_EQ(frames.size(), 12u);  // start, 10 times, end
  for (std::size_t k = 1; k < 11; ++k) {
    EXPECT_GE(frames[k], 0.0047 * k - 1e-15);
    EXPECT_LT(frames[k], 0.0047 * k + b.state.dt_max);
  }
  EXPECT_EQ(frames.back(), scene.time.end);
}

TEST(Step, LimitingNodesAreThoseThatSetIt) {
  for (auto formulation : formulations)
    for (auto rule : {StepRule::dual, StepRule::edge}) {
      Scene scene = free_bar(4);
      scene.physics.formulation = formulation;
      scene.time.step = rule;
      const Problem problem(scene);
      Simulation s = problem.start();
      march(s, 40);
      const std::string before = state_hash(s);
      const auto worst = limiting_nodes(s, 5), all = limiting_nodes(s, 1000000);
      EXPECT_EQ(state_hash(s), before);
      ASSERT_EQ(worst.size(), 5u);
      EXPECT_EQ(all.size(), problem.mesh.X.size());
      EXPECT_EQ(worst[0].second, allowed_step(s));
      for (std::size_t k = 1; k < all.size(); ++k) EXPECT_GE(all[k].second, all[k - 1].second);
      const double dt = allowed_step(s);  // with the worst node's length halved, it must set half the step
      Simulation shorter = problem.start_changed(
          [&](Domain& d) { d.step_length[d.order.row_of[worst[0].first]] /= 2; });
      shorter.state = s.state;
      EXPECT_NEAR(limiting_nodes(shorter, 1)[0].second, dt / 2, 1e-14 * dt);
    }
}

TEST(Step, LimitsOnStepsAndTimeStopTheRun) {
  Scene scene = free_bar(2);
  scene.time.max_steps = 7;
  const Problem problem(scene);
  Simulation s = problem.start();
  EXPECT_EQ(run_quietly(s), "stopped");
  EXPECT_EQ(s.state.step, 7);
}

}  // namespace
}  // namespace nanson::method
