// The step bound of the stress sweeps; for its places the present stress again, one node at a time.
#include "engine/step_bound.hpp"

#include <algorithm>

#include "engine/parts.hpp"

namespace nanson {
namespace {

/// Rows of eight nodes beside those of a state: what a stress sweep would overwrite.
struct Eight {
  Aligned<double> U = Aligned<double>(8 * row::U, 0.0), H = Aligned<double>(8 * row::H, 0.0),
                  W = Aligned<double>(8 * row::W, 0.0), PH = Aligned<double>(8 * row::PH, 0.0),
                  scratch = Aligned<double>(mixture_scratch(8), 0.0), length = Aligned<double>(8, 1e300);
};

/// 1/s of the fastest of row n.
double fastest_at(const Simulation& s, int n, Eight& eight) {
  const Domain& d = s.domain;
  const State& u = s.state;
  const std::ptrdiff_t first = n / 8 * 8;
  const auto copy = [&](const Aligned<double>& from, Aligned<double>& to, std::ptrdiff_t width) {
    if (!from.empty()) std::copy_n(from.begin() + width * first, 8 * width, to.begin());
    return to.data() - width * first;
  };
  Rows rows = present_rows(d, u);
  rows.U_new = copy(u.U[0], eight.U, row::U);
  rows.H_new = copy(u.H[0], eight.H, row::H);
  rows.W_new = eight.W.data() - row::W * first;
  rows.PH_new = eight.PH.data() - row::PH * first;
  double& length = eight.length[static_cast<std::size_t>(n - first)];
  length = d.step_length[static_cast<std::size_t>(n)];
  Part part{};
  part.node_begin = static_cast<std::int32_t>(first);
  part.node_end = part.node_begin + 8;
  const double* lengths = eight.length.data() - first;
  const PartReport report = d.mixture.empty() ? d.functions.stress(part, rows, d.coefficients, lengths)
                                              : mixed_stress(d.mixture,
                                                             {part.node_begin, part.node_end, 8,
                                                              d.mixture.group[static_cast<std::size_t>(n)]},
                                                             rows, d.coefficients, lengths, eight.scratch.data());
  length = 1e300;
  return report.fastest;
}

}  // namespace

double allowed_step(const Simulation& s) {
  double fastest = 0;
  for (const PartReport& r : s.state.reports) fastest = std::max(fastest, r.fastest);
  fastest = std::max(fastest, s.state.barrier.fastest);
  return s.domain.scene->time.cfl / fastest;
}

std::vector<std::pair<int, double>> limiting_nodes(const Simulation& s, int count) {
  std::vector<std::pair<int, double>> steps;
  Eight eight;
  for (int n = 0; n < s.domain.order.rows; ++n)
    if (!is_padding(s.domain, n))
      steps.emplace_back(s.domain.order.node_of[static_cast<std::size_t>(n)],
                         s.domain.scene->time.cfl / fastest_at(s, n, eight));
  const auto keep = std::min(steps.size(), static_cast<std::size_t>(count));
  std::partial_sort(
      steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(keep), steps.end(),
      [](const auto& p, const auto& q) { return p.second < q.second || (p.second == q.second && p.first < q.first); });
  steps.resize(keep);
  return steps;
}

}  // namespace nanson
