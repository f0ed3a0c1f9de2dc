// The scenes of a study's runs, all read and checked before the first one starts.
#pragma once
#include <string>
#include <vector>

#include "io/study/study.hpp"
#include "io/study/verdict.hpp"

namespace nanson {

struct StudyRun {
  PlannedRun plan;
  std::string hash;  // of the scene with all settings, its mesh file and the number of threads: the name of its folder
  std::vector<std::string> arguments;  // run SCENE --threads N --set ...; without --out
  VerdictRules rules;
  double cost = 0;  // nodes^(4/3) end / cfl: proportional to its time, for the ETA
};

/// Every error of every run at once, at its place in the scene or in the study file; what several runs share is said once.
std::vector<StudyRun> prepare(const Study& study, std::vector<std::string>& errors);

}  // namespace nanson
