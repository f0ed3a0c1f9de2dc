// Jump of {v, Sigma_J} across an edge's midpoint: of the nodal values, or of linear reconstructions with or without a limiter.
#pragma once
#include "kernels/part.hpp"

namespace nanson {

/// Sum or difference of directional derivatives along D of two nodes, sum_I (A_I op B_I) D_I, from gradient rows.
NANSON_INLINE Vec4 sum_along(const double* Ga, const double* Gb, Vec4 D) {
  Vec4 s = (load4(Ga) + load4(Gb)) * spread<0>(D);
  s = fma(load4(Ga + 4) + load4(Gb + 4), spread<1>(D), s);
  return fma(load4(Ga + 8) + load4(Gb + 8), spread<2>(D), s);
}
NANSON_INLINE Vec4 difference_along(const double* Ga, const double* Gb, Vec4 D) {
  Vec4 s = (load4(Ga) - load4(Gb)) * spread<0>(D);
  s = fma(load4(Ga + 4) - load4(Gb + 4), spread<1>(D), s);
  return fma(load4(Ga + 8) - load4(Gb + 8), spread<2>(D), s);
}
NANSON_INLINE Vec4 along(const double* G, Vec4 D) {
  Vec4 s = load4(G) * spread<0>(D);
  s = fma(load4(G + 4), spread<1>(D), s);
  return fma(load4(G + 8), spread<2>(D), s);
}

/// W+ - W- = W_b - W_a - 1/2 (phi_a G_a + phi_b G_b) . D (paper, section 3.2; method, section 4). `plain` = W_b - W_a, D = X_b - X_a [m].
template <Reconstruction reconstruction>
NANSON_INLINE Vec4 reconstructed_jump(const Rows& rows, int a, int b, Vec4 plain, Vec4 D) {
  if constexpr (reconstruction == Reconstruction::constant) return plain;
  else {
    const double *Ga = rows.G + row::G * a, *Gb = rows.G + row::G * b;
    if constexpr (reconstruction == Reconstruction::linear) return fma(sum_along(Ga, Gb, D), broadcast4(-0.5), plain);
    else
      return fma(load4(rows.L + row::L * a) * along(Ga, D) + load4(rows.L + row::L * b) * along(Gb, D),
                 broadcast4(-0.5), plain);
  }
}

/// Barth-Jespersen: the largest phi for which W + phi G.D/2 stays between the least and the largest value around, at every edge's midpoint.
/// `rise`, `fall`: largest and least G.D/2 over the node's edges; `above`, `below`: distance to the largest and least neighbour. Component by component.
NANSON_INLINE Vec4 barth_jespersen(Vec4 rise, Vec4 fall, Vec4 above, Vec4 below) {
  const Vec4 one = broadcast4(1.0), zero{};
  const Vec4 up = choose(rise > zero, above / choose(rise > zero, rise, one), one),
             down = choose(fall < zero, below / choose(fall < zero, fall, one), one);
  return smaller(one, smaller(up, down));
}

}  // namespace nanson
