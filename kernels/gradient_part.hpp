// Green-Gauss gradients, node by node over both kinds of edges: at once dF/dt and the reconstruction gradient (paper, eq. 43a; method: one pass serves both).
#pragma once
#include "kernels/part.hpp"
#include "kernels/reconstruction.hpp"

namespace nanson {

/// Visits the half-edges and corners of node n as edge(sense, edge, neighbour row) and corner(b, c, C).
template <class Edge, class Corner>
NANSON_INLINE void around(int n, const EdgeArrays& edges, const CornerArrays& corners, const NodeLists& lists,
                          Edge edge, Corner corner) {
  for (std::int32_t e = lists.out[n]; e < lists.out[n + 1]; ++e) edge(Outward(), e, edges.b[e]);
  for (std::int32_t k = lists.in[n]; k < lists.in[n + 1]; ++k) edge(Inward(), lists.in_edges[k], lists.in_nodes[k]);
  for (std::int32_t k = lists.corner[n]; k < lists.corner[n + 1]; ++k)
    corner(corners.b[k], corners.c[k], corners.C[0][k], corners.C[1][k], corners.C[2][k]);
}

/// Asks for the neighbours of nodes, or for their edges too, that will be read some nodes later: the processor's own prefetch loses the sequence of so many arrays as
/// soon as rows are gathered between them. The arrays are padded.
NANSON_INLINE void prefetch_lists(int n, const EdgeArrays& edges, const NodeLists& lists) {
  __builtin_prefetch(edges.b + lists.out[n] + ahead::arrays + ahead::swept_rows);
  __builtin_prefetch(lists.in_edges + lists.in[n] + ahead::arrays);
  __builtin_prefetch(lists.in_nodes + lists.in[n] + ahead::arrays);
}
NANSON_INLINE void prefetch_edges(int n, const EdgeArrays& edges, const NodeLists& lists) {
  const std::ptrdiff_t e = lists.out[n] + ahead::arrays;
  for (const double* C : edges.C) {
    __builtin_prefetch(C + e);
    __builtin_prefetch(C + e + 8);
  }
  prefetch_lists(n, edges, lists);
}
/// Asks for the row at the other end of an out-edge that comes `distance` edges later; those of in-edges are the part's own.
template <std::ptrdiff_t width, int distance, int lines = 1, class Sense>
NANSON_INLINE void prefetch_row(Sense, const double* rows, const EdgeArrays& edges, std::ptrdiff_t e) {
  if constexpr (Sense::value > 0) {
    const double* next = rows + width * edges.b[e + distance];
    for (int line = 0; line < lines; ++line) __builtin_prefetch(next + 8 * line);
  }
}

/// G_a = (1/Omega)[sum_b (W_b - W_a)/2 (x) C + sum_gamma (W_b + W_c - 2 W_a)/8 (x) C_gamma], W = {v, Sigma_J}: eq. (43a) with the (6,1,1)/8 rule (29)
/// after the closure of the dual cell has been used, so that a constant field has the gradient zero bitwise. G [1/s] and [Pa/m].
NANSON_INLINE void gradient_of_W(int n, const EdgeArrays& edges, const CornerArrays& corners, const NodeLists& lists,
                                 const Rows& rows) {
  prefetch_edges(n, edges, lists);
  const Vec4 Wa = load4(rows.W + row::W * n);
  Vec4 g0{}, g1{}, g2{};
  around(
      n, edges, corners, lists,
      [&](auto sense, std::ptrdiff_t e, std::ptrdiff_t b) {
        prefetch_row<row::W, ahead::swept_rows>(sense, rows.W, edges, e);
        const Vec4 d = Wa - load4(rows.W + row::W * b);  // this way round the load is part of the subtraction
        const auto back = opposite(sense);
        g0 = add_product(back, d, broadcast4(edges.C[0][e]), g0);
        g1 = add_product(back, d, broadcast4(edges.C[1][e]), g1);
        g2 = add_product(back, d, broadcast4(edges.C[2][e]), g2);
      },
      [&](int b, int c, double C0, double C1, double C2) {
        const Vec4 d = ((load4(rows.W + row::W * b) - Wa) + (load4(rows.W + row::W * c) - Wa)) * 0.25;
        g0 = fma(d, broadcast4(C0), g0);
        g1 = fma(d, broadcast4(C1), g1);
        g2 = fma(d, broadcast4(C2), g2);
      });
  const Vec4 half_inverse = broadcast4(0.5 * rows.X[row::X * n + 3]);
  double* G = rows.G + row::G * n;
  store4(G, g0 * half_inverse);
  store4(G + 4, g1 * half_inverse);
  store4(G + 8, g2 * half_inverse);
}

/// dP_a = theta/(4 Omega) [grad P : sum_b C (x) D (x) D - sum_b ((P_a - P_b) C) (x) D], D = X_a - X_b, and the row {P + dP | H} that the edges read. g: grad P as below;
/// q: columns of the second sum; CDD[I]: C_I times {D_0 D_0, D_0 D_1, D_0 D_2, D_2 D_2 | D_1 D_0, D_1 D_1, D_1 D_2, unused}.
NANSON_INLINE void correct_stress(int n, const Rows& rows, const Coefficients& k, const Vec4 (&P)[3],
                                  const Vec4 (&g)[3][3], const Vec4 (&q)[3], const Vec8 (&CDD)[3]) {
  constexpr int lane[3][3] = {{0, 1, 2}, {1, 5, 6}, {2, 6, 3}};
  const Vec4 scale = broadcast4(0.25 * k.theta * rows.X[row::X * n + 3]);
  Vec8 corrected[3];
  for (int L = 0; L < 3; ++L) {
    Vec4 sum[3];  // three at once: one chain of nine products would be waited for
    for (int K = 0; K < 3; ++K) {
      const auto C = [&](int I) { return broadcast4(CDD[I][lane[K][L]]); };
      sum[K] = fma(g[K][2], C(2), fma(g[K][1], C(1), g[K][0] * C(0)));
    }
    const Vec4 dP = ((sum[0] + sum[1]) + (sum[2] - q[L])) * scale;
    store4(rows.dP + row::dP * n + 4 * L, dP);
    corrected[L] = concat(P[L] + dP, load4(rows.PH + row::PH * n + 8 * L + 4));
  }
  double* PH = rows.PH_new + row::PH * n;
  for (int L = 0; L < 3; ++L) k.streams ? stream8(PH + 8 * L, corrected[L]) : store8(PH + 8 * L, corrected[L]);
}

/// Both gradients, G as gradient_of_W and dP_iI/dX_K [Pa/m], K-major as in row::GP; `corrects`: also what the full flux correction adds to the nodal stress,
/// dP_a = theta/(4 Omega) sum_b [(P_a - P_b + D . grad P_a) C] (x) D [Pa] (method, section 14). One visit of the neighbours: sum_b C_I D_K D_L is taken
/// beside the differences and meets the gradient of P when that is known. {P + dP | H} goes into the rows that the next stress overwrites: the edges read it there.
template <bool corrects>
NANSON_INLINE void gradients_of_W_and_P(int n, const EdgeArrays& edges, const CornerArrays& corners,
                                        const NodeLists& lists, const Rows& rows, const Coefficients& k,
                                        Vec4 (&g)[3][3]) {
  prefetch_edges(n, edges, lists);
  const double* Pa = rows.PH + row::PH * n;
  const Vec4 Xa = load4(rows.X + row::X * n), Wa = load4(rows.W + row::W * n),
             P[3] = {load4(Pa), load4(Pa + 8), load4(Pa + 16)};
  Vec8 g01[3] = {}, g2W[3] = {}, q01{}, CDD[3] = {};
  Vec4 q2{};
  const auto add = [&](auto sense, Vec4 d0, Vec4 d1, Vec4 d2, Vec4 dW, const Vec8(&C)[3]) {
    const Vec8 d01 = concat(d0, d1), d2W = concat(d2, dW);
    for (int K = 0; K < 3; ++K) {
      g01[K] = add_product(sense, d01, C[K], g01[K]);
      g2W[K] = add_product(sense, d2W, C[K], g2W[K]);
    }
  };
  around(
      n, edges, corners, lists,
      [&](auto sense, std::ptrdiff_t e, std::ptrdiff_t b) {
        prefetch_row<row::W, ahead::rows>(sense, rows.W, edges, e);
        prefetch_row<row::PH, ahead::rows, 3>(sense, rows.PH, edges, e);
        const double* Pb = rows.PH + row::PH * b;
        const Vec8 C[3] = {broadcast8(edges.C[0][e]), broadcast8(edges.C[1][e]), broadcast8(edges.C[2][e])};
        const Vec4 d0 = P[0] - load4(Pb), d1 = P[1] - load4(Pb + 8), d2 = P[2] - load4(Pb + 16);
        add(opposite(sense), d0, d1, d2, Wa - load4(rows.W + row::W * b), C);
        if constexpr (corrects) {
          prefetch_row<row::X, ahead::rows>(sense, rows.X, edges, e);
          const Vec4 D = Xa - load4(rows.X + row::X * b), y = fma(d2, low(C[2]), fma(d1, low(C[1]), d0 * low(C[0])));
          const Vec8 D01 = lanes_of<0, 0, 0, 2, 1, 1, 1, 3>(D);  // y has 0 in lane 3: D_2 there serves DD
          q01 = add_product(sense, concat(y, y), D01, q01);
          q2 = add_product(sense, y, spread<2>(D), q2);
          const Vec8 DD = D01 * lanes_of<0, 1, 2, 2, 0, 1, 2, 3>(D);
          for (int I = 0; I < 3; ++I) CDD[I] = add_product(sense, DD, C[I], CDD[I]);
        }
      },
      [&](int b, int c, double C0, double C1, double C2) {
        const double *Pb = rows.PH + row::PH * b, *Pc = rows.PH + row::PH * c, *Wb = rows.W + row::W * b,
                     *Wc = rows.W + row::W * c;
        const Vec8 C[3] = {broadcast8(C0), broadcast8(C1), broadcast8(C2)};
        const auto mean = [](Vec4 a, const double* b, const double* c) {
          return ((load4(b) - a) + (load4(c) - a)) * 0.25;
        };
        add(Outward(), mean(P[0], Pb, Pc), mean(P[1], Pb + 8, Pc + 8), mean(P[2], Pb + 16, Pc + 16), mean(Wa, Wb, Wc),
            C);
      });
  const double inverse = rows.X[row::X * n + 3];
  const Vec8 half_inverse = broadcast8(0.5 * inverse);
  for (int K = 0; K < 3; ++K) {
    const Vec8 a = g01[K] * half_inverse, b = g2W[K] * half_inverse;
    g[K][0] = low(a);
    g[K][1] = high(a);
    g[K][2] = low(b);
    store4(rows.G + row::G * n + 4 * K, high(b));
  }
  if constexpr (corrects) correct_stress(n, rows, k, P, g, {low(q01), high(q01), q2}, CDD);
}

/// Row L of a node: the limiter of its reconstruction (method, section 4).
NANSON_INLINE void limiter(int n, const EdgeArrays& edges, const CornerArrays& corners, const NodeLists& lists,
                           const Rows& rows) {
  const Vec4 Wa = load4(rows.W + row::W * n), Xa = load4(rows.X + row::X * n);
  const double* G = rows.G + row::G * n;
  Vec4 above{}, below{}, rise{}, fall{};
  around(
      n, edges, corners, lists,
      [&](auto sense, std::ptrdiff_t e, std::ptrdiff_t b) {
        prefetch_row<row::X, ahead::rows>(sense, rows.X, edges, e);
        const Vec4 d = load4(rows.W + row::W * b) - Wa, slope = along(G, load4(rows.X + row::X * b) - Xa) * 0.5;
        above = larger(above, d);
        below = smaller(below, d);
        rise = larger(rise, slope);
        fall = smaller(fall, slope);
      },
      [](int, int, double, double, double) {});
  store4(rows.L + row::L * n, barth_jespersen(rise, fall, above, below));
}

/// Row L of a node: pseudo-Laplacian sum_b (1 + lambda . D)(W_b - W_a), W = {v, J}; zero for linear fields (method, section 9).
NANSON_INLINE void pseudo_laplacian(int n, const EdgeArrays& edges, const CornerArrays& corners, const NodeLists& lists,
                                    const Rows& rows) {
  const Vec4 Wa = load4(rows.W + row::W * n), Xa = load4(rows.X + row::X * n),
             lambda = load4(rows.lambda + row::lambda * n);
  Vec4 sum{};
  around(
      n, edges, corners, lists,
      [&](auto sense, std::ptrdiff_t e, std::ptrdiff_t b) {
        prefetch_row<row::X, ahead::rows>(sense, rows.X, edges, e);
        const Vec4 weight = dot3(lambda, load4(rows.X + row::X * b) - Xa) + 1.0;
        sum = fma(weight, load4(rows.W + row::W * b) - Wa, sum);
      },
      [](int, int, double, double, double) {});
  store4(rows.L + row::L * n, sum);
}

template <bool tensor_jump, bool full_correction, NodeWeights weights>
void gradient_part(const Part& part, const EdgeArrays& edges, const CornerArrays& corners, const NodeLists& lists,
                   const Rows& rows, const Coefficients& k) {
  for (int n = part.node_begin; n < part.node_end; ++n) {
    Vec4 gradient_P[3][3];
    if constexpr (tensor_jump || full_correction)
      gradients_of_W_and_P<full_correction>(n, edges, corners, lists, rows, k, gradient_P);
    else gradient_of_W(n, edges, corners, lists, rows);
    if constexpr (tensor_jump)
      for (int m = 0; m < 9; ++m) store4(rows.GP + row::GP * n + 4 * m, gradient_P[m / 3][m % 3]);
    if constexpr (weights == NodeWeights::limiter) limiter(n, edges, corners, lists, rows);
    if constexpr (weights == NodeWeights::laplacian) pseudo_laplacian(n, edges, corners, lists, rows);
  }
  if constexpr (full_correction)
    if (k.streams) finish_streams();
}

}  // namespace nanson
