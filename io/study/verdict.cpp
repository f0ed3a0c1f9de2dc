// What broke the run comes first, then what it violated on its way, then what it left.
#include "io/study/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nanson {
namespace {

struct Growth {
  double largest = 0, first_t = -1, scale = 0;  // [-], [s] of the first row beyond the tolerance, [J]
};

/// Nothing when the history cannot say: no rows, or work that was not recorded.
std::optional<Growth> growth(const RunHistory& h, const VerdictRules& rules) {
  const bool knows_work = h.external_work.size() == h.t.size();
  if (h.t.empty() || h.kinetic.size() != h.t.size() || h.strain.size() != h.t.size() || (rules.works && !knows_work))
    return std::nullopt;
  const double start = h.kinetic[0] + h.strain[0];
  Growth g;
  g.scale = start;
  for (std::size_t i = 0; i < h.t.size(); ++i) {
    double given = knows_work ? h.external_work[i] : 0;
    if (h.angular_momentum_work.size() == h.t.size()) given += h.angular_momentum_work[i];
    g.scale = std::max(g.scale, std::abs(given));
    if (!(g.scale > 0)) continue;
    const double excess = (h.kinetic[i] + h.strain[i] - start - given) / g.scale;
    if (!(excess <= g.largest)) g.largest = excess;  // takes NaN too
    if (!(excess <= rules.energy_tolerance) && g.first_t < 0) g.first_t = h.t[i];
  }
  return g;
}

double least(const std::vector<double>& values) {
  double least = std::numeric_limits<double>::quiet_NaN();
  for (const double v : values)
    if (std::isnan(least) || v < least) least = v;
  return least;
}

std::string text_of(const RunSummary& s, const std::string& key) {
  const auto at = s.texts.find(key);
  return at == s.texts.end() ? "" : at->second;
}

Verdict verdict_of_cause(const std::string& cause) {
  if (cause == "detF" || cause == "J" || cause == "inverted_tet") return Verdict::inverted;
  if (cause == "not_finite") return Verdict::not_finite;
  if (cause == "dt_collapse") return Verdict::dt_collapse;
  if (cause == "energy_growth") return Verdict::energy_grew;
  if (cause == "iteration_limit") return Verdict::iteration_limit;
  if (cause == "max_wall_s") return Verdict::too_slow;
  return Verdict::stopped;
}

/// What the run violated, although it went on; empty when nothing.
void judge_course(Judgement& j, const RunOutcome& run, const std::optional<Growth>& g, const VerdictRules& rules) {
  const auto found = [&](Verdict v, std::string reason) {
    if (j.verdict == Verdict::sound) {
      j.verdict = v;
      j.reason = std::move(reason);
    }
  };
  if (g && g->first_t >= 0)
    found(Verdict::energy_grew, fmt::format("more than the initial energy and external work from t = {:.4g} s on, by "
                                            "{:.3g} of them at most (allowed {:g})",
                                            g->first_t, g->largest, rules.energy_tolerance));
  if (j.min_detF <= 0) found(Verdict::inverted, fmt::format("det F fell to {:.3g}", j.min_detF));
  if (const double J = least(run.history.min_J); J <= 0) found(Verdict::inverted, fmt::format("J fell to {:.3g}", J));
  if (j.min_tet_ratio <= 0)
    found(Verdict::inverted,
          fmt::format("a tet was turned inside out: its volume fell to {:.3g} of the undeformed one", j.min_tet_ratio));
  const auto number = [&](const char* key) {
    const auto at = run.summary->numbers.find(key);
    return at == run.summary->numbers.end() ? std::numeric_limits<double>::quiet_NaN() : at->second;
  };
  const double last = number("checkerboard"), most = number("extremes.checkerboard.value");
  if (rules.checkerboard_max > 0 && most > rules.checkerboard_max)
    found(Verdict::checkerboard,
          fmt::format("the pressure's checkerboard measure rose to {:.3g} at t = {:.4g} s (allowed {:g})", most,
                      number("extremes.checkerboard.t"), rules.checkerboard_max));
  if (rules.checkerboard_max > 0 && last > rules.checkerboard_max)
    found(Verdict::checkerboard, fmt::format("the pressure's checkerboard measure is {:.3g} at the end (allowed {:g})",
                                             last, rules.checkerboard_max));
}

}  // namespace

Judgement judge(const RunOutcome& run, const VerdictRules& rules) {
  Judgement j;
  const std::optional<Growth> g = growth(run.history, rules);
  if (g) j.energy_excess = g->largest;
  j.min_detF = least(run.history.min_detF);
  j.min_tet_ratio = least(run.history.min_tet_ratio);
  if (run.too_slow) {
    j.verdict = Verdict::too_slow;
    j.reason = fmt::format("took longer than report.max_wall_s = {:g} s", rules.max_wall_s);
    return j;
  }
  if (!run.summary) {
    j.verdict = Verdict::failed;
    const std::string how = run.exit_code > 128 ? fmt::format("was ended by signal {}", run.exit_code - 128)
                                                : fmt::format("ended with exit code {}", run.exit_code);
    j.reason = fmt::format("the program {} without a summary{}{}", how, run.last_words.empty() ? "" : ": ",
                           run.last_words);
    return j;
  }
  const std::string status = text_of(*run.summary, "status"), why = text_of(*run.summary, "reason");
  if (status != "done") {
    j.verdict = status == "breakdown" || !text_of(*run.summary, "cause").empty()
                    ? verdict_of_cause(text_of(*run.summary, "cause"))
                    : Verdict::failed;
    j.reason = why;
    // a run that blew up ends in det F or NaN: that its energy had grown before says more
    if (status == "breakdown" && g && g->first_t >= 0 && g->first_t < run.history.t.back()
        && j.verdict != Verdict::iteration_limit) {
      j.reason = fmt::format("more than the initial energy and external work from t = {:.4g} s on; then {}", g->first_t,
                             why);
      j.verdict = Verdict::energy_grew;
    }
    return j;
  }
  judge_course(j, run, g, rules);
  return j;
}

}  // namespace nanson
