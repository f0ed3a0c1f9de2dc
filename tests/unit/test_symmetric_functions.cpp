// Logarithm and exponential of symmetric tensors against the spectrum, on both sides of where the series end.
#include <gtest/gtest.h>

#include <cmath>

#include "kernels/symmetric_functions.hpp"
#include "tests/unit/random_tensor.hpp"

namespace nanson {
namespace {

using test::Random, test::uniform, test::random_rotation;

/// R diag(a, b, c) R^T.
Symmetric<double> turned(const Tensor<double>& R, double a, double b, double c) {
  const double value[3] = {a, b, c};
  double axis[3][3];
  for (int m = 0; m < 9; ++m) axis[m / 3][m % 3] = R[m % 3][m / 3];
  return composed(value, axis);
}
Symmetric<double> turned(Random& random, double a, double b, double c) {
  return turned(random_rotation(random), a, b, c);
}
double distance(const Symmetric<double>& A, const Symmetric<double>& B) {
  Symmetric<double> d;
  for (int k = 0; k < 6; ++k) d.a[k] = A.a[k] - B.a[k];
  return std::sqrt(square_norm(d));
}
Symmetric<double> identity6() { return {{1, 1, 1, 0, 0, 0}}; }

TEST(SymmetricFunctions, InverseAndProductGiveTheIdentity) {
  Random random(1);
  for (int k = 0; k < 1000; ++k) {
    const Symmetric<double> A = turned(random, uniform(random, 0.5, 2), uniform(random, 0.5, 2),
                                       uniform(random, 0.5, 2));
    EXPECT_LT(distance(commuting_product(A, inverse(A)), identity6()), 1e-14);
  }
}

TEST(SymmetricFunctions, PolynomialTakesItsCoefficientsInOrder) {
  Random random(2);
  const Symmetric<double> A = turned(random, 0.3, -0.7, 1.1), A2 = commuting_product(A, A),
                          p = polynomial(A, {2.0, -3.0, 0.5});
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(p.a[k], (k < 3 ? 2.0 : 0.0) - 3 * A.a[k] + 0.5 * A2.a[k], 1e-15);
}

/// Stretches from 1e-12 to 50 % apart: the series end at about 15 %.
TEST(SymmetricFunctions, DeviatoricLogarithmIsThatOfTheEigenvalues) {
  Random random(3);
  for (double size = 1e-12; size < 0.5; size *= 1.1)
    for (int k = 0; k < 20; ++k) {
      const double e[3] = {uniform(random, -size, size), uniform(random, -size, size), uniform(random, -size, size)};
      const double level = std::exp(uniform(random, -2, 2)), mean = (e[0] + e[1] + e[2]) / 3;
      const Tensor<double> R = random_rotation(random);
      const Symmetric<double> L = deviatoric_logarithm(
          turned(R, level * std::exp(e[0]), level * std::exp(e[1]), level * std::exp(e[2])));
      EXPECT_LT(distance(L, turned(R, e[0] - mean, e[1] - mean, e[2] - mean)), 3e-15) << size;
      EXPECT_NEAR(L.a[0] + L.a[1] + L.a[2], 0, 1e-16 + 4e-15 * size);
    }
}

TEST(SymmetricFunctions, ExponentialIsThatOfTheEigenvalues) {
  Random random(4);
  for (double size = 1e-12; size < 2; size *= 1.1)
    for (int k = 0; k < 20; ++k) {
      const double e[3] = {uniform(random, -size, size), uniform(random, -size, size), uniform(random, -size, size)};
      const Tensor<double> R = random_rotation(random);
      const Symmetric<double> expected = turned(R, std::exp(e[0]), std::exp(e[1]), std::exp(e[2]));
      EXPECT_LT(distance(exponential(turned(R, e[0], e[1], e[2])), expected) / std::sqrt(square_norm(expected)), 2e-15)
          << size;
    }
}

/// Just inside and just outside of their ends, the series and the spectrum give the same.
TEST(SymmetricFunctions, SeriesMeetTheSpectrumWhereTheyEnd) {
  Random random(5);
  for (int k = 0; k < 200; ++k) {
    const double a = uniform(random, -1, 1), b = uniform(random, -1, 1), size = std::sqrt(2 * (a * a + b * b + a * b));
    for (const double s : {0.2499, 0.2501}) {
      const Symmetric<double> A = turned(random, s * a / size, s * b / size, -s * (a + b) / size);
      EXPECT_LT(distance(exponential(A), by_spectrum(A, [](double x) { return exponential(x); })), 3e-15);
    }
    for (const double s : {0.28, 0.29, 0.30, 0.31, 0.32}) {  // |Y| from 0.14 to 0.16
      const Symmetric<double> A = turned(random, std::exp(s * a / size), std::exp(s * b / size),
                                         std::exp(-s * (a + b) / size));
      EXPECT_LT(distance(deviatoric_logarithm(A), deviator(by_spectrum(A, [](double x) { return logarithm(x); }))),
                3e-15);
    }
  }
}

TEST(SymmetricFunctions, MultiplesOfTheIdentityHaveNoDeviator) {
  for (const double m : {1e-3, 1.0, 7.0}) {
    const Symmetric<double> L = deviatoric_logarithm(Symmetric<double>{{m, m, m, 0, 0, 0}});
    for (const double l : L.a) EXPECT_NEAR(l, 0, 3e-16);
  }
  EXPECT_EQ(distance(exponential(Symmetric<double>{{0, 0, 0, 0, 0, 0}}), identity6()), 0);
}

TEST(SymmetricFunctions, LogarithmIsNanWhereThereIsNone) {
  const double nan = std::nan("");
  for (const Symmetric<double>& A : {Symmetric<double>{{1, 1, -0.1, 0, 0, 0}}, Symmetric<double>{{-1, -1, -1, 0, 0, 0}},
                                     Symmetric<double>{{0, 0, 0, 0, 0, 0}}, Symmetric<double>{{1, 1, 1, 0, 2, 0}},
                                     Symmetric<double>{{1, nan, 1, 0, 0, 0}}, Symmetric<double>{{1, 1, 1, 0, 0, nan}}})
    EXPECT_TRUE(std::isnan(square_norm(deviatoric_logarithm(A))));
}

/// Eight lanes, near, far and broken ones side by side: each as alone, to the bit.
TEST(SymmetricFunctions, LanesDoNotDisturbEachOther) {
  Random random(6);
  Symmetric<Vec8> A;
  Symmetric<double> alone[8];
  for (int i = 0; i < 8; ++i) {
    const double size = i < 4 ? 0.01 : 0.6;
    alone[i] = turned(random, 1 + uniform(random, -size, size), 1 + uniform(random, -size, size),
                      i == 7 ? -1 : 1 + uniform(random, -size, size));
    for (int k = 0; k < 6; ++k) A.a[k][i] = alone[i].a[k];
  }
  const Symmetric<Vec8> ln = deviatoric_logarithm(A), e = exponential(A);
  for (int i = 0; i < 8; ++i)
    for (int k = 0; k < 6; ++k) {
      EXPECT_EQ(e.a[k][i], exponential(alone[i]).a[k]);
      if (i < 7) {
        EXPECT_EQ(ln.a[k][i], deviatoric_logarithm(alone[i]).a[k]);
      } else {
        EXPECT_TRUE(std::isnan(ln.a[k][i]));
      }
    }
}

}  // namespace
}  // namespace nanson
