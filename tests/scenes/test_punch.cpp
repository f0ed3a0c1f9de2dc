// The punched block: holes close without inversion, volume is kept, and an evolved J keeps the pressure smoother.
#include "tests/scenes/scene_run.hpp"

namespace nanson {
namespace {

struct Row {
  const char* formulation;
  double top, min_detF, max_detF, checkerboard;  // [m] of the probe along Z, [-]
};

TEST(Punch, StaysWhereItWasInEveryFormulation) {
  for (const Row& r : {Row{"pF", -0.06477, 0.9855, 1.0196, 0.784}, Row{"pFJ", -0.07084, 0.9272, 1.1062, 0.399},
                       Row{"pFHJ", -0.07084, 0.9272, 1.1062, 0.399}}) {
    const SceneRun run = run_config("punch.toml",
                                    {"time.end=0.004", std::string("physics.formulation=") + r.formulation});
    EXPECT_EQ(run.summary.status, "done");
    EXPECT_NEAR(run.summary.energy.initial, 2.05685e5, 10);  // [J]
    EXPECT_NEAR(run.summary.probes.at("top").at("displacement")[2], r.top, 1e-4) << r.formulation;
    EXPECT_NEAR(run.summary.min_detF, r.min_detF, 1e-3) << r.formulation;
    EXPECT_NEAR(run.summary.max_detF, r.max_detF, 1e-3) << r.formulation;
    EXPECT_NEAR(run.summary.checkerboard, r.checkerboard, 0.01) << r.formulation;
    EXPECT_LT(*run.summary.energy.closure, 1e-3) << r.formulation;
    EXPECT_LE(run.largest_energy, 1 + 1e-6) << r.formulation;
    EXPECT_LE(run.summary.linear_momentum_drift, 1e-12) << r.formulation;
  }
}

}  // namespace
}  // namespace nanson
