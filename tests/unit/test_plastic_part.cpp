// The stress part function with a plastic state: who keeps what flowed, what work is booked, what is flagged.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/aligned.hpp"
#include "engine/material.hpp"
#include "kernels/part.hpp"

namespace nanson {
namespace {

/// Eight nodes of 1/8 m^3; node 3 is stretched by `e` (logarithmic, isochoric).
struct EightNodes {
  Aligned<double> X, U, W, PH, plastic, step_length;
  Coefficients k;
  Rows rows{};
  Part part{};

  explicit EightNodes(double e)
      : X(8 * row::X, 8.0),
        U(8 * row::U, 0.0),
        W(8 * row::W, 0.0),
        PH(8 * row::PH, 0.0),
        plastic(8 * row::plastic, 0.0),
        step_length(8, 0.1) {
    for (std::size_t n = 0; n < 8; ++n) {
      U[row::U * n + 3] = 1;
      for (std::size_t I = 0; I < 3; ++I) U[row::U * n + 4 * (I + 1) + I] = plastic[row::plastic * n + I] = 1;
    }
    for (std::size_t I = 0; I < 3; ++I) U[row::U * 3 + 4 * (I + 1) + I] = std::exp(I == 0 ? e : -e / 2);
    MaterialSpec m;
    m.law = Law::hencky_j2;
    m.density = 1000;
    m.youngs_modulus = 1e6;
    m.poissons_ratio = 0.3;
    m.yield_stress = 1e4;
    m.hardening_modulus = 2e4;
    k.material = constants_of(m);
    k.rho_cp = k.rho_cJ = m.density * k.material.cp;
    k.rho_cs = m.density * k.material.cs;
    rows.X = X.data();
    rows.U_new = U.data();
    rows.U_stage = U.data();
    rows.W_new = W.data();
    rows.PH_new = PH.data();
    rows.plastic_new = plastic.data();
    rows.plastic = plastic.data();
    part.node_end = 8;
  }
  PartReport stress(bool commits) {
    k.commits = commits;
    return stress_part<Law::hencky_j2, Volumetric::quadratic, Isochoric::F, Formulation::pFJ>(part, rows, k,
                                                                                              step_length.data());
  }
  double energy() {
    return strain_energy_part<Law::hencky_j2, Volumetric::quadratic, Isochoric::F, Formulation::pFJ>(part, rows, k);
  }
};

TEST(PlasticPart, OnlyAStageThatCommitsKeepsWhatFlowed) {
  EightNodes a(0.1);
  const Aligned<double> virgin = a.plastic;
  EXPECT_EQ(a.stress(false).plastic_work, 0);
  EXPECT_EQ(a.plastic, virgin);
  const Aligned<double> P = a.PH;
  const PartReport r = a.stress(true);
  EXPECT_EQ(a.PH, P);  // the stress is that of the same return
  for (std::size_t n = 0; n < 8; ++n)
    for (std::size_t i = 0; i < row::plastic; ++i)
      EXPECT_TRUE(n == 3 || a.plastic[row::plastic * n + i] == virgin[row::plastic * n + i]);
  const double mu = a.k.material.mu, eps_p = (3 * mu * 0.1 - 1e4) / (3 * mu + 2e4);
  EXPECT_NEAR(a.plastic[row::plastic * 3 + 3], eps_p, 1e-14);
  EXPECT_NEAR(a.plastic[row::plastic * 3 + 0], std::exp(-2 * eps_p), 1e-13);  // C_p^-1 of the plastic stretch
  EXPECT_NEAR(r.plastic_work, (1e4 * eps_p + 0.5 * 2e4 * eps_p * eps_p) / 8, 1e-9);
  EXPECT_NEAR(a.energy(), mu * 1.5 * (0.1 - eps_p) * (0.1 - eps_p) / 8, 1e-9);
  EXPECT_NEAR(a.stress(true).plastic_work, 0, 1e-9);  // nothing flows twice
}

TEST(PlasticPart, BelowTheYieldStressNothingIsTouched) {
  EightNodes a(1e-3);
  const Aligned<double> virgin = a.plastic;
  EXPECT_EQ(a.stress(true).plastic_work, 0);
  EXPECT_EQ(a.plastic, virgin);
}

TEST(PlasticPart, NanAndNonPositiveDeterminantsAreFlagged) {
  EXPECT_FALSE(EightNodes(0.1).stress(true).broken);
  for (const double bad : {std::nan(""), -1.0, 0.0})
    for (const std::size_t at : {3u, 4u, 9u, 14u}) {  // J and the diagonal of F
      EightNodes a(0.1);
      a.U[row::U * 5 + at] = bad;
      EXPECT_TRUE(a.stress(false).broken) << at << " " << bad;
      EXPECT_TRUE(a.stress(true).broken) << at << " " << bad;
    }
  EightNodes a(0.1);
  a.plastic[row::plastic * 6] = std::nan("");
  EXPECT_TRUE(a.stress(true).broken);
}

}  // namespace
}  // namespace nanson
