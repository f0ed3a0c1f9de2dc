// Period of the plate's first bending mode at small amplitude against the free-free Timoshenko beam.
#include "tests/scenes/scene_run.hpp"

namespace nanson {
namespace {

/// Twice the time between the first two zeros of the displacement after the start (it starts from zero): a period [s].
double period(const SceneRun& run) {
  const auto t = run.column("t"), u = run.column("centre_displacement_z");
  std::vector<double> zeros{0};
  for (std::size_t i = 2; i < u.size(); ++i)
    if (u[i - 1] * u[i] < 0) zeros.push_back(t[i - 1] + (t[i] - t[i - 1]) * u[i - 1] / (u[i - 1] - u[i]));
  EXPECT_GE(zeros.size(), 3u);
  return zeros.size() < 3 ? 0 : zeros[2];
}

TEST(BerylliumPlate, PeriodIsTimoshenkosOnTheMiddleMesh) {
  const SceneRun plain = run_config("beryllium_plate.toml", {"physics.flux_correction=none"});
  EXPECT_NEAR(period(plain), 28.96e-6, 0.03 * 28.96e-6);
  EXPECT_LE(plain.largest_energy, 1 + 1e-6);
  const SceneRun corrected = run_config("beryllium_plate.toml");
  EXPECT_NEAR(period(corrected), 28.96e-6, 0.01 * 28.96e-6);
  EXPECT_LE(corrected.largest_energy, 1 + 1e-6);
}

TEST(BerylliumPlate, NearlyIncompressibleVariantDoesNotLock) {
  const SceneRun run = run_config("beryllium_plate_incompressible.toml", {"mesh.cells=[4,24,4]"});
  EXPECT_EQ(run.summary.status, "done");
  EXPECT_NEAR(period(run), 29.27e-6, 0.03 * 29.27e-6);
  EXPECT_LE(run.largest_energy, 1 + 1e-6);
}

}  // namespace
}  // namespace nanson
