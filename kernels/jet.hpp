// A value and its derivative along one direction: the material laws run on it as they stand, so that the divergence of a stress is exact.
#pragma once
#include "kernels/column.hpp"

namespace nanson {

template <class Real>
struct Jet {
  Real value{}, slope{};
  Jet() = default;
  NANSON_INLINE Jet(Real v, Real s) : value(v), slope(s) {}
  NANSON_INLINE Jet(double x) : value(Real{} + x), slope{} {}
  NANSON_INLINE friend Jet operator+(Jet a, Jet b) { return {a.value + b.value, a.slope + b.slope}; }
  NANSON_INLINE friend Jet operator-(Jet a, Jet b) { return {a.value - b.value, a.slope - b.slope}; }
  NANSON_INLINE friend Jet operator-(Jet a) { return {-a.value, -a.slope}; }
  NANSON_INLINE friend Jet operator*(Jet a, Jet b) {
    return {a.value * b.value, a.slope * b.value + a.value * b.slope};
  }
  NANSON_INLINE friend Jet operator/(Jet a, Jet b) {
    const Real q = a.value / b.value;
    return {q, (a.slope - q * b.slope) / b.value};
  }
  NANSON_INLINE friend auto operator>(Jet a, Jet b) { return static_cast<Comparison<Real>>(a.value > b.value); }
  NANSON_INLINE friend Jet fma(Jet a, Jet b, Jet c) { return a * b + c; }
};

NANSON_INLINE Jet<double> choose(bool condition, Jet<double> a, Jet<double> b) { return condition ? a : b; }
NANSON_INLINE Jet<Vec8> choose(Mask8 condition, Jet<Vec8> a, Jet<Vec8> b) {
  return {choose(condition, a.value, b.value), choose(condition, a.slope, b.slope)};
}
template <class Real>
NANSON_INLINE Jet<Real> root(Jet<Real> a) {
  const Real r = root(a.value);
  return {r, a.slope / (r + r)};
}
template <class Real>
NANSON_INLINE Jet<Real> inverse_cube_root(Jet<Real> a) {
  const Real y = inverse_cube_root(a.value);
  return {y, -a.slope * y / (3.0 * a.value)};
}

}  // namespace nanson
