// What the boundary corners of a part add to its nodes: adjoint boundary flux and loads; and the rate of J by the motion of the dual cell (current areas).
#pragma once
#include "kernels/part.hpp"

namespace nanson {

/// Corners: adjoint boundary flux (2 P_a - P_b - P_c)/8 C_gamma (method, section 3) and the load on the face.
NANSON_INLINE void corner_forces(const Part& part, const CornerArrays& corners, const NodeLists& lists,
                                 const Rows& rows, const Coefficients& k, double* buffer) {
  const auto stress = [&](std::ptrdiff_t n, int I) { return load4(rows.PH + row::PH * n + 8 * I); };
  if (part.corner_begin == part.corner_end) return;
  for (int a = part.node_begin; a < part.node_end; ++a)
    for (std::int32_t g = lists.corner[a]; g < lists.corner[a + 1]; ++g) {
      Vec4 f = corners.load[g] >= 0 ? load4(rows.loads + 4 * corners.load[g]) : Vec4{};
      if (k.adjoint)
        for (int I = 0; I < 3; ++I) {
          const Vec4 Pa = stress(a, I), d = (Pa - stress(corners.b[g], I)) + (Pa - stress(corners.c[g], I));
          f = fma(d, broadcast4(0.125 * corners.C[I][g]), f);
        }
      store4(buffer + 4 * (g - part.corner_begin), f);
    }
}

/// Adjoint boundary flux (2 t_a - t_b - t_c)/8, t = sigma c_gamma of each of the face's corners, and the load on the face: without a resultant, and adjoint to
/// `cell_motion`, also where the three corners of a face have area vectors of their own (pseudo_updated).
NANSON_INLINE void current_corner_forces(const Part& part, const CornerArrays& corners, const NodeLists& lists,
                                         const Rows& rows, const Coefficients& k, double* buffer) {
  const auto traction = [&](std::int32_t n, std::int32_t g) {
    const double* sigma = rows.PH + row::PH * n + 4;
    Vec4 t = fma(load4(sigma + 8), broadcast4(corners.c_gamma[1][g]), load4(sigma) * broadcast4(corners.c_gamma[0][g]));
    t = fma(load4(sigma + 16), broadcast4(corners.c_gamma[2][g]), t);
    return Vec4{t[0], t[1], t[2], 0.0};  // u stands in lane 3
  };
  for (int a = part.node_begin; a < part.node_end; ++a)
    for (std::int32_t g = lists.corner[a]; g < lists.corner[a + 1]; ++g) {
      Vec4 f = corners.load[g] >= 0 ? load4(rows.loads + 4 * corners.load[g]) : Vec4{};
      if (k.adjoint) {
        const Vec4 t = traction(a, g);
        const Vec4 d = (t - traction(corners.b[g], corners.at_b[g])) + (t - traction(corners.c[g], corners.at_c[g]));
        f = fma(d, broadcast4(0.125), f);
      }
      store4(buffer + 4 * (g - part.corner_begin), f);
    }
}

/// dJ/dt = (1/Omega0) [sum_b (v_b - v_a)/2 . c + sum_gamma (v_b + v_c - 2 v_a)/8 . c_gamma] [1/s]: (48d) with relative velocities. The same where the areas close,
/// and right where they do not (pseudo_updated; method, section 8): a translation gives zero bitwise. An edge's share is the same from both ends: the edge loop has left it.
NANSON_INLINE void cell_motion(const Part& part, const CornerArrays& corners, const NodeLists& lists, const Rows& rows,
                               const double* motion) {
  for (int n = part.node_begin; n < part.node_end; ++n) {
    double sum = 0;
    for (std::int32_t e = lists.out[n]; e < lists.out[n + 1]; ++e) sum += motion[e - part.edge_begin];
    for (std::int32_t i = lists.in[n]; i < lists.in[n + 1]; ++i) sum += motion[lists.in_edges[i] - part.edge_begin];
    const Vec4 Wa = load4(rows.W + row::W * n);
    for (std::int32_t g = lists.corner[n]; g < lists.corner[n + 1]; ++g) {
      const Vec4 d = ((load4(rows.W + row::W * corners.b[g]) - Wa) + (load4(rows.W + row::W * corners.c[g]) - Wa))
                     * 0.25;
      sum += fma(d[2], corners.c_gamma[2][g], fma(d[1], corners.c_gamma[1][g], d[0] * corners.c_gamma[0][g]));
    }
    rows.dJ[n] = 0.5 * rows.X[row::X * n + 3] * sum;
  }
}

}  // namespace nanson
