// Entropy production of every edge in nonlinear runs (method, section 3), as the monitor counts it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "engine/history.hpp"
#include "scenes.hpp"

namespace nanson::method {
namespace {

/// Worst of all steps.
struct Worst {
  double least = 1e300, least_sum = 1e300, negative_share = 0;  // [W] [W] [-]
  double largest_sum = 0;                                       // [W]
};

Worst entropy_of(Reconstruction reconstruction, EntropyFix fix) {
  Scene scene = column(3);
  scene.mesh.size[2] = 3;
  scene.mesh.cells[2] = 9;
  scene.mesh.perturb = 0.2;
  scene.initial.height = 3;
  scene.time.end = 0.02;
  scene.physics.reconstruction = reconstruction;
  scene.physics.entropy_fix = fix;
  const Problem problem(scene);
  Simulation s = problem.start();
  Worst w;
  Observer observer;
  observer.on_step = [&](const Simulation&) {
    const EntropyProduction e = entropy_production(s);
    w.least = std::min(w.least, e.least);
    w.least_sum = std::min(w.least_sum, e.total);
    w.largest_sum = std::max(w.largest_sum, e.total);
    w.negative_share = std::max(w.negative_share, e.negative_share);
  };
  std::string reason;
  EXPECT_EQ(run(s, observer, reason), "done") << reason;
  testing::Test::RecordProperty(
      fmt::format("{}_{}", word(reconstruction), word(fix)),
      fmt::format("least {:.2e} of {:.2e} W, least sum {:.2e} W, share of negative edges {:.3f}", w.least,
                  w.largest_sum, w.least_sum, w.negative_share));
  return w;
}

TEST(EntropyProduction, IsNotNegativeOnAnyEdgeWithConstantReconstruction) {
  const Worst w = entropy_of(Reconstruction::constant, EntropyFix::none);
  EXPECT_GE(w.least, 0);
  EXPECT_EQ(w.negative_share, 0);
  EXPECT_GT(w.least_sum, 0);
}

/// Round-off: the fix decides on products of jumps, the monitor adds the parts in another order.
TEST(EntropyProduction, IsNotNegativeOnAnyEdgeWithTheEdgeFix) {
  for (auto reconstruction : {Reconstruction::linear, Reconstruction::limited}) {
    const Worst w = entropy_of(reconstruction, EntropyFix::edge);
    EXPECT_GE(w.least, -1e-14 * w.largest_sum) << word(reconstruction);
    EXPECT_GT(w.least_sum, 0) << word(reconstruction);
  }
}

TEST(EntropyProduction, OfLinearReconstructionIsNegativeOnSomeEdgesButNotInSum) {
  const Worst w = entropy_of(Reconstruction::linear, EntropyFix::none);
  EXPECT_LT(w.least, 0);
  EXPECT_GT(w.negative_share, 0.1);
  EXPECT_LT(w.negative_share, 0.6);
  EXPECT_GT(w.least_sum, 0);
}

/// The monitor's sum is the edge loops': over a stage they are the same power; and looking changes nothing, not even a flux correction that the next step takes.
TEST(EntropyProduction, IsTheDissipationOfTheAuditAndChangesNoBit) {
  for (auto correction : corrections) {
    Scene scene = loaded_bar(9);
    scene.monitor.energy = true;
    scene.physics.flux_correction = correction;
    const Problem problem(scene);
    Simulation s = problem.start(2), unseen = problem.start(2);
    ASSERT_GE(s.domain.order.parts.size(), 2u);
    march(s, 2);
    march(unseen, 2);
    const EntropyProduction e = entropy_production(s);
    EXPECT_EQ(e.total, entropy_production(s).total);
    Simulation one = problem.start(1);
    march(one, 2);
    EXPECT_EQ(e.total, entropy_production(one).total);
    EXPECT_EQ(e.least, entropy_production(one).least);
    EXPECT_NEAR(dissipated_power(s) / e.total, 1, 1e-12);
    march(s, 2);
    march(unseen, 2);
    EXPECT_EQ(state_hash(s), state_hash(unseen));
    EXPECT_EQ(s.books.dissipated, unseen.books.dissipated);
    double ours[9], theirs[9];
    entropy_production(s);
    for (int n = 0; n < s.domain.order.nodes; ++n) {
      field_named("P").at(s, n, ours);
      field_named("P").at(unseen, n, theirs);
      for (int k = 0; k < 9; ++k) EXPECT_EQ(ours[k], theirs[k]);
    }
  }
}

}  // namespace
}  // namespace nanson::method
