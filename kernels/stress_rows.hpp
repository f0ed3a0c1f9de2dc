// The rows that a stress sweep leaves to the next stage, eight nodes at a time.
#pragma once
#include "kernels/part.hpp"
#include "kernels/tensor.hpp"

namespace nanson {

/// The displacement x - X that springs are stretched by, from the state's x; none without springs.
NANSON_INLINE void find_displacement(const Rows& rows, int n, const Vec8 (&x)[3], bool springs, Vec8 (&u)[3]) {
  for (Vec8& ui : u) ui = Vec8{};
  if (!springs) return;
  Vec8 X[3], inverse_volume;
  load_transposed(rows.X + row::X * n, row::X, X[0], X[1], X[2], inverse_volume);
  for (int I = 0; I < 3; ++I) u[I] = x[I] - X[I];
}

/// What neighbours read of eight nodes: {v, swept} and, per column I, {P, 0 | second, u_I}; whole cache lines, past the caches where the mesh is larger than they are.
NANSON_INLINE void store_rows(const Rows& rows, int n, const Vec8 (&v)[3], Vec8 swept, const Tensor<Vec8>& P,
                              const Tensor<Vec8>& second, const Vec8 (&u)[3], bool streams) {
  double *W = rows.W_new + row::W * n, *PH = rows.PH_new + row::PH * n;
  const Vec8 zero{};
  if (!streams) {
    store_transposed(W, row::W, v[0], v[1], v[2], swept);
    for (int I = 0; I < 3; ++I) {
      store_transposed(PH + 8 * I, row::PH, P[0][I], P[1][I], P[2][I], zero);
      store_transposed(PH + 8 * I + 4, row::PH, second[0][I], second[1][I], second[2][I], u[I]);
    }
    return;
  }
  Vec4 w[8], p[8], s[8];
  rows_of(v[0], v[1], v[2], swept, w);
  for (int i = 0; i < 8; i += 2) stream8(W + row::W * i, concat(w[i], w[i + 1]));
  for (int I = 0; I < 3; ++I) {
    rows_of(P[0][I], P[1][I], P[2][I], zero, p);
    rows_of(second[0][I], second[1][I], second[2][I], u[I], s);
    for (int i = 0; i < 8; ++i) stream8(PH + row::PH * i + 8 * I, concat(p[i], s[i]));
  }
}

}  // namespace nanson
