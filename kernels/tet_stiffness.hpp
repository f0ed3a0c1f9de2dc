// The energy of what tets deform beyond the mean that their nodes carry (method, section 17): its share of a node. That of the edges, springs, is in the edge loops.
#pragma once
#include "kernels/column.hpp"
#include "kernels/tensor.hpp"

namespace nanson {

/// E = 1/2 sum_a c_a sum_(T at a) (V_T/4) |F_T - F_a|^2, c_a the modulus of a node [Pa], F_T the deformation of a tet, F_a the mean of those around a node:
///   E = 1/2 sum_T V_T c_T |F_T - I|^2 - 1/2 sum_a Omega_a c_a |F_a - I|^2,   c_T the mean of the tet's nodes (the I drop out: sum_T V_T c_T F_T = sum_a Omega_a c_a F_a).
/// The first sum is that of springs, 1/2 sum_ab k_ab |u_b - u_a|^2, k_ab = -sum_T V_T c_T grad N_a . grad N_b [N/m]; the second gives a node's stress
///   P -= c (F - I).
/// With current areas the two I, equal forces with undeformed areas, are left out of both: then neither has a torque.
template <class Real>
NANSON_INLINE void add_tet_stiffness(Tensor<Real>& P, const Tensor<Real>& F, double c, bool current_areas) {
  const double rest = current_areas ? 0.0 : 1.0;
  for (int i = 0; i < 3; ++i)
    for (int I = 0; I < 3; ++I) P[i][I] = fnma(constant<Real>(c), i == I ? F[i][I] - rest : F[i][I], P[i][I]);
}

/// -c |F - I|^2/2 of a node [J/m^3].
template <class Real>
NANSON_INLINE Real tet_stiffness_energy(const Tensor<Real>& F, double c) {
  Real square{};
  for (int i = 0; i < 3; ++i)
    for (int I = 0; I < 3; ++I) {
      const Real g = i == I ? F[i][I] - 1.0 : F[i][I];
      square = fma(g, g, square);
    }
  return -0.5 * c * square;
}

}  // namespace nanson
