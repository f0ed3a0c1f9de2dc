// The material: from {v, J, F, H} to the rows that neighbours read, {v, Sigma_J} and {P|H}, eight nodes as lanes; with the step bound and the breakdown test.
#pragma once
#include "kernels/materials/linear_elastic.hpp"
#include "kernels/materials/mooney_rivlin.hpp"
#include "kernels/materials/neo_hookean.hpp"
#include "kernels/part.hpp"

namespace nanson {

/// Fastest reference-frame speed of a node: the acoustic one, and that of the J stabilisation where J is evolved, U''|H N|/(rho0 c_p), or with the paper's
/// upwinding U''|H N|^2/(rho0 c_p), with |H N| <= |H| (method, section 6). [m/s]
template <Law law, Volumetric volumetric, Isochoric isochoric, Formulation formulation>
PartReport stress_part(const Part& part, const Rows& rows, const Coefficients& k, const double* step_length) {
  using Law_ = Material<law, volumetric, isochoric, formulation>;
  const double inverse_rho = 1.0 / k.material.rho, inverse_rho_cp = 1.0 / k.rho_cp;
  Vec8 fastest{};
  Mask8 broken{};
  for (int n = part.node_begin; n < part.node_end; n += 8) {
    const double* U = rows.U_new + row::U * n;
    Vec8 v[3], J, x;
    Tensor<Vec8> F, H;
    load_transposed(U, row::U, v[0], v[1], v[2], J);
    for (int I = 0; I < 3; ++I) load_transposed(U + 4 * (I + 1), row::U, F[0][I], F[1][I], F[2][I], x);
    if constexpr (formulation == Formulation::pFHJ)
      for (int I = 0; I < 3; ++I) load_transposed(rows.H_new + row::H * n + 4 * I, row::H, H[0][I], H[1][I], H[2][I], x);
    const Stress<Vec8> s = Law_::stress(F, H, J, k.material);

    const Vec8 zero{};
    store_transposed(rows.W_new + row::W * n, row::W, v[0], v[1], v[2], !k.sweeps_J ? s.Sigma_J : formulation == Formulation::pF ? s.det_F : J);
    for (int I = 0; I < 3; ++I) {
      store_transposed(rows.PH_new + row::PH * n + 8 * I, row::PH, s.P[0][I], s.P[1][I], s.P[2][I], zero);
      store_transposed(rows.PH_new + row::PH * n + 8 * I + 4, row::PH, s.H[0][I], s.H[1][I], s.H[2][I], zero);
    }
    Vec8 c = root(s.rho_c2 * inverse_rho);
    if constexpr (formulation != Formulation::pF && law != Law::linear_elastic)
      c = larger(c, s.d2U * inverse_rho_cp * (k.deformed_metric ? root(s.H2) : s.H2));
    const Vec8 rate = c / load8(step_length + n);
    fastest = larger(rate, fastest);
    const Vec8 size = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    Mask8 sound = (s.det_F > 0.0) & (size - size == 0.0);
    if constexpr (formulation != Formulation::pF) sound = sound & (J > 0.0);
    broken = broken | ~sound;
  }
  return {largest(fastest), any(broken)};
}

template <Law law, Volumetric volumetric, Isochoric isochoric, Formulation formulation>
double strain_energy_part(const Part& part, const Rows& rows, const Coefficients& k) {
  double sum = 0;
  for (int n = part.node_begin; n < part.node_end; ++n) {
    const double* U = rows.U_new + row::U * n;
    Tensor<double> F, H{};
    for (int m = 0; m < 9; ++m) F[m % 3][m / 3] = U[4 * (m / 3 + 1) + m % 3];
    if constexpr (formulation == Formulation::pFHJ)
      for (int m = 0; m < 9; ++m) H[m % 3][m / 3] = rows.H_new[row::H * n + 4 * (m / 3) + m % 3];
    sum += Material<law, volumetric, isochoric, formulation>::energy(F, H, U[3], k.material) / rows.X[row::X * n + 3];
  }
  return sum;
}

}  // namespace nanson
