// Every material that is built (cmake/PartInstances.cmake), as types for typed tests, with random states of each.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "kernels/materials/linear_elastic.hpp"
#include "kernels/materials/mooney_rivlin.hpp"
#include "kernels/materials/neo_hookean.hpp"
#include "kernels/parting.hpp"
#include "tests/unit/random_tensor.hpp"

namespace nanson::test {

/// What a law reads, and its stress and energy there.
struct MaterialState {
  Tensor<double> F, H;
  double J;
};

template <Law law_, Volumetric volumetric_, Isochoric isochoric_, Formulation formulation_,
          Parting parting_ = Parting::none>
struct Built {
  static constexpr Law law = law_;
  static constexpr Volumetric volumetric = volumetric_;
  static constexpr Isochoric isochoric = isochoric_;
  static constexpr Formulation formulation = formulation_;
  static constexpr Parting parting = parting_;
  static constexpr bool finite_strain = law != Law::linear_elastic, evolves_J = formulation != Formulation::pF,
                        evolves_H = formulation == Formulation::pFHJ;
  using Own = Material<law, volumetric, isochoric, formulation>;

  [[gnu::noinline]] static Stress<double> stress(const MaterialState& s, const MaterialConstants& m) {
    return stress(s.F, s.H, s.J, m);
  }
  [[gnu::noinline]] static Stress<Vec8> stress(const Tensor<Vec8>& F, const Tensor<Vec8>& H, Vec8 J,
                                               const MaterialConstants& m) {
    return stress<Vec8>(F, H, J, m);
  }
  [[gnu::noinline]] static double energy(const MaterialState& s, const MaterialConstants& m) {
    const double law = Own::energy(s.F, s.H, s.J, m);
    return parting == Parting::energy ? law + parting_energy(s.F, s.J, m.parting) : law;
  }
  static std::string name() {
    return std::string(word(law)) + "_" + std::string(word(volumetric)) + "_" + std::string(word(isochoric)) + "_"
           + std::string(word(formulation)) + (parting == Parting::energy ? "_parting" : "");
  }

 private:
  template <class Real>
  NANSON_INLINE static Stress<Real> stress(const Tensor<Real>& F, const Tensor<Real>& H, Real J,
                                           const MaterialConstants& m) {
    Stress<Real> s = Own::stress(F, H, J, m);
    if constexpr (parting == Parting::energy) add_parting(s, F, J, m.parting);
    return s;
  }
};

inline MaterialConstants constants(bool with_xi) {
  MaterialConstants m;
  m.rho = 1100;
  m.mu = 7;
  m.kappa = 31;
  m.parting = 9;
  m.xi = with_xi ? 0.4 : 0.0;
  m.zeta = 0.5 * (m.mu - 3 * std::sqrt(3.0) * m.xi);
  m.cp = std::sqrt((m.kappa + 4.0 / 3 * m.mu) / m.rho);
  m.cs = std::sqrt(m.mu / m.rho);
  return m;
}

/// What a formulation does not evolve is NaN: the law must not read it.
template <class Material_>
MaterialState random_state(Random& random) {
  constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
  MaterialState s;
  s.F = random_F(random, 0.6, 1.6);
  const Tensor<double> cof = cofactor(s.F);
  for (int k = 0; k < 9; ++k)
    s.H.a[k / 3][k % 3] = Material_::evolves_H ? cof.a[k / 3][k % 3] + uniform(random, -0.1, 0.1) : NaN;
  s.J = Material_::evolves_J ? determinant(s.F, cof) * uniform(random, 0.8, 1.25) : NaN;
  return s;
}

inline MaterialState undeformed() { return {identity<double>(), identity<double>(), 1.0}; }

template <Law law, Volumetric v, Isochoric i>
using pF = Built<law, v, i, Formulation::pF>;
template <Law law, Volumetric v, Isochoric i>
using pFJ = Built<law, v, i, Formulation::pFJ>;
template <Law law, Volumetric v, Isochoric i>
using pFHJ = Built<law, v, i, Formulation::pFHJ>;

template <Law law, Formulation f>
using Parted = Built<law, Volumetric::quadratic, Isochoric::F, f, Parting::energy>;

using enum Law;
using enum Volumetric;
using AllMaterials =
    ::testing::Types<pF<linear_elastic, quadratic, Isochoric::F>, pFJ<linear_elastic, quadratic, Isochoric::F>,
                     pFHJ<linear_elastic, quadratic, Isochoric::F>, pF<neo_hookean, quadratic, Isochoric::F>,
                     pFJ<neo_hookean, quadratic, Isochoric::F>, pFHJ<neo_hookean, quadratic, Isochoric::F>,
                     pF<neo_hookean, barrier, Isochoric::F>, pFJ<neo_hookean, barrier, Isochoric::F>,
                     pFHJ<neo_hookean, barrier, Isochoric::F>, pFJ<neo_hookean, quadratic, Isochoric::J>,
                     pFHJ<neo_hookean, quadratic, Isochoric::J>, pFJ<neo_hookean, barrier, Isochoric::J>,
                     pFHJ<neo_hookean, barrier, Isochoric::J>, pF<mooney_rivlin, quadratic, Isochoric::F>,
                     pFJ<mooney_rivlin, quadratic, Isochoric::F>, pFHJ<mooney_rivlin, quadratic, Isochoric::F>,
                     pF<mooney_rivlin, barrier, Isochoric::F>, pFJ<mooney_rivlin, barrier, Isochoric::F>,
                     pFHJ<mooney_rivlin, barrier, Isochoric::F>, pFJ<mooney_rivlin, quadratic, Isochoric::J>,
                     pFHJ<mooney_rivlin, quadratic, Isochoric::J>, pFJ<mooney_rivlin, barrier, Isochoric::J>,
                     pFHJ<mooney_rivlin, barrier, Isochoric::J>, Parted<neo_hookean, Formulation::pFJ>,
                     Parted<neo_hookean, Formulation::pFHJ>, Parted<mooney_rivlin, Formulation::pFJ>,
                     Parted<mooney_rivlin, Formulation::pFHJ>>;

struct MaterialName {
  template <class Material_>
  static std::string GetName(int) {
    return Material_::name();
  }
};

}  // namespace nanson::test
