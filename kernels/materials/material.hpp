// What every material law takes and gives.
#pragma once
#include "kernels/tensor.hpp"
#include "kernels/traits.hpp"

namespace nanson {

inline constexpr int hardening_points = 16;  // the most that a hardening curve may have

/// Isotropic hardening: tau_y = tau_y[i] + slope[i] (eps_p - eps_p[i]) from eps_p[i] to the next point, and on beyond the last.
struct Hardening {
  int count = 0;
  double eps_p[hardening_points] = {};  // [-] growing, from 0
  double tau_y[hardening_points] = {};  // [Pa]
  double slope[hardening_points] = {};  // [Pa] >= 0
};

/// Constants of a material. mu = E/(2(1+nu)), kappa = E/(3(1-2nu)); 2 zeta + 3 sqrt(3) xi = mu.
struct MaterialConstants {
  double rho = 0;            // [kg/m^3] undeformed density
  double mu = 0, kappa = 0;  // [Pa] shear and bulk modulus
  double zeta = 0, xi = 0;   // [Pa] of the isochoric energy (paper, eq. 14)
  double cp = 0, cs = 0;     // [m/s] undeformed wave speeds (paper, eq. 39)
  double parting = 0;        // [Pa] M of the energy of the parting of det F from J, 0 without
  double cJ = 0;             // [m/s] of the waves that D^J stabilises: c_p with kappa + M
  double tet_stiffness = 0;  // [Pa] modulus of the energies of the tets, 0 without
  double tet_barrier = 0;    // [Pa]
  Hardening hardening;       // of laws that yield
};

/// Stress of one node (or of eight as lanes).
template <class Real>
struct Stress {
  Tensor<Real> P;  // [Pa] first Piola-Kirchhoff stress
  Tensor<Real> H;  // [-] the area map that fluxes and dJ/dt use
  Real Sigma_J;    // [Pa] conjugate of J, whose jump stabilises it
  Real detF;       // [-]
  Real
      rho_c2;  // [Pa] bound of rho0 c^2 over all directions, c the fastest reference-frame speed of the acoustic tensor
  Real d2U;    // [Pa] U''(J); with an energy of the parting d(Sigma_J)/dJ of both
  Real H2;     // [-] bound of the squared spectral norm of H
};

/// Largest eigenvalue of a symmetric positive 3x3 tensor is at most m + sqrt(2) s, m and s mean and deviation of its eigenvalues (exact for equal stretches).
template <class Real>
NANSON_INLINE Real eigenvalue_bound(Real trace, Real trace_of_square) {
  const Real m = trace * (1.0 / 3.0);
  const Real s2 = trace_of_square * (1.0 / 3.0) - m * m;
  return m + root(2.0 * larger(s2, s2 - s2));
}

/// Squared spectral norms of F and of cof F from F:F, H:H and det F, as bounds.
template <class Real>
struct SpectralBounds {
  Real F2, H2;
};
template <class Real>
NANSON_INLINE SpectralBounds<Real> spectral_bounds(Real FF, Real HH, Real j) {
  return {eigenvalue_bound(FF, FF * FF - 2.0 * HH), eigenvalue_bound(HH, HH * HH - 2.0 * FF * (j * j))};
}

/// What sweeps and rules ask of a law. A law with a state has a `State`, `return_mapping` and `flowed` besides stress and energy.
struct LawTraits {
  bool has_state = false;       // keeps what flowed, a row a node
  bool carries_energy = false;  // its volumetric and isochoric energies are its own: there is no choice of them
  bool is_linear = false;       // in the geometry too: H = I
};

template <Law, Volumetric, Isochoric, Formulation>
struct Material;

/// A law's own energies are no choice, and without an evolved J there is none to put into the isochoric one.
template <Law law, Volumetric volumetric, Isochoric isochoric, Formulation formulation>
constexpr bool is_material = formulation != Formulation::pFp
                             && ((volumetric == Volumetric::quadratic && isochoric == Isochoric::F)
                                 || (!Material<law, volumetric, isochoric, formulation>::traits.carries_energy
                                     && (isochoric == Isochoric::F || evolves_J(formulation))));

}  // namespace nanson
