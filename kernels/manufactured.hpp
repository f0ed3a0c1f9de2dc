// A motion of any size that a body force makes exact (method of manufactured solutions): u_i = A_i cos(omega t) s_i c_j c_k with s_m = sin(pi X_m/l), c_m = cos(pi X_m/l)
// and i, j, k the three directions. All planes X_m = k l are planes of symmetry.
#pragma once
#include "kernels/jet.hpp"
#include "kernels/materials/linear_elastic.hpp"
#include "kernels/materials/mooney_rivlin.hpp"
#include "kernels/materials/neo_hookean.hpp"

namespace nanson {

/// The waves at a point: s and c of each direction, and k = pi/l [1/m].
template <class Real>
struct Waves {
  Real s[3], c[3];
  double k;
};

/// Derivative of s_i c_j c_k, `order[m]` times along X_m (at most twice) [1/m^(sum of order)].
template <class Real>
NANSON_INLINE Real wave_derivative(const Waves<Real>& w, int i, const int (&order)[3]) {
  Real product = Real{} + 1.0;
  for (int m = 0; m < 3; ++m) {
    const Real& plain = m == i ? w.s[m] : w.c[m];
    const Real& other = m == i ? w.c[m] : w.s[m];
    const double sign = m == i ? 1.0 : -1.0;  // s' = k c, c' = -k s
    product = product * (order[m] == 0 ? plain : order[m] == 1 ? (sign * w.k) * other : (-w.k * w.k) * plain);
  }
  return product;
}

/// F = I + du/dX, `size[i]` = A_i cos(omega t) [m].
template <class Real>
NANSON_INLINE Tensor<Real> manufactured_F(const Waves<Real>& w, const double (&size)[3]) {
  Tensor<Real> F = identity<Real>();
  for (int i = 0; i < 3; ++i)
    for (int I = 0; I < 3; ++I) {
      int order[3] = {};
      ++order[I];
      F[i][I] = F[i][I] + size[i] * wave_derivative(w, i, order);
    }
  return F;
}

/// g = d^2u/dt^2 - Div P(F)/rho0 [m/s^2]; d^2u/dt^2 = -omega^2 u. P is that of the law with its area and volume maps taken from F.
template <Law law, Volumetric volumetric, class Real>
NANSON_INLINE void manufactured_body_force(const Waves<Real>& w, const double (&size)[3], double omega,
                                           const MaterialConstants& m, Real (&g)[3]) {
  const Tensor<Real> F = manufactured_F(w, size);
  for (int i = 0; i < 3; ++i) g[i] = (-omega * omega * size[i]) * wave_derivative(w, i, {0, 0, 0});
  for (int I = 0; I < 3; ++I) {
    Tensor<Jet<Real>> along;  // F and its derivative along X_I
    for (int j = 0; j < 3; ++j)
      for (int J = 0; J < 3; ++J) {
        int order[3] = {};
        ++order[J];
        ++order[I];
        along[j][J] = {F[j][J], size[j] * wave_derivative(w, j, order)};
      }
    const auto P = Material<law, volumetric, Isochoric::F, Formulation::pF>::stress(along, along, Jet<Real>(1.0), m).P;
    for (int i = 0; i < 3; ++i) g[i] = g[i] - P[i][I].slope / m.rho;
  }
}

}  // namespace nanson
