// Quantities by name, from wherever they come.
#include "io/study/study_results.hpp"

#include <algorithm>
#include <cmath>

namespace nanson {

int StudyResults::done() const {
  return static_cast<int>(
      std::count_if(results.begin(), results.end(), [](const StudyRunResult& r) { return r.made; }));
}

StudyRunResult assess(const StudyRun& run, RunOutcome outcome) {
  StudyRunResult r;
  r.made = true;
  r.judgement = judge(outcome, run.rules);
  if (outcome.summary) r.quantities = outcome.summary->numbers;
  auto& q = r.quantities;
  if (const auto volume = quantity(r, "volume"), tets = quantity(r, "tets"); volume && tets && *tets > 0)
    q["h"] = std::cbrt(6 * *volume / *tets);
  q["process_s"] = outcome.wall_s;
  if (r.judgement.energy_excess) q["energy_excess"] = *r.judgement.energy_excess;
  if (std::isfinite(r.judgement.min_detF)) q["least_detF"] = r.judgement.min_detF;
  if (std::isfinite(r.judgement.min_tet_ratio)) q["least_tet_ratio"] = r.judgement.min_tet_ratio;
  for (const auto& [key, value] : run.plan.varied)
    if (const auto number = number_in(value)) q[key] = *number;
  r.outcome = std::move(outcome);
  return r;
}

void find_rates(StudyResults& all) {
  const ReportSpec& report = all.study->report;
  if (report.rate_over.empty()) return;
  std::vector<PlannedRun> plans;
  for (const StudyRun& run : all.runs) plans.push_back(run.plan);
  const std::vector<int> before = predecessors(plans, report.rate_over);
  const std::string over = report.rate_over.starts_with("mesh.") ? "h" : report.rate_over;  // cells change h
  for (std::size_t i = 0; i < plans.size(); ++i) {
    if (before[i] < 0) continue;
    const StudyRunResult &coarse = all.results[static_cast<std::size_t>(before[i])], &fine = all.results[i];
    if (!coarse.ended() || !fine.ended()) continue;
    for (const std::string& y : report.y) {
      const auto h0 = quantity(coarse, over), e0 = quantity(coarse, y), h1 = quantity(fine, over),
                 e1 = quantity(fine, y);
      if (!h0 || !e0 || !h1 || !e1) continue;
      if (const auto rate = observed_rate(*h0, *e0, *h1, *e1)) all.results[i].rates[y] = *rate;
    }
  }
}

std::optional<double> quantity(const StudyRunResult& r, const std::string& name) {
  const auto at = r.quantities.find(name);
  if (at == r.quantities.end() || !std::isfinite(at->second)) return std::nullopt;
  return at->second;
}

}  // namespace nanson
