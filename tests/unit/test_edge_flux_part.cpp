// The edge loop on one edge between two parts, which both of them compute: antisymmetry in every bit, central flux, dissipation.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/aligned.hpp"
#include "engine/physics_rules.hpp"
#include "engine/registry.hpp"
#include "tests/unit/random_tensor.hpp"

using namespace nanson;
using namespace nanson::test;

namespace {

struct Combination {
  PhysicsSpec physics;
  std::string name() const {
    std::string text;
    for (const auto w : {word(physics.stabilisation), word(physics.reconstruction), word(physics.flux_correction),
                         word(physics.formulation), word(physics.pressure_jump), word(physics.upwind_metric),
                         word(physics.entropy_fix)})
      text.append(w).append(" ");
    return text;
  }
  bool evolves_J() const { return physics.formulation != Formulation::pF; }
  bool upwind() const { return physics.stabilisation == Stabilisation::upwind; }
  int width() const { return physics.flux_correction == FluxCorrection::none ? 4 : 8; }
};

bool is_allowed(const PhysicsSpec& physics) {
  Scene scene;
  scene.physics = physics;
  return !broken_rule(scene);
}

/// Every edge loop that the rules allow.
const std::vector<Combination>& combinations() {
  static const std::vector<Combination> built = [] {
    std::vector<Combination> all;
    for (const UpwindMetric metric : {UpwindMetric::deformed, UpwindMetric::paper})
      for (const Reconstruction reconstruction :
           {Reconstruction::constant, Reconstruction::linear, Reconstruction::limited})
        for (const FluxCorrection correction : {FluxCorrection::none, FluxCorrection::pressure, FluxCorrection::full})
          for (const EntropyFix fix : {EntropyFix::none, EntropyFix::edge})
            for (const auto& [formulation, jump] :
                 {std::pair(Formulation::pF, PressureJump::scalar), std::pair(Formulation::pFJ, PressureJump::scalar),
                  std::pair(Formulation::pFJ, PressureJump::tensor)}) {
              PhysicsSpec physics;
              physics.reconstruction = reconstruction;
              physics.flux_correction = correction;
              physics.upwind_metric = metric;
              physics.entropy_fix = fix;
              physics.formulation = formulation;
              physics.pressure_jump = jump;
              if (is_allowed(physics)) all.push_back({physics});
            }
    for (const Formulation formulation : {Formulation::pF, Formulation::pFJ}) {
      PhysicsSpec physics;
      physics.stabilisation = Stabilisation::jst;
      physics.formulation = formulation;
      all.push_back({physics});
    }
    return all;
  }();
  return built;
}

/// Rows 0 to 7 are part 0, 8 to 15 part 1; the edge joins rows 0 and 8. Random rows.
struct TwoParts {
  static constexpr int rows = 16, a = 0, b = 8;
  Aligned<double> X, W, PH, G, GP, L;
  std::int32_t first[64] = {a, b}, second[64] = {b, a}, none[rows + 1] = {}, out[rows + 1] = {};
  double C[3][64] = {}, size = 0, q[64] = {};
  Part part[2] = {{0, 8, 0, 1, 0, 0, 0, 0}, {8, 16, 1, 2, 0, 0, 0, 0}};
  Coefficients k;
  double flux[2][8];

  explicit TwoParts(Random& random) {
    const auto fill = [&](Aligned<double>& x, int width) {
      x.resize(static_cast<std::size_t>(width * rows));
      for (double& value : x) value = uniform(random, -1, 1);
    };
    fill(X, row::X);
    fill(W, row::W);
    fill(PH, row::PH);
    fill(G, row::G);
    fill(GP, row::GP);
    fill(L, row::L);
    for (double& phi : L) phi = std::abs(phi);  // a limiter
    for (int n = 0; n < rows; ++n) {
      for (int m = 0; m < 6; ++m) PH[row::PH * n + 4 * m + 3] = 0;  // the lanes that are zero in a run
      for (int m = 0; m < 9; ++m) GP[row::GP * n + 4 * m + 3] = 0;
      X[row::X * n + 3] = 2;
      out[n] = n > 8 ? 2 : n > 0 ? 1 : 0;
    }
    out[rows] = 2;
    for (int i = 0; i < 3; ++i) {
      C[i][0] = uniform(random, -1, 1);
      C[i][1] = -C[i][0];
    }
    size = std::sqrt(C[0][0] * C[0][0] + C[1][0] * C[1][0] + C[2][0] * C[2][0]);
    k.rho_cp = k.rho_cJ = 3;
    k.rho_cs = 1.2;
    k.material.cp = 2;
  }
  Rows nodal() {
    Rows r{};
    r.X = X.data();
    r.W = W.data();
    r.PH = PH.data();
    r.G = G.data();
    r.GP = GP.data();
    r.L = L.data();
    r.lagged_q = q;
    return r;
  }
  EdgeArrays edges() const { return {first, second, {C[0], C[1], C[2]}}; }
  NodeLists lists() const { return {out, none, none, none, none}; }
  bool takes_lagged = false;
  PartFunctions functions(const Combination& c, bool audits = false) const {
    return find_part_functions(c.physics, MaterialSpec{}, audits, takes_lagged);
  }

  Coefficients coefficients(const Combination& c, bool audits = false) const {
    Coefficients with = k;
    with.edge = edge_choices(c.physics, audits);
    return with;
  }

  /// Flux as both parts see it; lanes 4 to 7 are q of a flux correction.
  void run(const Combination& c) {
    for (int p = 0; p < 2; ++p) {
      alignas(64) double edge[8 * 9] = {};
      functions(c).edge_flux(part[p], edges(), CornerArrays{}, lists(), nodal(), coefficients(c),
                             {edge, nullptr, nullptr, nullptr});
      for (int i = 0; i < 8; ++i) flux[p][i] = edge[i];
    }
  }
  /// Power of the stabilisation that part p counts; nothing without an audit.
  double power(const Combination& c, int p) {
    alignas(64) double edge[8 * 9] = {};
    const auto run = [&](bool audits) {
      return functions(c, audits).edge_flux(part[p], edges(), CornerArrays{}, lists(), nodal(), coefficients(c, audits),
                                            {edge, nullptr, nullptr, nullptr});
    };
    EXPECT_EQ(run(false), 0.0);
    return run(true);
  }
  /// P_ave C.
  std::array<double, 3> central() const {
    const auto P = [&](int n, int i, int I) { return PH[row::PH * n + 8 * I + i]; };
    std::array<double, 3> t{};
    for (int i = 0; i < 3; ++i)
      for (int I = 0; I < 3; ++I) t[i] += 0.5 * (P(a, i, I) + P(b, i, I)) * C[I][0];
    return t;
  }
  /// v, Sigma_J and P linear in X, with their gradients in G and GP. No limiter; the pseudo-Laplacian of a linear field is zero.
  void make_linear(Random& random, bool upwind) {
    for (double& l : L) l = upwind;
    double slope[3][4], P0[9], slope_P[3][9];
    const auto fill = [&](auto& values) {
      for (double& x : values) x = uniform(random, -1, 1);
    };
    for (int I = 0; I < 3; ++I) {
      fill(slope[I]);
      fill(slope_P[I]);
    }
    fill(P0);
    for (const int n : {a, b}) {
      const double* x = &X[row::X * n];
      for (int i = 0; i < 4; ++i) {
        W[row::W * n + i] = 0.3 * i + slope[0][i] * x[0] + slope[1][i] * x[1] + slope[2][i] * x[2];
        for (int I = 0; I < 3; ++I) G[row::G * n + 4 * I + i] = slope[I][i];
      }
      for (int m = 0; m < 9; ++m) {
        const double P = P0[m] + slope_P[0][m] * x[0] + slope_P[1][m] * x[1] + slope_P[2][m] * x[2];
        PH[row::PH * n + 8 * (m / 3) + m % 3] = P;
        for (int K = 0; K < 3; ++K) GP[row::GP * n + 4 * (3 * K + m / 3) + m % 3] = slope_P[K][m];
      }
    }
  }
};

}  // namespace

TEST(EdgeFluxPart, SeenFromTheOtherPartIsBitwiseTheOpposite) {
  ASSERT_EQ(
      combinations().size(),
      2 * 7 * 3 * 2 + 2u);  // metrics, pairs of reconstruction and correction, of formulation and jump, fixes; jst
  for (const Combination& c : combinations()) {
    Random random(1);
    int with_D_J = 0;
    for (int k = 0; k < 100; ++k) {
      TwoParts two(random);
      two.run(c);
      for (int i = 0; i < 4; ++i) EXPECT_EQ(two.flux[0][i], -two.flux[1][i]) << c.name() << "lane " << i;
      EXPECT_NE(two.flux[0][0], 0.0) << c.name();
      with_D_J += two.flux[0][3] != 0;
    }
    const int least = c.physics.entropy_fix == EntropyFix::edge ? 40 : 100;  // the fix drops half of random jumps
    EXPECT_GE(with_D_J, c.evolves_J() ? least : 0) << c.name();
    EXPECT_LE(with_D_J, c.evolves_J() ? 100 : 0) << c.name();
  }
}

TEST(EdgeFluxPart, CorrectionOfTheVelocityGradientIsBitwiseTheSameFromBothParts) {
  for (const Combination& c : combinations()) {
    if (c.width() == 4) continue;
    Random random(2);
    for (int k = 0; k < 100; ++k) {
      TwoParts two(random);
      two.run(c);
      for (int i = 0; i < 4; ++i) {
        double q = 0;  // (theta/4)(G_a - G_b) . D
        for (int I = 0; I < 3; ++I)
          q += 0.25 * two.k.theta * (two.G[4 * I + i] - two.G[row::G * two.b + 4 * I + i])
               * (two.X[row::X * two.b + I] - two.X[I]);
        EXPECT_EQ(two.flux[0][4 + i], two.flux[1][4 + i]) << c.name();
        EXPECT_NEAR(two.flux[0][4 + i], q, 1e-15) << c.name();
      }
    }
  }
}

TEST(EdgeFluxPart, LinearFieldsGiveTheCentralFluxAlone) {
  for (const Combination& c : combinations()) {
    if (c.physics.reconstruction == Reconstruction::constant) continue;
    Random random(3);
    for (int k = 0; k < 100; ++k) {
      TwoParts two(random);
      two.make_linear(random, c.upwind());
      two.run(c);
      const auto t = two.central();
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(two.flux[0][i], t[i], 1e-13) << c.name();
      EXPECT_NEAR(two.flux[0][3], 0, 1e-13) << c.name();
    }
  }
}

TEST(EdgeFluxPart, ConstantReconstructionDampsLinearFields) {
  for (const Combination& c : combinations()) {
    if (c.physics.reconstruction != Reconstruction::constant) continue;
    Random random(4);
    TwoParts two(random);
    two.make_linear(random, c.upwind());
    two.run(c);
    const auto t = two.central();
    EXPECT_GT(std::abs(two.flux[0][0] - t[0]) + std::abs(two.flux[0][1] - t[1]) + std::abs(two.flux[0][2] - t[2]), 1e-2)
        << c.name();
  }
}

TEST(EdgeFluxPart, PressureCorrectionActsAlongTheDeformedArea) {
  Random random(5);
  for (const Combination& c : combinations()) {
    if (c.physics.flux_correction != FluxCorrection::pressure) continue;
    Combination plain = c;
    plain.physics.flux_correction = FluxCorrection::none;
    TwoParts two(random);
    two.run(plain);
    double before[4], area[3] = {};
    std::copy(two.flux[0], two.flux[0] + 4, before);
    two.run(c);
    for (int i = 0; i < 3; ++i)
      for (int I = 0; I < 3; ++I)
        area[i] += 0.5 * (two.PH[8 * I + 4 + i] + two.PH[row::PH * two.b + 8 * I + 4 + i]) * two.C[I][0];
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(two.flux[0][i] - before[i], two.flux[0][7] * area[i], 1e-13) << c.name();
    EXPECT_EQ(two.flux[0][3], before[3]) << c.name();
  }
}

// Of a lagged correction, PH and the velocity gradient have theirs already: the edges add what they have of the pressure, and nothing else.
TEST(EdgeFluxPart, ALaggedCorrectionIsTakenAsItIs) {
  Random random(9);
  for (const Combination& c : combinations()) {
    if (c.physics.flux_correction == FluxCorrection::none) continue;
    const bool pressure = c.physics.flux_correction == FluxCorrection::pressure;
    Combination plain = c;
    plain.physics.flux_correction = FluxCorrection::none;
    TwoParts two(random);
    two.run(pressure ? c : plain);
    double expected[4];
    std::copy(two.flux[0], two.flux[0] + 4, expected);
    if (pressure) {
      EXPECT_EQ(two.q[0], two.flux[0][7]) << c.name();
      EXPECT_EQ(two.q[1], two.q[0]) << c.name();
    }
    two.takes_lagged = true;
    two.run(c);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(two.flux[0][i], expected[i]) << c.name();
    two.q[0] = two.q[1] = 0;
    two.run(c);
    std::copy(two.flux[0], two.flux[0] + 4, expected);
    two.run(plain);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(two.flux[0][i], expected[i]) << c.name();
  }
}

TEST(EdgeFluxPart, DissipationIsThePowerOfTheStabilisationCountedOnce) {
  for (const Combination& c : combinations()) {
    if (!c.upwind()) continue;
    Combination plain = c;
    plain.physics.flux_correction = FluxCorrection::none;
    Random random(6);
    for (int k = 0; k < 100; ++k) {
      TwoParts two(random);
      two.run(plain);
      const auto t = two.central();
      double expected = (two.W[row::W * two.b + 3] - two.W[3]) * two.flux[0][3];
      for (int i = 0; i < 3; ++i) expected += (two.W[row::W * two.b + i] - two.W[i]) * (two.flux[0][i] - t[i]);
      double power = 0;
      for (int p = 0; p < 2; ++p) power += two.power(c, p);
      EXPECT_NEAR(power, expected, 1e-12) << c.name();
      const bool edge_by_edge = c.physics.reconstruction == Reconstruction::constant
                                || c.physics.entropy_fix == EntropyFix::edge;
      if (edge_by_edge && c.physics.pressure_jump == PressureJump::scalar) {
        EXPECT_GE(power, 0.0) << c.name();
      }
    }
  }
}

// Why there is a fix: with linear reconstruction the power of an edge may be negative (method, section 3).
TEST(EdgeFluxPart, WithoutTheEntropyFixALinearReconstructionCanFeedAnEdge) {
  Random random(7);
  int fed = 0;
  for (int k = 0; k < 500; ++k) {
    TwoParts two(random);
    fed += two.power({PhysicsSpec{}}, 0) < 0;
  }
  EXPECT_GT(fed, 5);
}

TEST(EdgeFluxPart, JamesonSchmidtTurkelDampsTheDifferenceOfThePseudoLaplacians) {
  PhysicsSpec physics;
  physics.stabilisation = Stabilisation::jst;
  Random random(8);
  TwoParts two(random);
  two.run({physics});
  const auto t = two.central();
  const double* Lb = &two.L[row::L * two.b];
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(two.flux[0][i], t[i] - two.k.rho_cp / 256 * two.size * (Lb[i] - two.L[i]), 1e-15);
  EXPECT_NEAR(two.flux[0][3], -two.k.material.cp / 8192 * two.size * (Lb[3] - two.L[3]), 1e-17);
}
