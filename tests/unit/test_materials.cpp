// Every law: stress against differences of the energy, objectivity, the undeformed state, lanes against the scalar.
#include <gtest/gtest.h>

#include "tests/unit/material_list.hpp"

using namespace nanson;
using namespace nanson::test;

namespace {

template <class Material_>
struct MaterialLaws : ::testing::Test {
  MaterialConstants m = constants(Material_::law == Law::mooney_rivlin);
};
TYPED_TEST_SUITE(MaterialLaws, AllMaterials, MaterialName);

/// The state after dF = h A, along the motion that the formulation ties: dH = F x dF, dJ = H:dF with the law's own H (I in linear elasticity).
template <class Material_>
MaterialState moved(const MaterialState& s, const Tensor<double>& H, const Tensor<double>& A, double h) {
  return {sum(s.F, A, h), sum(s.H, cross(s.F, A), h), s.J + h * contract(H, A)};
}

/// dE/dh by a fourth-order central difference.
template <class Energy>
double slope(Energy E) {
  const double h = 1e-3;
  return (8 * (E(h) - E(-h)) - (E(2 * h) - E(-2 * h))) / (12 * h);
}

void set_lane(Tensor<Vec8>& T, int lane, const Tensor<double>& A) {
  for (int k = 0; k < 9; ++k) T.a[k / 3][k % 3][lane] = A.a[k / 3][k % 3];
}

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

}  // namespace

TYPED_TEST(MaterialLaws, StressIsTheSlopeOfTheEnergyAlongTheMotion) {
  Random random(1);
  for (int k = 0; k < 50; ++k) {
    const MaterialState s = random_state<TypeParam>(random);
    const Stress<double> stress = TypeParam::stress(s, this->m);
    for (int e = 0; e < 9; ++e) {
      Tensor<double> A{};
      A.a[e / 3][e % 3] = 1;
      const double dE = slope(
          [&](double h) { return TypeParam::energy(moved<TypeParam>(s, stress.H, A, h), this->m); });
      EXPECT_NEAR(contract(stress.P, A), dE, 1e-8 * (largest_entry(stress.P) + this->m.kappa)) << "entry " << e;
    }
  }
}

TYPED_TEST(MaterialLaws, SigmaJIsTheSlopeOfTheEnergyInJ) {
  Random random(2);
  for (int k = 0; k < 50; ++k) {
    const MaterialState s = random_state<TypeParam>(random);
    const Stress<double> stress = TypeParam::stress(s, this->m);
    double dE = 0;
    if constexpr (TypeParam::
                      evolves_J)  // at fixed F and H: dU/dJ, and the isochoric energy's share where that one reads J
      dE = slope([&](double h) { return TypeParam::energy({s.F, s.H, s.J + h}, this->m); });
    else if constexpr (TypeParam::finite_strain)
      dE = slope([&](double h) { return VolumetricEnergy<TypeParam::volumetric>::U(stress.detF + h, this->m.kappa); });
    else dE = this->m.kappa * (s.F[0][0] + s.F[1][1] + s.F[2][2] - 3);
    EXPECT_NEAR(stress.Sigma_J, dE, 1e-8 * (std::abs(dE) + this->m.kappa));
  }
}

TYPED_TEST(MaterialLaws, VolumetricStiffnessIsTheSlopeOfThePressure) {
  Random random(3);
  for (int k = 0; k < 50; ++k) {
    const MaterialState s = random_state<TypeParam>(random);
    const Stress<double> stress = TypeParam::stress(s, this->m);
    const double J = TypeParam::evolves_J ? s.J : stress.detF;
    double d2U = slope([&](double h) { return VolumetricEnergy<TypeParam::volumetric>::dU(J + h, this->m.kappa); });
    if constexpr (TypeParam::parting == Parting::energy)
      d2U = slope([&](double h) { return TypeParam::stress({s.F, s.H, s.J + h}, this->m).Sigma_J; });
    EXPECT_NEAR(stress.d2U, d2U, 1e-8 * d2U);
  }
}

TYPED_TEST(MaterialLaws, UndeformedStateHasNoStressAndNoEnergy) {
  const MaterialState s = undeformed();
  const Stress<double> stress = TypeParam::stress(s, this->m);
  EXPECT_LE(largest_entry(stress.P), 1e-14 * this->m.kappa);
  EXPECT_NEAR(TypeParam::energy(s, this->m), 0, 1e-14 * this->m.kappa);
  EXPECT_EQ(stress.detF, 1.0);
  EXPECT_LE(largest_entry(sum(stress.H, identity<double>(), -1)), 0);
  // with the evolved J in the isochoric energy the conjugates of F, H and J balance each other without being zero
  const double conjugate = TypeParam::isochoric == Isochoric::J ? -2 * (this->m.zeta + 3 * std::sqrt(3.0) * this->m.xi)
                                                                : 0.0;
  EXPECT_NEAR(stress.Sigma_J, conjugate, 1e-14 * this->m.kappa);
}

TYPED_TEST(MaterialLaws, ARotatedStateHasTheRotatedStressAndTheSameEnergy) {
  if constexpr (TypeParam::finite_strain) {
    Random random(4);
    for (int k = 0; k < 50; ++k) {
      const MaterialState s = random_state<TypeParam>(random);
      const Tensor<double> R = random_rotation(random);
      const MaterialState rotated{product(R, s.F), product(R, s.H), s.J};
      const Stress<double> before = TypeParam::stress(s, this->m), after = TypeParam::stress(rotated, this->m);
      EXPECT_LE(largest_entry(sum(after.P, product(R, before.P), -1)),
                1e-13 * (largest_entry(before.P) + this->m.kappa));
      EXPECT_NEAR(after.Sigma_J, before.Sigma_J, 1e-13 * (std::abs(before.Sigma_J) + this->m.kappa));
      EXPECT_NEAR(TypeParam::energy(rotated, this->m), TypeParam::energy(s, this->m), 1e-12 * this->m.kappa);
      EXPECT_NEAR(after.rho_c2, before.rho_c2, 1e-11 * before.rho_c2);
    }
  } else {  // linear elasticity sees a rotation as a strain: tr (R - I) is not 0
    MaterialState s = undeformed();
    s.F = {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};
    EXPECT_GT(largest_entry(TypeParam::stress(s, this->m).P), this->m.mu);
  }
}

TYPED_TEST(MaterialLaws, StressTimesFTransposedIsSymmetricWhenHAndJBelongToF) {
  if constexpr (TypeParam::finite_strain) {
    Random random(5);
    for (int k = 0; k < 50; ++k) {
      MaterialState s = random_state<TypeParam>(random);
      s.H = cofactor(s.F);
      s.J = determinant(s.F, s.H);
      const Tensor<double> tau = product(TypeParam::stress(s, this->m).P, transposed(s.F));
      EXPECT_LE(largest_entry(sum(tau, transposed(tau), -1)), 1e-13 * (largest_entry(tau) + this->m.kappa));
    }
  } else {  // P itself is symmetric
    Random random(5);
    const Tensor<double> P = TypeParam::stress(random_state<TypeParam>(random), this->m).P;
    EXPECT_LE(largest_entry(sum(P, transposed(P), -1)), 0);
  }
}

TYPED_TEST(MaterialLaws, LanesHaveTheBitsOfTheScalar) {
  Random random(6);
  for (int k = 0; k < 50; ++k) {
    MaterialState s[8];
    Tensor<Vec8> F, H;
    Vec8 J;
    for (int n = 0; n < 8; ++n) {
      s[n] = random_state<TypeParam>(random);
      set_lane(F, n, s[n].F);
      set_lane(H, n, s[n].H);
      J[n] = s[n].J;
    }
    const Stress<Vec8> wide = TypeParam::stress(F, H, J, this->m);
    for (int n = 0; n < 8; ++n) {
      const Stress<double> one = TypeParam::stress(s[n], this->m);
      for (int e = 0; e < 9; ++e) {
        EXPECT_TRUE(same_bits(wide.P.a[e / 3][e % 3][n], one.P.a[e / 3][e % 3])) << "P entry " << e;
        EXPECT_TRUE(same_bits(wide.H.a[e / 3][e % 3][n], one.H.a[e / 3][e % 3])) << "H entry " << e;
      }
      EXPECT_TRUE(same_bits(wide.Sigma_J[n], one.Sigma_J));
      EXPECT_TRUE(same_bits(wide.detF[n], one.detF));
      EXPECT_TRUE(same_bits(wide.rho_c2[n], one.rho_c2));
      EXPECT_TRUE(same_bits(wide.d2U[n], one.d2U));
      EXPECT_TRUE(same_bits(wide.H2[n], one.H2));
    }
  }
}

TYPED_TEST(MaterialLaws, StressIsNaNWhereTheIsochoricEnergyHasNoVolume) {
  if constexpr (TypeParam::finite_strain) {
    for (const double bad : {0.0, -0.5, std::numeric_limits<double>::quiet_NaN()}) {
      MaterialState s = undeformed();
      if (TypeParam::isochoric == Isochoric::J) s.J = bad;
      else s.F[2][2] = bad;
      const Stress<double> stress = TypeParam::stress(s, this->m);
      for (int e = 0; e < 9; ++e) EXPECT_TRUE(std::isnan(stress.P.a[e / 3][e % 3])) << "entry " << e << " at " << bad;
    }
  } else {  // linear: finite for any finite F; stress_part flags it
    MaterialState s = undeformed();
    s.F[2][2] = -0.5;
    EXPECT_LT(largest_entry(TypeParam::stress(s, this->m).P), 100 * this->m.kappa);
    EXPECT_EQ(TypeParam::stress(s, this->m).detF, -0.5);
  }
}
