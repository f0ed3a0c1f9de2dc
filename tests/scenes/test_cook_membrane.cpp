// Cook's membrane at nu = 0.5 on an unstructured mesh against a static solution by other elements (Taylor-Hood, 6.92 m).
#include "tests/scenes/scene_run.hpp"

namespace nanson {
namespace {

TEST(CookMembrane, StandsAtTheStaticAnswerAtTheDefaultStep) {
  const SceneRun run = run_config("cook_membrane.toml", {});
  ASSERT_EQ(run.summary.status, "done");
  EXPECT_EQ(run.summary.integrator, "ssp_rk3");
  EXPECT_NEAR(run.summary.probes.at("tip").at("displacement")[1], 6.92, 0.04 * 6.92);  // 6.95
  EXPECT_LT(run.summary.extremes.speed.value, 1);  // 40 m/s where the step is too large
  EXPECT_LT(*run.summary.energy.closure, 0.01);
}

TEST(CookMembrane, TwoStagesAmplifyItsShearWavesAtAStepThatThreeDamp) {
  for (const char* integrator : {"tvd_rk2", "ssp_rk3"}) {
    const SceneRun run = run_config("cook_membrane.toml", {"mesh.file=meshes/cook_coarse.msh", "time.cfl=0.4",
                                                           std::string("time.integrator=") + integrator});
    EXPECT_EQ(run.summary.status == "done" && run.summary.extremes.speed.value < 1,
              std::string(integrator) == "ssp_rk3")
        << integrator << " " << run.summary.status << " " << run.summary.extremes.speed.value;
  }
}

}  // namespace
}  // namespace nanson
