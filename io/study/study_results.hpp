// What is known of a study's runs: outcome, verdict, the quantities that plots and tables ask for, rates between neighbours.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/provenance.hpp"
#include "io/study/study_scenes.hpp"

namespace nanson {

struct StudyRunResult {
  bool made = false;    // false: not reached yet
  bool reused = false;  // by a resumed study
  RunOutcome outcome;
  Judgement judgement;
  std::map<std::string, double>
      quantities;                       // numbers of the summary, of the study (study_quantities), and of varied keys
  std::map<std::string, double> rates;  // of report.y, against the predecessor along report.rate_over

  /// It came to its end, so that its errors mean something.
  bool ended() const {
    return made && outcome.summary && outcome.summary->texts.contains("status")
           && outcome.summary->texts.at("status") == "done";
  }
};

struct StudyResults {
  const Study* study = nullptr;
  std::vector<StudyRun> runs;
  std::vector<StudyRunResult> results;  // one a run
  std::filesystem::path folder;
  Provenance from;
  std::string machine;  // processor as the system names it, and its number of cores
  std::string command;  // that makes all of this
  int done() const;
};

/// Verdict and quantities of one run.
StudyRunResult assess(const StudyRun& run, RunOutcome outcome);

/// Rates of all results; to be called when they are known.
void find_rates(StudyResults& all);

std::optional<double> quantity(const StudyRunResult& r, const std::string& name);

}  // namespace nanson
