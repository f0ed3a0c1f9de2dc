// The verdict on a run, from its summary and history: sound, or one word and a sentence for what was wrong.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "io/results/read_summary.hpp"
#include "kernels/traits.hpp"

namespace nanson {

enum class Verdict {
  sound,
  energy_grew,
  inverted,
  not_finite,
  dt_collapse,
  checkerboard,
  iteration_limit,
  too_slow,
  stopped,
  failed
};
constexpr auto words(Verdict) {
  return std::array<std::string_view, 10>{"sound",        "energy grew",     "J <= 0",   "not finite", "dt collapse",
                                          "checkerboard", "iteration limit", "too slow", "stopped",    "failed"};
}

/// What a child process left behind.
struct RunOutcome {
  std::optional<RunSummary> summary;
  RunHistory history;
  int exit_code = 0;       // 128 + n: ended by signal n
  bool too_slow = false;   // ended by the study
  double wall_s = 0;       // [s] of the whole process
  std::string last_words;  // the end of its log, when it failed
};

struct VerdictRules {
  double energy_tolerance = 1e-6;  // [-] of the initial energy
  double checkerboard_max = 0;     // [-] 0: not judged
  double max_wall_s = 0;           // [s]
  bool works = false;  // loads, moving supports or body forces: without monitor.energy their work is not known
};

struct Judgement {
  Verdict verdict = Verdict::sound;
  std::string reason;  // a sentence, empty when sound
  std::optional<double>
      energy_excess;  // [-] largest (E - E0 - W) over the larger of E0 and the largest |W|; nothing when it is not known
  double min_detF = 0, min_tet_ratio = 0;  // [-] least over the run; NaN when it was not recorded
};

Judgement judge(const RunOutcome& run, const VerdictRules& rules);

}  // namespace nanson
