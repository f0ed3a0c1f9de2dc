// The Jameson-Schmidt-Turkel scheme, the paper's comparison: average fluxes and a fourth-difference dissipation without shock term (method, section 9).
#pragma once
#include "kernels/edge_flux_part.hpp"
#include "kernels/gradient_part.hpp"

namespace nanson {

inline constexpr double jst_k4_p = 1.0 / 256, jst_k4_J = 1.0 / 8192;  // [-] captions of the paper's figures 4 and 5

/// Flux {P_ave C - k4_p rho cp |C| (L_b(v) - L_a(v)), -k4_J cp |C| (L_b(J) - L_a(J))}; L in row L, W = {v, J}.
inline double edge_flux_jst_part(const Part& part, const EdgeArrays& edges, const CornerArrays& corners,
                                 const NodeLists& lists, const Rows& rows, const Coefficients& k,
                                 const Scratch& scratch) {
  const double of_v = -jst_k4_p * k.rho_cp, of_J = k.edge.evolves_J ? -jst_k4_J * k.material.cp : 0.0;
  const Vec4 scale{of_v, of_v, of_v, of_J};
  for (int a = part.node_begin; a < part.node_end; ++a) {
    const double* PHa = rows.PH + row::PH * a;
    const Vec8 PH_a[3] = {load8(PHa), load8(PHa + 8), load8(PHa + 16)};
    const Vec4 La = load4(rows.L + row::L * a);
    prefetch_edges(a, edges, lists);
    prefetch_U(a + ahead::nodes, rows, false);
    for (std::int32_t e = lists.out[a]; e < lists.out[a + 1]; ++e) {
      prefetch_row<row::PH, ahead::rows, 3>(Outward(), rows.PH, edges, e);
      prefetch_row<row::L, ahead::rows>(Outward(), rows.L, edges, e);
      const std::int32_t b = edges.b[e];
      const double C[3] = {edges.C[0][e], edges.C[1][e], edges.C[2][e]};
      Vec4 t = low(average_traction_and_area(PH_a, rows.PH + row::PH * b, C));
      if (edges.stiffness) t = t + spring_force<Areas::undeformed>(edges, e, rows);
      store4(scratch.edge + 4 * (e - part.edge_begin),
             fma((load4(rows.L + row::L * b) - La) * broadcast4(edge_size(edges, e)), scale, t));
    }
  }
  corner_forces(part, corners, lists, rows, k, scratch.corner);
  return 0;
}

}  // namespace nanson
