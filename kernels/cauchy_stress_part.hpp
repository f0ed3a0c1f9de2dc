// The material with the Cauchy stress that fluxes with current areas take: sigma = P F^T / J in place of H in the rows {P|H} (method, section 8); {p,F,J}.
#pragma once
#include "kernels/part.hpp"
#include "kernels/tensor.hpp"

namespace nanson {

NANSON_INLINE void push_forward(const Part& part, const Rows& rows) {
  for (int n = part.node_begin; n < part.node_end; n += 8) {
    const double* U = rows.U_new + row::U * n;
    double* PH = rows.PH_new + row::PH * n;
    Vec8 unused, J;
    Tensor<Vec8> F, P;
    load_transposed(U, row::U, unused, unused, unused, J);
    for (int I = 0; I < 3; ++I) {
      load_transposed(U + 4 * (I + 1), row::U, F[0][I], F[1][I], F[2][I], unused);
      load_transposed(PH + 8 * I, row::PH, P[0][I], P[1][I], P[2][I], unused);
    }
    const Vec8 inverse_J = 1.0 / J;
    for (int j = 0; j < 3; ++j) {
      Vec8 sigma[3];
      for (int i = 0; i < 3; ++i) sigma[i] = fma(P[i][2], F[j][2], fma(P[i][1], F[j][1], P[i][0] * F[j][0])) * inverse_J;
      store_transposed(PH + 8 * j + 4, row::PH, sigma[0], sigma[1], sigma[2], Vec8{});
    }
  }
}

template <Law law, Volumetric volumetric, Isochoric isochoric>
PartReport cauchy_stress_part(const Part& part, const Rows& rows, const Coefficients& k, const double* step_length) {
  const PartReport report = stress_part<law, volumetric, isochoric, Formulation::pFJ>(part, rows, k, step_length);
  push_forward(part, rows);
  return report;
}

}  // namespace nanson
