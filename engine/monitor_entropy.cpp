// Numerical entropy production of every edge: the power that the stabilisation takes out of it (paper, eq. 75; method, section 3).
#include <algorithm>

#include "engine/current_areas.hpp"
#include "engine/monitor.hpp"
#include "engine/parts.hpp"

namespace nanson {
namespace {

enum Sum { total, negative, edges, sums, least = sums };

/// The edge loop over one edge at a time: a part without nodes whose only edge it is.
void add_part(const Simulation& s, const PartFunctions& functions, const CurrentGeometry& current, const Rows& rows,
              const Part& part, const Scratch& scratch, double* out) {
  const EdgeArrays arrays = flux_edges(s.domain, current);
  const CornerArrays corners = flux_corners(s.domain, current);
  Coefficients k = s.domain.coefficients;
  k.edge.audits = true;
  for (std::int32_t e = part.edge_begin; e < part.edge_end; ++e) {
    if (arrays.b[e] < arrays.a[e]) continue;  // the other part's copy counts
    Part one{};
    one.edge_begin = e;
    one.edge_end = e + 1;
    const double power = functions.edge_flux(one, arrays, corners, s.domain.order.lists(), rows, k, scratch);
    out[total] += power;
    out[negative] += power < 0;
    out[edges] += 1;
    out[least] = std::min(out[least], power);
  }
}

}  // namespace

EntropyProduction entropy_production(const Simulation& s) {
  State work = s.state;  // gradients and areas of the present state, as the next stage finds them
  const Rows rows = stage_rows(s.domain, work, 0, 0);
  const PartFunctions functions = find_part_functions(
      s.domain.scene->physics, s.domain.scene->material, true,
      s.state.has_lagged_correction);  // a correction that the next stage takes stays as it is
  find_current_areas(s, rows.U_stage, work.current);
  if (s.domain.scene->physics.reconstruction != Reconstruction::constant) {
    const auto arrays = s.domain.order.edges();
    const auto corners = s.domain.order.corners();
    const auto lists = s.domain.order.lists();
    for_parts(s, [&](int p, Scratch) {
      functions.gradient(s.domain.order.parts[static_cast<std::size_t>(p)], arrays, corners, lists, rows,
                         s.domain.coefficients);
    });
  }
  const auto sum = sums_over_parts<sums>(s, [&](int p, double* out) {
    out[least] = 1e300;
    add_part(s, functions, work.current, rows, s.domain.order.parts[static_cast<std::size_t>(p)],
             scratch_of(s, omp_get_thread_num()), out);
  });
  EntropyProduction e{1e300, sum[total], sum[negative] / sum[edges]};
  for (const auto& row : s.team.part_rows) e.least = std::min(e.least, row[least]);
  return e;
}

}  // namespace nanson
