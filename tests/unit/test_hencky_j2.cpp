// The von Mises law: closed forms, objectivity, energy, hardening, step bound, lanes.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/material.hpp"
#include "kernels/materials/hencky_j2.hpp"
#include "tests/unit/random_tensor.hpp"

namespace nanson {
namespace {

using pF = Material<Law::hencky_j2, Volumetric::quadratic, Isochoric::F, Formulation::pF>;
using pFJ = Material<Law::hencky_j2, Volumetric::quadratic, Isochoric::F, Formulation::pFJ>;
using pFHJ = Material<Law::hencky_j2, Volumetric::quadratic, Isochoric::F, Formulation::pFHJ>;
using test::product, test::random_rotation, test::Random, test::uniform;

MaterialSpec copper() {
  MaterialSpec m;
  m.law = Law::hencky_j2;
  m.density = 8930;
  m.youngs_modulus = 117e9;
  m.poissons_ratio = 0.35;
  m.yield_stress = 0.4e9;
  m.hardening_modulus = 0.1e9;
  return m;
}
MaterialConstants elastic() {
  MaterialSpec m = copper();
  m.yield_stress = 1e30;
  return constants_of(m);
}

PlasticState<double> virgin() { return {{{1, 1, 1, 0, 0, 0}}, 0}; }

/// Stretches within `size` of 1.
Tensor<double> random_F(Random& random, double size) { return test::random_F(random, 1 - size, 1 + size); }

Tensor<double> stretch(double a, double b, double c) { return {{{a, 0, 0}, {0, b, 0}, {0, 0, c}}}; }

struct Answer {
  ReturnMapping<double> mapping;
  Stress<double> stress;
  PlasticState<double> state;
};
template <class Own = pF>
Answer evaluate(const Tensor<double>& F, const PlasticState<double>& z, const MaterialConstants& m, double J = 0) {
  const auto r = Own::return_mapping(F, z, m);
  return {r, Own::stress(F, cofactor(F), J > 0 ? J : determinant(F, cofactor(F)), r, m), Own::flowed(F, z, r)};
}

/// A plastic state that a few random strains leave behind.
PlasticState<double> deformed_state(Random& random, const MaterialConstants& m) {
  PlasticState<double> z = virgin();
  for (int k = 0; k < 3; ++k) z = evaluate(random_F(random, 0.3), z, m).state;
  return z;
}

/// Isochoric uniaxial stretch e (logarithmic): q = 3 mu e until yield, then (3 mu tau_0 + 3 mu H e)/(3 mu + H); eps_p the rest.
TEST(HenckyJ2, FollowsTheUniaxialClosedForm) {
  const MaterialConstants m = constants_of(copper());
  PlasticState<double> z = virgin();
  const double H = 0.1e9, tau_0 = 0.4e9;
  for (double e = 0.0005; e < 0.5; e *= 1.3) {
    const Answer a = evaluate(stretch(std::exp(e), std::exp(-e / 2), std::exp(-e / 2)), z, m);
    const double q = std::min(3 * m.mu * e, (3 * m.mu * tau_0 + 3 * m.mu * H * e) / (3 * m.mu + H));
    EXPECT_NEAR(a.mapping.q / q, 1, 1e-12) << e;
    EXPECT_NEAR(a.state.eps_p, e - q / (3 * m.mu), 1e-13) << e;
    EXPECT_NEAR(a.stress.P[0][0] / (2.0 / 3 * q / std::exp(e)), 1, 1e-9) << e;
    z = a.state;
  }
  EXPECT_GT(z.eps_p, 0.3);
}

TEST(HenckyJ2, SuperposedRotationTurnsTheStressAndLeavesTheState) {
  Random random(5);
  const MaterialConstants m = constants_of(copper());
  for (int k = 0; k < 200; ++k) {
    const PlasticState<double> z = deformed_state(random, m);
    const Tensor<double> F = random_F(random, 0.3), R = random_rotation(random);
    const Answer a = evaluate(F, z, m), b = evaluate(product(R, F), z, m);
    const Tensor<double> RP = product(R, a.stress.P);
    const double scale = std::sqrt(contract(RP, RP));
    for (int n = 0; n < 9; ++n) EXPECT_NEAR(b.stress.P.a[n / 3][n % 3] / scale, RP.a[n / 3][n % 3] / scale, 1e-11);
    for (int n = 0; n < 6; ++n) EXPECT_NEAR(b.state.C_p_inv.a[n], a.state.C_p_inv.a[n], 1e-11);
    EXPECT_NEAR(b.state.eps_p, a.state.eps_p, 1e-13);
  }
}

TEST(HenckyJ2, PlasticWorkIsNeverNegativeAndTheStateKeepsDetOne) {
  Random random(6);
  const MaterialConstants m = constants_of(copper());
  for (int walk = 0; walk < 20; ++walk) {
    PlasticState<double> z = virgin();
    Tensor<double> F = identity<double>();
    for (int k = 0; k < 100; ++k) {
      const Tensor<double> step = random_F(random, 0.01);
      if (const Tensor<double> next = product(step, F); std::abs(determinant(next, cofactor(next)) - 1) < 0.3) F = next;
      const Answer a = evaluate(F, z, m);
      EXPECT_GE(a.mapping.plastic_work, 0);
      EXPECT_GE(a.state.eps_p, z.eps_p);
      EXPECT_LE(a.mapping.q, (0.4e9 + 0.1e9 * a.state.eps_p) * (1 + 1e-9));
      z = a.state;
      const auto& C = z.C_p_inv;
      const Tensor<double> full{
          {{C(0, 0), C(0, 1), C(0, 2)}, {C(0, 1), C(1, 1), C(1, 2)}, {C(0, 2), C(1, 2), C(2, 2)}}};
      EXPECT_NEAR(determinant(full, cofactor(full)), 1, 1e-12);
      EXPECT_NEAR(evaluate(F, z, m).mapping.d_gamma, 0, 1e-12);  // back on the surface
    }
    EXPECT_GT(z.eps_p, 0.1);
  }
}

TEST(HenckyJ2, UnloadsElasticallyAndLeavesTheStateToTheBit) {
  const MaterialConstants m = constants_of(copper());
  const PlasticState<double> z = evaluate(stretch(1.1, 1 / std::sqrt(1.1), 1 / std::sqrt(1.1)), virgin(), m).state;
  ASSERT_GT(z.eps_p, 0.05);
  const double e = std::log(1.1) - 0.002;  // q falls by 3 mu 0.002
  const Answer a = evaluate(stretch(std::exp(e), std::exp(-e / 2), std::exp(-e / 2)), z, m);
  EXPECT_NEAR(a.mapping.q, 0.4e9 + 0.1e9 * z.eps_p - 3 * m.mu * 0.002, 1e2);
  EXPECT_EQ(a.mapping.plastic_work, 0);
  EXPECT_EQ(a.state.eps_p, z.eps_p);
  for (int k = 0; k < 6; ++k) EXPECT_EQ(a.state.C_p_inv.a[k], z.C_p_inv.a[k]);
}

TEST(HenckyJ2, LinearTableIsLinearHardening) {
  Random random(7);
  MaterialSpec table = copper();
  table.hardening = {{0, 0.4e9}, {0.01, 0.401e9}, {0.2, 0.42e9}, {500, 50.4e9}};
  const MaterialConstants m = constants_of(copper()), t = constants_of(table);
  PlasticState<double> z = virgin();
  for (int k = 0; k < 200; ++k) {
    const Tensor<double> F = random_F(random, 0.3);
    const Answer a = evaluate(F, z, m), b = evaluate(F, z, t);
    EXPECT_NEAR(a.mapping.d_gamma, b.mapping.d_gamma, 1e-13);
    EXPECT_NEAR(a.mapping.q / b.mapping.q, 1, 1e-12);
    z = a.state;
  }
}

/// A step far over several kinks ends on the curve, beyond the last point on its level.
TEST(HenckyJ2, ReturnsToTheTableAcrossItsKinks) {
  MaterialSpec table = copper();
  table.hardening = {{0, 0.1e9},
                     {0.001, 0.3e9},
                     {0.01, 0.3e9},
                     {0.1, 0.5e9},
                     {0.2, 0.8e9}};  // neither convex nor concave, with a flat piece
  const MaterialConstants m = constants_of(table);
  const auto curve = [&](double eps) {
    double y = table.hardening.back().second;
    for (std::size_t i = table.hardening.size() - 1; i-- > 0;) {
      const auto [e0, y0] = table.hardening[i];
      const auto [e1, y1] = table.hardening[i + 1];
      if (eps < e1) y = y0 + (y1 - y0) * (eps - e0) / (e1 - e0);
    }
    return y;
  };
  for (const double start : {0.0, 0.0005, 0.05, 0.3})
    for (double e = 0.002; e < 1; e *= 1.2) {
      PlasticState<double> z = virgin();
      z.eps_p = start;
      const Answer a = evaluate(stretch(std::exp(e), std::exp(-e / 2), std::exp(-e / 2)), z, m);
      if (3 * m.mu * e > curve(start)) {
        EXPECT_NEAR(a.mapping.q / curve(a.state.eps_p), 1, 1e-9) << start << " " << e;
      } else {
        EXPECT_EQ(a.state.eps_p, start);
      }
    }
}

TEST(HenckyJ2, ElasticStressIsTheDerivativeOfTheEnergy) {
  Random random(8);
  const MaterialConstants flows = constants_of(copper()), m = elastic();
  for (int k = 0; k < 100; ++k) {
    const PlasticState<double> z = deformed_state(random, flows);
    const Tensor<double> F = random_F(random, 0.3);
    const Answer a = evaluate(F, z, m), b = evaluate<pFJ>(F, z, m, 0.9);
    const double scale = std::sqrt(contract(a.stress.P, a.stress.P));
    for (int n = 0; n < 9; ++n) {
      const double h = 1e-5;
      Tensor<double> plus = F, minus = F;
      plus.a[n / 3][n % 3] += h;
      minus.a[n / 3][n % 3] -= h;
      EXPECT_NEAR((pF::energy(plus, 0, z, m) - pF::energy(minus, 0, z, m)) / (2 * h) / scale,
                  a.stress.P.a[n / 3][n % 3] / scale, 1e-8);
      EXPECT_NEAR((pFJ::energy(plus, 0.9, z, m) - pFJ::energy(minus, 0.9, z, m)) / (2 * h) / scale,
                  (b.stress.P.a[n / 3][n % 3] - b.stress.Sigma_J * b.stress.H.a[n / 3][n % 3]) / scale, 1e-8);
    }
    Tensor<double> H = cofactor(F);
    H[0][1] += 0.1;  // evolved, and away from cof F
    EXPECT_NEAR((pFHJ::stress(F, H, 0.9, a.mapping, m).P[0][1] - b.stress.P[0][1]) / (0.1 * b.stress.Sigma_J), 1, 1e-9);
    const double dU = (pFJ::energy(F, 0.9 + 1e-5, z, m) - pFJ::energy(F, 0.9 - 1e-5, z, m)) / 2e-5;
    EXPECT_NEAR(dU / b.stress.Sigma_J, 1, 1e-8);
    const double d2U = (evaluate<pFJ>(F, z, m, 0.9 + 1e-5).stress.Sigma_J
                        - evaluate<pFJ>(F, z, m, 0.9 - 1e-5).stress.Sigma_J)
                       / 2e-5;
    EXPECT_NEAR(d2U / b.stress.d2U, 1, 1e-8);
  }
}

TEST(HenckyJ2, SpeedBoundHoldsForRandomDirectionsAndIsExactAtRest) {
  Random random(9);
  const MaterialConstants flows = constants_of(copper()), m = elastic();
  EXPECT_NEAR(evaluate(identity<double>(), virgin(), m).stress.rho_c2 / (m.rho * m.cp * m.cp), 1, 1e-12);
  double sharpest = 0;
  for (int k = 0; k < 3000; ++k) {
    const PlasticState<double> z = k % 2 ? deformed_state(random, flows) : virgin();
    const Tensor<double> F = random_F(random, k % 3 ? 0.4 : 0.05);
    const double bound = evaluate(F, z, m).stress.rho_c2, h = 1e-4;
    double w[3], N[3], w2 = 0, N2 = 0;
    for (int i = 0; i < 3; ++i) {
      w[i] = uniform(random, -1, 1);
      N[i] = k % 5 ? uniform(random, -1, 1) : w[i];
    }
    for (int i = 0; i < 3; ++i) {
      w2 += w[i] * w[i];
      N2 += N[i] * N[i];
    }
    Tensor<double> plus = F, minus = F;
    for (int n = 0; n < 9; ++n) {
      const double d = h * w[n / 3] * N[n % 3] / std::sqrt(w2 * N2);
      plus.a[n / 3][n % 3] += d;
      minus.a[n / 3][n % 3] -= d;
    }
    const double curvature = (pF::energy(plus, 0, z, m) - 2 * pF::energy(F, 0, z, m) + pF::energy(minus, 0, z, m))
                             / (h * h);
    EXPECT_LT(curvature, bound * (1 + 1e-4));
    sharpest = std::max(sharpest, curvature / bound);
  }
  EXPECT_GT(sharpest, 0.7);
}

TEST(HenckyJ2, LanesEqualScalarsToTheBit) {
  Random random(10);
  MaterialSpec table = copper();
  table.hardening = {{0, 0.4e9}, {0.1, 0.5e9}, {0.3, 0.6e9}};
  for (const MaterialConstants& m : {constants_of(copper()), constants_of(table)})
    for (int k = 0; k < 50; ++k) {
      Tensor<double> F[8];
      PlasticState<double> z[8];
      Tensor<Vec8> F8;
      PlasticState<Vec8> z8;
      Vec8 J;
      for (int i = 0; i < 8; ++i) {
        F[i] = i == 0 ? identity<double>() : random_F(random, i < 3 ? 1e-4 : 0.3);
        z[i] = i < 4 ? virgin() : deformed_state(random, m);
        for (int n = 0; n < 9; ++n) F8.a[n / 3][n % 3][i] = F[i].a[n / 3][n % 3];
        for (int n = 0; n < 6; ++n) z8.C_p_inv.a[n][i] = z[i].C_p_inv.a[n];
        z8.eps_p[i] = z[i].eps_p;
        J[i] = 1 + 0.01 * i;
      }
      const auto r8 = pFJ::return_mapping(F8, z8, m);
      const auto s8 = pFJ::stress(F8, cofactor(F8), J, r8, m);
      const auto n8 = pFJ::flowed(F8, z8, r8);
      for (int i = 0; i < 8; ++i) {
        const Answer a = evaluate<pFJ>(F[i], z[i], m, J[i]);
        for (int n = 0; n < 9; ++n) EXPECT_EQ(s8.P.a[n / 3][n % 3][i], a.stress.P.a[n / 3][n % 3]);
        for (int n = 0; n < 6; ++n) EXPECT_EQ(n8.C_p_inv.a[n][i], a.state.C_p_inv.a[n]);
        EXPECT_EQ(n8.eps_p[i], a.state.eps_p);
        EXPECT_EQ(s8.rho_c2[i], a.stress.rho_c2);
        EXPECT_EQ(r8.plastic_work[i], a.mapping.plastic_work);
      }
    }
}

TEST(HenckyJ2, StressOfTheUndeformedVirginNodeIsZero) {
  const Answer a = evaluate(identity<double>(), virgin(), constants_of(copper()));
  for (int n = 0; n < 9; ++n) EXPECT_EQ(a.stress.P.a[n / 3][n % 3], 0);
  EXPECT_EQ(a.state.eps_p, 0);
}

}  // namespace
}  // namespace nanson
