// Loops over parts and sums over them in an order that no thread count changes.
#pragma once
#include <omp.h>

#include <algorithm>
#include <array>
#include <span>

#include "engine/simulation.hpp"

namespace nanson {

/// Where the buffers of a thread begin, and where they end [doubles]: fluxes of `edge_row` an edge, corners, forces, gradients, motion of edges.
inline std::array<std::ptrdiff_t, 6> scratch_offsets(const Order& o, std::ptrdiff_t edge_row) {
  const std::ptrdiff_t edges = o.most_edges + 8, nodes = o.most_nodes;
  const std::ptrdiff_t sizes[] = {edge_row * edges, 4 * static_cast<std::ptrdiff_t>(o.most_corners), 4 * nodes,
                                  12 * nodes, edges};
  std::array<std::ptrdiff_t, 6> at{};
  for (std::size_t i = 0; i < 5; ++i) at[i + 1] = at[i] + sizes[i];
  return at;
}

/// Of one thread, for the largest part and any scheme; at least a huge page: on small pages, scattered in memory, they push the part's rows out of L2.
inline std::size_t part_scratch(const Order& o) {
  return std::max(static_cast<std::size_t>(scratch_offsets(o, 8)[5]),
                  CacheLineAllocator<double>::huge_page / sizeof(double));
}

inline Scratch scratch_of(const Simulation& s, int thread) {
  double* p = s.team.scratch[static_cast<std::size_t>(thread)].data();
  const bool corrected = s.domain.scene->physics.flux_correction != FluxCorrection::none;
  const auto at = scratch_offsets(s.domain.order, corrected ? 8 : 4);
  return {p, p + at[1], p + at[2], p + at[3], p + at[4]};
}

/// Runs sweep(part index, scratch) over all parts; parts stay with their thread from sweep to sweep.
template <class Sweep>
void for_parts(const Simulation& s, Sweep sweep) {
  const int count = static_cast<int>(s.domain.order.parts.size());
#pragma omp parallel for schedule(static) num_threads(s.team.threads) if (count > 1)
  for (int p = 0; p < count; ++p) sweep(p, scratch_of(s, omp_get_thread_num()));
}

/// Sum by halves: the tree depends on the length alone.
inline double tree_sum(std::span<const double> x) {
  if (x.size() <= 2) return x.empty() ? 0.0 : x.size() == 1 ? x[0] : x[0] + x[1];
  const std::size_t half = x.size() / 2;
  return tree_sum(x.first(half)) + tree_sum(x.subspan(half));
}

/// Stress sweep of a part into rows.W_new, PH_new; the edge buffer is free by then.
inline PartReport stress_of_part(const Domain& d, int p, const Rows& rows, const Coefficients& k,
                                 const Scratch& scratch) {
  const double* length = d.step_length.data();
  if (d.mixture.empty()) return d.functions.stress(d.order.parts[static_cast<std::size_t>(p)], rows, k, length);
  PartReport report;
  for (int i = d.mixture.first_run[static_cast<std::size_t>(p)];
       i < d.mixture.first_run[static_cast<std::size_t>(p) + 1]; ++i) {
    const PartReport run = mixed_stress(d.mixture, d.mixture.runs[static_cast<std::size_t>(i)], rows, k, length,
                                        scratch.edge);
    report.fastest = run.fastest > report.fastest ? run.fastest : report.fastest;
    report.broken = report.broken || run.broken;
    report.plastic_work += run.plastic_work;
  }
  return report;
}

/// Sum of term(part index) over all parts.
template <class Term>
double sum_over_parts(const Simulation& s, Term term) {
  for_parts(s, [&](int p, Scratch) { s.team.part_sums[static_cast<std::size_t>(p)] = term(p); });
  return tree_sum(s.team.part_sums);
}

/// Sums of the first `count` entries of all rows of s.team.part_rows.
template <std::size_t count>
std::array<double, count> tree_sums(const Simulation& s) {
  std::array<double, count> sums;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t p = 0; p < s.team.part_rows.size(); ++p) s.team.part_sums[p] = s.team.part_rows[p][i];
    sums[i] = tree_sum(s.team.part_sums);
  }
  return sums;
}

/// Sums over all parts of what add(part index, sums of the part) adds to zeros.
template <std::size_t count, class Add>
std::array<double, count> sums_over_parts(const Simulation& s, Add add) {
  for_parts(s, [&](int p, Scratch) {
    double* sums = s.team.part_rows[static_cast<std::size_t>(p)].data();
    for (std::size_t i = 0; i < count; ++i) sums[i] = 0;
    add(p, sums);
  });
  return tree_sums<count>(s);
}

}  // namespace nanson
