// Verdicts from made-up summaries and histories.
#include <gtest/gtest.h>

#include <cmath>

#include "io/study/verdict.hpp"

namespace nanson {
namespace {

constexpr VerdictRules rules{1e-6, 0.3, 10, false};

/// A sound run of three rows whose energy falls.
RunOutcome sound_run() {
  RunOutcome r;
  r.summary = RunSummary{{{"checkerboard", 0.1}, {"energy.initial", 10}},
                         {{"status", "done"}, {"reason", ""}, {"cause", ""}}};
  r.history = {{0, 1, 2}, {10, 5, 4}, {0, 5, 5}, {}, {}, {1, 0.9, 0.95}, {1, 0.9, 0.95}, {1, 0.8, 0.9}};
  return r;
}

RunOutcome broken(const std::string& cause, const std::string& reason) {
  RunOutcome r = sound_run();
  r.exit_code = 3;
  r.summary->texts = {{"status", "breakdown"}, {"cause", cause}, {"reason", reason}};
  return r;
}

TEST(Verdict, SoundNeedsNoReason) {
  const Judgement j = judge(sound_run(), rules);
  EXPECT_EQ(j.verdict, Verdict::sound);
  EXPECT_EQ(j.reason, "");
  EXPECT_EQ(j.energy_excess, 0.0);
  EXPECT_EQ(j.min_detF, 0.9);
  EXPECT_EQ(j.min_tet_ratio, 0.8);
}

TEST(Verdict, EnergyThatGrewIsTimedAndMeasured) {
  RunOutcome r = sound_run();
  r.history.strain = {0, 5.0001, 6.5};
  const Judgement j = judge(r, rules);
  EXPECT_EQ(j.verdict, Verdict::energy_grew);
  EXPECT_NEAR(*j.energy_excess, 0.05, 1e-12);
  EXPECT_NE(j.reason.find("from t = 1 s on, by 0.05 of them"), std::string::npos) << j.reason;
  VerdictRules loose = rules;
  loose.energy_tolerance = 0.06;
  EXPECT_EQ(judge(r, loose).verdict, Verdict::sound);
}

TEST(Verdict, ExternalWorkMayRaiseEnergy) {
  RunOutcome r = sound_run();
  r.history.strain = {0, 10, 16};
  r.history.external_work = {0, 5, 10};
  EXPECT_EQ(judge(r, rules).verdict, Verdict::sound);
  r.history.external_work = {0, 5, 9.9};
  EXPECT_EQ(judge(r, rules).verdict, Verdict::energy_grew);
}

TEST(Verdict, WorkThatWasNotRecordedLeavesEnergyOpen) {
  RunOutcome r = sound_run();
  r.history.strain = {0, 10, 16};
  VerdictRules loaded = rules;
  loaded.works = true;
  EXPECT_EQ(judge(r, loaded).verdict, Verdict::sound);
  EXPECT_FALSE(judge(r, loaded).energy_excess);
}

TEST(Verdict, EnergyThatIsNotANumberDoesNotPass) {
  RunOutcome r = sound_run();
  r.history.strain[2] = std::nan("");
  EXPECT_EQ(judge(r, rules).verdict, Verdict::energy_grew);
}

TEST(Verdict, GeometryOnTheWayCounts) {
  for (auto column : {&RunHistory::min_detF, &RunHistory::min_J, &RunHistory::min_tet_ratio}) {
    RunOutcome r = sound_run();
    (r.history.*column)[1] = -0.1;
    EXPECT_EQ(judge(r, rules).verdict, Verdict::inverted);
    EXPECT_NE(judge(r, rules).reason.find("-0.1"), std::string::npos);
  }
}

TEST(Verdict, CheckerboardIsJudgedWhereABoundIsSet) {
  RunOutcome r = sound_run();
  r.summary->numbers["checkerboard"] = 0.9;
  EXPECT_EQ(judge(r, rules).verdict, Verdict::checkerboard);
  VerdictRules open = rules;
  open.checkerboard_max = 0;
  EXPECT_EQ(judge(r, open).verdict, Verdict::sound);
}

TEST(Verdict, ABreakdownHasItsCause) {
  const std::pair<const char*, Verdict> table[] = {{"detF", Verdict::inverted},
                                                   {"J", Verdict::inverted},
                                                   {"not_finite", Verdict::not_finite},
                                                   {"dt_collapse", Verdict::dt_collapse},
                                                   {"energy_growth", Verdict::energy_grew},
                                                   {"iteration_limit", Verdict::iteration_limit}};
  for (const auto& [cause, verdict] : table) {
    const Judgement j = judge(broken(cause, "why"), rules);
    EXPECT_EQ(j.verdict, verdict) << cause;
    EXPECT_EQ(j.reason, "why");
  }
}

TEST(Verdict, GrowthBeforeABreakdownIsWhatBrokeIt) {
  RunOutcome r = broken("detF", "det F is not positive");
  r.history.strain = {0, 50, 1e9};
  const Judgement j = judge(r, rules);
  EXPECT_EQ(j.verdict, Verdict::energy_grew);
  EXPECT_NE(j.reason.find("then det F is not positive"), std::string::npos) << j.reason;
}

TEST(Verdict, StoppedRunsAreNotSound) {
  RunOutcome r = sound_run();
  r.summary->texts = {{"status", "stopped"}, {"cause", "max_steps"}, {"reason", "time.max_steps reached"}};
  EXPECT_EQ(judge(r, rules).verdict, Verdict::stopped);
  r.summary->texts["cause"] = "max_wall_s";
  EXPECT_EQ(judge(r, rules).verdict, Verdict::too_slow);
  r = sound_run();
  r.too_slow = true;
  EXPECT_EQ(judge(r, rules).verdict, Verdict::too_slow);
  EXPECT_EQ(judge(r, rules).reason, "took longer than report.max_wall_s = 10 s");
}

TEST(Verdict, AProgramThatDiedIsAResult) {
  RunOutcome r;
  r.exit_code = 139;
  EXPECT_EQ(judge(r, rules).verdict, Verdict::failed);
  EXPECT_EQ(judge(r, rules).reason, "the program was ended by signal 11 without a summary");
  r.exit_code = 1;
  r.last_words = "no memory";
  EXPECT_EQ(judge(r, rules).reason, "the program ended with exit code 1 without a summary: no memory");
}

}  // namespace
}  // namespace nanson
