// Green-Gauss gradients, node by node over both kinds of edges: at once dF/dt and the reconstruction gradient (paper, eq. 43a; method: one pass serves both).
#pragma once
#include "kernels/part.hpp"
#include "kernels/reconstruction.hpp"

namespace nanson {

/// Visits the half-edges and corners of node n as visit(neighbour row, C from n) and corner(b, c, C).
template <class Edge, class Corner>
NANSON_INLINE void around(int n, const EdgeArrays& edges, const CornerArrays& corners, const NodeLists& lists, Edge edge, Corner corner) {
  for (std::int32_t e = lists.out[n]; e < lists.out[n + 1]; ++e) edge(edges.b[e], edges.C[0][e], edges.C[1][e], edges.C[2][e]);
  for (std::int32_t k = lists.in[n]; k < lists.in[n + 1]; ++k) {
    const std::int32_t e = lists.in_edges[k];
    edge(edges.a[e], -edges.C[0][e], -edges.C[1][e], -edges.C[2][e]);
  }
  for (std::int32_t k = lists.corner[n]; k < lists.corner[n + 1]; ++k) corner(corners.b[k], corners.c[k], corners.C[0][k], corners.C[1][k], corners.C[2][k]);
}

/// G_a = (1/Omega)[sum_b (W_b - W_a)/2 (x) C + sum_gamma (W_b + W_c - 2 W_a)/8 (x) C_gamma], W = {v, Sigma_J}: eq. (43a) with the (6,1,1)/8 rule (29)
/// after the closure of the dual cell has been used, so that a constant field has the gradient zero bitwise. G [1/s] and [Pa/m].
NANSON_INLINE void gradient_of_W(int n, const EdgeArrays& edges, const CornerArrays& corners, const NodeLists& lists, const Rows& rows) {
  constexpr int ahead = 60;  // edges whose neighbour rows are asked for in advance; the array is padded
  for (std::int32_t e = lists.out[n]; e < lists.out[n + 1]; ++e) __builtin_prefetch(rows.W + row::W * edges.b[e + ahead]);
  const Vec4 Wa = load4(rows.W + row::W * n);
  Vec4 g0{}, g1{}, g2{};
  around(
      n, edges, corners, lists,
      [&](int b, double C0, double C1, double C2) {
        const Vec4 d = load4(rows.W + row::W * b) - Wa;
        g0 = fma(d, broadcast4(C0), g0), g1 = fma(d, broadcast4(C1), g1), g2 = fma(d, broadcast4(C2), g2);
      },
      [&](int b, int c, double C0, double C1, double C2) {
        const Vec4 d = ((load4(rows.W + row::W * b) - Wa) + (load4(rows.W + row::W * c) - Wa)) * 0.25;
        g0 = fma(d, broadcast4(C0), g0), g1 = fma(d, broadcast4(C1), g1), g2 = fma(d, broadcast4(C2), g2);
      });
  const Vec4 half_inverse = broadcast4(0.5 * rows.X[row::X * n + 3]);
  double* G = rows.G + row::G * n;
  store4(G, g0 * half_inverse), store4(G + 4, g1 * half_inverse), store4(G + 8, g2 * half_inverse);
}

/// Gradient of the stress, dP_iI/dX_K [Pa/m], by the same rule; K-major as in row::GP.
NANSON_INLINE void gradient_of_P(int n, const EdgeArrays& edges, const CornerArrays& corners, const NodeLists& lists, const Rows& rows, Vec4 (&g)[3][3]) {
  const double* Pa = rows.PH + row::PH * n;
  for (auto& gk : g)
    for (auto& gki : gk) gki = Vec4{};
  auto add = [&](int I, Vec4 d, double C0, double C1, double C2) {
    g[0][I] = fma(d, broadcast4(C0), g[0][I]), g[1][I] = fma(d, broadcast4(C1), g[1][I]), g[2][I] = fma(d, broadcast4(C2), g[2][I]);
  };
  around(
      n, edges, corners, lists,
      [&](int b, double C0, double C1, double C2) {
        for (int I = 0; I < 3; ++I) add(I, load4(rows.PH + row::PH * b + 8 * I) - load4(Pa + 8 * I), C0, C1, C2);
      },
      [&](int b, int c, double C0, double C1, double C2) {
        for (int I = 0; I < 3; ++I) {
          const Vec4 P = load4(Pa + 8 * I);
          add(I, ((load4(rows.PH + row::PH * b + 8 * I) - P) + (load4(rows.PH + row::PH * c + 8 * I) - P)) * 0.25, C0, C1, C2);
        }
      });
  const Vec4 half_inverse = broadcast4(0.5 * rows.X[row::X * n + 3]);
  for (auto& gk : g)
    for (auto& gki : gk) gki = gki * half_inverse;
}

/// Nodal stress of the full flux correction, Q_a = P_a + theta/(4 Omega) sum_b [(P_a - P_b + D . grad P_a) C] (x) D [Pa] (method, section 14).
NANSON_INLINE void corrected_stress(int n, const EdgeArrays& edges, const CornerArrays& corners, const NodeLists& lists, const Rows& rows, double theta,
                                    const Vec4 (&g)[3][3]) {
  const double* Pa = rows.PH + row::PH * n;
  const Vec4 Xa = load4(rows.X + row::X * n);
  Vec4 q[3] = {};
  around(
      n, edges, corners, lists,
      [&](int b, double C0, double C1, double C2) {
        const Vec4 D = load4(rows.X + row::X * b) - Xa, D0 = spread<0>(D), D1 = spread<1>(D), D2 = spread<2>(D);
        const double C[3] = {C0, C1, C2};
        Vec4 y{};
        for (int I = 0; I < 3; ++I) {
          Vec4 r = load4(Pa + 8 * I) - load4(rows.PH + row::PH * b + 8 * I);
          r = fma(g[0][I], D0, r), r = fma(g[1][I], D1, r), r = fma(g[2][I], D2, r);
          y = fma(r, broadcast4(C[I]), y);
        }
        q[0] = fma(y, D0, q[0]), q[1] = fma(y, D1, q[1]), q[2] = fma(y, D2, q[2]);
      },
      [](int, int, double, double, double) {});
  const Vec4 scale = broadcast4(0.25 * theta * rows.X[row::X * n + 3]);
  for (int I = 0; I < 3; ++I) store4(rows.Q + row::Q * n + 4 * I, fma(q[I], scale, load4(Pa + 8 * I)));
}

/// Row L of a node: the limiter of its reconstruction (method, section 4).
NANSON_INLINE void limiter(int n, const EdgeArrays& edges, const CornerArrays& corners, const NodeLists& lists, const Rows& rows) {
  const Vec4 Wa = load4(rows.W + row::W * n), Xa = load4(rows.X + row::X * n);
  const double* G = rows.G + row::G * n;
  Vec4 above{}, below{}, rise{}, fall{};
  around(
      n, edges, corners, lists,
      [&](int b, double, double, double) {
        const Vec4 d = load4(rows.W + row::W * b) - Wa, slope = along(G, load4(rows.X + row::X * b) - Xa) * 0.5;
        above = larger(above, d), below = smaller(below, d), rise = larger(rise, slope), fall = smaller(fall, slope);
      },
      [](int, int, double, double, double) {});
  store4(rows.L + row::L * n, barth_jespersen(rise, fall, above, below));
}

/// Row L of a node: pseudo-Laplacian sum_b (1 + lambda . D)(W_b - W_a), W = {v, J}; zero for linear fields (method, section 9).
NANSON_INLINE void pseudo_laplacian(int n, const EdgeArrays& edges, const CornerArrays& corners, const NodeLists& lists, const Rows& rows) {
  const Vec4 Wa = load4(rows.W + row::W * n), Xa = load4(rows.X + row::X * n), lambda = load4(rows.lambda + row::lambda * n);
  Vec4 sum{};
  around(
      n, edges, corners, lists,
      [&](int b, double, double, double) {
        const Vec4 weight = dot3(lambda, load4(rows.X + row::X * b) - Xa) + 1.0;
        sum = fma(weight, load4(rows.W + row::W * b) - Wa, sum);
      },
      [](int, int, double, double, double) {});
  store4(rows.L + row::L * n, sum);
}

template <bool tensor_jump, bool full_correction, NodeWeights weights>
void gradient_part(const Part& part, const EdgeArrays& edges, const CornerArrays& corners, const NodeLists& lists, const Rows& rows, const Coefficients& k) {
  for (int n = part.node_begin; n < part.node_end; ++n) {
    gradient_of_W(n, edges, corners, lists, rows);
    if constexpr (weights == NodeWeights::limiter) limiter(n, edges, corners, lists, rows);
    if constexpr (weights == NodeWeights::laplacian) pseudo_laplacian(n, edges, corners, lists, rows);
    if constexpr (tensor_jump || full_correction) {
      Vec4 g[3][3];
      gradient_of_P(n, edges, corners, lists, rows, g);
      if constexpr (tensor_jump)
        for (int m = 0; m < 9; ++m) store4(rows.GP + row::GP * n + 4 * m, g[m / 3][m % 3]);
      if constexpr (full_correction) corrected_stress(n, edges, corners, lists, rows, k.theta, g);
    }
  }
}

}  // namespace nanson
