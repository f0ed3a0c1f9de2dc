// What the writers wrote is read back; what is not whole is not taken for a summary.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "io/read_csv.hpp"
#include "io/results/read_summary.hpp"
#include "io/results/write_history.hpp"
#include "io/results/write_summary.hpp"
#include "tests/support/temporary_folder.hpp"

namespace nanson {
namespace {

TEST(ReadSummary, GivesBackWhatWasWritten) {
  Summary s;
  s.status = "breakdown";
  s.cause = "detF";
  s.reason = "tab\t \"quoted\" \\ \u00e9";
  s.nodes = 117649;
  s.wall_s = 0.1 + 0.2;
  s.linear_momentum_drift = -1.25e-300;
  s.min_detF = std::nan("");
  s.errors["p1_L2"] = 1.0 / 3;
  s.probes["tip"]["x"] = {1, 2.5, -3};
  const auto read = parse_summary(summary_json(s, {"1.2.3", "abc+", "", "", "", "host", ""}));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->texts.at("status"), "breakdown");
  EXPECT_EQ(read->texts.at("reason"), s.reason);
  EXPECT_EQ(read->texts.at("provenance.commit"), "abc+");
  EXPECT_EQ(read->texts.at("keep_angular_momentum"), "false");
  EXPECT_EQ(read->numbers.at("nodes"), 117649);
  EXPECT_EQ(read->numbers.at("wall_s"), 0.1 + 0.2);
  EXPECT_EQ(read->numbers.at("linear_momentum_drift"), -1.25e-300);
  EXPECT_EQ(read->numbers.at("errors.p1_L2"), 1.0 / 3);
  EXPECT_EQ(read->numbers.at("probes.tip.x.1"), 2.5);
  EXPECT_FALSE(read->numbers.contains("min_detF"));
}

TEST(ReadSummary, EveryCutOfASummaryIsRefused) {
  const std::string json = summary_json({}, {});
  for (std::size_t n = 0; n + 2 < json.size(); ++n) EXPECT_FALSE(parse_summary(json.substr(0, n))) << n;
  EXPECT_FALSE(parse_summary(json + "}"));
  for (const char* bad :
       {"{\"a\": nan}", "{\"a\": inf}", "{a: 1}", "{\"a\" 1}", "{\"a\": 1,}", "{\"a\": \"\\q\"}", "{\"a\": \"\\u12\"}"})
    EXPECT_FALSE(parse_summary(bad)) << bad;
}

TEST(ReadSummary, NumberKeysAreThoseOfTheFile) {
  Summary s;
  s.projection.emplace();
  s.throughput = Throughput{1, 1, 1, 1, 1, 1};
  s.energy.closure = s.energy.external_work = s.energy.dissipated = s.energy.angular_momentum_work =
      s.energy.lost_at_start = 0;
  s.angular_momentum_drift = 0;
  s.nodes = 1;
  s.peak_bytes = 0;
  Extremes& e = s.extremes;
  for (Extreme* x : {&e.least_tet_ratio, &e.least_detF, &e.most_detF, &e.least_detF_over_J, &e.most_detF_over_J,
                     &e.checkerboard, &e.speed})
    *x = {1, 0};
  for (const char* name : {"p1_L1", "p1_L2", "P11_L1", "P11_L2", "P11_L1_t0", "P11_L2_t0"}) s.errors[name] = 0;
  std::vector<std::string> written;
  const auto read = parse_summary(summary_json(s, {}));
  ASSERT_TRUE(read);
  for (const auto& [key, value] : read->numbers) written.push_back(key);
  std::vector<std::string> known = summary_numbers();
  std::sort(known.begin(), known.end());
  EXPECT_EQ(known, written);
}

TEST(ReadHistory, TakesTheColumnsThatThereAre) {
  const test::TemporaryFolder folder;
  {
    HistoryWriter writer(folder / "history.csv", {{"t", "s"}, {"kinetic", "J"}, {"odd, name", "-"}, {"min_detF", "-"}});
    writer.row(std::vector<double>{0, 1, 2, 3});
    writer.row(std::vector<double>{0.1, 1.5, 2, std::nan("")});
  }
  test::write_text(folder / "cut.csv", test::read_text(folder / "history.csv") + "0.2,1.");
  for (const char* name : {"history.csv", "cut.csv"}) {
    const RunHistory h = read_history(folder / name);
    EXPECT_EQ(h.t, (std::vector<double>{0, 0.1}));
    EXPECT_EQ(h.kinetic, (std::vector<double>{1, 1.5}));
    EXPECT_TRUE(h.strain.empty());
    ASSERT_EQ(h.min_detF.size(), 2u);
    EXPECT_TRUE(std::isnan(h.min_detF[1]));
  }
  EXPECT_TRUE(read_history(folder / "none.csv").t.empty());
}

TEST(ReadCsv, KnowsQuotesCommentsAndWrongRows) {
  std::string why;
  const auto table = parse_csv("# peers\nlabel,cpu_s [s]\n\"a, \"\"b\"\"\",1.5\r\n", why);
  ASSERT_TRUE(table) << why;
  EXPECT_EQ(table->names, (std::vector<std::string>{"label", "cpu_s"}));
  EXPECT_EQ(table->rows, (std::vector<std::vector<std::string>>{{"a, \"b\"", "1.5"}}));
  EXPECT_FALSE(parse_csv("a,b\n1,2\n3\n", why));
  EXPECT_EQ(why, "line 3 has 1 fields, the heading 2");
  EXPECT_FALSE(parse_csv("", why));
  EXPECT_EQ(csv_text("a, \"b\""), "\"a, \"\"b\"\"\"");
}

}  // namespace
}  // namespace nanson
