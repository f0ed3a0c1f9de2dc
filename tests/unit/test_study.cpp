// The plan of a study: which runs, in which order, which are neighbours; rates and hashes.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "io/study/study.hpp"

namespace nanson {
namespace {

StudyAxis axis(const std::string& key, const std::vector<std::string>& values) {
  StudyAxis a{key, {}};
  for (const std::string& v : values) a.values.push_back({key, v, "s.toml:1:1"});
  return a;
}

Study two_by_three() {
  Study s;
  s.scene = "cube.toml";
  s.set = {{"time.end", "0.1", ""}};
  s.vary = {axis("physics.formulation", {"\"pF\"", "\"pFJ\""}),
            axis("mesh.cells", {"[2, 2, 2]", "[4, 4, 4]", "[8, 8, 8]"})};
  return s;
}

std::vector<std::string> labels(const Study& s) {
  std::vector<std::string> all;
  for (const PlannedRun& r : plan(s)) all.push_back(r.label);
  return all;
}

TEST(StudyPlan, EveryCombinationIsARunAndTheFirstKeyChangesSlowest) {
  EXPECT_EQ(
      labels(two_by_three()),
      (std::vector<std::string>{
          "physics.formulation = pF, mesh.cells = [2, 2, 2]", "physics.formulation = pF, mesh.cells = [4, 4, 4]",
          "physics.formulation = pF, mesh.cells = [8, 8, 8]", "physics.formulation = pFJ, mesh.cells = [2, 2, 2]",
          "physics.formulation = pFJ, mesh.cells = [4, 4, 4]", "physics.formulation = pFJ, mesh.cells = [8, 8, 8]"}));
}

TEST(StudyPlan, VariedValuesComeAfterTheCaseAndTheCommonOnes) {
  Study s = two_by_three();
  s.cases = {{"soft", {}, {{"time.end", "0.2", ""}}}, {"hard", "other.toml", {}}};
  const auto runs = plan(s);
  ASSERT_EQ(runs.size(), 12u);
  std::vector<std::string> keys;
  for (const StudySetting& x : runs[0].settings) keys.push_back(x.key + "=" + x.value);
  EXPECT_EQ(keys, (std::vector<std::string>{"time.end=0.1", "time.end=0.2", "physics.formulation=\"pF\"",
                                            "mesh.cells=[2, 2, 2]"}));
  EXPECT_EQ(runs[0].scene, "cube.toml");
  EXPECT_EQ(runs[6].scene, "other.toml");
  EXPECT_EQ(runs[6].label, "hard, physics.formulation = pF, mesh.cells = [2, 2, 2]");
  EXPECT_EQ(varied_keys(s), (std::vector<std::string>{"case", "physics.formulation", "mesh.cells"}));
  EXPECT_EQ(name_of(runs[6], {"case", "physics.formulation"}), "hard, pF");
}

TEST(StudyPlan, CasesAloneAreRunsOfTheirOwn) {
  Study s = two_by_three();
  s.vary.clear();
  s.cases = {{"a", {}, {}}, {"b", {}, {}}};
  EXPECT_EQ(labels(s), (std::vector<std::string>{"a", "b"}));
}

TEST(StudyPlan, NeighboursDifferInOneKeyOnly) {
  const auto runs = plan(two_by_three());
  EXPECT_EQ(predecessors(runs, "mesh.cells"), (std::vector<int>{-1, 0, 1, -1, 3, 4}));
  EXPECT_EQ(predecessors(runs, "physics.formulation"), (std::vector<int>{-1, -1, -1, 0, 1, 2}));
  EXPECT_EQ(predecessors(runs, "time.cfl"), std::vector<int>(6, -1));
}

TEST(StudyRates, FollowFromTwoErrors) {
  EXPECT_NEAR(*observed_rate(0.5, 0.4, 0.25, 0.1), 2, 1e-14);
  EXPECT_NEAR(*observed_rate(0.25, 0.1, 0.5, 0.4), 2, 1e-14);
  EXPECT_NEAR(*observed_rate(0.3, 0.1, 0.1, 0.2), std::log(0.5) / std::log(3.0), 1e-14);
  EXPECT_FALSE(observed_rate(0.5, 0.4, 0.5, 0.1));
  EXPECT_FALSE(observed_rate(0.5, 0, 0.25, 0.1));
  EXPECT_FALSE(observed_rate(0.5, 0.4, 0.25, std::nan("")));
  EXPECT_FALSE(observed_rate(0.5, INFINITY, 0.25, 0.1));
}

TEST(StudyValues, AreReadAsNumbersWhereTheyAre) {
  EXPECT_EQ(number_in("[24, 12, 6]"), 24);
  EXPECT_EQ(number_in("1.5e-3"), 1.5e-3);
  EXPECT_FALSE(number_in("\"pF\""));
  EXPECT_FALSE(number_in("true"));
  EXPECT_FALSE(number_in("inf"));
  EXPECT_FALSE(number_in("[]"));
  EXPECT_EQ(readable("\"pFJ\""), "pFJ");
  EXPECT_EQ(readable("[1, 2]"), "[1, 2]");
}

TEST(StudyHash, IsFnv1aAndTellsTextsApart) {
  EXPECT_EQ(text_hash(""), "cbf29ce484222325");
  EXPECT_EQ(text_hash("a"), "af63dc4c8601ec8c");
  std::set<std::string> hashes;
  for (int i = 0; i < 1000; ++i) hashes.insert(text_hash("time.cfl = 0." + std::to_string(i)));
  EXPECT_EQ(hashes.size(), 1000u);
}

}  // namespace
}  // namespace nanson
