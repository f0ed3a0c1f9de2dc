// The numerical flux across one edge: average plus acoustic Riemann stabilisation (paper, eq. 34-43 and Remark 4).
#pragma once
#include "kernels/column.hpp"
#include "kernels/traits.hpp"

namespace nanson {

/// Stabilisation of one edge, before it meets the jump: D^p = shear d + normal (c . d) c with d the jump of v, D^J = volume (jump of Sigma_J).
/// c = H_ave C; size = |C|; cn = c_p-scale of the normal part times |C|: |C| (paper) or max(|C|, |c|), that is c_p max(1, |H_ave N|) (deformed).
/// D^p = 1/2 [rho cs |C| d + (rho cp cn - rho cs |C|) (c.d)/(c.c) c] (eq. 36a, 37, 41); D^J = (Sigma+ - Sigma-) c.c / (2 rho cJ cn) (Remark 4, eq. 42, where
/// cJ is cp; with an energy of the parting cp of kappa + M, the stiffness that J meets).
/// One edge (double) or eight as lanes (Vec8); Z: the impedances, double where all edges share them.
template <class Real>
struct EdgeCoefficientsOf {
  Real shear;   // [kg/s]
  Real normal;  // [kg/(m^4 s)]
  Real volume;  // [m^3/(Pa s)]
};

template <class Real, class Z>
NANSON_INLINE EdgeCoefficientsOf<Real> edge_coefficients(Real cc, Real size, Z rho_cp, Z rho_cs, Z rho_cJ,
                                                         bool deformed_metric) {
  const Real cn = deformed_metric ? larger(size, root(cc)) : size;
  const Real inverse = 1.0 / (cc * cn);
  const Real shear = 0.5 * (rho_cs * size);
  return {shear, fma(Real{} + 0.5 * rho_cp, cn, -shear) * (inverse * cn), (0.5 / rho_cJ) * (cc * cc) * inverse};
}

/// What multiplies the jump d = {v, Sigma_J}: D^p = shear d + along c, D^J = volume d_3.
template <class Real>
struct StabiliserOf {
  Real shear, volume, along;
};

/// From the product c.d of the reconstructed jump of v.
template <class Real>
NANSON_INLINE StabiliserOf<Real> stabiliser(const EdgeCoefficientsOf<Real>& s, Real cd) {
  return {s.shear, s.volume, s.normal * cd};
}

/// The entropy fix drops the normal or the tangential part of D^p, and D^J, where the reconstructed jump d opposes the plain one (method, section 3).
/// From the products c.d, c.plain and d.plain of the velocity jumps, and that of the pressure jumps.
template <class Real>
NANSON_INLINE StabiliserOf<Real> fixed_stabiliser(const EdgeCoefficientsOf<Real>& s, Real cc, Real cd, Real c_plain,
                                                  Real d_plain, Real pressure_product) {
  const Real zero{}, cd_cc = cd / cc, tangential = d_plain - cd_cc * c_plain;
  const Real shear = choose(tangential < 0.0, zero, s.shear), volume = choose(pressure_product < 0.0, zero, s.volume);
  const Real normal = choose(cd * c_plain < 0.0, zero, fma(s.normal, cd, s.shear * cd_cc));
  return {shear, volume, fma(-shear, cd_cc, normal)};
}

/// Central traction and area of an edge: {P_ave C | H_ave C} from the {P|H} columns of both ends.
NANSON_INLINE Vec8 average_traction_and_area(const Vec8 (&PH_a)[3], const double* PH_b, const double (&C)[3]) {
  Vec8 s = (PH_a[0] + load8(PH_b)) * broadcast8(0.5 * C[0]);
  s = fma(PH_a[1] + load8(PH_b + 8), broadcast8(0.5 * C[1]), s);
  return fma(PH_a[2] + load8(PH_b + 16), broadcast8(0.5 * C[2]), s);
}

}  // namespace nanson
