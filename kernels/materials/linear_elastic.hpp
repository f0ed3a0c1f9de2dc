// Linear elasticity, linear throughout: H = I wherever it appears (method: small strain).
#pragma once
#include "kernels/materials/material.hpp"

namespace nanson {

/// P = 2 mu dev eps + p I, eps = sym(F) - I, p = kappa tr eps in pF and kappa (J - 1) where J is evolved.
/// Energy mu dev eps : dev eps + kappa/2 (tr eps or J - 1)^2 [J/m^3].
template <Volumetric volumetric, Isochoric isochoric, Formulation formulation>
struct Material<Law::linear_elastic, volumetric, isochoric, formulation> {
  static constexpr LawTraits traits{.carries_energy = true, .is_linear = true};

  template <class Real>
  NANSON_INLINE static Stress<Real> stress(const Tensor<Real>& F, const Tensor<Real>&, Real J,
                                           const MaterialConstants& m) {
    Stress<Real> s;
    const Tensor<Real> cof = cofactor(F);
    s.detF = determinant(F, cof);
    const Real trace = F[0][0] + F[1][1] + F[2][2] - 3.0;
    const Real p = m.kappa * (formulation == Formulation::pF ? trace : J - 1.0);
    for (int i = 0; i < 3; ++i)
      for (int I = 0; I < 3; ++I) s.P[i][I] = m.mu * (F[i][I] + F[I][i]);
    for (int i = 0; i < 3; ++i) s.P[i][i] = s.P[i][i] - 2.0 * m.mu * (1.0 + trace * (1.0 / 3.0)) + p;
    s.H = identity<Real>();
    s.Sigma_J = p;
    s.rho_c2 = p - p + m.rho * m.cp * m.cp;
    s.d2U = p - p + m.kappa;
    s.H2 = p - p + 1.0;
    return s;
  }
  template <class Real>
  NANSON_INLINE static Real energy(const Tensor<Real>& F, const Tensor<Real>&, Real J, const MaterialConstants& m) {
    const Real trace = F[0][0] + F[1][1] + F[2][2] - 3.0;
    Real dev2{};
    for (int i = 0; i < 3; ++i)
      for (int I = 0; I < 3; ++I) {
        Real e = 0.5 * (F[i][I] + F[I][i]);
        if (i == I) e = e - (1.0 + trace / 3.0);
        dev2 = dev2 + e * e;
      }
    const Real e = formulation == Formulation::pF ? trace : J - 1.0;
    return m.mu * dev2 + 0.5 * m.kappa * e * e;
  }
};

}  // namespace nanson
