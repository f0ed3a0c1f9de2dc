// A pulse through a jump of density and stiffness against the one-dimensional coefficients of reflection and transmission.
#include <algorithm>

#include "tests/scenes/scene_run.hpp"

namespace nanson {
namespace {

struct Coefficients1D {
  double reflected, transmitted;
};

/// Largest velocities that pass the probes on both sides, over the incident one.
Coefficients1D measured(const SceneRun& run) {
  const std::vector<double> soft = run.column("soft_velocity_x"), hard = run.column("hard_velocity_x");
  const double incident = *std::ranges::max_element(soft);
  return {*std::ranges::min_element(soft) / incident, *std::ranges::max_element(hard) / incident};
}

TEST(TwoMaterialsBar, ReflectsAndTransmitsLikeTheImpedances) {
  for (const char* formulation : {"physics.formulation=pF", "physics.formulation=pFJ"}) {
    const SceneRun coarse = run_config("two_materials_bar.toml", {"mesh.cells=[64,4,4]", formulation}),
                   fine = run_config("two_materials_bar.toml", {"mesh.cells=[128,4,4]", formulation});
    const Coefficients1D c = measured(coarse), f = measured(fine);
    EXPECT_EQ(fine.summary.status, "done");
    EXPECT_NEAR(fine.summary.mass, 3000 * 0.125 * 0.125, 1e-12);
    EXPECT_EQ(fine.summary.material, "soft linear_elastic, hard linear_elastic");
    EXPECT_NEAR(c.reflected, -0.6, 0.09) << formulation;
    EXPECT_NEAR(c.transmitted, 0.4, 0.045) << formulation;
    EXPECT_NEAR(f.reflected, -0.6, 0.02) << formulation;
    EXPECT_NEAR(f.transmitted, 0.4, 0.01) << formulation;
    EXPECT_LE(*fine.summary.energy.closure, 2e-4) << formulation;
  }
}

}  // namespace
}  // namespace nanson
