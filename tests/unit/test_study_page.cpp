// CSV, plots and page from made-up results.
#include <gtest/gtest.h>

#include <cmath>

#include "io/read_csv.hpp"
#include "io/study/study_plots.hpp"

namespace nanson {
namespace {

Study map_study() {
  Study s;
  s.name = "map";
  s.kind = StudyKind::stability;
  s.vary = {{"physics.formulation", {{"physics.formulation", "\"pF\"", ""}, {"physics.formulation", "\"pFJ\"", ""}}},
            {"time.cfl", {{"time.cfl", "0.3", ""}, {"time.cfl", "0.9", ""}}}};
  s.report.x = "time.cfl";
  s.report.y = {"errors.p1_L2"};
  s.report.title = "<Map> & \"more\"";
  return s;
}

/// Runs 1 to 3 made, the third broke down; run 4 not reached.
StudyResults sample(const Study& s) {
  StudyResults all;
  all.study = &s;
  all.folder = "results/map";
  all.command = "nanson study map.toml";
  for (PlannedRun& p : plan(s)) {
    StudyRun run;
    run.plan = p;
    run.hash = text_hash(p.label);
    run.arguments = {"run", "a b.toml", "--set", "x='1'"};
    all.runs.push_back(run);
  }
  all.results.resize(4);
  for (std::size_t i = 0; i < 3; ++i) {
    RunOutcome o;
    o.summary = RunSummary{
        {{"errors.p1_L2", 0.1 / (1.0 + static_cast<double>(i))}, {"volume", 1}, {"tets", 48}, {"cpu_s", 2}},
        {{"status", i < 2 ? "done" : "breakdown"},
         {"cause", i < 2 ? "" : "detF"},
         {"reason", i < 2 ? "" : "J < 0, \"there\""}}};
    all.results[i] = assess(all.runs[i], o);
  }
  return all;
}

TEST(StudyTable, HasOneRowARunThatWasMade) {
  const Study s = map_study();
  std::string why;
  const auto table = parse_csv(study_csv(sample(s)), why);
  ASSERT_TRUE(table) << why;
  ASSERT_EQ(table->rows.size(), 3u);
  EXPECT_EQ(table->numbers("run"), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(table->rows[2][*table->column("verdict")], "J <= 0");
  EXPECT_EQ(table->rows[2][*table->column("reason")], "J < 0, \"there\"");
  EXPECT_EQ(table->rows[2][*table->column("physics.formulation")], "pFJ");
  EXPECT_EQ(table->numbers("time.cfl"), (std::vector<double>{0.3, 0.9, 0.3}));
  for (const double h : table->numbers("h")) EXPECT_DOUBLE_EQ(h, 0.5);
}

TEST(StudyResults, RatesNeedTwoRunsThatEnded) {
  Study s = map_study();
  s.report.rate_over = "time.cfl";
  StudyResults all = sample(s);
  find_rates(all);
  ASSERT_TRUE(all.results[1].rates.contains("errors.p1_L2"));
  EXPECT_NEAR(all.results[1].rates.at("errors.p1_L2"), std::log(2.0) / std::log(1.0 / 3), 1e-12);
  for (int i : {0, 2, 3}) EXPECT_TRUE(all.results[static_cast<std::size_t>(i)].rates.empty()) << i;
}

TEST(StudyPlots, AMapHasOneMarkARunAndASeriesAVerdict) {
  const Study s = map_study();
  const auto plots = study_plots(sample(s));
  ASSERT_EQ(plots.size(), 1u);
  const std::string& script = plots[0].script;
  EXPECT_NE(script.find("$verdict0 << EOD\n0 0\n1 0\nEOD"), std::string::npos) << script;
  EXPECT_NE(script.find("$verdict2 << EOD\n0 1\nEOD"), std::string::npos) << script;
  EXPECT_EQ(script.find("$verdict1"), std::string::npos);
}

TEST(StudyPlots, ErrorsOfBrokenRunsAreNotDrawn) {
  Study s = map_study();
  s.kind = StudyKind::sweep;
  s.report.lines = {"physics.formulation"};
  s.report.reference = {{"peer", {{"time.cfl", 0.5}, {"errors.p1_L2", 0.2}}}, {"elsewhere", {{"time.cfl", 0.5}}}};
  const auto plots = study_plots(sample(s));
  ASSERT_EQ(plots.size(), 1u);
  EXPECT_NE(plots[0].script.find("title 'pF'"), std::string::npos);
  EXPECT_EQ(plots[0].script.find("title 'pFJ'"), std::string::npos);
  EXPECT_NE(plots[0].script.find("title 'peer'"), std::string::npos);
  EXPECT_EQ(plots[0].script.find("elsewhere"), std::string::npos);
}

TEST(StudyPlots, NoStringInAScriptCanRunACommand) {
  EXPECT_EQ(gnuplot_text("a`b`\\ 'c'\n$d"), "'a`b`\\ ''c'' $d'");
  for (const StudyKind kind : {StudyKind::stability, StudyKind::sweep, StudyKind::compare}) {
    Study s = map_study();
    s.kind = kind;
    s.report.reference = {{"x`r`", {{"time.cfl", 0.5}, {"errors.p1_L2", 0.2}}}};
    s.vary[0].values[0].value = "\"a`n`\"";
    for (const StudyPlot& p : study_plots(sample(s))) {
      bool single = false, doubled = false;
      for (const char c : p.script) {
        single ^= c == '\'' && !doubled;
        doubled ^= c == '"' && !single;
        EXPECT_TRUE(c != '`' || single) << p.script;
      }
    }
  }
}

TEST(StudyTable, NoCellIsAFormula) {
  EXPECT_EQ(csv_text("=1+1"), "'=1+1");
  EXPECT_EQ(csv_text("@SUM(A1,A2)"), "\"'@SUM(A1,A2)\"");
  EXPECT_EQ(csv_text("-x"), "'-x");
  EXPECT_EQ(csv_text("\tx"), "' x");
  EXPECT_EQ(csv_text("\x1b[31mred\n"), "\\x1b[31mred ");
  for (const char* number : {"-5", "+1e-3", "-inf", "-0.25"}) EXPECT_EQ(csv_text(number), number);
}

TEST(StudyPage, EscapesTextAndQuotesCommands) {
  const Study s = map_study();
  const std::string page = study_page(sample(s), {});
  EXPECT_NE(page.find("<h1>&lt;Map&gt; &amp; &quot;more&quot;</h1>"), std::string::npos);
  EXPECT_NE(page.find("3 of 4 made: 2 sound, 1 J &lt;= 0"), std::string::npos);
  EXPECT_NE(page.find("J &lt; 0, &quot;there&quot;"), std::string::npos);
  EXPECT_NE(page.find("nanson run 'a b.toml' --set 'x='\\''1'\\'''"), std::string::npos) << page;
  EXPECT_EQ(shell_quoted("time.end=0.1"), "time.end=0.1");
  EXPECT_EQ(shell_quoted("~x"), "'~x'");
  EXPECT_EQ(shell_quoted(""), "''");
  EXPECT_EQ(escaped(std::string("a\x01") + "b\n"), "a b\n");
}

}  // namespace
}  // namespace nanson
