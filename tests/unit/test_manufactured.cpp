// The manufactured motion: v and F of one motion, and the body force against differences of the stress in space and of the velocity in time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/manufactured.hpp"
#include "engine/material.hpp"
#include "kernels/manufactured.hpp"
#include "tests/unit/scene_text.hpp"

namespace nanson {
namespace {

Scene scene_of(Law law, Volumetric volumetric) {
  Scene s;
  s.material.law = law;
  s.material.volumetric = volumetric;
  s.material.density = 1100;
  s.material.youngs_modulus = 17e6;
  s.material.poissons_ratio = 0.45;
  s.material.xi = law == Law::mooney_rivlin ? 5e5 : 0;
  s.initial.field = InitialField::manufactured;
  s.initial.amplitudes = {0.1, -0.07, 0.12};
  s.initial.length = 1.3;
  s.initial.period = 0.007;
  return s;
}

Vec3 displacement(const Scene& s, const Vec3& X, double t) {
  Vec3 u;
  for (int i = 0; i < 3; ++i) {
    const double pi = std::acos(-1.0);
    u[i] = s.initial.amplitudes[i] * std::cos(2 * pi * t / s.initial.period);
    for (int m = 0; m < 3; ++m)
      u[i] *= m == i ? std::sin(pi * X[m] / s.initial.length) : std::cos(pi * X[m] / s.initial.length);
  }
  return u;
}

/// Fourth order difference of f about 0.
template <class F>
double slope(F f, double h) {
  return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
}

Vec3 shifted(Vec3 X, int k, double h) {
  X[k] += h;
  return X;
}

TEST(Manufactured, VelocityAndDeformationAreThoseOfOneMotion) {
  const Scene s = scene_of(Law::neo_hookean, Volumetric::quadratic);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> at(-1, 1), when(0, 0.01);
  for (int sample = 0; sample < 20; ++sample) {
    const Vec3 X{at(random), at(random), at(random)};
    const double t = when(random);
    const PointState p = manufactured_solution(s, X, t);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(p.u[i], displacement(s, X, t)[i], 1e-14);
      EXPECT_NEAR(p.v[i], slope([&](double h) { return displacement(s, X, t + h)[i]; }, 1e-5), 1e-6);
      for (int I = 0; I < 3; ++I)
        EXPECT_NEAR(p.F[i][I] - (i == I),
                    slope([&](double h) { return displacement(s, shifted(X, I, h), t)[i]; }, 1e-3), 1e-9);
    }
  }
}

TEST(Manufactured, BodyForceBalancesMomentumForEveryLaw) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> at(0, 1), when(0, 0.01);
  for (const auto& [law, volumetric] : {std::pair(Law::linear_elastic, Volumetric::quadratic),
                                        {Law::neo_hookean, Volumetric::quadratic},
                                        {Law::neo_hookean, Volumetric::barrier},
                                        {Law::mooney_rivlin, Volumetric::quadratic},
                                        {Law::mooney_rivlin, Volumetric::barrier}}) {
    const Scene s = scene_of(law, volumetric);
    const MaterialConstants m = constants_of(s.material);
    RawMesh raw;
    for (int n = 0; n < 8; ++n) raw.X.push_back({at(random), at(random), at(random)});
    Mesh mesh;
    mesh.X = raw.X;
    Order order;
    order.rows = 8;
    order.node_of = {0, 1, 2, 3, 4, 5, 6, 7};
    const Manufactured force = make_manufactured(s, mesh, order);
    const double t = when(random);
    alignas(64) double X[8 * row::X] = {}, f[8 * 4] = {};
    for (int n = 0; n < 8; ++n) X[row::X * n + 3] = 1 / (0.5 + n);  // {X, 1/Omega}
    add_manufactured_force(force, s, m, {0, 8, 0, 0, 0, 0, 0, 0}, X, t, f);
    for (int n = 0; n < 8; ++n)
      for (int i = 0; i < 3; ++i) {
        double expected = slope([&](double h) { return manufactured_solution(s, mesh.X[n], t + h).v[i]; }, 1e-5);
        for (int I = 0; I < 3; ++I)
          expected -= slope(
                          [&](double h) {
                            return exact_stress(s.material, m,
                                                manufactured_solution(s, shifted(mesh.X[n], I, h), t))[i][I];
                          },
                          1e-3)
                      / m.rho;
        EXPECT_NEAR(f[4 * n + i] / (m.rho * (0.5 + n)), expected, 1e-6 * std::max(1e5, std::abs(expected)))
            << word(law) << ' ' << word(volumetric);
      }
  }
}

TEST(Manufactured, PlanesOfSymmetryAreHeldExactly) {
  const Scene s = scene_of(Law::neo_hookean, Volumetric::quadratic);
  for (const double X : {0.0, s.initial.length, -s.initial.length, 3 * s.initial.length})
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(manufactured_solution(s,
                                      shifted({0.3, 0.2, 0.4}, k,
                                              X
                                                  - (k == 0   ? 0.3
                                                     : k == 1 ? 0.2
                                                              : 0.4)),
                                      1e-3)
                    .v[k],
                0.0);
}

TEST(Manufactured, ScenesThatAreNotExactAreRefused) {
  const std::string base = R"(scene = "m"
[mesh]
box = { origin = [0, 0, 0], size = [1, 2, 1] }
cells = [2, 4, 2]
[material]
law = "neo_hookean"
density = 1000
youngs_modulus = 1e6
poissons_ratio = 0.3
[physics]
formulation = "pFJ"
[initial]
field = "manufactured"
amplitudes = [0.1, 0.1, 0.1]
length = 1
period = 0.1
[[boundary]]
face = ["xmin", "xmax", "ymin", "ymax", "zmin", "zmax"]
kind = "symmetric"
[time]
end = 0.1
[monitor]
energy = false
)";
  EXPECT_TRUE(read_text(base).errors.empty()) << joined(read_text(base).errors);
  const auto refused = [&](const std::string& from, const std::string& to, const std::string& error) {
    const SceneResult r = read_text(edited(base, from, to));
    ASSERT_EQ(r.errors.size(), 1u) << error << joined(r.errors);
    EXPECT_TRUE(r.errors[0].starts_with(error)) << error << joined(r.errors);
  };
  refused("\"pFJ\"", "\"pFp\"", "scene.toml:11:15: physics.formulation = \"pFp\": has no exact solution");
  refused("length = 1", "length = 0.7",
          "scene.toml:15:10: initial.length = 0.7: the faces of mesh.box must lie on multiples of it");
  refused("\"symmetric\"", "\"fixed\"",
          "scene.toml:13:9: initial.field = \"manufactured\": needs kind = \"symmetric\" on all six faces");
  refused("\"ymin\", ", "",
          "scene.toml:13:9: initial.field = \"manufactured\": needs kind = \"symmetric\" on all six faces");
  EXPECT_TRUE(read_text(edited(base, "energy = false", "energy = true")).errors.empty());
  EXPECT_TRUE(read_text(edited(base, "formulation = \"pFJ\"", "keep_angular_momentum = true")).errors.empty());
  refused("period = 0.1", "", "scene.toml:12:1: initial.period: is missing");
}

}  // namespace
}  // namespace nanson
