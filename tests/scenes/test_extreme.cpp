// The scenes that the stability maps push, as they stand or shorter: sound, their books closed, where they were.
#include <algorithm>

#include "tests/scenes/scene_run.hpp"

namespace nanson {
namespace {

double least(const SceneRun& run, const char* column) {
  const auto c = run.column(column);
  return *std::min_element(c.begin(), c.end());
}
double most(const SceneRun& run, const char* column) {
  const auto c = run.column(column);
  return *std::max_element(c.begin(), c.end());
}

SceneRun sound_run(const std::string& scene, double closure, std::vector<std::string> settings = {}) {
  const SceneRun run = run_config("extreme/" + scene + ".toml", settings);
  EXPECT_EQ(run.summary.status, "done") << scene;
  EXPECT_LT(*run.summary.energy.closure, closure) << scene;
  EXPECT_LT(run.summary.linear_momentum_drift, 1e-12) << scene;
  EXPECT_GT(least(run, "min_tet_ratio"), 0) << scene << ": no tet turns inside out";
  return run;
}

/// 0.36 m of way in 0.055 s: the plate speeds up over 0.02 s.
TEST(Block, CrushedToTwoThirdsStaysWhereItWas) {
  const SceneRun run = sound_run("block", 1e-5,
                                 {"time.end=0.055", "output.probes={top={at=[0.1,0.1,1.0],fields=['displacement']}}"});
  EXPECT_NEAR(run.summary.probes.at("top").at("displacement")[2], -0.36, 1e-5);
  EXPECT_NEAR(*run.summary.energy.external_work, 1.5415e6, 0.01e6);  // [J]
  EXPECT_NEAR(least(run, "min_detF"), 0.828, 0.005);
  EXPECT_NEAR(most(run, "max_detF_over_J"), 1.0025, 0.001);
}

TEST(BentPlate, StaysWhereItWas) {
  const SceneRun run = sound_run("bent_plate", 3e-4);
  EXPECT_NEAR(run.summary.energy.initial, 0.5 * 110 * 3.5,
              1e-9);  // [J] 110 kg at 2 m/s but for an eighth, which is held
  EXPECT_NEAR(run.summary.energy.kinetic, 19.25, 0.2);
  EXPECT_NEAR(run.summary.energy.strain, 72.3, 0.7);
  EXPECT_LE(run.largest_energy, 1 + 1e-6);
}

/// The dual cell's step sees a nearly flat tet for what it is, the shortest edge does not.
TEST(FlatTet, CostsFewStepsAndStaysWhereItWas) {
  const SceneRun run = sound_run("flat_tet", 2e-3);
  EXPECT_EQ(run.summary.steps, 347);
  EXPECT_NEAR(run.summary.energy.kinetic, 28.2, 0.5);
  EXPECT_NEAR(run.summary.energy.strain, 479.8, 5);
  EXPECT_LE(run.largest_energy, 1 + 1e-6);
  const SceneRun first = run_config("extreme/flat_tet.toml", {"time.max_steps=1", "time.step=edge"});
  EXPECT_GT(run.summary.dt_max, 1.9 * first.summary.dt_max);  // 2.0
}

TEST(Layers, OfStiffnessOneToAThousandStayWhereTheyWere) {
  const SceneRun run = sound_run("layers", 1e-6);
  EXPECT_NEAR(run.summary.mass, 2200, 1e-9);  // [kg]
  EXPECT_NEAR(run.summary.energy.kinetic, 17695, 200);
  EXPECT_NEAR(run.summary.energy.strain, 70505, 700);
  EXPECT_LE(run.largest_energy, 1 + 1e-6);
}

TEST(SpinningBar, KeepsItsMomentaOverTwoTurnsAndStaysWhereItWas) {
  const SceneRun run = sound_run("spinning_bar", 1e-4, {"time.end=12.566370614", "output.every=12.0"});
  EXPECT_LT(*run.summary.angular_momentum_drift, 1e-13);
  EXPECT_NEAR(run.summary.energy.kinetic, 7438, 50);
  EXPECT_NEAR(run.summary.energy.strain, 1836, 20);
  EXPECT_NEAR(least(run, "min_detF_over_J"), 0.969, 0.003);
  EXPECT_LE(run.largest_energy, 1 + 1e-6);
}

}  // namespace
}  // namespace nanson
