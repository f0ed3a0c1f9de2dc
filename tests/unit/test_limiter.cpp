// The limiter of one node, and the entropy fix of one edge.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "kernels/flux.hpp"
#include "kernels/reconstruction.hpp"
#include "tests/unit/random_tensor.hpp"

using namespace nanson;
using namespace nanson::test;

namespace {

Vec4 random_column(Random& random, double least, double most) {
  return Vec4{uniform(random, least, most), uniform(random, least, most), uniform(random, least, most),
              uniform(random, least, most)};
}

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

/// A node with six neighbours: their differences from it, and the slopes G.D/2 at the midpoints.
struct Star {
  Vec4 d[6], slope[6];
  Vec4 rise{}, fall{}, above{}, below{};

  template <class Difference, class Slope>
  Star(Difference difference, Slope slope_of) {
    for (int k = 0; k < 6; ++k) {
      d[k] = difference(k);
      slope[k] = slope_of(k);
      above = larger(above, d[k]);
      below = smaller(below, d[k]);
      rise = larger(rise, slope[k]);
      fall = smaller(fall, slope[k]);
    }
  }
  Vec4 phi() const { return barth_jespersen(rise, fall, above, below); }
};

}  // namespace

TEST(BarthJespersen, ValuesAtTheMidpointsStayWithinTheNeighbours) {
  Random random(1);
  int limited = 0, whole = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Star s([&](int) { return random_column(random, -1, 1); },
                 [&](int) { return random_column(random, -0.8, 0.8); });
    const Vec4 phi = s.phi();
    for (int i = 0; i < 4; ++i) {
      EXPECT_GE(phi[i], 0);
      EXPECT_LE(phi[i], 1);
      (phi[i] < 1 ? limited : whole) += 1;
      for (int k = 0; k < 6; ++k) {
        EXPECT_LE(phi[i] * s.slope[k][i], s.above[i] + 1e-15);
        EXPECT_GE(phi[i] * s.slope[k][i], s.below[i] - 1e-15);
      }
    }
  }
  EXPECT_GT(limited, 100);
  EXPECT_GT(whole, 100);
}

TEST(BarthJespersen, LeavesALinearFieldAlone) {  // differences are twice the slopes at the midpoints
  Random random(2);
  for (int trial = 0; trial < 100; ++trial) {
    Vec4 slope[6];
    for (auto& x : slope) x = random_column(random, -1, 1);
    const Star s([&](int k) { return 2.0 * slope[k]; }, [&](int k) { return slope[k]; });
    for (int i = 0; i < 4; ++i) EXPECT_EQ(s.phi()[i], 1.0);
  }
}

TEST(BarthJespersen, IsOneForAConstantFieldAndZeroAtAnExtremum) {
  const Star constant([](int) { return Vec4{}; }, [](int) { return Vec4{}; });
  const Star peak([](int k) { return broadcast4(-1.0 - k); }, [](int k) { return broadcast4(k - 2.5); });
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(constant.phi()[i], 1.0);
    EXPECT_EQ(peak.phi()[i], 0.0);
  }
}

/// The node's own NaN is in its gradient, hence in the reconstructed jump whatever phi is: no component of it becomes a number again.
TEST(BarthJespersen, DoesNotMakeNaNANumber) {
  for (int bad = 0; bad < 4; ++bad) {
    alignas(64) double X[8] = {0, 0, 0, 1, 1, 0, 0, 1};
    alignas(64) double W[8] = {};
    alignas(64) double G[24];
    alignas(64) double L[8];
    for (double& g : G) g = 0.1;
    for (double& l : L) l = 1;
    for (int I = 0; I < 3; ++I) G[4 * I + bad] = nan_value;
    W[bad] = nan_value;
    const Vec4 slope = along(G, Vec4{1, 0, 0, 0}) * 0.5, d = load4(W + 4) - load4(W);
    const Vec4 phi = barth_jespersen(larger(slope, Vec4{}), smaller(slope, Vec4{}), larger(d, Vec4{}),
                                     smaller(d, Vec4{}));
    store4(L, phi);
    Rows rows{};
    rows.X = X;
    rows.W = W;
    rows.G = G;
    rows.L = L;
    const Vec4 jump = reconstructed_jump<Reconstruction::limited>(rows, 0, 1, d, Vec4{1, 0, 0, 0});
    for (int i = 0; i < 4; ++i) EXPECT_EQ(std::isnan(jump[i]), i == bad) << bad;
  }
}

namespace {

/// {D^p, D^J} = {shear, shear, shear, volume} d + along c of one edge.
template <EntropyFix fix>
StabiliserOf<double> one_edge(const EdgeCoefficientsOf<double>& k, Vec4 plain, Vec4 d, Vec4 c, double cc) {
  return fix == EntropyFix::none
             ? stabiliser(k, dot3(c, d)[0])
             : fixed_stabiliser(k, cc, dot3(c, d)[0], dot3(c, plain)[0], dot3(d, plain)[0], d[3] * plain[3]);
}

/// Power of {D^p, D^J} on the plain jump, and whether the fix changed the stabilisation.
struct Power {
  double with_fix, without;
  double scale;
};

template <UpwindMetric metric>
Power power_of(Random& random) {
  Vec4 c = random_column(random, -1, 1);
  c[3] = 0;
  const double cc = dot3(c, c)[0], size = std::sqrt(cc) * std::exp(uniform(random, -1.1, 1.1));
  const Vec4 plain = random_column(random, -1, 1), d = random_column(random, -1, 1);
  const EdgeCoefficientsOf<double> k = edge_coefficients(cc, size, 3.0, uniform(random, 0, 3.0), 3.0,
                                                         metric == UpwindMetric::deformed);
  const auto power = [&](const StabiliserOf<double>& s) {
    const Vec4 D = Vec4{s.shear, s.shear, s.shear, s.volume} * d + s.along * c;
    return dot3(D, plain)[0] + D[3] * plain[3];
  };
  return {power(one_edge<EntropyFix::edge>(k, plain, d, c, cc)), power(one_edge<EntropyFix::none>(k, plain, d, c, cc)),
          k.shear + std::abs(k.normal) * cc + k.volume};
}

template <UpwindMetric metric>
void expect_no_edge_is_fed() {
  Random random(3);
  int fed = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Power p = power_of<metric>(random);
    EXPECT_GE(p.with_fix, -1e-14 * p.scale);
    EXPECT_GE(p.with_fix, p.without - 1e-14 * p.scale);
    fed += p.without < 0;
  }
  EXPECT_GT(fed, 300) << "the fix had nothing to do";
}

}  // namespace

TEST(EntropyFix, TakesPowerOutOfEveryEdgeWhateverTheJumps) {
  expect_no_edge_is_fed<UpwindMetric::deformed>(), expect_no_edge_is_fed<UpwindMetric::paper>();
}

TEST(EntropyFix, LeavesAnEdgeAloneWhoseReconstructedJumpIsAShareOfThePlainOne) {
  Random random(4);
  for (int trial = 0; trial < 200; ++trial) {
    Vec4 c = random_column(random, -1, 1);
    c[3] = 0;
    const double cc = dot3(c, c)[0];
    const Vec4 plain = random_column(random, -1, 1), d = 0.3 * plain;
    const EdgeCoefficientsOf<double> k = edge_coefficients(cc, std::sqrt(cc), 3.0, 1.0, 3.0, true);
    const StabiliserOf<double> with = one_edge<EntropyFix::edge>(k, plain, d, c, cc),
                               without = one_edge<EntropyFix::none>(k, plain, d, c, cc);
    EXPECT_EQ(with.shear, without.shear);
    EXPECT_EQ(with.volume, without.volume);
    EXPECT_NEAR(with.along, without.along, 1e-14 * std::abs(without.along) + 1e-15 * k.shear / std::sqrt(cc));
  }
}
