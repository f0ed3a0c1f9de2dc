// The numerical flux of one edge against the paper's matrices (eq. 36-43, Remark 4), built in full.
#include "kernels/flux.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "tests/unit/random_tensor.hpp"

using namespace nanson;
using namespace nanson::test;
using Eigen::Matrix3d, Eigen::Vector3d;

namespace {

constexpr double rho = 1100, cp = 240, cs = 70;  // [kg/m^3] [m/s] [m/s]

struct Edge {
  Vector3d C, c, d;  // [m^2] [m^2] [m/s]: area, deformed area, jump of v
  double d_Sigma;    // [Pa]
};

Vector3d random_vector(Random& random) {
  return {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
}

/// Areas that grow or shrink by up to 3.
Edge random_edge(Random& random) {
  Edge e{random_vector(random), random_vector(random), random_vector(random), uniform(random, -1, 1)};
  e.c *= e.C.norm() / e.c.norm() * std::exp(uniform(random, -1.1, 1.1));
  return e;
}

/// S^p and S^t (paper, eq. 37) for the normal speed c_n.
Matrix3d stabilisation(const Vector3d& c, double normal, double tangential) {
  const Matrix3d nn = c.normalized() * c.normalized().transpose();
  return normal * nn + tangential * (Matrix3d::Identity() - nn);
}

template <UpwindMetric metric>
double normal_speed(const Edge& e) {
  return metric == UpwindMetric::paper ? cp : cp * std::max(1.0, e.c.norm() / e.C.norm());
}

template <UpwindMetric metric>
EdgeCoefficientsOf<double> coefficients(const Edge& e, double speed_p = cp, double speed_s = cs) {
  return edge_coefficients(e.c.squaredNorm(), e.C.norm(), rho * speed_p, rho * speed_s, rho * speed_p,
                           metric == UpwindMetric::deformed);
}

Vector3d momentum(const EdgeCoefficientsOf<double>& s, const Edge& e) {
  return s.shear * e.d + s.normal * e.c.dot(e.d) * e.c;
}

template <UpwindMetric metric>
void expect_the_papers_matrices() {
  Random random(1);
  for (int k = 0; k < 500; ++k) {
    const Edge e = random_edge(random);
    const EdgeCoefficientsOf<double> s = coefficients<metric>(e);
    const double speed = normal_speed<metric>(e);
    const Vector3d D = e.C.norm() / 2 * stabilisation(e.c, speed, cs) * (rho * e.d);
    EXPECT_LE((momentum(s, e) - D).norm(), 1e-13 * rho * speed * e.C.norm());
    const double D_J = e.d_Sigma * e.c.dot(stabilisation(e.c, 1 / speed, 1 / cs) * e.c) / (2 * rho * e.C.norm());
    EXPECT_NEAR(s.volume * e.d_Sigma, D_J, 1e-13 * std::abs(D_J));
  }
}

template <UpwindMetric metric>
void expect_dissipation() {
  Random random(2);
  for (int k = 0; k < 500; ++k) {
    const Edge e = random_edge(random);
    const double speed_s = uniform(random, 0, cp);
    const EdgeCoefficientsOf<double> s = coefficients<metric>(e, cp, speed_s);
    EXPECT_GE(e.d.dot(momentum(s, e)), 0.499 * rho * speed_s * e.C.norm() * e.d.squaredNorm());
    EXPECT_GT(e.d_Sigma * s.volume * e.d_Sigma, 0);
  }
}

}  // namespace

TEST(Flux, StabilisationIsThePapersMatrices) { expect_the_papers_matrices<UpwindMetric::paper>(); }

TEST(Flux, DeformedMetricScalesThePressureSpeedByTheStretchOfTheArea) {
  expect_the_papers_matrices<UpwindMetric::deformed>();
}

TEST(Flux, StabilisationDissipates) {
  expect_dissipation<UpwindMetric::paper>(), expect_dissipation<UpwindMetric::deformed>();
}

TEST(Flux, MetricsAgreeBitwiseWhereTheAreaHasNotGrown) {
  Random random(3);
  int shrunk = 0;
  for (int k = 0; k < 500; ++k) {
    const Edge e = random_edge(random);
    const EdgeCoefficientsOf<double> p = coefficients<UpwindMetric::paper>(e),
                                     d = coefficients<UpwindMetric::deformed>(e);
    const bool grown = e.c.norm() > e.C.norm();
    shrunk += !grown;
    EXPECT_EQ(p.shear, d.shear);
    EXPECT_EQ(p.normal < d.normal, grown);
    EXPECT_EQ(p.volume > d.volume, grown);
    EXPECT_EQ(p.normal == d.normal && p.volume == d.volume, !grown);
  }
  EXPECT_GT(shrunk, 100);
}

TEST(Flux, AverageTractionAndAreaIsTheMeanOfBothEndsTimesC) {
  Random random(4);
  alignas(64) double a[24];
  alignas(64) double b[24];
  for (int k = 0; k < 24; ++k) {
    a[k] = uniform(random, -1, 1);
    b[k] = uniform(random, -1, 1);
  }
  const double C[3] = {0.3, -0.7, 0.2};
  const Vec8 PH_a[3] = {load8(a), load8(a + 8), load8(a + 16)};
  const Vec8 tc = average_traction_and_area(PH_a, b, C);
  for (int i = 0; i < 8; ++i) {
    double expected = 0;
    for (int I = 0; I < 3; ++I) expected += 0.5 * (a[8 * I + i] + b[8 * I + i]) * C[I];
    EXPECT_NEAR(tc[i], expected, 1e-15);
  }
}
