// A number that counts its own operations: the laws of kernels/materials run on it once, so that their flops are counted, not estimated.
#pragma once
#include "engine/material.hpp"
#include "kernels/materials/linear_elastic.hpp"
#include "kernels/materials/mooney_rivlin.hpp"
#include "kernels/materials/neo_hookean.hpp"

namespace nanson {

struct Counted {
  double value = 0;
  Counted() = default;
  Counted(double x) : value(x) {}
  static inline long flops = 0;
  static Counted of(double x, int count) {
    flops += count;
    return x;
  }
};
inline Counted operator+(Counted a, Counted b) { return Counted::of(a.value + b.value, 1); }
inline Counted operator-(Counted a, Counted b) { return Counted::of(a.value - b.value, 1); }
inline Counted operator*(Counted a, Counted b) { return Counted::of(a.value * b.value, 1); }
inline Counted operator/(Counted a, Counted b) { return Counted::of(a.value / b.value, 1); }
inline Counted operator-(Counted a) { return Counted::of(-a.value, 1); }
inline bool operator>(Counted a, Counted b) { return Counted::of(0, 1), a.value > b.value; }
inline Counted fma(Counted a, Counted b, Counted c) { return Counted::of(fma(a.value, b.value, c.value), 2); }
inline Counted root(Counted a) { return Counted::of(root(a.value), 1); }
inline Counted choose(bool condition, Counted a, Counted b) { return condition ? a : b; }
inline Counted fnma(Counted a, Counted b, Counted c) { return Counted::of(fnma(a.value, b.value, c.value), 2); }
inline Counted inverse_cbrt_guess(Counted a) { return Counted::of(inverse_cbrt_guess(a.value), 2); }

/// Flops of one evaluation of a law.
template <Law law, Volumetric volumetric, Isochoric isochoric, Formulation formulation>
double flops_of_law(const MaterialConstants& m) {
  Tensor<Counted> F = identity<Counted>(), H = identity<Counted>();
  Counted::flops = 0;
  Material<law, volumetric, isochoric, formulation>::stress(F, H, Counted(1.0), m);
  return static_cast<double>(Counted::flops);
}

}  // namespace nanson
