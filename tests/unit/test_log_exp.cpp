// The inlined logarithm and exponential against the C library: error in ulp, special values, lanes equal to scalars.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "kernels/column.hpp"

namespace nanson {
namespace {

/// |value - exact| in units of the last place of the exact value.
double ulps(double value, long double exact) {
  const double rounded = static_cast<double>(exact),
               unit = std::nextafter(std::abs(rounded), HUGE_VAL) - std::abs(rounded);
  return static_cast<double>(std::abs(static_cast<long double>(value) - exact)) / unit;
}

constexpr double infinity = HUGE_VAL;
const double nan_value = std::nan("");

TEST(Logarithm, IsWithinTwoUlpOverAllScales) {
  std::mt19937_64 random(1);
  double worst = 0;
  for (int k = 0; k < 200000; ++k) {
    const double near_one = std::ldexp(1 + double(random() >> 11) * 0x1p-53, -1 + k % 2),
                 wide = std::ldexp(near_one, int(random() % 2000) - 1000);
    for (const double x : {near_one, wide, 1 + (near_one - 1) * 1e-6})
      worst = std::max(worst, x == 1 ? 0.0 : ulps(logarithm(x), std::log(static_cast<long double>(x))));
  }
  EXPECT_LT(worst, 2);
}

TEST(Exponential, IsWithinTwoUlp) {
  std::mt19937_64 random(2);
  double worst = 0;
  for (int k = 0; k < 200000; ++k) {
    const double unit = double(random() >> 11) * 0x1p-52 - 1;
    for (const double x : {unit, 1e-4 * unit, 700 * unit})
      worst = std::max(worst, ulps(exponential(x), std::exp(static_cast<long double>(x))));
  }
  EXPECT_LT(worst, 2);
}

TEST(Logarithm, KeepsNanAndGivesItOutsideItsDomain) {
  EXPECT_EQ(logarithm(1.0), 0.0);
  EXPECT_EQ(logarithm(infinity), infinity);
  for (const double x : {0.0, -0.0, -1.0, -infinity, nan_value, -nan_value, 0x1p-1030})
    EXPECT_TRUE(std::isnan(logarithm(x))) << x;
}

TEST(Exponential, KeepsNanAndEndsInZeroAndInfinity) {
  EXPECT_EQ(exponential(0.0), 1.0);
  EXPECT_EQ(exponential(infinity), infinity);
  EXPECT_EQ(exponential(720.0), infinity);
  EXPECT_EQ(exponential(-720.0), 0.0);
  EXPECT_EQ(exponential(-infinity), 0.0);
  EXPECT_TRUE(std::isnan(exponential(nan_value)));
  EXPECT_TRUE(std::isnan(exponential(std::bit_cast<double>(0x7ff8000000000fffull))));  // whatever its payload
}

TEST(LogExp, LanesEqualScalarsToTheBit) {
  std::mt19937_64 random(3);
  for (int k = 0; k < 2000; ++k) {
    Vec8 x;
    for (int i = 0; i < 8; ++i) x[i] = std::ldexp(double(random() >> 11) * 0x1p-52 - 0.5, int(random() % 16) - 6);
    x[k % 8] = k % 3 ? x[k % 8] : nan_value;
    const Vec8 l = logarithm(x), e = exponential(x);
    for (int i = 0; i < 8; ++i) {
      EXPECT_TRUE(l[i] == logarithm(x[i]) || (std::isnan(l[i]) && std::isnan(logarithm(x[i])))) << x[i];
      EXPECT_TRUE(e[i] == exponential(x[i]) || (std::isnan(e[i]) && std::isnan(x[i]))) << x[i];
    }
  }
}

}  // namespace
}  // namespace nanson
