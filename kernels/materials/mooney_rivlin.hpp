// Polyconvex Mooney-Rivlin (paper, eq. 13-17); xi = 0 and zeta = mu/2 is the neo-Hookean law.
#pragma once
#include "kernels/materials/material.hpp"
#include "kernels/materials/volumetric.hpp"

namespace nanson {

/// psi = zeta j^(-2/3) F:F + xi j^(-2) (H:H)^(3/2) - 3(zeta + sqrt(3) xi) + U(J) [J/m^3].
/// isochoric = F: j = det F, P = Sigma_F + Sigma_H x F + (d psi_iso/dj) cof F + U'(J) H, Sigma_J = U'(J).
/// isochoric = J: j = J as the paper writes it, P = Sigma_F + Sigma_H x F + Sigma_J H, Sigma_J = d psi_iso/dJ + U'(J).
template <bool with_xi, Volumetric volumetric, Isochoric isochoric, Formulation formulation>
struct PolyconvexMaterial {
  static constexpr LawTraits traits{};
  using U = VolumetricEnergy<volumetric>;

  template <class Real>
  NANSON_INLINE static Stress<Real> stress(const Tensor<Real>& F, const Tensor<Real>& evolved_H, Real evolved_J,
                                           const MaterialConstants& m) {
    Stress<Real> s;
    const Tensor<Real> cof = cofactor(F);
    s.detF = determinant(F, cof);
    s.H = formulation == Formulation::pFHJ ? evolved_H : cof;
    const Real J = formulation == Formulation::pF ? s.detF : evolved_J;
    const Real j = isochoric == Isochoric::J ? J : s.detF;
    const Real FF = contract(F, F), j_third = inverse_cube_root(j), j_inv = j_third * j_third * j_third;
    const Real Sigma_F = 2.0 * m.zeta * (j_third * j_third);
    Real dpsi_dj = -(1.0 / 3.0) * Sigma_F * FF * j_inv;
    for (int k = 0; k < 9; ++k) s.P.a[k / 3][k % 3] = Sigma_F * F.a[k / 3][k % 3];
    if constexpr (with_xi) {
      const Real hh = contract(s.H, s.H), r = root(hh), xi_j2 = m.xi * (j_inv * j_inv);
      dpsi_dj = dpsi_dj - 2.0 * xi_j2 * j_inv * (hh * r);
      const Tensor<Real> HxF = cross(s.H, F);
      const Real Sigma_H = 3.0 * xi_j2 * r;
      for (int k = 0; k < 9; ++k) s.P.a[k / 3][k % 3] = fma(Sigma_H, HxF.a[k / 3][k % 3], s.P.a[k / 3][k % 3]);
    }
    const Real p = U::dU(J, m.kappa);
    s.Sigma_J = isochoric == Isochoric::J ? dpsi_dj + p : p;
    for (int k = 0; k < 9; ++k) {
      const Real by_cof = isochoric == Isochoric::J ? s.Sigma_J * s.H.a[k / 3][k % 3]
                                                    : fma(dpsi_dj, cof.a[k / 3][k % 3], p * s.H.a[k / 3][k % 3]);
      s.P.a[k / 3][k % 3] = s.P.a[k / 3][k % 3] + by_cof;
    }
    const Real HH = contract(cof, cof);
    const SpectralBounds<Real> norms = spectral_bounds(FF, HH, s.detF);
    s.H2 = norms.H2;
    s.d2U = U::d2U(J, m.kappa);
    s.rho_c2 = speed_bound(FF, HH, norms, s.detF, isochoric == Isochoric::J ? inverse_cube_root(s.detF) : j_third,
                           s.d2U, m);
    return s;
  }

  /// Bound of the acoustic tensor's largest eigenvalue over all directions [Pa]; for xi = 0 exact at F = I.
  /// Neo-Hookean part: Q = mt I + A h h^T - B (f h^T + h f^T), f = F N, h = cof F N, f.h = j; eigenvalue (a + sqrt(a^2 + 4 b^2))/2 with
  /// a = A |h|^2 - 2 B j, b = B sqrt(|f|^2 |h|^2 - j^2), growing in |f| and |h|, whose largest values are the spectral norms.
  /// xi part: with r = |H|, psi = xi r^3/j^2 has the second variation 3 xi r/j^2 [2 (r' - r j'/j)^2 + |K|^2 - r'^2] along w (x) N, K = F x (w (x) N),
  /// where |r' - r j'/j| <= |cof F|^3/(r j) and |K|^2 <= 2 |F|^2.
  template <class Real>
  NANSON_INLINE static Real speed_bound(Real FF, Real HH, const SpectralBounds<Real>& n, Real j, Real j_third, Real d2U,
                                        const MaterialConstants& m) {
    const Real t2 = j_third * j_third, mt = 2.0 * m.zeta * t2, j_inv = t2 * j_third;
    const Real A = (5.0 / 9.0) * mt * FF * (j_inv * j_inv) + d2U, B = (2.0 / 3.0) * mt * j_inv;
    const Real a = A * n.H2 - 2.0 * B * j, f2h2 = n.F2 * n.H2 - j * j, b2 = B * B * larger(f2h2, f2h2 - f2h2);
    Real q = mt + 0.5 * (a + root(a * a + 4.0 * b2));
    if constexpr (with_xi)
      q = q + 6.0 * m.xi * root(HH) * (j_inv * j_inv) * (n.H2 * n.H2 * n.H2 / (HH * (j * j)) + n.F2);
    return q;
  }

  template <class Real>
  NANSON_INLINE static Real energy(const Tensor<Real>& F, const Tensor<Real>& evolved_H, Real evolved_J,
                                   const MaterialConstants& m) {
    const Tensor<Real> cof = cofactor(F), H = formulation == Formulation::pFHJ ? evolved_H : cof;
    const Real detF = determinant(F, cof), J = formulation == Formulation::pF ? detF : evolved_J;
    const Real j = isochoric == Isochoric::J ? J : detF, j_third = inverse_cube_root(j);
    Real iso = m.zeta * contract(F, F) * (j_third * j_third) - 3.0 * m.zeta;
    if constexpr (with_xi) {
      const Real HH = contract(H, H);
      iso = iso + (m.xi * HH * root(HH) / (j * j) - 3.0 * root(3.0) * m.xi);
    }
    return iso + U::U(J, m.kappa);
  }
};

template <Volumetric volumetric, Isochoric isochoric, Formulation formulation>
struct Material<Law::mooney_rivlin, volumetric, isochoric, formulation>
    : PolyconvexMaterial<true, volumetric, isochoric, formulation> {};

}  // namespace nanson
