// The punched block: holes close without inversion, volume is kept, and the three formulations move alike.
#include "tests/scenes/scene_run.hpp"

namespace nanson {
namespace {

TEST(Punch, ReachesTheFiguresMeasuredBeforeInEveryFormulation) {
  for (const std::string formulation : {"pF", "pFJ", "pFHJ"}) {
    const SceneRun run = run_config("punch.toml", {"time.end=0.004", "physics.formulation=" + formulation});
    EXPECT_EQ(run.summary.status, "done");
    EXPECT_NEAR(run.summary.energy.initial, 2.05685e5, 1e2);  // [J]
    EXPECT_NEAR(run.summary.probes.at("top").at("displacement")[2], formulation == "pF" ? -0.0648 : -0.0705, 0.0005)
        << formulation;
    EXPECT_GT(run.summary.min_detF, 0.9) << formulation;
    EXPECT_LT(run.summary.max_detF, 1.12) << formulation;
    EXPECT_LT(*run.summary.energy.closure, 1.5e-3) << formulation;
    EXPECT_LE(run.largest_energy, 1 + 1e-6) << formulation;
    EXPECT_LE(run.summary.linear_momentum_drift, 1e-12) << formulation;
  }
}

}  // namespace
}  // namespace nanson
