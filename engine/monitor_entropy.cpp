// Numerical entropy production of every edge: the power that the stabilisation takes out of it (paper, eq. 75; method, section 3).
#include <algorithm>

#include "engine/monitor.hpp"
#include "engine/parts.hpp"

namespace nanson {
namespace {

enum Sum { total, negative, edges, sums, least = sums };

/// The dissipation sweep over one edge at a time: a part of one node whose only out-edge it is.
void add_part(const Simulation& s, const Rows& rows, const Part& part, double* out) {
  const EdgeArrays arrays = flux_edges(s);
  NodeLists lists = s.order.lists();
  Part one = part;
  for (int a = part.node_begin; a < part.node_end; ++a)
    for (std::int32_t e = s.order.out[static_cast<std::size_t>(a)]; e < s.order.out[static_cast<std::size_t>(a) + 1]; ++e) {
      if (arrays.b[e] < a) continue;  // the other part's copy counts
      const std::int32_t ends[2] = {e, e + 1};
      lists.out = ends - a;
      one.node_begin = a, one.node_end = a + 1;
      const double power = s.functions.dissipation(one, arrays, lists, rows, s.coefficients);
      out[total] += power, out[negative] += power < 0, out[edges] += 1;
      out[least] = std::min(out[least], power);
    }
}

}  // namespace

EntropyProduction entropy_production(Simulation& s) {
  const Rows rows = stage_rows(s.state, 0, 0);
  find_current_areas(s, rows.U_stage);
  if (s.scene->physics.reconstruction != Reconstruction::constant) {  // of the present state; the next stage computes them again
    const auto arrays = s.order.edges();
    const auto corners = s.order.corners();
    const auto lists = s.order.lists();
    for_parts(s, [&](int p, Scratch) { s.functions.gradient(s.order.parts[static_cast<std::size_t>(p)], arrays, corners, lists, rows, s.coefficients); });
  }
  const auto sum = sums_over_parts<sums>(s, [&](int p, double* out) {
    out[least] = 1e300;
    add_part(s, rows, s.order.parts[static_cast<std::size_t>(p)], out);
  });
  EntropyProduction e{1e300, sum[total], sum[negative] / sum[edges]};
  for (const auto& row : s.part_rows) e.least = std::min(e.least, row[least]);
  return e;
}

}  // namespace nanson
