// The two halves of the tets' own energy: springs on edges, and the nodes' share; and the barrier of one tet (method, section 17).
#include "kernels/tet_stiffness.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "engine/dual.hpp"
#include "kernels/tet_barrier.hpp"
#include "tests/unit/material_list.hpp"
#include "tests/unit/meshes.hpp"

using namespace nanson;
using namespace nanson::test;

namespace {

/// Deformation gradient of a tet from the places of its nodes.
Eigen::Matrix3d gradient_of(const Vec3 (&X)[4], const Vec3 (&x)[4]) {
  Eigen::Matrix3d E, e;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) {
      E(i, k) = X[k + 1][i] - X[0][i];
      e(i, k) = x[k + 1][i] - x[0][i];
    }
  return e * E.inverse();
}

}  // namespace

TEST(TetStiffness, StressOfANodeIsTheDerivativeOfItsEnergy) {
  Random random(1);
  for (int k = 0; k < 50; ++k) {
    const double c = uniform(random, 0.1, 3);
    Tensor<double> F = random_F(random, 0.5, 2), P{};
    add_tet_stiffness(P, F, c, false);
    for (int m = 0; m < 9; ++m) {  // a square: its differences are exact
      Tensor<double> more = F, less = F;
      more.a[m / 3][m % 3] += 0.5;
      less.a[m / 3][m % 3] -= 0.5;
      EXPECT_NEAR(P.a[m / 3][m % 3], tet_stiffness_energy(more, c) - tet_stiffness_energy(less, c), 1e-13);
    }
    Tensor<double> of_current{};
    add_tet_stiffness(of_current, F, c, true);  // -c F: P F^T is symmetric
    for (int m = 0; m < 9; ++m) EXPECT_DOUBLE_EQ(of_current.a[m / 3][m % 3], -c * F.a[m / 3][m % 3]);
  }
}

/// 1/2 sum k_ab |u_b - u_a|^2 = 1/2 sum_T V_T c_T |grad u|^2 for any displacement and any moduli, on a mesh with obtuse tets.
TEST(TetStiffness, SpringsHoldTheEnergyOfTheTets) {
  const Mesh mesh = box({4, 3, 5}, Split::alternating, 0.3);
  Random random(2);
  std::vector<double> modulus;
  std::vector<Vec3> x = mesh.X;
  for (Vec3& p : x) {
    modulus.push_back(uniform(random, 1, 20));
    for (double& c : p) c += uniform(random, -0.4, 0.4);
  }
  const Dual dual = make_dual(mesh, modulus);
  double springs = 0, tets = 0;
  bool has_negative = false;
  for (const DualEdge& e : dual.edges) {
    const Vec3 stretch = (x[e.b] - x[e.a]) - (mesh.X[e.b] - mesh.X[e.a]);
    springs += 0.5 * e.stiffness * dot(stretch, stretch);
    has_negative = has_negative || e.stiffness < 0;
  }
  for (const auto& t : mesh.tets) {
    const Vec3 X[4] = {mesh.X[t[0]], mesh.X[t[1]], mesh.X[t[2]], mesh.X[t[3]]},
               now[4] = {x[t[0]], x[t[1]], x[t[2]], x[t[3]]};
    const double c = 0.25 * (modulus[t[0]] + modulus[t[1]] + modulus[t[2]] + modulus[t[3]]);
    tets += 0.5 * tet_volume(X[0], X[1], X[2], X[3]) * c
            * (gradient_of(X, now) - Eigen::Matrix3d::Identity()).squaredNorm();
  }
  EXPECT_TRUE(has_negative);
  EXPECT_NEAR(springs / tets, 1, 1e-13);
  EXPECT_EQ(make_dual(mesh).edges[7].stiffness, 0);
  for (std::size_t e = 0; e < dual.edges.size(); ++e)  // nothing else changes
    EXPECT_EQ(dual.edges[e].C, make_dual(mesh).edges[e].C) << e;
}

TEST(TetBarrier, BeginsSmoothlyAndItsDerivativesAreThoseOfTheEnergy) {
  EXPECT_EQ(crushing(crushed_share).phi, 0);
  EXPECT_EQ(crushing(crushed_share).d, 0);
  for (const double r : {0.29, 0.1, 0.01, 1e-3,
                         -0.2}) {  // straight below 3e-4: its second derivative there is that of the kink's upper side
    const double h = 1e-6 * (r > 1e-3 ? r : 1e-3);
    EXPECT_NEAR(crushing(r).d / ((crushing(r + h).phi - crushing(r - h).phi) / (2 * h)), 1, 1e-6) << r;
    if (r > 0) {
      EXPECT_NEAR(crushing(r).dd / ((crushing(r + h).d - crushing(r - h).d) / (2 * h)), 1, 1e-6) << r;
    }
    EXPECT_LT(crushing(r).d, 0) << r;
  }
}

/// Forces on the four nodes and the share of the nodal stress, against differences of V m phi(J_T / Jm).
TEST(TetBarrier, ForcesOfACrushedTetAreTheDerivativesOfItsEnergy) {
  Random random(3);
  int crushed = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Vec3 X[4] = {{0, 0, 0}, {1, 0.1, 0}, {0, 1.2, 0.1}, {0.1, 0, 0.9}};
    Vec3 x[4];
    double detF[4];
    const double squeeze = uniform(random, -0.1, 0.3);
    for (int a = 0; a < 4; ++a) {
      x[a] = {X[a][0] + uniform(random, -0.1, 0.1), X[a][1] + uniform(random, -0.1, 0.1), X[a][2] * squeeze};
      detF[a] = uniform(random, 0.5, 1.5);
    }
    const double modulus = 7, rho = 3, V = tet_volume(X[0], X[1], X[2], X[3]);
    const auto share = [&] {
      return tet_volume(x[0], x[1], x[2], x[3]) / V / (0.25 * (detF[0] + detF[1] + detF[2] + detF[3]));
    };
    const auto energy = [&] { return V * modulus * crushing(share()).phi; };
    if (share() >= 0.28 || share() < 0.02) continue;
    ++crushed;
    double places[4][3];
    for (int m = 0; m < 12; ++m) places[m / 3][m % 3] = x[m / 3][m % 3];
    const double mean = 0.25 * (detF[0] + detF[1] + detF[2] + detF[3]);
    const CrushedTet t = crushed_tet(places, 6 * V, mean, share(), modulus, rho);
    const auto slope = [&](double& of) {
      const double at = of, h = 1e-6;
      of = at + h;
      const double more = energy();
      of = at - h;
      const double less = energy();
      of = at;
      return (more - less) / (2 * h);
    };
    double size = 0;
    for (int m = 0; m < 12; ++m) size = std::max(size, std::abs(t.force[m / 3][m % 3]));
    for (int a = 0; a < 4; ++a) {
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(t.force[a][i], -slope(x[a][i]), 1e-5 * size) << a << i;
      EXPECT_NEAR(t.weight[a] / slope(detF[a]), 1, 1e-5);  // P:dF = weight d(det F): of the energy itself
    }
    for (int i = 0; i < 3; ++i)
      EXPECT_EQ(t.force[3][i], -t.force[0][i] - t.force[1][i] - t.force[2][i]) << "momentum is lost";
    EXPECT_GT(t.rate2, 0);
  }
  EXPECT_GT(crushed, 100);
}
