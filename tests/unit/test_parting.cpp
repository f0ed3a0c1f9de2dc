// The energy of the parting: nothing where J is det F, what it pulls which way, and what it adds to a law with a plastic state.
#include <gtest/gtest.h>

#include "engine/aligned.hpp"
#include "engine/material.hpp"
#include "engine/registry.hpp"
#include "tests/unit/material_list.hpp"

using namespace nanson;
using namespace nanson::test;

namespace {

constexpr double M = 5;  // [Pa]

/// What it adds to a law without stress.
Stress<double> alone(const Tensor<double>& F, const Tensor<double>& H, double J) {
  Stress<double> s{};
  s.H = H;
  s.detF = determinant(F, cofactor(F));
  s.H2 = contract(H, H);
  add_parting(s, F, J, M);
  return s;
}

Tensor<double> difference(const Tensor<double>& A, const Tensor<double>& B) { return sum(A, B, -1); }

}  // namespace

TEST(Parting, AddsNothingWhereJIsDetF) {
  Random random(1);
  for (int k = 0; k < 200; ++k) {
    const Tensor<double> F = random_F(random, 0.5, 2), H = cofactor(F);
    const double J = determinant(F, H);
    const Stress<double> s = alone(F, H, J);
    EXPECT_LE(largest_entry(s.P), 1e-15 * M * largest_entry(H) / J);
    EXPECT_LE(std::abs(s.Sigma_J), 1e-15 * M / J);
    EXPECT_LE(parting_energy(F, J, M), 1e-30 * M);
    EXPECT_NEAR(s.d2U, M / (J * J), 1e-14 * M / (J * J));  // but a stiffness
    EXPECT_LE(std::abs(s.rho_c2), 1e-15 * M * s.H2 / (J * J));
  }
}

TEST(Parting, PullsJToDetFInFirstOrderAndTheForcesInSecond) {
  for (const double e : {1e-2, -1e-2, 1e-4, -1e-4}) {
    const Stress<double> s = alone(identity<double>(), identity<double>(), std::exp(-e));  // l = e
    EXPECT_NEAR(s.Sigma_J, -M * e, 2 * M * e * e);  // J grows where its Sigma_J is the lower one
    EXPECT_NEAR(s.P[0][0], -M * e * e, 2 * M * std::abs(e * e * e));
    EXPECT_NEAR(parting_energy(identity<double>(), std::exp(-e), M), 0.5 * M * e * e, 1e-14);
  }
}

/// Eight nodes through the registry, with and without: the difference is that of the energy alone.
TEST(Parting, AddsTheSameToAPlasticLaw) {
  for (const Formulation formulation : {Formulation::pFJ, Formulation::pFHJ}) {
    MaterialSpec spec;
    spec.law = Law::hencky_j2;
    spec.density = 1000;
    spec.youngs_modulus = 20;
    spec.poissons_ratio = 0.3;
    spec.yield_stress = 1;
    spec.hardening_modulus = 2;
    Aligned<double> U(8 * row::U), H(8 * row::H), X(8 * row::X, 1.0), W(8 * row::W), PH(8 * row::PH),
        plastic(8 * row::plastic), length(8, 1.0);
    Random random(2);
    MaterialState states[8];
    for (std::size_t n = 0; n < 8; ++n) {
      MaterialState& s = states[n];
      s.F = random_F(random, 0.8, 1.25);
      s.H = sum(cofactor(s.F), random_F(random, 0.8, 1.25), 0.05);
      s.J = uniform(random, 0.7, 1.4);
      if (formulation == Formulation::pFJ) s.H = cofactor(s.F);
      for (std::size_t m = 0; m < 9; ++m) {
        U[row::U * n + 4 * (m / 3 + 1) + m % 3] = s.F[m % 3][m / 3];
        H[row::H * n + 4 * (m / 3) + m % 3] = s.H[m % 3][m / 3];
      }
      U[row::U * n + 3] = s.J;
      for (std::size_t I = 0; I < 3; ++I) plastic[row::plastic * n + I] = 1;
    }
    Rows rows{};
    rows.X = X.data();
    rows.U_new = U.data();
    rows.H_new = H.data();
    rows.U_stage = U.data();
    rows.H_stage = H.data();
    rows.W_new = W.data();
    rows.PH_new = PH.data();
    rows.plastic_new = plastic.data();
    rows.plastic = plastic.data();
    Coefficients k;
    k.material = constants_of(spec);
    k.material.parting = M;
    k.rho_cp = k.rho_cJ = k.material.rho * k.material.cp;
    Part part{};
    part.node_end = 8;
    PhysicsSpec physics;
    physics.formulation = formulation;
    const PartFunctions functions = find_part_functions(physics, spec);
    Coefficients plain = k;
    plain.material.parting = 0;
    functions.stress(part, rows, plain, length.data());
    const Aligned<double> W_plain = W, PH_plain = PH;
    functions.stress(part, rows, k, length.data());
    double energy = functions.strain_energy(part, rows, plain);
    for (std::size_t n = 0; n < 8; ++n) {
      const Stress<double> added = alone(states[n].F, states[n].H, states[n].J);
      Tensor<double> P;
      for (std::size_t m = 0; m < 9; ++m)
        P[m % 3][m / 3] = PH[row::PH * n + 8 * (m / 3) + m % 3] - PH_plain[row::PH * n + 8 * (m / 3) + m % 3];
      EXPECT_LE(largest_entry(difference(P, added.P)), 1e-13 * k.material.kappa) << n;
      EXPECT_NEAR(W[row::W * n + 3] - W_plain[row::W * n + 3], added.Sigma_J, 1e-13 * k.material.kappa) << n;
      energy += parting_energy(states[n].F, states[n].J, M);
    }
    EXPECT_NEAR(functions.strain_energy(part, rows, k), energy, 1e-13 * energy);
  }
}
