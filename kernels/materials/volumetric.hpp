// Volumetric energies U(J), U' and U'' [Pa].
#pragma once

#include "kernels/column.hpp"
#include "kernels/traits.hpp"

namespace nanson {

template <Volumetric>
struct VolumetricEnergy;

/// U = kappa/2 (J - 1)^2 (paper, eq. 14): no barrier at J = 0.
template <>
struct VolumetricEnergy<Volumetric::quadratic> {
  template <class Real>
  NANSON_INLINE static Real U(Real J, double kappa) {
    return 0.5 * kappa * ((J - 1.0) * (J - 1.0));
  }
  template <class Real>
  NANSON_INLINE static Real dU(Real J, double kappa) {
    return kappa * (J - 1.0);
  }
  template <class Real>
  NANSON_INLINE static Real d2U(Real J, double kappa) {
    return J - J + kappa;
  }
};

/// U = kappa/2 [(J^2 - 1)/2 - ln J]: infinite at J = 0.
template <>
struct VolumetricEnergy<Volumetric::barrier> {
  template <class Real>
  NANSON_INLINE static Real U(Real J, double kappa) {
    return 0.5 * kappa * (0.5 * (J * J - 1.0) - logarithm(J));
  }
  template <class Real>
  NANSON_INLINE static Real dU(Real J, double kappa) {
    return 0.5 * kappa * (J - 1.0 / J);
  }
  template <class Real>
  NANSON_INLINE static Real d2U(Real J, double kappa) {
    return 0.5 * kappa * (1.0 + 1.0 / (J * J));
  }
};

}  // namespace nanson
