// Fluxes with current area vectors and the Cauchy stress (paper, eq. 48, 49), and the rate of J by the motion of the dual cell; {p,F,J}.
#pragma once
#include "kernels/edge_flux_part.hpp"
#include "kernels/gradient_part.hpp"

namespace nanson {

/// dJ/dt = (1/Omega0) [sum_b (v_b - v_a)/2 . c + sum_gamma (v_b + v_c - 2 v_a)/8 . c_gamma] [1/s]: (48d) with relative velocities. The same where the areas close,
/// and right where they do not (pseudo_updated; method, section 8): a translation gives zero bitwise.
NANSON_INLINE void cell_motion(const Part& part, EdgeArrays edges, CornerArrays corners, const NodeLists& lists, const Rows& rows) {
  for (int i = 0; i < 3; ++i) edges.C[i] = edges.c[i], corners.C[i] = corners.c_gamma[i];  // `around` visits what stands in C
  for (int n = part.node_begin; n < part.node_end; ++n) {
    const Vec4 Wa = load4(rows.W + row::W * n);
    Vec4 s{};
    around(
        n, edges, corners, lists, [&](auto sense, std::int32_t e, int b) { s = add_product(sense, load4(rows.W + row::W * b) - Wa, Vec4{edges.C[0][e], edges.C[1][e], edges.C[2][e], 0.0}, s); },
        [&](int b, int c, double c0, double c1, double c2) {
          s = fma(((load4(rows.W + row::W * b) - Wa) + (load4(rows.W + row::W * c) - Wa)) * 0.25, Vec4{c0, c1, c2, 0.0}, s);
        });
    rows.dJ[n] = 0.5 * rows.X[row::X * n + 3] * ((s[0] + s[1]) + s[2]);
  }
}

/// Adjoint boundary flux (2 t_a - t_b - t_c)/8, t = sigma c_gamma of each of the face's corners, and the load on the face: without a resultant, and adjoint to
/// `cell_motion`, also where the three corners of a face have area vectors of their own (pseudo_updated).
NANSON_INLINE void current_corner_forces(const Part& part, const CornerArrays& corners, const NodeLists& lists, const Rows& rows, double* buffer) {
  const auto traction = [&](std::int32_t n, std::int32_t g) {
    const double* sigma = rows.PH + row::PH * static_cast<std::ptrdiff_t>(n) + 4;
    const Vec4 t = fma(load4(sigma + 8), broadcast4(corners.c_gamma[1][g]), load4(sigma) * broadcast4(corners.c_gamma[0][g]));
    return fma(load4(sigma + 16), broadcast4(corners.c_gamma[2][g]), t);
  };
  for (int a = part.node_begin; a < part.node_end; ++a)
    for (std::int32_t g = lists.corner[a]; g < lists.corner[a + 1]; ++g) {
      const Vec4 t = traction(a, g), load = corners.load[g] >= 0 ? load4(rows.loads + 4 * corners.load[g]) : Vec4{};
      const Vec4 d = (t - traction(corners.b[g], corners.at_b[g])) + (t - traction(corners.c[g], corners.at_c[g]));
      store4(buffer + 4 * (g - part.corner_begin), fma(d, broadcast4(0.125), load));
    }
}

template <Reconstruction reconstruction, UpwindMetric metric, bool audits>
double current_flux_part(const Part& part, const EdgeArrays& edges, const CornerArrays& corners, const NodeLists& lists, const Rows& rows, const Coefficients& k,
                       const Scratch& scratch) {
  const double power =
      edge_fluxes<reconstruction, EdgeCorrection::none, audits, true, PressureJump::scalar, metric, EntropyFix::none, Areas::current>(part, edges, rows, k, scratch.edge);
  current_corner_forces(part, corners, lists, rows, scratch.corner);
  cell_motion(part, edges, corners, lists, rows);
  return power;
}

}  // namespace nanson
