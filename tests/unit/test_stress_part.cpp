// The material's sweep: what it writes where, the step bound, and which nodes it calls broken. Through the registry, as a run calls it.
#include <gtest/gtest.h>

#include <functional>
#include <utility>
#include <vector>

#include "engine/material.hpp"
#include "engine/physics_rules.hpp"
#include "engine/registry.hpp"
#include "engine/solver.hpp"
#include "tests/unit/material_list.hpp"

using namespace nanson;
using namespace nanson::test;

namespace {

constexpr double NaN = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
constexpr int nodes = 24;

MaterialSpec material_spec(Law law, Volumetric volumetric, Isochoric isochoric) {
  MaterialSpec m;
  m.law = law;
  m.volumetric = volumetric;
  m.isochoric = isochoric;
  m.density = 1100;
  m.youngs_modulus = 17;
  m.poissons_ratio = 0.45;
  m.xi = law == Law::mooney_rivlin ? 0.3 : 0.0;
  return m;
}

/// Rows of 24 nodes, undeformed and at rest, and the part function of a material.
template <class Material_>
struct StressPart : ::testing::Test {
  Aligned<double> U = Aligned<double>(row::U * nodes), H = Aligned<double>(row::H * nodes),
                  X = Aligned<double>(row::X * nodes, 1.0);
  Aligned<double> W = Aligned<double>(row::W * nodes, NaN), PH = Aligned<double>(row::PH * nodes, NaN),
                  length = Aligned<double>(nodes, 0.5);
  MaterialSpec spec = material_spec(Material_::law, Material_::volumetric, Material_::isochoric);
  Coefficients k;
  PartFunctions functions;

  StressPart() {
    PhysicsSpec physics;
    physics.formulation = Material_::formulation;
    physics.parting = Material_::parting == Parting::energy ? 0.7 : 0;
    functions = find_part_functions(physics, spec);
    k.material = constants_of(spec, physics);
    k.rho_cp = k.material.rho * k.material.cp;
    k.rho_cJ = k.material.rho * k.material.cJ;
    k.rho_cs = k.material.rho * k.material.cs;
    for (int n = 0; n < nodes; ++n) set(n, undeformed());
  }
  void set(int n, const MaterialState& s, Vec3 v = {}) {
    for (int m = 0; m < 9; ++m) {
      U[row::U * n + 4 * (m / 3 + 1) + m % 3] = s.F[m % 3][m / 3];
      H[row::H * n + 4 * (m / 3) + m % 3] = s.H[m % 3][m / 3];
    }
    for (int i = 0; i < 3; ++i) U[row::U * n + i] = v[i];
    U[row::U * n + 3] = s.J;
  }
  Rows rows() {
    Rows r{};
    r.X = X.data();
    r.U_new = U.data();
    r.H_new = H.data();
    r.U_stage = U.data();
    r.H_stage = H.data();
    r.W_new = W.data();
    r.PH_new = PH.data();
    return r;
  }
  PartReport run() {
    Part part{};
    part.node_end = nodes;
    return functions.stress(part, rows(), k, length.data());
  }
};
TYPED_TEST_SUITE(StressPart, AllMaterials, MaterialName);

/// A random state whose H and J follow from F where they are not evolved: rows hold something everywhere.
template <class Material_>
MaterialState row_state(Random& random) {
  MaterialState s = random_state<Material_>(random);
  if (!Material_::evolves_H) s.H = cofactor(s.F);
  if (!Material_::evolves_J) s.J = 1;
  return s;
}

}  // namespace

TYPED_TEST(StressPart, WritesVelocitySigmaJAndTheColumnsOfPAndH) {
  Random random(1);
  MaterialState s[nodes];
  for (int n = 0; n < nodes; ++n) {
    s[n] = row_state<TypeParam>(random);
    this->set(n, s[n], {1.0 + n, 2.0 + n, 3.0 + n});
  }
  EXPECT_FALSE(this->run().broken);
  for (int n = 0; n < nodes; ++n) {
    const Stress<double> stress = TypeParam::stress(s[n], this->k.material);
    const double *W = &this->W[row::W * n], *PH = &this->PH[row::PH * n];
    for (int i = 0; i < 3; ++i) EXPECT_EQ(W[i], i + 1.0 + n);
    EXPECT_EQ(W[3], stress.Sigma_J);
    for (int I = 0; I < 3; ++I) {
      for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(PH[8 * I + i], stress.P[i][I]);
        EXPECT_EQ(PH[8 * I + 4 + i], stress.H[i][I]);
      }
      EXPECT_EQ(PH[8 * I + 3], 0.0);
      EXPECT_EQ(PH[8 * I + 7], 0.0);
    }
  }
}

TYPED_TEST(StressPart, WritesTheSameRowsPastTheCaches) {
  Random random(4);
  for (int n = 0; n < nodes; ++n) this->set(n, row_state<TypeParam>(random), {1.0 + n, 2.0 + n, 3.0 + n});
  this->run();
  const Aligned<double> W = this->W, PH = this->PH;
  std::fill(this->W.begin(), this->W.end(), NaN);
  std::fill(this->PH.begin(), this->PH.end(), NaN);
  this->k.streams = true;
  this->run();
  EXPECT_EQ(this->W, W);
  EXPECT_EQ(this->PH, PH);
}

TYPED_TEST(StressPart, FastestIsTheLargestSpeedOverLength) {
  Random random(2);
  double expected = 0;
  for (int n = 0; n < nodes; ++n) {
    const MaterialState s = row_state<TypeParam>(random);
    this->set(n, s);
    this->length[n] = uniform(random, 0.1, 2);
    const Stress<double> stress = TypeParam::stress(s, this->k.material);
    double c = std::sqrt(stress.rho_c2 / this->k.material.rho);
    if (TypeParam::evolves_J && TypeParam::finite_strain)
      c = std::max(c, stress.d2U * std::sqrt(stress.H2) / this->k.rho_cJ);
    expected = std::max(expected, c / this->length[n]);
  }
  EXPECT_NEAR(this->run().fastest, expected, 1e-14 * expected);
}

TYPED_TEST(StressPart, StepBoundOfPaperUpwindingGrowsWithTheSquareOfTheArea) {
  const double a = 2;
  const MaterialState s{sum(Tensor<double>{}, identity<double>(), a), sum(Tensor<double>{}, identity<double>(), a * a),
                        a * a * a};
  this->set(5, s);
  const Stress<double> stress = TypeParam::stress(s, this->k.material);
  const double acoustic = std::sqrt(stress.rho_c2 / this->k.material.rho),
               of_J = stress.d2U * a * a * a * a / this->k.rho_cJ;
  this->k.edge.deformed_metric = false;
  const bool stabilised = TypeParam::evolves_J && TypeParam::finite_strain;
  EXPECT_GT(stabilised ? of_J : 1.06 * acoustic, 1.05 * acoustic);
  EXPECT_NEAR(this->run().fastest, (stabilised ? of_J : acoustic) / 0.5, 1e-12 * of_J);
}

TYPED_TEST(StressPart, SoundNodesAreNotFlagged) {
  Random random(3);
  for (int repeat = 0; repeat < 20; ++repeat) {
    for (int n = 0; n < nodes; ++n) this->set(n, row_state<TypeParam>(random), {uniform(random, -1e3, 1e3), 0, -1e100});
    EXPECT_FALSE(this->run().broken);
  }
}

TYPED_TEST(StressPart, AnUnsoundNodeIsFlaggedInEveryLane) {
  std::vector<std::pair<const char*, std::function<void(double*)>>> damages = {
      {"det F = 0", [](double* U) { U[4] = 0; }},    {"det F < 0", [](double* U) { U[4] = -1; }},
      {"v inf", [](double* U) { U[0] = infinity; }}, {"v -inf", [](double* U) { U[1] = -infinity; }},
      {"v NaN", [](double* U) { U[2] = NaN; }},      {"v too large to square", [](double* U) { U[2] = 1e200; }},
  };
  for (int m = 0; m < 9; ++m) damages.push_back({"F NaN", [m](double* U) { U[4 * (m / 3 + 1) + m % 3] = NaN; }});
  if (TypeParam::evolves_J) {
    damages.push_back({"J = 0", [](double* U) { U[3] = 0; }});
    damages.push_back({"J < 0", [](double* U) { U[3] = -1e-9; }});
    damages.push_back({"J NaN", [](double* U) { U[3] = NaN; }});
  }
  for (const auto& [what, damage] : damages)
    for (int n = 0; n < nodes; ++n) {
      this->set(n, undeformed());
      damage(&this->U[row::U * n]);
      EXPECT_TRUE(this->run().broken) << what << " at node " << n;
      this->set(n, undeformed());
      EXPECT_FALSE(this->run().broken);
    }
}

TYPED_TEST(StressPart, JIsNotReadWhereItIsNotEvolved) {
  if (TypeParam::evolves_J) this->U[row::U * 3 + 3] = 1.01;
  else this->U[row::U * 3 + 3] = NaN;
  const PartReport report = this->run();
  EXPECT_FALSE(report.broken);
  EXPECT_EQ(this->W[row::W * 3 + 3] != 0, TypeParam::evolves_J);
}

TYPED_TEST(StressPart, StrainEnergyIsTheSumOfEnergyTimesVolume) {
  Random random(4);
  double expected = 0;
  for (int n = 0; n < nodes; ++n) {
    const MaterialState s = row_state<TypeParam>(random);
    const double volume = uniform(random, 0.5, 2);
    this->set(n, s);
    this->X[row::X * n + 3] = 1 / volume;
    expected += volume * TypeParam::energy(s, this->k.material);
  }
  Part part{};
  part.node_end = nodes;
  EXPECT_NEAR(this->functions.strain_energy(part, this->rows(), this->k), expected, 1e-13 * expected);
}

/// Every law in every formulation that the rules and the scene's reader leave, and the projected ones.
TEST(Registry, BuildsTheMaterialsThatAreTestedAndNoOthers) {
  int built = 0, projected = 0;
  for (const Law law : {Law::linear_elastic, Law::neo_hookean, Law::mooney_rivlin, Law::hencky_j2})
    for (const Volumetric volumetric : {Volumetric::quadratic, Volumetric::barrier})
      for (const Isochoric isochoric : {Isochoric::F, Isochoric::J})
        for (const Formulation formulation : {Formulation::pF, Formulation::pFJ, Formulation::pFHJ, Formulation::pFp}) {
          Scene scene;
          scene.physics.formulation = formulation;
          scene.material = material_spec(law, volumetric, isochoric);
          const bool chosen = volumetric != Volumetric::quadratic || isochoric != Isochoric::F;
          const bool refused = broken_rule(scene) || (law_traits(law).carries_energy && chosen);
          const auto find = [&] { return find_part_functions(scene.physics, scene.material); };
          if (refused) {
            EXPECT_THROW(find(), std::logic_error);
          } else {
            EXPECT_TRUE(find().stress && find().strain_energy && find().accumulate_update);
            ++(formulation == Formulation::pFp ? projected : built);
          }
        }
  constexpr int parted = 4;   // of the list, not counted here: an energy of the parting is no type
  constexpr int plastic = 3;  // test_hencky_j2.cpp, test_plastic_part.cpp
  EXPECT_EQ(built, plastic - parted + std::tuple_size_v<decltype([]<class... T>(::testing::Types<T...>) {
                     return std::tuple<T...>{};
                   }(AllMaterials{}))>);
  EXPECT_EQ(projected, 2);
}

TEST(Padding, IsNeverFlaggedAndNeverSetsTheStep) {
  MeshSpec box;
  box.size = {1, 1, 1};
  box.cells = {2, 2, 2};
  std::vector<std::string> errors;
  const Mesh mesh = finish_mesh(make_box(box), errors);
  ASSERT_TRUE(errors.empty());
  Scene scene;
  scene.material = material_spec(Law::neo_hookean, Volumetric::quadratic, Isochoric::F);
  scene.body_force = {0, 0, -9.81};
  Simulation s = make_simulation(scene, mesh, 1);
  const double fastest = s.state.reports[0].fastest;
  ASSERT_EQ(s.domain.order.rows, 32);
  for (int step = 0; step < 100; ++step) {
    s.state.dt = allowed_step(s);
    advance(s);
    ASSERT_FALSE(s.state.reports[0].broken);
  }
  EXPECT_NEAR(s.state.reports[0].fastest, fastest,
              1e-6 * fastest);  // free fall; round-off in F enters the bound by its square root
  for (int n = 27; n < 32; ++n)
    for (int m = 0; m < 9; ++m)
      EXPECT_EQ(s.state.U[0][row::U * n + 4 * (m / 3 + 1) + m % 3], m % 4 == 0) << "F of row " << n;
}
