// Bitwise the same result for every number of threads and for every repetition.
#include <gtest/gtest.h>

#include <set>

#include "scenes.hpp"

namespace nanson::method {
namespace {

/// State, ledger and step after a few steps of a scene with supports and loads, as text; every bit counts.
std::string outcome(const Problem& problem, int threads) {
  Simulation s = problem.start(threads);
  march(s, 3);
  std::string bits = state_hash(s);
  const Energies e = energies(s);
  const Momenta m = momenta(s);
  for (double x : {s.dt, allowed_step(s), s.ledger.impulse[0], s.ledger.impulse[2], s.ledger.external_work, s.ledger.dissipated, e.kinetic, e.strain, m.linear[0], m.angular[1]})
    bits += ' ' + std::to_string(std::bit_cast<std::uint64_t>(x));
  return bits;
}

TEST(Determinism, ThreadsChangeNoBit) {
  Scene scene = loaded_bar(9);
  scene.monitor.energy = true;
  Problem problem(scene);
  ASSERT_GE(problem.start().order.parts.size(), 2u);
  for (const PhysicsSpec& physics : every_physics())
    for (auto integrator : integrators) {
      problem.scene.physics = physics, problem.scene.time.integrator = integrator;
      const std::string once = outcome(problem, 1);
      for (int threads : {2, 3}) EXPECT_EQ(once, outcome(problem, threads)) << name(physics) << ' ' << word(integrator) << ' ' << threads;
    }
}

TEST(Determinism, ManyPartsOnManyThreadsChangeNoBit) {
  Scene scene = loaded_bar(16);
  const Problem problem(scene);
  ASSERT_GE(problem.start().order.parts.size(), 8u);
  std::set<std::string> outcomes;
  for (int threads = 1; threads <= 5; ++threads) outcomes.insert(outcome(problem, threads));
  EXPECT_EQ(outcomes.size(), 1u);
}

TEST(Determinism, RepetitionChangesNoBit) {
  for (auto correction : corrections) {
    Scene scene = loaded_bar(9);
    scene.physics.flux_correction = correction;
    EXPECT_EQ(outcome(Problem(scene), 2), outcome(Problem(scene), 2));
  }
}

/// The hash is worth the name: one last bit of one node is seen.
TEST(Determinism, HashSeesOneBit) {
  const Problem problem(free_bar(2));
  Simulation s = problem.start();
  const std::string before = state_hash(s);
  double& J = U_of(s, 5)[3];
  J = std::nextafter(J, 2.0);
  EXPECT_NE(before, state_hash(s));
}

}  // namespace
}  // namespace nanson::method
