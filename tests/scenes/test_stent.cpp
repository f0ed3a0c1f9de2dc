// The stent: its driven end goes where it must, the reactions carry the momentum, and it bends as it did.
#include <cmath>

#include "tests/scenes/scene_run.hpp"

namespace nanson {
namespace {

TEST(Stent, EndFollowsItsPathAndTheShellStaysWhereItWas) {
  for (const std::string formulation : {"pF", "pFJ"}) {  // the same pulse, earlier, so that the run is short
    const SceneRun run = run_config(
        "stent.toml", {"time.end=0.003", "boundary.end.time.centre=0.004", "physics.formulation=" + formulation,
                       "output.probes={end={at=[0.01,0,0.01],fields=['displacement']},middle={at=[0.01,0,0.005],fields="
                       "['displacement']}}"});
    EXPECT_EQ(run.summary.status, "done");
    const double path = -0.006
                        * (1 / (1 + std::exp(800 * 0.001))
                           - 1 / (1 + std::exp(800 * 0.004)));  // [m] integral of the prescribed velocity
    const auto &at_end = run.summary.probes.at("end").at("displacement"),
               &middle = run.summary.probes.at("middle").at("displacement");
    EXPECT_NEAR(at_end[2], path, 1e-5 * std::abs(path)) << formulation;
    EXPECT_NEAR(middle[0], formulation == "pF" ? 1.009e-3 : 0.723e-3, 2e-5) << formulation;
    EXPECT_NEAR(middle[2], formulation == "pF" ? -0.857e-3 : -0.814e-3, 2e-5) << formulation;
    EXPECT_NEAR(middle[1], 0, 1e-15) << formulation;
    EXPECT_LT(*run.summary.energy.closure, 1e-3) << formulation;
    EXPECT_LE(run.summary.linear_momentum_drift, 1e-12) << formulation;
    EXPECT_GT(run.summary.min_detF, formulation == "pF" ? 0.9 : 0.5)
        << "with one tet across the thickness J does not hold det F";
  }
}

TEST(Stent, PressedOnItsStripsStaysWhereItWas) {
  const SceneRun run = run_config("stent.toml", {"mesh.file=meshes/stent_strip.msh", "boundary.1.face=strip",
                                                 "time.end=0.003", "boundary.strip.time.centre=0.004",
                                                 "output.probes={strip={at=[0,0.005,0.01],fields=['displacement']},"
                                                 "side={at=[0.005,0,0.00866],fields=['displacement']}}"});
  EXPECT_EQ(run.summary.status, "done");
  const double path = -0.006 * (1 / (1 + std::exp(800 * 0.001)) - 1 / (1 + std::exp(800 * 0.004)));  // [m]
  const auto &at_strip = run.summary.probes.at("strip").at("displacement"),
             &side = run.summary.probes.at("side").at("displacement");
  EXPECT_NEAR(at_strip[2], path, 1e-5 * std::abs(path));
  EXPECT_NEAR(side[0], 0.156e-3, 5e-6);
  EXPECT_NEAR(side[2], -0.155e-3, 5e-6);
  EXPECT_LT(*run.summary.energy.closure, 1e-3);
  EXPECT_GT(run.summary.min_detF, 0.97);
}

}  // namespace
}  // namespace nanson
