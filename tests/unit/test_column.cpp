// Columns and lanes: every width gives the bits of the scalar; transposition; the cube root.
#include "kernels/column.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/random_tensor.hpp"

using namespace nanson;
using namespace nanson::test;

namespace {

constexpr double NaN = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

/// Equal bits, or both NaN (whose sign and payload the hardware chooses).
::testing::AssertionResult same(double a, double b) {
  if (std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (a != a && b != b))
    return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << a << " and " << b << " differ by " << b - a;
}

/// Any sign, exponents from 2^-60 to 2^60; every tenth one is special.
double any_number(Random& random) {
  constexpr double special[] = {0.0, -0.0, 1.0, -1.0, NaN, infinity, -infinity, 1e300, -1e300, 1e-300};
  if (random() % 10 == 0) return special[random() % 10];
  return std::ldexp(uniform(random, -1, 1), static_cast<int>(random() % 121) - 60);
}

Vec8 eight_of(Random& random) {
  Vec8 v;
  for (int i = 0; i < 8; ++i) v[i] = any_number(random);
  return v;
}

/// Distance of t from x^(-1/3), in units of the last place of t.
double ulps_off(double t, double x) {
  const long double exact = 1 / cbrtl(static_cast<long double>(x));
  const double spacing = std::nextafter(t, infinity) - t;
  return static_cast<double>(std::fabs(static_cast<long double>(t) - exact) / spacing);
}

double log_uniform(Random& random) { return std::pow(10, uniform(random, -300, 300)); }

}  // namespace

TEST(Column, FmaRoundsAlikeInEveryWidth) {
  Random random(1);
  for (int k = 0; k < 2000; ++k) {
    const Vec8 a = eight_of(random), b = eight_of(random), c = eight_of(random), wide = nanson::fma(a, b, c),
               minus = nanson::fnma(a, b, c);
    const Vec4 narrow = nanson::fma(low(a), low(b), low(c)), minus4 = nanson::fnma(low(a), low(b), low(c));
    for (int i = 0; i < 8; ++i)
      EXPECT_TRUE(same(wide[i], nanson::fma(a[i], b[i], c[i])) && same(minus[i], nanson::fma(-a[i], b[i], c[i])));
    for (int i = 0; i < 4; ++i)
      EXPECT_TRUE(same(narrow[i], nanson::fma(a[i], b[i], c[i])) && same(minus4[i], nanson::fma(-a[i], b[i], c[i])));
  }
}

TEST(Column, LanesAreComparedAndSummed) {
  const std::int32_t a[9] = {0, 1, 5, -3, 7, 7, 2, 1 << 30, 9}, b[9] = {0, 2, 1, 4, 7, 8, -2, 3, 10};
  for (int from : {0, 1}) {  // from any address
    const Mask8 less = less8(a + from, b + from);
    for (int i = 0; i < 8; ++i) EXPECT_EQ(less[i] != 0, a[from + i] < b[from + i]);
  }
  EXPECT_EQ(nanson::sum(Vec8{1, 2, 4, 8, 16, 32, 64, 128}), 255.0);
}

TEST(Column, RootRoundsAlikeInEveryWidth) {
  Random random(2);
  for (int k = 0; k < 2000; ++k) {
    const Vec8 x = eight_of(random), wide = root(x);
    const Vec4 narrow = root(low(x));
    for (int i = 0; i < 8; ++i) EXPECT_TRUE(same(wide[i], std::sqrt(x[i])));
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(same(narrow[i], std::sqrt(x[i])));
    EXPECT_TRUE(same(root(x[0]), std::sqrt(x[0])));
  }
}

TEST(Column, ChooseAndLargerTakeTheSecondWhereAComparisonWithNaNFails) {
  Random random(3);
  for (int k = 0; k < 2000; ++k) {
    const Vec8 a = eight_of(random), b = eight_of(random), chosen = choose(a < b, a, b), most = larger(a, b);
    for (int i = 0; i < 8; ++i) {
      EXPECT_TRUE(same(chosen[i], a[i] < b[i] ? a[i] : b[i]));
      EXPECT_TRUE(same(choose(a[i] < b[i], a[i], b[i]), chosen[i]));
      EXPECT_TRUE(same(most[i], a[i] > b[i] ? a[i] : b[i]));
      EXPECT_TRUE(same(larger(a[i], b[i]), most[i]));
    }
  }
  EXPECT_EQ(larger(NaN, 2.0), 2.0);
  EXPECT_TRUE(std::isnan(larger(2.0, NaN)));
}

TEST(InverseCubeRoot, IsWithinTwoUlps) {
  Random random(4);
  double worst = 0;
  for (int k = 0; k < 300000; ++k) {
    const double x = log_uniform(random);
    worst = std::max(worst, ulps_off(inverse_cube_root(x), x));
  }
  for (int e = -996; e <= 996; ++e)  // both sides of every power of two
    for (const double x :
         {std::ldexp(1, e), std::nextafter(std::ldexp(1, e), 0), std::nextafter(std::ldexp(1, e), infinity)})
      worst = std::max(worst, ulps_off(inverse_cube_root(x), x));
  for (int k = 0; k < 100000; ++k) {  // where J lives
    const double x = uniform(random, 0.01, 10);
    worst = std::max(worst, ulps_off(inverse_cube_root(x), x));
  }
  RecordProperty("worst_ulps", std::to_string(worst));
  EXPECT_LE(worst, 2);
}

TEST(InverseCubeRoot, IsExactAtOne) { EXPECT_EQ(inverse_cube_root(1.0), 1.0); }

TEST(InverseCubeRoot, IsNaNWhereTheNumberIsNotPositive) {
  for (const double x : {0.0, -0.0, -1.0, -8.0, -1e300, -1e-300, NaN, -infinity}) {
    EXPECT_TRUE(std::isnan(inverse_cube_root(x))) << x;
    Vec8 v = broadcast8(8.0);
    v[5] = x;
    const Vec8 t = inverse_cube_root(v);
    for (int i = 0; i < 8; ++i) EXPECT_EQ(std::isnan(t[i]), i == 5) << x;
  }
}

TEST(InverseCubeRoot, OfEightLanesHasTheBitsOfTheScalar) {
  Random random(5);
  for (int k = 0; k < 20000; ++k) {
    Vec8 x;
    for (int i = 0; i < 8; ++i) x[i] = k % 2 ? log_uniform(random) : uniform(random, -0.1, 3);
    const Vec8 t = inverse_cube_root(x);
    for (int i = 0; i < 8; ++i) EXPECT_TRUE(same(t[i], inverse_cube_root(x[i])));
  }
}

TEST(Column, LoadTransposedTakesEightRowsAsFourLanes) {
  for (const int stride : {4, 12, 24}) {
    alignas(64) double rows[8 * 24];
    for (int k = 0; k < 8 * 24; ++k) rows[k] = k;
    Vec8 c[4];
    load_transposed(rows, stride, c[0], c[1], c[2], c[3]);
    for (int k = 0; k < 4; ++k)
      for (int i = 0; i < 8; ++i) EXPECT_EQ(c[k][i], stride * i + k);
  }
}

TEST(Column, StoreTransposedIsTheInverseAndTouchesNothingElse) {
  for (const int stride : {4, 16, 24}) {
    alignas(64) double rows[8 * 24];
    alignas(64) double back[8 * 24];
    for (int k = 0; k < 8 * 24; ++k) {
      rows[k] = k;
      back[k] = -1;
    }
    Vec8 c[4];
    load_transposed(rows, stride, c[0], c[1], c[2], c[3]);
    store_transposed(back, stride, c[0], c[1], c[2], c[3]);
    for (int k = 0; k < 8 * 24; ++k) EXPECT_EQ(back[k], k % stride < 4 && k < 8 * stride ? rows[k] : -1) << k;
  }
}

TEST(Column, LowHighAndConcatKeepTheLanes) {
  const Vec8 v{0, 1, 2, 3, 4, 5, 6, 7}, again = concat(low(v), high(v));
  for (int i = 0; i < 8; ++i) EXPECT_EQ(again[i], i);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(high(v)[i], i + 4);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(spread<2>(low(v))[i], 2);
}

TEST(Column, Dot3IgnoresTheFourthLane) {
  const Vec4 a{1, 2, 3, NaN}, b{4, -5, 6, infinity};
  for (int i = 0; i < 4; ++i) EXPECT_EQ(dot3(a, b)[i], 4 - 10 + 18);
}

TEST(Column, AnySeesEveryLane) {
  const Vec8 zero{};
  EXPECT_FALSE(any(zero > 0.0));
  for (int i = 0; i < 8; ++i) {
    Vec8 v{};
    v[i] = 1;
    EXPECT_TRUE(any(v > 0.0));
  }
}

TEST(Column, LargestSeesEveryLane) {
  for (int i = 0; i < 8; ++i) {
    Vec8 v = broadcast8(-2.0);
    v[i] = -1;
    EXPECT_EQ(largest(v), -1.0);
  }
}
