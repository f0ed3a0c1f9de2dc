// The numerical flux across one edge: average plus acoustic Riemann stabilisation (paper, eq. 34-43 and Remark 4).
#pragma once
#include "kernels/column.hpp"
#include "kernels/traits.hpp"

namespace nanson {

/// Stabilisation of one edge, before it meets the jump: D^p = shear d + normal (c . d) c with d the jump of v, D^J = volume (jump of Sigma_J).
/// c = H_ave C; size = |C|; cn = c_p-scale of the normal part times |C|: |C| (paper) or max(|C|, |c|), that is c_p max(1, |H_ave N|) (deformed).
/// D^p = 1/2 [rho cs |C| d + (rho cp cn - rho cs |C|) (c.d)/(c.c) c] (eq. 36a, 37, 41); D^J = (Sigma+ - Sigma-) c.c / (2 rho cp cn) (Remark 4, eq. 42).
struct EdgeCoefficients {
  double shear;   // [kg/s]
  double normal;  // [kg/(m^4 s)]
  double volume;  // [m^3/(Pa s)]
};

template <UpwindMetric metric>
NANSON_INLINE EdgeCoefficients edge_coefficients(double cc, double size, double rho_cp, double rho_cs) {
  double cn = size;
  if constexpr (metric == UpwindMetric::deformed) cn = larger(size, root(cc));
  const double inverse = 1.0 / (cc * cn);
  const double shear = 0.5 * (rho_cs * size);
  return {shear, fma(0.5 * rho_cp, cn, -shear) * (inverse * cn), (0.5 / rho_cp) * (cc * cc) * inverse};
}

/// Central traction and area of an edge: {P_ave C | H_ave C} from the {P|H} columns of both ends.
NANSON_INLINE Vec8 average_traction_and_area(const Vec8 (&PH_a)[3], const double* PH_b, const double (&C)[3]) {
  Vec8 s = (PH_a[0] + load8(PH_b)) * broadcast8(0.5 * C[0]);
  s = fma(PH_a[1] + load8(PH_b + 8), broadcast8(0.5 * C[1]), s);
  return fma(PH_a[2] + load8(PH_b + 16), broadcast8(0.5 * C[2]), s);
}

}  // namespace nanson
