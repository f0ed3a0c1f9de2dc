// von Mises hyperelastic-plastic law in principal logarithmic stretches, isotropic hardening, with its return mapping (paper, section 6.7; method, section 5).
#pragma once
#include "kernels/materials/material.hpp"
#include "kernels/symmetric_functions.hpp"

namespace nanson {

/// State of a node: inverse plastic right Cauchy-Green tensor and equivalent plastic strain.
template <class Real>
struct PlasticState {
  Symmetric<Real> C_p_inv;  // [-] det 1
  Real eps_p;               // [-]
};

/// The stress after the return to the yield surface.
template <class Real>
struct ReturnMapping {
  Symmetric<Real>
      ln_b_e;    // [-] deviator of ln b_e, b_e = F C_p^-1 F^T; the deviatoric Kirchhoff stress is tau = mu ln_b_e
  Real q;        // [Pa] sqrt(3/2) |tau|
  Real d_gamma;  // [-] growth of eps_p, >= 0
  Real
      plastic_work;  // [J/m^3] tau_y d eps_p, mean of tau_y before and after: exact along a straight piece of the hardening curve
};

/// Trial tau = mu dev ln b_e, b_e = F C_p^-1 F^T, q = sqrt(3/2) |tau|, f = q - tau_y(eps_p); where f > 0 the d_gamma with q - 3 mu d_gamma = tau_y(eps_p + d_gamma),
/// tau *= 1 - 3 mu d_gamma/q, by d_gamma n, n = (3/2) tau/q, taken off ln V_e. In no axes: these tensors share theirs.
/// P = tau F^-T + p H, p = U'(J) = kappa ln J/J, Sigma_J = p. Energy mu |dev ln V_e|^2 + kappa/2 (ln J)^2 [J/m^3].
template <Volumetric volumetric, Isochoric isochoric, Formulation formulation>
struct Material<Law::hencky_j2, volumetric, isochoric, formulation> {
  static constexpr LawTraits traits{.has_state = true, .carries_energy = true};
  template <class Real>
  using State = PlasticState<Real>;

  template <class Real>
  NANSON_INLINE static Symmetric<Real> elastic_strain(const Tensor<Real>& F, const Symmetric<Real>& C_p_inv) {
    Tensor<Real> FC;
    for (int i = 0; i < 3; ++i)
      for (int I = 0; I < 3; ++I)
        FC[i][I] = fma(F[i][0], C_p_inv(0, I), fma(F[i][1], C_p_inv(1, I), F[i][2] * C_p_inv(2, I)));
    Symmetric<Real> b;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) b(i, j) = fma(FC[i][0], F[j][0], fma(FC[i][1], F[j][1], FC[i][2] * F[j][2]));
    return b;
  }

  /// The piece of the hardening curve that the return ends on is the last one whose start the trial still exceeds: q - 3 mu (e - eps_p) falls, tau_y(e) does not.
  template <class Real>
  NANSON_INLINE static ReturnMapping<Real> return_mapping(const Tensor<Real>& F, const PlasticState<Real>& z,
                                                          const MaterialConstants& m) {
    ReturnMapping<Real> r;
    r.ln_b_e = deviatoric_logarithm(elastic_strain(F, z.C_p_inv));
    const Real q = m.mu * root(1.5 * square_norm(r.ln_b_e));
    const Hardening& h = m.hardening;
    Real g{}, tau_y{};
    for (int i = 0; i < h.count; ++i) {
      const Real beyond = z.eps_p - h.eps_p[i], excess = q - h.tau_y[i];
      const Real g_i = (excess - h.slope[i] * beyond) * (1.0 / (3.0 * m.mu + h.slope[i]));
      if (i == 0) {
        g = g_i;
        tau_y = h.tau_y[0] + h.slope[0] * beyond;
      } else {
        g = choose(excess + 3.0 * m.mu * beyond > 0.0, g_i, g);
        tau_y = choose(beyond > 0.0, h.tau_y[i] + h.slope[i] * beyond, tau_y);
      }
    }
    r.d_gamma = choose(g > 0.0, g, Real{});
    const Real per_q = r.d_gamma / (q + 1e-300);
    for (Real& ln : r.ln_b_e.a) ln = ln * (1.0 - 3.0 * m.mu * per_q);
    r.q = q - 3.0 * m.mu * r.d_gamma;
    r.plastic_work = 0.5 * r.d_gamma * (tau_y + r.q);
    return r;
  }

  template <class Real>
  NANSON_INLINE static Stress<Real> stress(const Tensor<Real>& F, const Tensor<Real>& evolved_H, Real evolved_J,
                                           const ReturnMapping<Real>& r, const MaterialConstants& m) {
    Stress<Real> s;
    const Tensor<Real> cof = cofactor(F);
    s.detF = determinant(F, cof);
    s.H = formulation == Formulation::pFHJ ? evolved_H : cof;
    const Real J = formulation == Formulation::pF ? s.detF : evolved_J;
    const Real ln_J = logarithm(J), inverse_J = 1.0 / J, inverse_det = 1.0 / s.detF;
    s.Sigma_J = m.kappa * ln_J * inverse_J;
    s.d2U = m.kappa * (1.0 - ln_J) * (inverse_J * inverse_J);
    for (int i = 0; i < 3; ++i)
      for (int I = 0; I < 3; ++I) {
        const Real t = fma(r.ln_b_e(i, 0), cof[0][I], fma(r.ln_b_e(i, 1), cof[1][I], r.ln_b_e(i, 2) * cof[2][I]));
        s.P[i][I] = fma(t, m.mu * inverse_det, s.Sigma_J * s.H[i][I]);
      }
    const Real HH = contract(cof, cof);
    s.H2 = spectral_bounds(contract(F, F), HH, s.detF).H2;
    s.rho_c2 = speed_bound(r.q, s.H2, inverse_det * inverse_det, s.d2U, m);
    return s;
  }

  /// Bound of the elastic acoustic tensor's largest eigenvalue over all directions [Pa], exact at F = I; plastic flow is softer.
  /// With h = w (x) F^-T N and the principal axes of b_e, the second variation of mu |dev ln V_e|^2 along w (x) N is that at F = I, at most (4/3) mu |h|^2, and
  /// -tau_a h_aa^2 + (G b_b - mu) h_ab^2 + (G b_a - mu) h_ba^2 + 2 (G (b_a + b_b)/2 - mu - (tau_a + tau_b)/2) h_ab h_ba, G = mu ln(b_a/b_b)/(b_a - b_b).
  /// The logarithmic mean lies between the geometric and the arithmetic one: G b <= mu R, R = lambda_max/lambda_min <= exp(q/(sqrt(3) mu)), |tau_a| <= (2/3) q.
  /// Hence [(4/3) mu + 2 mu (R - 1) + (2/3) q] |H|^2/j^2, and U'' |H|^2 of the volumetric part.
  template <class Real>
  NANSON_INLINE static Real speed_bound(Real q, Real H2, Real inverse_j2, Real d2U, const MaterialConstants& m) {
    const Real R = exponential(q * (0.57735026918962576 / m.mu));
    const Real deviatoric = (4.0 / 3.0) * m.mu + 2.0 * m.mu * (R - 1.0) + (2.0 / 3.0) * q;
    return H2 * (deviatoric * inverse_j2 + larger(d2U, d2U - d2U));
  }

  /// C_p^-1 = F^-1 b_e F^-T of the returned b_e, a multiple of exp(ln_b_e), with det 1, and eps_p; where nothing flowed the state is left as it is, to the bit.
  template <class Real>
  NANSON_INLINE static PlasticState<Real> flowed(const Tensor<Real>& F, const PlasticState<Real>& z,
                                                 const ReturnMapping<Real>& r) {
    const Tensor<Real> cof = cofactor(F);
    const Real inverse_det = 1.0 / determinant(F, cof);
    Tensor<Real> F_inv;
    for (int i = 0; i < 3; ++i)
      for (int I = 0; I < 3; ++I) F_inv[I][i] = cof[i][I] * inverse_det;
    const Symmetric<Real> C = elastic_strain(F_inv, exponential(r.ln_b_e));
    const Real to_det_one = inverse_cube_root(determinant(C, cofactor(C)));
    PlasticState<Real> out;
    for (int k = 0; k < 6; ++k) out.C_p_inv.a[k] = choose(r.d_gamma > 0.0, C.a[k] * to_det_one, z.C_p_inv.a[k]);
    out.eps_p = z.eps_p + r.d_gamma;
    return out;
  }

  template <class Real>
  NANSON_INLINE static Real energy(const Tensor<Real>& F, std::type_identity_t<Real> evolved_J,
                                   const PlasticState<Real>& z, const MaterialConstants& m) {
    const Real ln_J = logarithm(formulation == Formulation::pF ? determinant(F, cofactor(F)) : evolved_J);
    return 0.25 * m.mu * square_norm(deviatoric_logarithm(elastic_strain(F, z.C_p_inv)))
           + 0.5 * m.kappa * (ln_J * ln_J);
  }
};

}  // namespace nanson
