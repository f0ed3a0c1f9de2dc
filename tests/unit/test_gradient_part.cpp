// Green-Gauss gradients with the (6,1,1)/8 boundary rule, through the parts of an order: exact for linear fields, mean of the finite-element gradients.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "engine/node_geometry.hpp"
#include "engine/order.hpp"
#include "engine/registry.hpp"
#include "tests/unit/meshes.hpp"
#include "tests/unit/random_tensor.hpp"

using namespace nanson;
using namespace nanson::test;

namespace {

struct Gradients : ::testing::TestWithParam<Split> {
  Mesh mesh = box({13, 12, 10}, GetParam(), 0.2);  // two parts
  Dual dual = make_dual(mesh);
  Order order = make_order(dual, static_cast<int>(mesh.X.size()));
  Aligned<double> X = zeros(row::X), W = zeros(row::W), PH = zeros(row::PH), G = zeros(row::G), dP = zeros(row::dP),
                  GP = zeros(row::GP), PH_new = zeros(row::PH);
  Aligned<double> L = zeros(row::L), lambda;
  Random random{1};

  Gradients() {
    for (int r = 0; r < order.rows; ++r) {
      const int n = order.node_of[r];
      for (int k = 0; k < 3 && n >= 0; ++k) X[row::X * r + k] = mesh.X[n][k];
      X[row::X * r + 3] = n < 0 ? 1 : 1 / dual.volume[n];
    }
  }
  Aligned<double> zeros(int width) const { return Aligned<double>(static_cast<std::size_t>(width * order.rows), 0.0); }

  void run(PressureJump jump, FluxCorrection correction) {
    PhysicsSpec physics;
    physics.pressure_jump = jump;
    physics.flux_correction = correction;
    run(physics);
  }
  void run(const PhysicsSpec& physics) {
    const PartFunctions f = find_part_functions(physics, MaterialSpec{});
    Rows r{};
    r.X = X.data();
    r.W = W.data();
    r.PH = PH.data();
    r.G = G.data();
    r.dP = dP.data();
    r.GP = GP.data();
    r.L = L.data();
    r.lambda = lambda.data();
    r.PH_new = PH_new.data();
    for (const Part& part : order.parts)
      f.gradient(part, order.edges(), order.corners(), order.lists(), r, Coefficients{});
  }
};
INSTANTIATE_TEST_SUITE_P(Splits, Gradients, ::testing::Values(Split::alternating, Split::kuhn),
                         [](const auto& info) { return std::string(word(info.param)); });

}  // namespace

TEST_P(Gradients, OfLinearFieldsAreExactAtEveryNode) {
  ASSERT_EQ(order.parts.size(), 2u);
  double slope[3][4], value[4];
  for (auto& s : slope)
    for (double& x : s) x = uniform(random, -1, 1);
  for (double& x : value) x = uniform(random, -1, 1);
  for (int n = 0; n < order.nodes; ++n)
    for (int i = 0; i < 4; ++i) {
      W[row::W * order.row_of[n] + i] = value[i];
      for (int I = 0; I < 3; ++I) W[row::W * order.row_of[n] + i] += slope[I][i] * mesh.X[n][I];
    }
  run(PressureJump::scalar, FluxCorrection::none);
  for (int n = 0; n < order.nodes; ++n)
    for (int I = 0; I < 3; ++I)
      for (int i = 0; i < 4; ++i)
        EXPECT_NEAR(G[row::G * order.row_of[n] + 4 * I + i], slope[I][i], 1e-13) << "node " << n;
}

TEST_P(Gradients, OfAConstantFieldAreZeroBitwise) {
  for (int n = 0; n < order.nodes; ++n)
    for (int i = 0; i < 4; ++i) W[row::W * order.row_of[n] + i] = 0.1 * (i + 1);
  for (double& g : G) g = 7;
  run(PressureJump::scalar, FluxCorrection::none);
  for (const double g : G) EXPECT_EQ(g, 0.0);
}

TEST_P(Gradients, AreTheVolumeWeightedMeanOfTheFiniteElementGradients) {
  for (int n = 0; n < order.nodes; ++n)
    for (int i = 0; i < 4; ++i) W[row::W * order.row_of[n] + i] = uniform(random, -1, 1);
  run(PressureJump::scalar, FluxCorrection::none);
  std::vector<Eigen::Matrix<double, 4, 3>> mean(mesh.X.size(), Eigen::Matrix<double, 4, 3>::Zero());
  for (const auto& t : mesh.tets) {
    Eigen::Matrix3d D;              // columns: edges from node 0
    Eigen::Matrix<double, 4, 3> d;  // columns: differences along them
    for (int v = 1; v < 4; ++v)
      for (int i = 0; i < 4; ++i) {
        if (i < 3) D(i, v - 1) = mesh.X[t[v]][i] - mesh.X[t[0]][i];
        d(i, v - 1) = W[row::W * order.row_of[t[v]] + i] - W[row::W * order.row_of[t[0]] + i];
      }
    const Eigen::Matrix<double, 4, 3> gradient = d * D.inverse();
    for (const int n : t) mean[n] += volume(mesh, t) / 4 / dual.volume[n] * gradient;
  }
  for (int n = 0; n < order.nodes; ++n)
    for (int I = 0; I < 3; ++I)
      for (int i = 0; i < 4; ++i)
        EXPECT_NEAR(G[row::G * order.row_of[n] + 4 * I + i], mean[n](i, I), 1e-12) << "node " << n;
}

TEST_P(Gradients, OfALinearStressAreExactAndItHasNoCorrection) {
  double slope[3][9];
  for (auto& s : slope)
    for (double& x : s) x = uniform(random, -1, 1);
  for (int n = 0; n < order.nodes; ++n)
    for (int m = 0; m < 9; ++m)
      PH[row::PH * order.row_of[n] + 8 * (m / 3) + m % 3] = 0.3 + slope[0][m] * mesh.X[n][0]
                                                            + slope[1][m] * mesh.X[n][1] + slope[2][m] * mesh.X[n][2];
  run(PressureJump::tensor, FluxCorrection::full);
  for (int r = 0; r < order.rows; ++r) {
    if (order.node_of[r] < 0) continue;
    for (int m = 0; m < 9; ++m) {
      for (int K = 0; K < 3; ++K) EXPECT_NEAR(GP[row::GP * r + 4 * (3 * K + m / 3) + m % 3], slope[K][m], 1e-13);
      EXPECT_NEAR(dP[row::dP * r + 4 * (m / 3) + m % 3], 0, 1e-13);
    }
  }
}

// dP_a = theta/(4 Omega_a) sum_b [(P_a - P_b + D . grad P_a) C] (x) D (method, section 14), summed over the dual's edges as they stand.
TEST_P(Gradients, CorrectionOfTheStressIsItsFormula) {
  for (int r = 0; r < order.rows; ++r)
    for (int m = 0; m < 9 && order.node_of[r] >= 0; ++m) PH[row::PH * r + 8 * (m / 3) + m % 3] = uniform(random, -1, 1);
  for (int r = 0; r < order.rows; ++r)
    for (int m = 0; m < 9; ++m) PH[row::PH * r + 8 * (m / 3) + 4 + m % 3] = uniform(random, -1, 1);  // H
  run(PressureJump::tensor, FluxCorrection::full);
  const auto P = [&](int n, int i, int I) { return PH[row::PH * order.row_of[n] + 8 * I + i]; };
  std::vector<Eigen::Matrix3d> expected(mesh.X.size(), Eigen::Matrix3d::Zero());
  const auto add = [&](int a, int b, double sign, const Vec3& C) {
    const Vec3 D = (mesh.X[b] - mesh.X[a]);
    for (int i = 0; i < 3; ++i) {
      double y = 0;
      for (int I = 0; I < 3; ++I) {
        double r = P(a, i, I) - P(b, i, I);
        for (int K = 0; K < 3; ++K) r += GP[row::GP * order.row_of[a] + 4 * (3 * K + I) + i] * D[K];
        y += r * sign * C[I];
      }
      for (int J = 0; J < 3; ++J) expected[a](i, J) += (2.0 / 3) / (4 * dual.volume[a]) * y * D[J];
    }
  };
  for (const DualEdge& e : dual.edges) {
    add(e.a, e.b, 1, e.C);
    add(e.b, e.a, -1, e.C);
  }
  for (int n = 0; n < order.nodes; ++n)
    for (int m = 0; m < 9; ++m) {
      const std::ptrdiff_t r = order.row_of[n], P_row = row::PH * r + 8 * (m / 3) + m % 3;
      EXPECT_NEAR(dP[row::dP * r + 4 * (m / 3) + m % 3], expected[n](m % 3, m / 3), 1e-13) << "node " << n;
      EXPECT_EQ(PH_new[P_row], PH[P_row] + dP[row::dP * r + 4 * (m / 3) + m % 3]) << "what the edges read";
      EXPECT_EQ(PH_new[P_row + 4], PH[P_row + 4]);
    }
}

TEST_P(Gradients, LimitedReconstructionsStayBetweenTheNeighboursAtEveryMidpointAndTouchThem) {
  for (int n = 0; n < order.nodes; ++n)
    for (int i = 0; i < 4; ++i) W[row::W * order.row_of[n] + i] = uniform(random, -1, 1);
  PhysicsSpec physics;
  physics.reconstruction = Reconstruction::limited;
  run(physics);
  std::vector<std::vector<int>> neighbours(mesh.X.size());
  for (const DualEdge& e : dual.edges) {
    neighbours[e.a].push_back(e.b);
    neighbours[e.b].push_back(e.a);
  }
  for (int n = 0; n < order.nodes; ++n)
    for (int i = 0; i < 4; ++i) {
      const int r = order.row_of[n];
      const double W_n = W[row::W * r + i], phi = L[row::L * r + i];
      double least = W_n, most = W_n, closest = 1e300;
      for (const int b : neighbours[n]) {
        least = std::min(least, W[row::W * order.row_of[b] + i]);
        most = std::max(most, W[row::W * order.row_of[b] + i]);
      }
      for (const int b : neighbours[n]) {
        double value = W_n;
        for (int I = 0; I < 3; ++I) value += 0.5 * phi * G[row::G * r + 4 * I + i] * (mesh.X[b][I] - mesh.X[n][I]);
        closest = std::min({closest, value - least, most - value});
      }
      EXPECT_GE(phi, 0);
      EXPECT_LE(phi, 1);
      EXPECT_GE(closest, -1e-14);
      EXPECT_TRUE(phi == 1 || closest < 1e-14) << "limited more than needed at node " << n;
    }
}

TEST_P(Gradients, PseudoLaplacianOfALinearFieldIsZeroAtEveryNode) {
  lambda = laplacian_weights(mesh, dual, order);
  for (int n = 0; n < order.nodes; ++n)
    for (int i = 0; i < 4; ++i)
      W[row::W * order.row_of[n] + i] = i + (i + 1) * mesh.X[n][0] - i * mesh.X[n][1] + 0.5 * mesh.X[n][2];
  for (double& l : L) l = 7;
  PhysicsSpec physics;
  physics.stabilisation = Stabilisation::jst;
  run(physics);
  for (const double l : L) EXPECT_NEAR(l, 0, 1e-12);
  W[row::W * order.row_of[500]] += 1;
  run(physics);
  EXPECT_LT(L[row::L * order.row_of[500]], -1);  // minus the sum of the weights
}
