// The stress of {p, F, p}: the law's isochoric part and the pressure, an unknown of its own that rides in lane 3 of {v, pressure | F, x} (method, section 10).
#pragma once
#include "kernels/materials/mooney_rivlin.hpp"
#include "kernels/materials/neo_hookean.hpp"
#include "kernels/part.hpp"

namespace nanson {

template <Law law>
using IsochoricMaterial = Material<law, Volumetric::quadratic, Isochoric::F, Formulation::pF>;

/// The constants with kappa = 0: what is left of the law is its isochoric part.
NANSON_INLINE MaterialConstants isochoric(MaterialConstants m) {
  m.kappa = 0;
  return m;
}

/// P = P_iso(F) + p H, H = cof F; the step is bound by the constant shear wave speed.
template <Law law>
PartReport projected_stress_part(const Part& part, const Rows& rows, const Coefficients& k, const double* step_length) {
  const MaterialConstants m = isochoric(k.material);
  Vec8 fastest{};
  Mask8 broken{};
  for (int n = part.node_begin; n < part.node_end; n += 8) {
    const double* U = rows.U_new + row::U * n;
    Vec8 v[3], p, x;
    Tensor<Vec8> F;
    load_transposed(U, row::U, v[0], v[1], v[2], p);
    for (int I = 0; I < 3; ++I) load_transposed(U + 4 * (I + 1), row::U, F[0][I], F[1][I], F[2][I], x);
    const Stress<Vec8> s = IsochoricMaterial<law>::stress(F, F, p, m);
    const Vec8 zero{};
    store_transposed(rows.W_new + row::W * n, row::W, v[0], v[1], v[2], p);
    for (int I = 0; I < 3; ++I) {
      store_transposed(rows.PH_new + row::PH * n + 8 * I, row::PH, fma(p, s.H[0][I], s.P[0][I]), fma(p, s.H[1][I], s.P[1][I]), fma(p, s.H[2][I], s.P[2][I]), zero);
      store_transposed(rows.PH_new + row::PH * n + 8 * I + 4, row::PH, s.H[0][I], s.H[1][I], s.H[2][I], zero);
    }
    fastest = larger(k.material.cs / load8(step_length + n), fastest);
    const Vec8 size = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    broken = broken | ~((s.detF > 0.0) & (size - size == 0.0) & (p - p == 0.0));
  }
  return {largest(fastest), any(broken)};
}

/// Sum of Omega (psi_iso + p^2/(2 kappa)) [J].
template <Law law>
double projected_energy_part(const Part& part, const Rows& rows, const Coefficients& k) {
  const MaterialConstants m = isochoric(k.material);
  double sum = 0;
  for (int n = part.node_begin; n < part.node_end; ++n) {
    const double* U = rows.U_new + row::U * n;
    Tensor<double> F;
    for (int i = 0; i < 9; ++i) F[i % 3][i / 3] = U[4 * (i / 3 + 1) + i % 3];
    sum += (IsochoricMaterial<law>::energy(F, F, 1.0, m) + 0.5 * U[3] * U[3] / k.material.kappa) / rows.X[row::X * n + 3];
  }
  return sum;
}

}  // namespace nanson
