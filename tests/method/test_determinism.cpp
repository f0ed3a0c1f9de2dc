// Bitwise the same result for every number of threads and for every repetition.
#include <gtest/gtest.h>

#include <map>
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
  for (double x : {s.state.dt, allowed_step(s), s.books.impulse[0], s.books.impulse[2], s.books.external_work,
                   s.books.dissipated, e.kinetic, e.strain, m.linear[0], m.angular[1]})
    bits += ' ' + std::to_string(std::bit_cast<std::uint64_t>(x));
  return bits;
}

TEST(Determinism, ThreadsChangeNoBit) {
  Scene scene = loaded_bar(9);
  scene.monitor.energy = true;
  Problem problem(scene);
  ASSERT_GE(problem.start().domain.order.parts.size(), 2u);
  for (const PhysicsSpec& physics : every_physics())
    for (auto integrator : integrators) {
      problem.scene.physics = physics;
      problem.scene.time.integrator = integrator;
      const std::string once = outcome(problem, 1);
      for (int threads : {2, 3})
        EXPECT_EQ(once, outcome(problem, threads)) << name(physics) << ' ' << word(integrator) << ' ' << threads;
    }
}

TEST(Determinism, ManyPartsOnManyThreadsChangeNoBit) {
  Scene scene = loaded_bar(16);
  const Problem problem(scene);
  ASSERT_GE(problem.start().domain.order.parts.size(), 8u);
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

/// What one part takes from an edge, the other gives: bitwise. The rows are random.
TEST(Determinism, FluxOfACutEdgeIsBitwiseOppositeInItsTwoParts) {
  Problem problem(free_bar(9));
  for (const PhysicsSpec& physics : every_physics()) {
    problem.scene.physics = physics;
    Simulation s = problem.start();
    State& u = s.state;
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int n : real_rows(s)) {
      for (int i = 0; i < 4; ++i) u.W[u.now][row::W * n + i] = uniform(random);
      for (int m = 0; m < 18; ++m) u.PH[u.now][row::PH * n + 4 * (m / 3) + m % 3] = uniform(random);
    }
    Aligned<double> G(row::G * s.domain.order.rows, 0.0);
    Rows rows{};
    rows.X = s.domain.X.data();
    rows.W = u.W[u.now].data();
    rows.PH = u.PH[u.now].data();
    rows.G = G.data();
    rows.dP = u.dP.data();
    rows.PH_new = u.PH[1 - u.now].data();
    rows.lagged_q = u.q.data();
    rows.GP = u.GP.data();
    for (const Part& part : s.domain.order.parts)
      s.domain.functions.gradient(part, s.domain.order.edges(), s.domain.order.corners(), s.domain.order.lists(), rows,
                                  s.domain.coefficients);
    if (s.domain.functions.corrects_stress) rows.PH = rows.PH_new;
    const int width = physics.flux_correction == FluxCorrection::none ? 4 : 8;
    std::map<std::pair<int, int>, std::array<double, 4>> flux;
    int pairs = 0, unequal = 0;
    for (const Part& part : s.domain.order.parts) {
      double* edge = s.team.scratch[0].data();
      const Scratch scratch{edge, edge + 8 * (s.domain.order.most_edges + 8), nullptr, nullptr};
      s.domain.functions.edge_flux(part, s.domain.order.edges(), s.domain.order.corners(), s.domain.order.lists(), rows,
                                   s.domain.coefficients, scratch);
      for (int e = part.edge_begin; e < part.edge_end; ++e) {
        const double* f = scratch.edge + width * (e - part.edge_begin);
        flux[{s.domain.order.a[e], s.domain.order.b[e]}] = {f[0], f[1], f[2], f[3]};
        const auto other = flux.find({s.domain.order.b[e], s.domain.order.a[e]});
        if (other == flux.end()) continue;
        ++pairs;
        for (int i = 0; i < 4; ++i) unequal += f[i] != -other->second[i];
      }
    }
    EXPECT_GT(pairs, 100);
    EXPECT_EQ(unequal, 0) << name(physics);
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
