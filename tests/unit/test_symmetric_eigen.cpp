// The Jacobi decomposition against its definition, on random, graded, equal and nearly equal eigenvalues.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "kernels/symmetric_eigen.hpp"

namespace nanson {
namespace {

/// A = R diag(value) R^T with random axes.
Symmetric<double> random_tensor(std::mt19937_64& random, const double (&value)[3]) {
  std::normal_distribution<double> normal;
  double axis[3][3];
  for (auto& a : axis)
    for (double& x : a) x = normal(random);
  for (int k = 0; k < 3; ++k) {  // Gram-Schmidt
    for (int j = 0; j < k; ++j) {
      const double along = axis[k][0] * axis[j][0] + axis[k][1] * axis[j][1] + axis[k][2] * axis[j][2];
      for (int i = 0; i < 3; ++i) axis[k][i] -= along * axis[j][i];
    }
    const double size = std::hypot(axis[k][0], axis[k][1], axis[k][2]);
    for (double& x : axis[k]) x /= size;
  }
  return composed(value, axis);
}

double largest(const Symmetric<double>& A) {
  double m = 0;
  for (const double x : A.a) m = std::max(m, std::abs(x));
  return m;
}

TEST(SymmetricEigen, ComposesAgainWithOrthonormalAxes) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  double composition = 0, orthogonality = 0;
  for (int k = 0; k < 30000; ++k) {
    const double scale = std::pow(10.0, 8 * uniform(random)), near = std::pow(10.0, -8 * std::abs(uniform(random)));
    for (const auto& value : std::vector<std::array<double, 3>>{{uniform(random), uniform(random), uniform(random)},
                                                                {1, scale, scale * scale},
                                                                {1, 1 + near, 1 - near * uniform(random)},
                                                                {1, 1, 1 + near},
                                                                {2, 2, 2},
                                                                {1, 1, scale}}) {
      const double v[3] = {value[0], value[1], value[2]};
      const Symmetric<double> A = random_tensor(random, v);
      const Spectrum<double> S = symmetric_eigen(A);
      const Symmetric<double> B = composed(S.value, S.axis);
      for (int m = 0; m < 6; ++m) composition = std::max(composition, std::abs(B.a[m] - A.a[m]) / largest(A));
      for (int p = 0; p < 3; ++p)
        for (int q = 0; q < 3; ++q)
          orthogonality = std::max(orthogonality, std::abs(S.axis[p][0] * S.axis[q][0] + S.axis[p][1] * S.axis[q][1]
                                                           + S.axis[p][2] * S.axis[q][2] - (p == q)));
    }
  }
  EXPECT_LT(composition, 1e-14);
  EXPECT_LT(orthogonality, 1e-14);
}

TEST(SymmetricEigen, LeavesADiagonalTensorAlone) {
  const Spectrum<double> S = symmetric_eigen(Symmetric<double>{{3, 1, 2, 0, 0, 0}});
  EXPECT_TRUE(S.value[0] == 3 && S.value[1] == 1 && S.value[2] == 2);
  for (int k = 0; k < 9; ++k) EXPECT_EQ(S.axis[k / 3][k % 3], k % 4 == 0);
}

TEST(SymmetricEigen, KeepsNan) {
  for (int m = 0; m < 6; ++m) {
    Symmetric<double> A{{3, 1, 2, 0.1, 0.2, 0.3}};
    A.a[m] = std::nan("");
    const Spectrum<double> S = symmetric_eigen(A);
    EXPECT_TRUE(std::isnan(S.value[0] + S.value[1] + S.value[2])) << m;
  }
}

}  // namespace
}  // namespace nanson
