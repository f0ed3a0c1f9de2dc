// The stress of {p, F, p}: the law's isochoric part and the pressure, an unknown of its own that rides in lane 3 of {v, pressure | F, x} (method, section 10).
#pragma once
#include "kernels/materials/mooney_rivlin.hpp"
#include "kernels/materials/neo_hookean.hpp"
#include "kernels/part.hpp"
#include "kernels/stress_rows.hpp"
#include "kernels/tet_stiffness.hpp"

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
    Vec8 v[3], x[3], u[3], p;
    Tensor<Vec8> F;
    load_transposed(U, row::U, v[0], v[1], v[2], p);
    for (int I = 0; I < 3; ++I) load_transposed(U + 4 * (I + 1), row::U, F[0][I], F[1][I], F[2][I], x[I]);
    const Stress<Vec8> s = IsochoricMaterial<law>::stress(F, F, p, m);
    Tensor<Vec8> P;
    for (int i = 0; i < 3; ++i)
      for (int I = 0; I < 3; ++I) P[i][I] = fma(p, s.H[i][I], s.P[i][I]);
    if (m.tet_stiffness > 0) add_tet_stiffness(P, F, m.tet_stiffness, false);
    find_displacement(rows, n, x, m.tet_stiffness > 0, u);
    if (rows.detF) store8(rows.detF + n, s.detF);
    store_rows(rows, n, v, p, P, s.H, u, k.streams);
    fastest = larger(k.material.cs / load8(step_length + n), fastest);
    const Vec8 size = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    broken = broken | ~((s.detF > 0.0) & (size - size == 0.0) & (p - p == 0.0));
  }
  if (k.streams) finish_streams();
  return {largest(fastest), any(broken)};
}

/// Sum of Omega (psi_iso + p^2/(2 kappa)) [J].
template <Law law>
double projected_energy_part(const Part& part, const Rows& rows, const Coefficients& k) {
  const MaterialConstants m = isochoric(k.material);
  Vec8 total{};
  for (std::ptrdiff_t n = part.node_begin; n < part.node_end; n += 8) {
    const double* U = rows.U_stage + row::U * n;
    Vec8 v[3], X[3], p, x, inverse_volume;
    Tensor<Vec8> F;
    load_transposed(U, row::U, v[0], v[1], v[2], p);
    for (int I = 0; I < 3; ++I) load_transposed(U + 4 * (I + 1), row::U, F[0][I], F[1][I], F[2][I], x);
    load_transposed(rows.X + row::X * n, row::X, X[0], X[1], X[2], inverse_volume);
    Vec8 density = IsochoricMaterial<law>::energy(F, F, Vec8{} + 1.0, m) + 0.5 / k.material.kappa * (p * p);
    if (m.tet_stiffness > 0) density = density + tet_stiffness_energy(F, m.tet_stiffness);
    total = total + choose(first_lanes(part.node_end - n), density / inverse_volume, Vec8{});
  }
  return sum(total);
}

}  // namespace nanson
