// The energy of the parting: what ties the evolved J to det F, of which D^J alone takes it away.
#pragma once
#include "kernels/materials/material.hpp"

namespace nanson {

/// Beside psi(F, H, J) of the law: (M/2) l^2, l = ln(det F/J) [J/m^3], M [Pa]. With d = det F and cof the cofactor of F, both always F's own (H of {p,F,H,J} stays out of it),
/// d(l)/dF = cof/d and d(l)/dJ = -1/J. J moves with dJ/dt = H:dF/dt, so that a body does the work
///   P:dF/dt, P += d(psi)/dF + d(psi)/dJ H = M l (cof/d - H/J),   and D^J meets   Sigma_J += d(psi)/dJ = -M l/J.
/// Where H = cof, P gains M l (1/d - 1/J) cof only, of second order in the parting: it is D^J, driven by Sigma_J, that carries J back to det F.
/// d(Sigma_J)/dJ += M (1 + l)/J^2. Along w (x) N, where d and H N do not bend, the second variation is M (w.h)^2 [(1/d - 1/J)^2 + l (1/J^2 - 1/d^2)] with h = H N = cof N,
/// both terms >= 0: the bound of the acoustic tensor's largest eigenvalue gains that with |h|^2 <= H2.
template <class Real>
NANSON_INLINE void add_parting(Stress<Real>& s, const Tensor<Real>& F, Real J, double M) {
  const Tensor<Real> cof = cofactor(F);
  const Real inverse_J = 1.0 / J, inverse_d = 1.0 / s.detF, gap = inverse_d - inverse_J;
  const Real l = logarithm(s.detF * inverse_J), of_d = M * l * inverse_d, of_J = -M * l * inverse_J;
  for (int k = 0; k < 9; ++k) {
    Real& P = s.P.a[k / 3][k % 3];
    P = fma(of_d, cof.a[k / 3][k % 3], fma(of_J, s.H.a[k / 3][k % 3], P));
  }
  s.Sigma_J = s.Sigma_J + of_J;
  s.d2U = s.d2U + M * (1.0 + l) * (inverse_J * inverse_J);
  s.rho_c2 = s.rho_c2 + M * s.H2 * (gap * (gap - l * (inverse_d + inverse_J)));
}

template <class Real>
NANSON_INLINE Real parting_energy(const Tensor<Real>& F, Real J, double M) {
  const Real l = logarithm(determinant(F, cofactor(F)) / J);
  return 0.5 * M * (l * l);
}

}  // namespace nanson
