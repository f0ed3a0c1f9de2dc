// Initial fields and exact solutions: motion, wave equation and boundary conditions by differences.
#include "engine/initial.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "engine/material.hpp"
#include "kernels/materials/linear_elastic.hpp"
#include "tests/unit/meshes.hpp"
#include "tests/unit/random_tensor.hpp"

using namespace nanson;
using namespace nanson::test;

namespace {

constexpr double pi = std::numbers::pi;

Scene elastic(InitialField field) {
  Scene s;
  s.material.law = Law::linear_elastic;
  s.material.density = 1100;
  s.material.youngs_modulus = 17e6;
  s.material.poissons_ratio = 0.45;
  s.initial.field = field;
  s.initial.amplitude = 5e-4;
  return s;
}

/// A travelling pulse in an oblique direction.
Scene travelling() {
  Scene s = elastic(InitialField::plane_wave);
  s.initial.length = 0.4;
  s.initial.direction = {2.0 / 3, -1.0 / 3, 2.0 / 3};
  return s;
}

constexpr Extent extent{{-1, 0.5, 2}, {1, 3.5, 3.5}};
constexpr Vec3 middle{0, 2, 2.75};  // of that box

/// Fourth-order central difference of f(s) at 0.
double slope(const std::function<double(double)>& f, double h) {
  return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
}

Vec3 moved(Vec3 X, int axis, double h) {
  X[axis] += h;
  return X;
}

Tensor<double> stress(const Scene& scene, const Vec3& X, double t) {
  const PointState p = exact_solution(scene, extent, X, t);
  Tensor<double> F;
  for (int k = 0; k < 9; ++k) F.a[k / 3][k % 3] = p.F[k / 3][k % 3];
  return Material<Law::linear_elastic, Volumetric::quadratic, Isochoric::F, Formulation::pF>::stress(
             F, F, 1.0, constants_of(scene.material))
      .P;
}

using Displacement = std::function<double(int, const Vec3&, double)>;

/// u, F = I + grad u and v = du/dt at random points and times. `length` and `time` are the scales of the field.
void expect_motion(const Scene& scene, const Displacement& u, const std::function<Vec3(Random&)>& point, double length,
                   double time) {
  Random random(1);
  const double U = scene.initial.amplitude;
  for (int k = 0; k < 200; ++k) {
    const Vec3 X = point(random);
    const double t = uniform(random, 0, time);
    const PointState p = exact_solution(scene, extent, X, t);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(p.u[i], u(i, X, t), 1e-12 * U);
      EXPECT_NEAR(p.v[i], slope([&](double h) { return u(i, X, t + h); }, 1e-3 * time), 1e-6 * U / time);
      for (int I = 0; I < 3; ++I)
        EXPECT_NEAR(p.F[i][I] - (i == I), slope([&](double h) { return u(i, moved(X, I, h), t); }, 1e-3 * length),
                    1e-6 * U / length);
    }
  }
}

/// rho dv/dt = Div P at random points and times.
void expect_wave_equation(const Scene& scene, const std::function<Vec3(Random&)>& point, double length, double time) {
  Random random(2);
  const double rho = scene.material.density;
  for (int k = 0; k < 200; ++k) {
    const Vec3 X = point(random);
    const double t = uniform(random, 0, time);
    for (int i = 0; i < 3; ++i) {
      const double force = rho
                           * slope([&](double h) { return exact_solution(scene, extent, X, t + h).v[i]; }, 1e-3 * time);
      double divergence = 0;
      for (int I = 0; I < 3; ++I)
        divergence += slope([&](double h) { return stress(scene, moved(X, I, h), t)[i][I]; }, 1e-3 * length);
      EXPECT_NEAR(force, divergence, 1e-5 * rho * scene.initial.amplitude / (time * time));
    }
  }
}

Vec3 in_unit_cube(Random& random) { return {uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1)}; }

double standing_displacement(int i, const Vec3& X, double t) {
  const double cp = constants_of(elastic(InitialField::standing_wave).material).cp;
  double product = 5e-4 * std::cos(std::sqrt(3.0) / 2 * cp * pi * t);
  for (int k = 0; k < 3; ++k) product *= k == i ? std::sin(pi * X[k] / 2) : std::cos(pi * X[k] / 2);
  return product;
}

double along(const Vec3& X) { return (2 * X[0] - (X[1] - 2) + 2 * (X[2] - 2.75)) / 3; }

double travelling_displacement(int i, const Vec3& X, double t) {
  const Scene scene = travelling();
  const double s = (along(X) - constants_of(scene.material).cp * t) / 0.4;
  return std::abs(s) < 1 ? 5e-4 * std::pow(1 - s * s, 4) * scene.initial.direction[i] : 0.0;
}

Vec3 around_the_centre(Random& random) {
  return {uniform(random, -0.5, 0.5), uniform(random, 1.5, 2.5), uniform(random, 2.25, 3.25)};
}

const double cube_time = 1 / constants_of(elastic(InitialField::standing_wave).material).cp,
             pulse_time = 0.3 * cube_time;  // [s]

}  // namespace

TEST(StandingWave, IsAMotion) {
  expect_motion(elastic(InitialField::standing_wave), standing_displacement, in_unit_cube, 1, cube_time);
}

TEST(StandingWave, SatisfiesTheWaveEquation) {
  expect_wave_equation(elastic(InitialField::standing_wave), in_unit_cube, 1, cube_time);
}

// Symmetric on X_i = 0: no normal velocity, no shear traction. Skew-symmetric on X_i = 1: no tangential velocity, no normal traction.
TEST(StandingWave, HoldsItsBoundaryConditions) {
  const Scene scene = elastic(InitialField::standing_wave);
  const double stress_scale = constants_of(scene.material).kappa * scene.initial.amplitude,
               v_scale = scene.initial.amplitude / cube_time;
  Random random(3);
  for (int k = 0; k < 100; ++k)
    for (int i = 0; i < 3; ++i) {
      Vec3 X = in_unit_cube(random);
      const double t = uniform(random, 0, 3 * cube_time);
      X[i] = 0;
      EXPECT_NEAR(exact_solution(scene, extent, X, t).v[i], 0, 1e-14 * v_scale);
      for (int j = 1; j < 3; ++j) EXPECT_NEAR(stress(scene, X, t)[(i + j) % 3][i], 0, 1e-9 * stress_scale);
      X[i] = 1;
      for (int j = 1; j < 3; ++j) EXPECT_NEAR(exact_solution(scene, extent, X, t).v[(i + j) % 3], 0, 1e-14 * v_scale);
      EXPECT_NEAR(stress(scene, X, t)[i][i], 0, 1e-9 * stress_scale);
    }
}

TEST(StandingWave, StartsAtRestWithItsAmplitude) {
  const Scene scene = elastic(InitialField::standing_wave);
  const PointState p = initial_state(scene, extent, {0, 0, 0}, {});
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(p.v[i], 0);
    EXPECT_NEAR(p.F[i][i], 1 + 5e-4 * pi / 2, 1e-15);
  }
}

TEST(PlaneWave, IsAMotion) { expect_motion(travelling(), travelling_displacement, around_the_centre, 0.4, pulse_time); }

TEST(PlaneWave, SatisfiesTheWaveEquation) { expect_wave_equation(travelling(), around_the_centre, 0.4, pulse_time); }

TEST(PlaneWave, StartsAtTheMiddleOfTheMeshAndTravelsWithThePressureSpeed) {
  EXPECT_EQ(extent_of(box({2, 3, 2}, Split::kuhn, 0.1)).middle(), middle);
  const Scene scene = travelling();
  const Vec3 n = scene.initial.direction;
  const auto at = [&](double s, double t) {
    return exact_solution(scene, extent, {middle[0] + s * n[0], middle[1] + s * n[1], middle[2] + s * n[2]}, t);
  };
  const double t = 0.001, way = constants_of(scene.material).cp * t;
  for (const double s : {-0.39, -0.2, 0.0, 0.1, 0.39})
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(at(s, 0).v[i], at(s + way, t).v[i], 1e-12 * std::abs(at(0.2, 0).v[0]));
  for (const double s : {-0.41, 0.41, 5.0}) {
    EXPECT_EQ(at(s, 0).v, Vec3{});
    EXPECT_EQ(at(s, 0).F[0][0], 1);
  }
  EXPECT_GT(dot(at(0.2, 0).v, n), 0);  // the front half moves on, the rear half comes back
  EXPECT_LT(dot(at(-0.2, 0).v, n), 0);
}

TEST(InitialState, RestAndUniformVelocityAreUndeformed) {
  Scene scene;
  EXPECT_EQ(initial_state(scene, extent, {1, 2, 3}, {}).v, Vec3{});
  scene.initial.field = InitialField::velocity;
  scene.initial.v = {1, -2, 3};
  const PointState p = initial_state(scene, extent, {4, 5, 6}, {});
  EXPECT_EQ(p.v, (Vec3{1, -2, 3}));
  for (int k = 0; k < 9; ++k) EXPECT_EQ(p.F[k / 3][k % 3], k % 4 == 0);
  EXPECT_FALSE(has_exact_solution(scene));
}

TEST(InitialState, RotationIsOmegaCrossTheArmFromTheCentre) {
  Scene scene;
  scene.initial.field = InitialField::rotation;
  scene.initial.omega = {1, 2, 3};
  EXPECT_EQ(initial_state(scene, extent, {5, 7, 9}, {4, 5, 6}).v, (Vec3{2 * 3 - 3 * 2, 3 * 1 - 1 * 3, 1 * 2 - 2 * 1}));
  scene.initial.omega = {0, 0, 2};
  EXPECT_EQ(initial_state(scene, extent, {5, 7, 9}, {4, 5, 6}).v, (Vec3{-4, 2, 0}));
  scene.initial.centre = Vec3{5, 6, 0};  // in place of the centre of mass
  EXPECT_EQ(initial_state(scene, extent, {5, 7, 9}, {4, 5, 6}).v, (Vec3{-2, 0, 0}));
}

TEST(InitialState, TwistGrowsAsAQuarterSineOverTheHeight) {
  Scene scene;
  scene.initial.field = InitialField::twist;
  scene.initial.twist_omega = 105;
  scene.initial.height = 6;
  EXPECT_EQ(initial_state(scene, extent, {0.5, 0.25, 0}, {}).v, Vec3{});
  for (const double share : {1.0 / 3, 1.0}) {
    const Vec3 v =
        initial_state(scene, extent, {0.5, 0.25, 6 * share}, {9, 9, 9}).v;  // about the Z axis, not the centre of mass
    const double omega = 105 * (share == 1 ? 1 : 0.5);
    EXPECT_NEAR(v[0], -0.25 * omega, 1e-12);
    EXPECT_NEAR(v[1], 0.5 * omega, 1e-12);
    EXPECT_EQ(v[2], 0);
  }
}

TEST(InitialState, PlateModeIsTheFirstFreeBendingModeOfTheBeryllium) {
  Scene scene;
  scene.initial.field = InitialField::plate_mode;
  scene.initial.amplitude = 4.3369e-7;  // lengths in m (method, section 12)
  scene.initial.mode_omega = 2.36e5;
  scene.initial.B = 78.834;
  const double unit = 4.3369e-7 * 2.36e5;
  const Extent plate{{-0.005, -0.03, -0.005}, {0.005, 0.03, 0.005}};
  const auto v = [&](double Y) { return initial_state(scene, plate, {0.001, Y, -0.002}, {}).v; };
  EXPECT_NEAR(v(-0.03)[2], -2 * 57.646 * unit, 1e-12 * unit);
  for (const double Y : {-0.03, -0.02, -0.01, 0.0})
    EXPECT_NEAR(v(Y)[2], v(-Y)[2], 0.02 * 2 * 57.646 * unit);  // symmetric, to the digits of g1 and g2
  EXPECT_NEAR(v(0)[2] / v(-0.03)[2], -0.6078, 1e-3);           // middle over end
  const double node = 0.06 * (0.5 - 0.22416);
  EXPECT_NEAR(v(node)[2], 0, 0.02 * 2 * 57.646 * unit);
  EXPECT_NEAR(v(-node)[2], 0, 0.001 * 2 * 57.646 * unit);
  const Extent moved{{-0.005, 0.97, -0.005}, {0.005, 1.03, 0.005}};
  EXPECT_NEAR(initial_state(scene, moved, {0, 1, 0}, {}).v[2], v(0)[2], 1e-9 * unit)
      << "the mode is the plate's, wherever it lies";
  EXPECT_EQ(v(0.02)[0], 0);
  EXPECT_EQ(v(0.02)[1], 0);
}

TEST(InitialJ, IsLinearOnlyForTheExactSolutionsOfLinearElasticity) {
  const double F[3][3] = {{1.1, 0.2, 0}, {0.3, 0.9, 0}, {0, 0, 1.2}};
  Scene scene = elastic(InitialField::standing_wave);
  EXPECT_NEAR(initial_J(scene, F), 1 + 0.1 - 0.1 + 0.2, 1e-15);
  scene.initial.J = InitialJ::det;
  EXPECT_NEAR(initial_J(scene, F), (1.1 * 0.9 - 0.06) * 1.2, 1e-15);
  scene = elastic(InitialField::twist);
  EXPECT_NEAR(initial_J(scene, F), (1.1 * 0.9 - 0.06) * 1.2, 1e-15);
}
