// Time factors of loads and prescribed velocities, against closed values.
#include "engine/time_function.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace nanson;

namespace {

TimeFunction of(TimeKind kind) {
  TimeFunction f;
  f.kind = kind;
  return f;
}

TimeFunction table(std::vector<std::pair<double, double>> points) {
  TimeFunction f = of(TimeKind::table);
  f.points = std::move(points);
  return f;
}

}  // namespace

TEST(TimeFunction, IsOneWhereNothingIsSaid) {
  for (const double t : {0.0, 1e-9, 3.0, 1e9}) EXPECT_EQ(value_at(TimeFunction{}, t), 1);
}

TEST(TimeFunction, RampGrowsToOneAndStays) {
  TimeFunction f = of(TimeKind::ramp);
  f.until = 0.4;
  EXPECT_EQ(value_at(f, 0), 0);
  EXPECT_DOUBLE_EQ(value_at(f, 0.1), 0.25);
  EXPECT_DOUBLE_EQ(value_at(f, 0.3), 0.75);
  EXPECT_EQ(value_at(f, 0.4), 1);
  EXPECT_EQ(value_at(f, 17), 1);
  EXPECT_EQ(value_at(f, -1), 0);
}

TEST(TimeFunction, SineHasItsFrequencyInHertzAndItsPhaseInRadians) {
  TimeFunction f = of(TimeKind::sine);
  f.frequency = 50;
  EXPECT_EQ(value_at(f, 0), 0);
  EXPECT_NEAR(value_at(f, 0.005), 1, 1e-15);
  EXPECT_NEAR(value_at(f, 0.015), -1, 1e-15);
  EXPECT_NEAR(value_at(f, 0.02), 0, 1e-14);
  EXPECT_NEAR(value_at(f, 0.02 / 12), 0.5, 1e-15);
  f.phase = std::numbers::pi / 2;
  EXPECT_NEAR(value_at(f, 0), 1, 1e-15);
  EXPECT_NEAR(value_at(f, 0.01), -1, 1e-15);
}

TEST(TimeFunction, PulseIsOneFromItsStartUntilBeforeItsEnd) {
  TimeFunction f = of(TimeKind::pulse);
  f.from = 1;
  f.until = 2;
  EXPECT_EQ(value_at(f, std::nextafter(1, 0)), 0);
  EXPECT_EQ(value_at(f, 1), 1);
  EXPECT_EQ(value_at(f, std::nextafter(2, 0)), 1);
  EXPECT_EQ(value_at(f, 2), 0);
}

TEST(TimeFunction, LogisticIsOneAtItsCentreAndItsFormulaAround) {
  TimeFunction f = of(TimeKind::logistic);
  f.rate = 3;
  f.centre = 2;
  f.until = 100;
  EXPECT_EQ(value_at(f, 2), 1);
  for (const double t : {0.0, 0.5, 1.9, 2.1, 3.0, 5.0}) {
    const double g = std::exp(3 * (2 - t));
    EXPECT_NEAR(value_at(f, t), 4 * g / ((1 + g) * (1 + g)), 1e-15);
  }
}

TEST(TimeFunction, LogisticIsSymmetricAboutItsCentre) {
  TimeFunction f = of(TimeKind::logistic);
  f.rate = 7;
  f.centre = 2;
  f.until = 100;
  for (const double s : {0.125, 0.5, 1.0, 1.75}) EXPECT_EQ(value_at(f, 2 - s), value_at(f, 2 + s));
}

TEST(TimeFunction, LogisticNeverOverflows) {
  TimeFunction f = of(TimeKind::logistic);
  f.rate = 1e6;
  f.centre = 1;
  f.until = 1e9;
  for (const double t :
       {0.0, 0.999, 2.0, 1e9}) {  // g = exp(1e6) overflows at t = 0 where the formula is taken as it stands
    EXPECT_GE(value_at(f, t), 0);
    EXPECT_LT(value_at(f, t), 1e-300);
  }
  f.rate = -1e6;
  EXPECT_EQ(value_at(f, 0), 0);
  EXPECT_EQ(value_at(f, 1), 1);
}

TEST(TimeFunction, LogisticEndsAfterItsLastTime) {
  TimeFunction f = of(TimeKind::logistic);
  f.rate = 1;
  f.centre = 2;
  f.until = 2;
  EXPECT_EQ(value_at(f, 2), 1);
  EXPECT_EQ(value_at(f, std::nextafter(2, 3)), 0);
}

TEST(TimeFunction, TableIsLinearBetweenItsPoints) {
  const TimeFunction f = table({{0, 1}, {2, 5}, {3, -1}});
  EXPECT_EQ(value_at(f, 0), 1);
  EXPECT_EQ(value_at(f, 0.5), 2);
  EXPECT_EQ(value_at(f, 2), 5);
  EXPECT_EQ(value_at(f, 2.5), 2);
  EXPECT_EQ(value_at(f, 3), -1);
}

TEST(TimeFunction, TableIsConstantOutsideItsRange) {
  const TimeFunction f = table({{1, 4}, {2, 6}});
  EXPECT_EQ(value_at(f, -1e9), 4);
  EXPECT_EQ(value_at(f, 0.999), 4);
  EXPECT_EQ(value_at(f, 2.001), 6);
  EXPECT_EQ(value_at(f, 1e9), 6);
  for (const double t : {0.0, 1.0, 2.0}) EXPECT_EQ(value_at(table({{1, 3}}), t), 3);
}
