// Boundary corners of the edge loop: load plus adjoint boundary flux (2 P_a - P_b - P_c)/8 C_gamma (method, section 3).
#include <gtest/gtest.h>

#include "engine/aligned.hpp"
#include "engine/registry.hpp"
#include "tests/unit/random_tensor.hpp"

using namespace nanson;
using namespace nanson::test;

namespace {

/// One part of eight nodes without edges; node 0 owns two corners, (0; 1, 2) loaded and (0; 2, 3) free.
struct Corners {
  static constexpr int rows = 8;
  Aligned<double> X = Aligned<double>(row::X * rows), W = Aligned<double>(row::W * rows),
                  PH = Aligned<double>(row::PH * rows);
  Aligned<double> G = Aligned<double>(row::G * rows), loads = Aligned<double>(4);
  std::int32_t none[64] = {}, begin[rows + 1] = {0, 2, 2, 2, 2, 2, 2, 2, 2}, b[2] = {1, 2}, c[2] = {2, 3},
               load[2] = {0, -1};
  double C[3][2], zero[64] = {};
  Coefficients k;
  alignas(64) double force[8];

  explicit Corners(Random& random) {
    for (int n = 0; n < rows; ++n)
      for (int m = 0; m < 9; ++m) PH[row::PH * n + 8 * (m / 3) + m % 3] = uniform(random, -1, 1);
    for (auto& Ci : C)
      for (double& x : Ci) x = uniform(random, -1, 1);
    for (int i = 0; i < 3; ++i) loads[i] = uniform(random, -1, 1);
    k.rho_cp = k.rho_cJ = 3;
    k.rho_cs = 1;
  }
  /// Force on node 0 through corner g.
  const double* run(FluxCorrection correction, int g) {
    PhysicsSpec physics;
    physics.flux_correction = correction;
    Rows r{};
    r.X = X.data();
    r.W = W.data();
    r.PH = PH.data();
    r.G = G.data();
    r.loads = loads.data();
    for (double& f : force) f = -7;
    find_part_functions(physics, MaterialSpec{})
        .edge_flux({0, rows, 0, 0, 0, 2, 0, 0}, {none, none, {zero, zero, zero}}, {b, c, {C[0], C[1], C[2]}, load},
                   {none, none, none, none, begin}, r, k, {nullptr, force, nullptr, nullptr});
    return force + 4 * g;
  }
  double adjoint(int g, int i) const {
    double f = 0;
    for (int I = 0; I < 3; ++I) {
      const auto at = [&](int n) { return PH[row::PH * n + 8 * I + i]; };
      f += (2 * at(0) - at(b[g]) - at(c[g])) / 8 * C[I][g];
    }
    return f;
  }
};

}  // namespace

TEST(CornerForces, AreTheLoadAndTheAdjointFlux) {
  Random random(1);
  for (const FluxCorrection correction : {FluxCorrection::none, FluxCorrection::pressure, FluxCorrection::full}) {
    Corners corners(random);
    for (int g = 0; g < 2; ++g) {
      const double* f = corners.run(correction, g);
      for (int i = 0; i < 3; ++i) {
        const double flux = corners.adjoint(g, i);
        EXPECT_NEAR(f[i], flux + (g == 0 ? corners.loads[i] : 0.0), 1e-15);
      }
      EXPECT_EQ(f[3], 0.0);
    }
  }
}

TEST(CornerForces, OfThePapersBoundaryAreTheLoadAlone) {
  Random random(3);
  Corners corners(random);
  corners.k.adjoint = false;
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(corners.run(FluxCorrection::none, 0)[i], i < 3 ? corners.loads[i] : 0.0);
    EXPECT_EQ(corners.run(FluxCorrection::none, 1)[i], 0.0);
  }
}
