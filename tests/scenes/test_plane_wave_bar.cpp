// The travelling pulse against d'Alembert's solution.
#include <cmath>

#include "tests/scenes/scene_run.hpp"

namespace nanson {
namespace {

TEST(PlaneWaveBar, ErrorsFallWithTheMesh) {
  const SceneRun coarse = run_config("plane_wave_bar.toml", {"mesh.cells=[32,4,4]"}),
                 fine = run_config("plane_wave_bar.toml");
  EXPECT_EQ(fine.summary.status, "done");
  const double p1 = std::log2(coarse.summary.errors.at("p1_L2") / fine.summary.errors.at("p1_L2"));
  const double P11 = std::log2(coarse.summary.errors.at("P11_L2") / fine.summary.errors.at("P11_L2"));
  EXPECT_GE(p1, 1.9);
  EXPECT_GE(P11, 1.9);
  EXPECT_LE(fine.largest_energy, 1 + 1e-6);
  RecordProperty("p1_L2", std::to_string(fine.summary.errors.at("p1_L2")));
}

}  // namespace
}  // namespace nanson
