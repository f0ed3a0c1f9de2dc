// What `nanson new` writes is a scene that runs.
#include <filesystem>

#include "io/new_scene.hpp"
#include "scene_run.hpp"
#include "tests/support/temporary_folder.hpp"

namespace nanson {
namespace {

/// The beam swings down by the 0.11 m that README.md tells, within the spread of a change of the scheme.
TEST(NewScene, RunsAndBendsTheBeam) {
  const test::TemporaryFolder folder;
  test::write_text(folder / "beam.toml", new_scene_text("beam"));
  std::vector<std::string> errors;
  const auto loaded = load(folder / "beam.toml", {}, errors);
  ASSERT_TRUE(loaded) << (errors.empty() ? "" : errors[0]);
  Simulation s = make_simulation(loaded->scene, loaded->mesh, 1);
  std::string reason;
  const std::string status = run(s, {}, reason);
  const Summary summary = summarise(s, place_probes(loaded->scene, loaded->mesh), status, reason);
  EXPECT_EQ(summary.status, "done");
  const double tip = summary.probes.at("tip").at("displacement")[2];
  EXPECT_LT(tip, -0.08);
  EXPECT_GT(tip, -0.13);
}

}  // namespace
}  // namespace nanson
