// Laws at deformations whose stress is known in closed form: linear elasticity, volumetric energies, simple shear and uniform stretch.
#include <gtest/gtest.h>

#include "engine/material.hpp"
#include "tests/unit/material_list.hpp"

using namespace nanson;
using namespace nanson::test;

namespace {

const Tensor<double> I3 = identity<double>();

}  // namespace

TEST(LinearElastic, StressIsHookesLaw) {
  const MaterialConstants m = constants(false);
  const double lambda = m.kappa - 2.0 / 3 * m.mu;
  const Tensor<double> F{{{1.01, 0.02, -0.03}, {0.05, 0.97, 0.04}, {0.01, -0.06, 1.08}}};
  const Stress<double> s = pF<linear_elastic, quadratic, Isochoric::F>::stress({F, I3, 7.0}, m);
  const double trace = 0.01 - 0.03 + 0.08;
  for (int i = 0; i < 3; ++i)
    for (int I = 0; I < 3; ++I) {
      const double eps = 0.5 * (F[i][I] + F[I][i]) - (i == I),
                   expected = 2 * m.mu * eps + (i == I ? lambda * trace : 0.0);
      EXPECT_NEAR(s.P[i][I], expected, 1e-14 * m.kappa);
    }
  EXPECT_NEAR(s.Sigma_J, m.kappa * trace, 1e-14 * m.kappa);
  EXPECT_EQ(largest_entry(sum(s.H, I3, -1)), 0);
  EXPECT_DOUBLE_EQ(s.rho_c2, m.rho * m.cp * m.cp);
  EXPECT_EQ(s.d2U, m.kappa);
  EXPECT_EQ(s.H2, 1.0);
}

TEST(LinearElastic, PressureComesFromTheEvolvedJ) {
  const MaterialConstants m = constants(false);
  Tensor<double> F = I3;
  F[0][1] = 0.02;
  const Stress<double> s = pFJ<linear_elastic, quadratic, Isochoric::F>::stress({F, I3, 1.004}, m);
  EXPECT_NEAR(s.Sigma_J, m.kappa * 0.004, 1e-14 * m.kappa);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(s.P[i][i], m.kappa * 0.004, 1e-14 * m.kappa);
  EXPECT_NEAR(s.P[0][1], m.mu * 0.02, 1e-14 * m.kappa);
  EXPECT_NEAR(s.P[1][0], m.mu * 0.02, 1e-14 * m.kappa);
}

TEST(LinearElastic, EnergyOfUniaxialStrainIsHalfTheWaveModulus) {
  const MaterialConstants m = constants(false);
  Tensor<double> F = I3;
  F[1][1] = 1.03;
  const double E = 0.5 * (m.kappa + 4.0 / 3 * m.mu) * 0.03 * 0.03;
  EXPECT_NEAR((pF<linear_elastic, quadratic, Isochoric::F>::energy({F, I3, 7.0}, m)), E, 1e-14 * m.kappa);
  EXPECT_NEAR((pFJ<linear_elastic, quadratic, Isochoric::F>::energy({F, I3, 1.03}, m)), E, 1e-14 * m.kappa);
}

TEST(Volumetric, EnergiesAndTheirSlopesVanishAtOneWhereTheStiffnessIsKappa) {
  const auto check = []<Volumetric v>() {
    EXPECT_EQ(VolumetricEnergy<v>::U(1, 31), 0);
    EXPECT_EQ(VolumetricEnergy<v>::dU(1.0, 31), 0);
    EXPECT_EQ(VolumetricEnergy<v>::d2U(1.0, 31), 31);
  };
  check.template operator()<quadratic>();
  check.template operator()<barrier>();
}

TEST(Volumetric, OnlyTheBarrierIsInfiniteAtZero) {
  EXPECT_EQ(VolumetricEnergy<quadratic>::U(0.0, 2), 1);
  EXPECT_FALSE(std::isfinite(VolumetricEnergy<barrier>::U(0.0, 2)));
  EXPECT_NEAR(VolumetricEnergy<barrier>::U(0x1p-1022, 2), 1022 * std::log(2.0) - 0.5, 1e-12);
  EXPECT_LT(VolumetricEnergy<barrier>::dU(1e-6, 2.0), -0.9e6);
  EXPECT_NEAR(VolumetricEnergy<barrier>::U(2.0, 2), 1.5 - std::log(2.0), 1e-15);
}

TEST(NeoHookean, SimpleShearHasShearStressMuGamma) {
  const MaterialConstants m = constants(false);
  const double gamma = 0.7;
  Tensor<double> F = I3;
  F[0][1] = gamma;
  // P = mu (F - (F:F)/3 cof F), cof F = I - gamma e_y (x) e_x
  const Tensor<double> P = pF<neo_hookean, quadratic, Isochoric::F>::stress({F, I3, 1.0}, m).P;
  const double third = (3 + gamma * gamma) / 3;
  EXPECT_NEAR(P[0][1], m.mu * gamma, 1e-14 * m.mu);
  EXPECT_NEAR(P[1][0], m.mu * third * gamma, 1e-14 * m.mu);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(P[i][i], m.mu * (1 - third), 1e-14 * m.mu);
}

TEST(FiniteStrain, UniformStretchHasThePressureOfTheVolumetricEnergyAlone) {
  const double a = 1.3, J = a * a * a;
  const Tensor<double> F = sum(Tensor<double>{}, I3, a);
  const auto check = [&]<class Material_>(Material_, bool with_xi, double dU) {
    const MaterialConstants m = constants(with_xi);
    const Tensor<double> P = Material_::stress({F, cofactor(F), J}, m).P;
    EXPECT_LE(largest_entry(sum(P, I3, -dU * a * a)), 1e-13 * m.kappa) << Material_::name();
  };
  const double quadratic_dU = 31 * (J - 1), barrier_dU = 15.5 * (J - 1 / J);
  check(pF<neo_hookean, quadratic, Isochoric::F>{}, false, quadratic_dU);
  check(pF<neo_hookean, barrier, Isochoric::F>{}, false, barrier_dU);
  check(pF<mooney_rivlin, quadratic, Isochoric::F>{}, true, quadratic_dU);
  check(pF<mooney_rivlin, barrier, Isochoric::F>{}, true, barrier_dU);
  check(pFJ<mooney_rivlin, quadratic, Isochoric::J>{}, true, quadratic_dU);
  check(pFHJ<mooney_rivlin, barrier, Isochoric::F>{}, true, barrier_dU);
}

TEST(FiniteStrain, SmallStrainsFollowHookesLaw) {
  Random random(1);
  const auto check = [&]<class Material_>(Material_, bool with_xi) {
    const MaterialConstants m = constants(with_xi);
    const double h = 1e-6;
    for (int k = 0; k < 20; ++k) {
      const Tensor<double> A = random_tensor(random), F = sum(I3, A, h);
      const Tensor<double> linear = pF<linear_elastic, quadratic, Isochoric::F>::stress({F, I3, 1.0}, m).P;
      const Tensor<double> P = Material_::stress({F, cofactor(F), determinant(F, cofactor(F))}, m).P;
      EXPECT_LE(largest_entry(sum(P, linear, -1)), 50 * m.kappa * h * h) << Material_::name();
    }
  };
  check(pF<neo_hookean, quadratic, Isochoric::F>{}, false);
  check(pF<neo_hookean, barrier, Isochoric::F>{}, false);
  check(pF<mooney_rivlin, quadratic, Isochoric::F>{}, true);
  check(pFHJ<mooney_rivlin, barrier, Isochoric::J>{}, true);
}

TEST(Constants, AreThoseOfYoungsModulusAndPoissonsRatio) {
  MaterialSpec spec;
  spec.law = Law::mooney_rivlin;
  spec.density = 1100;
  spec.youngs_modulus = 17e6;
  spec.poissons_ratio = 0.45;
  spec.xi = 2e5;
  const MaterialConstants m = constants_of(spec);
  EXPECT_NEAR(9 * m.kappa * m.mu / (3 * m.kappa + m.mu), 17e6, 1e-6);
  EXPECT_NEAR((3 * m.kappa - 2 * m.mu) / (2 * (3 * m.kappa + m.mu)), 0.45, 1e-14);
  EXPECT_NEAR(2 * m.zeta + 3 * std::sqrt(3.0) * m.xi, m.mu, 1e-9);
  EXPECT_EQ(m.xi, 2e5);
  EXPECT_NEAR(m.rho * m.cp * m.cp, m.kappa + 4.0 / 3 * m.mu, 1e-7);
  EXPECT_NEAR(m.rho * m.cs * m.cs, m.mu, 1e-8);
  spec.law = Law::neo_hookean;  // xi belongs to Mooney-Rivlin alone
  EXPECT_EQ(constants_of(spec).xi, 0.0);
  EXPECT_DOUBLE_EQ(constants_of(spec).zeta, 0.5 * m.mu);
}
