// summary.json: stable keys, null for what is missing or not finite. (tests/tools/read_with_h5py.py reads a whole one with a JSON parser.)
#include <gtest/gtest.h>

#include <limits>

#include "io/results/write_summary.hpp"
#include "tests/support/temporary_folder.hpp"

namespace nanson {
namespace {

const Provenance from{"1.2.3", "0123456789ab+", "GNU 12", "-O3", "native (x)", "host", "2026-01-01T00:00:00Z"};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(WriteSummary, HasAllKeys) {
  Summary all;
  all.projection.emplace();
  all.throughput.emplace();
  all.errors["p1_L1"] = 0;
  const std::string json = summary_json(all, from);
  for (const char* key : {"status",
                          "reason",
                          "cause",
                          "scene",
                          "formulation",
                          "material",
                          "description",
                          "stabilisation",
                          "reconstruction",
                          "flux_correction",
                          "boundary_flux",
                          "upwind_metric",
                          "pressure_jump",
                          "parting",
                          "tet_stiffness",
                          "tet_barrier",
                          "integrator",
                          "step",
                          "split",
                          "nodes",
                          "tets",
                          "edges",
                          "steps",
                          "t_end",
                          "dt_min",
                          "dt_max",
                          "threads",
                          "wall_s",
                          "cpu_s",
                          "setup_s",
                          "ns_per_node_step",
                          "bytes_per_node",
                          "peak_bytes",
                          "peak_bytes_per_node",
                          "fields_left_out",
                          "state_hash",
                          "energy",
                          "initial",
                          "kinetic",
                          "strain",
                          "external_work",
                          "dissipated",
                          "angular_momentum_work",
                          "closure",
                          "lost_at_start",
                          "mass",
                          "volume",
                          "keep_angular_momentum",
                          "angular_momentum_drift",
                          "linear_momentum_drift",
                          "min_detF",
                          "max_detF",
                          "errors",
                          "probes",
                          "setup",
                          "sweeps",
                          "checkerboard",
                          "extremes",
                          "warnings",
                          "projection",
                          "throughput",
                          "provenance",
                          "version",
                          "commit",
                          "compiler",
                          "flags",
                          "cpu",
                          "host"})
    EXPECT_TRUE(contains(json, '"' + std::string(key) + "\": ")) << key;
}

TEST(WriteSummary, MissingAndNonFiniteNumbersAreNull) {
  Summary summary;
  summary.energy.closure = 0.25;
  summary.min_detF = std::numeric_limits<double>::quiet_NaN();
  summary.max_detF = -std::numeric_limits<double>::infinity();
  summary.errors["p1_L2"] = std::numeric_limits<double>::infinity();
  summary.probes["tip"]["v"] = {1.0, std::numeric_limits<double>::quiet_NaN()};
  const std::string json = summary_json(summary, from);
  for (const char* text : {"\"external_work\": null", "\"closure\": 0.25", "\"min_detF\": null", "\"max_detF\": null",
                           "\"p1_L2\": null", "null\n"})
    EXPECT_TRUE(contains(json, text)) << text << json;
  EXPECT_FALSE(contains(json, "NaN"));
  EXPECT_FALSE(contains(json, "Infinity"));
}

TEST(WriteSummary, ThePeakIsSharedOutOverTheNodes) {
  Summary summary;
  EXPECT_TRUE(contains(summary_json(summary, from), "\"peak_bytes_per_node\": null"));
  summary.nodes = 1000;
  summary.peak_bytes = 1.5e6;
  EXPECT_TRUE(contains(summary_json(summary, from), "\"peak_bytes_per_node\": 1500"));
}

TEST(WriteSummary, TextIsEscapedAndNeverTakenForNull) {
  Summary summary;
  summary.reason = "NaN in \"NaN\": NaN\\";
  summary.scene = "a\"";
  summary.material = "\n\x01";
  const std::string json = summary_json(summary, from);
  for (const char* text : {R"("reason": "NaN in \"NaN\": NaN\\")", R"("scene": "a\"")", R"("material": "\n\u0001")"})
    EXPECT_TRUE(contains(json, text)) << text;
}

TEST(WriteSummary, NumbersKeepAllDigitsAndCountsAreWhole) {
  Summary summary;
  summary.nodes = 117649;
  summary.wall_s = 0.1 + 0.2;
  summary.sweeps = {{"edge_flux", 1.5}, {"stress", 1.0}, {"edge_flux", 0.25}};
  const std::string json = summary_json(summary, from);
  for (const char* text : {"\"nodes\": 117649,", "\"wall_s\": 0.30000000000000004", "\"edge_flux\": 1.75"})
    EXPECT_TRUE(contains(json, text)) << text;
}

TEST(WriteSummary, TheFileIsReplacedAsAWhole) {
  const test::TemporaryFolder folder;
  test::write_text(folder / "summary.json", "old");
  write_summary(folder / "summary.json", {}, from);
  EXPECT_EQ(test::read_text(folder / "summary.json"), summary_json({}, from));
  EXPECT_FALSE(std::filesystem::exists(folder / "summary.json.tmp"));
}

TEST(WriteSummary, AFolderThatIsMissingIsReported) {
  const test::TemporaryFolder folder;
  try {
    write_summary(folder / "none" / "summary.json", {}, from);
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()),
              (folder / "none").string() + "/summary.json: could not be written: No such file or directory");
  }
}

}  // namespace
}  // namespace nanson
