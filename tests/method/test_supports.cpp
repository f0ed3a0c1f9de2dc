// Supports: prescribed velocities are exact, held components stay held, rollers slide and corners hold.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "engine/time_function.hpp"
#include "scenes.hpp"

namespace nanson::method {
namespace {

std::vector<int> nodes_of(const Mesh& mesh, const std::string& patch) {
  std::vector<int> nodes;
  for (const Face& f : mesh.faces)
    if (f.patch >= 0 && mesh.patch_names[f.patch] == patch) nodes.insert(nodes.end(), f.nodes.begin(), f.nodes.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

const Constraint* constraint_of(const Simulation& s, int node) {
  for (const Constraint& h : s.domain.boundary.constraints)
    if (s.domain.order.node_of[h.node] == node) return &h;
  return nullptr;
}

std::vector<TimeFunction> every_time_function() {
  std::vector<TimeFunction> all(6);
  all[1].kind = TimeKind::ramp;
  all[1].until = 0.006;
  all[2].kind = TimeKind::sine;
  all[2].frequency = 70;
  all[2].phase = 0.4;
  all[3].kind = TimeKind::pulse;
  all[3].from = 0.003;
  all[3].until = 0.008;
  all[4].kind = TimeKind::logistic;
  all[4].rate = 800;
  all[4].centre = 0.005;
  all[4].until = 0.009;
  all[5].kind = TimeKind::table;
  all[5].points = {{0.001, 0.2}, {0.004, -1}, {0.0045, 0.7}, {0.009, 0}};
  return all;
}

TEST(PrescribedVelocity, IsExactAtEveryStepForEveryTimeFunction) {
  double worst = 0;
  for (auto integrator : integrators)
    for (const TimeFunction& f : every_time_function()) {
      Scene scene = free_bar(3);
      scene.boundary = {condition({"zmax"}, BoundaryKind::velocity), condition({"zmin"}, BoundaryKind::fixed)};
      scene.boundary[0].velocity = {4, 0, -9};
      scene.boundary[0].held = {true, false, true};
      scene.boundary[0].time = f;
      scene.time.integrator = integrator;
      scene.time.end = 0.012;
      scene.time.cfl = 0.1;
      const Problem problem(scene);
      const std::vector<int> driven = nodes_of(problem.mesh, "zmax");
      Simulation s = problem.start();
      double sideways = 0;
      Observer observer;
      observer.on_step = [&](const Simulation&) {
        for (int n : driven) {
          const double* v = U_of(s, n);
          worst = std::max({worst, std::abs(v[0] - 4 * value_at(f, s.state.t)) / 9,
                            std::abs(v[2] + 9 * value_at(f, s.state.t)) / 9});
          sideways = std::max(sideways, std::abs(v[1]));
        }
      };
      std::string reason;
      EXPECT_EQ(run(s, observer, reason), "done") << word(f.kind);
      EXPECT_GT(s.state.step, 60);
      EXPECT_GT(sideways, 1) << "the free component must move";
    }
  RecordProperty("worst", fmt::format("{:.3g}", worst));
  EXPECT_LT(worst, 1e-13);
}

/// The position of a driven face follows the trapezoidal rule of its velocity: exact for a ramp.
TEST(PrescribedVelocity, PositionOfARampIsExact) {
  Scene scene = free_bar(2);
  scene.initial.field = InitialField::rest;
  scene.boundary = {condition({"zmax"}, BoundaryKind::velocity)};
  scene.boundary[0].velocity = {0, 0, 10};
  scene.boundary[0].time.kind = TimeKind::ramp;
  scene.boundary[0].time.until = 1;
  for (auto integrator : integrators) {
    scene.time.integrator = integrator;
    const Problem problem(scene);
    Simulation s = problem.start();
    march(s, 50);
    for (int n : nodes_of(problem.mesh, "zmax"))
      EXPECT_NEAR(U_of(s, n)[15], 2 + 5 * s.state.t * s.state.t, 1e-14) << word(integrator);
  }
}

TEST(Supports, HeldComponentsStayHeld) {
  double worst = 0;
  for (const PhysicsSpec& physics : every_physics())
    for (auto integrator : integrators) {
      Scene scene = loaded_bar(3);
      scene.physics = physics;
      scene.time.integrator = integrator;
      const Problem problem(scene);
      Simulation s = problem.start();
      for (int i = 0; i < 60; ++i) {
        march(s, 1);
        for (int n : nodes_of(problem.mesh, "zmin"))
          for (int k = 0; k < 3; ++k) EXPECT_EQ(U_of(s, n)[k], 0) << name(physics);
        for (int n : nodes_of(problem.mesh, "xmin"))
          worst = std::max(worst, std::abs(U_of(s, n)[0]) / extrema(s).max_speed);
      }
    }
  RecordProperty("worst", fmt::format("{:.3g}", worst));
  EXPECT_LT(worst, 1e-14);
}

TEST(Supports, SymmetricAndSkewFacesOfTheCubeHold) {
  double normal = 0, tangential = 0, free = 0;
  for (auto integrator : integrators) {
    Scene scene = cube(6);
    scene.time.integrator = integrator;
    const Problem problem(scene);
    Simulation s = problem.start();
    for (int i = 0; i < 60; ++i) {
      march(s, 1);
      const double size = extrema(s).max_speed;
      for (int axis = 0; axis < 3; ++axis) {
        const std::string letter(1, static_cast<char>('x' + axis));
        for (int n : nodes_of(problem.mesh, letter + "min"))
          normal = std::max(normal, std::abs(U_of(s, n)[axis]) / size);
        for (int n : nodes_of(problem.mesh, letter + "max")) {
          for (int k : {(axis + 1) % 3, (axis + 2) % 3})
            tangential = std::max(tangential, std::abs(U_of(s, n)[k]) / size);
          free = std::max(free, std::abs(U_of(s, n)[axis]) / size);
        }
      }
    }
  }
  RecordProperty("held", fmt::format("{:.3g}, {:.3g}", normal, tangential));
  EXPECT_LT(normal, 1e-14);
  EXPECT_LT(tangential, 1e-14);
  EXPECT_GT(free, 0.9) << "a skew face moves along its normal";
}

/// Kinetic energy that the supports take from v(0) is reported, and is not part of the initial energy.
TEST(Supports, EnergyLostAtTheStartIsBooked) {
  Scene scene = free_bar(3);
  scene.initial.field = InitialField::velocity;
  scene.initial.v = {3, 4, 12};
  scene.boundary = {condition({"zmin"}, BoundaryKind::fixed)};
  const Problem problem(scene);
  Simulation s = problem.start();
  double held_mass = 0;
  for (int n : nodes_of(problem.mesh, "zmin")) held_mass += 1100 * s.domain.volume[n];
  EXPECT_NEAR(s.books.lost_at_start, 0.5 * held_mass * 169, 1e-9 * s.books.lost_at_start);
  EXPECT_NEAR(s.books.initial_energy + s.books.lost_at_start, 0.5 * 2200 * 169, 1e-9 * s.books.initial_energy);
}

/// A quarter of a tube: the box [1, 2] x [0, 1] x [0, 1] bent around z, x the radius, y the quarter turn.
Problem tube(int n) {
  Scene s;
  s.mesh.origin = {1, 0, 0};
  s.mesh.size = {1, 1, 1};
  s.mesh.cells = {2, n, 2};
  s.material.density = 1100;
  s.material.youngs_modulus = 17e6;
  s.material.poissons_ratio = 0.3;
  s.time.end = 0.01;
  RawMesh raw = make_box(s.mesh);
  for (Vec3& X : raw.X)
    X = {X[0] * std::cos(X[1] * std::numbers::pi / 2), X[0] * std::sin(X[1] * std::numbers::pi / 2), X[2]};
  return {s, mesh_of(std::move(raw))};
}

TEST(Roller, OnACurvedFaceHoldsOneDirectionOnly) {
  Problem p = tube(12);
  p.scene.boundary = {condition({"xmin"}, BoundaryKind::symmetric)};
  Simulation s = p.start();
  for (int n : nodes_of(p.mesh, "xmin")) {
    const Constraint* h = constraint_of(s, n);
    ASSERT_NE(h, nullptr);
    ASSERT_EQ(h->count, 1) << "node " << n << " of a smooth face is locked";
    const double radial = std::abs(h->d[0][0] * p.mesh.X[n][0] + h->d[0][1] * p.mesh.X[n][1]);  // radius 1
    EXPECT_GT(radial, std::cos(std::numbers::pi / 48 + 1e-12)) << "node " << n;                 // half a facet
    EXPECT_EQ(h->d[0][2], 0);
  }
}

TEST(Roller, SlidesAroundACurvedFace) {
  Problem p = tube(12);
  p.scene.boundary = {condition({"xmin", "xmax"}, BoundaryKind::symmetric)};
  p.scene.initial.field = InitialField::rotation;
  p.scene.initial.omega = {0, 0, 2};
  p.scene.initial.centre = Vec3{};
  Simulation s = p.start();
  EXPECT_LT(s.books.lost_at_start, 2e-3 * s.books.initial_energy);
  EXPECT_EQ(run_quietly(s), "done");
  double slowest = 1e300, fastest = 0;
  for (const char* face : {"xmin", "xmax"})
    for (int n : nodes_of(p.mesh, face)) {
      const Vec3& X = p.mesh.X[n];
      const double* v = U_of(s, n);
      const double r = std::hypot(X[0], X[1]), around = (X[0] * v[1] - X[1] * v[0]) / r;  // was 2 r
      slowest = std::min(slowest, around / (2 * r));
      fastest = std::max(fastest, around / (2 * r));
    }
  RecordProperty("speed", fmt::format("{:.3f} to {:.3f}", slowest, fastest));
  EXPECT_GT(slowest, 0.75);
  EXPECT_LT(fastest, 1.25);
}

TEST(Roller, EdgesOfTwoPatchesHoldTwoDirectionsAndCornersThree) {
  Problem p = tube(12);
  p.scene.boundary = {condition({"xmin", "ymin"}, BoundaryKind::symmetric),
                      condition({"zmin"}, BoundaryKind::symmetric)};
  Simulation s = p.start();
  int held[4] = {};
  for (int n = 0; n < s.domain.order.nodes; ++n) {
    const Vec3& X = p.mesh.X[n];
    const int expected = (std::hypot(X[0], X[1]) < 1 + 1e-9) + (std::abs(X[1]) < 1e-9) + (std::abs(X[2]) < 1e-9);
    const Constraint* h = constraint_of(s, n);
    EXPECT_EQ(h ? h->count : 0, expected) << "node " << n;
    ++held[expected];
    for (int a = 0; h && a < h->count; ++a)
      for (int b = 0; b < h->count; ++b)
        EXPECT_NEAR(h->d[a][0] * h->d[b][0] + h->d[a][1] * h->d[b][1] + h->d[a][2] * h->d[b][2], a == b, 1e-14);
  }
  EXPECT_EQ(held[3], 1);
  EXPECT_EQ(held[2], 2 + 2 + 12);  // corner excepted: edges of 3, 3 and 13 nodes
  p.scene.initial.field = InitialField::velocity;
  p.scene.initial.v = {1, 2, 3};
  Simulation moving = p.start();
  march(moving, 50);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(U_of(moving, 0)[k], 0, 1e-14);  // node 0 is the corner
}

/// Two faces of one patch that meet at one degree: their edge holds two directions, not one averaged normal.
TEST(Roller, TipOfAOneDegreeWedgeHoldsTwoDirections) {
  const double high = std::tan(std::numbers::pi / 180);
  RawMesh raw;
  raw.X = {{0, 0, 0}, {1, 0, 0}, {1, high, 0}, {0, 0, 1}, {1, 0, 1}, {1, high, 1}};
  raw.tets = {{0, 1, 2, 5}, {0, 1, 5, 4}, {0, 4, 5, 3}};
  raw.tet_region = {0, 0, 0};
  raw.region_names = {"wedge"};
  raw.patch_names = {"sides"};
  for (const auto& t : {std::array{0, 1, 4}, {0, 4, 3}, {0, 2, 5}, {0, 5, 3}}) {
    raw.triangles.push_back(t);
    raw.triangle_patch.push_back(0);
  }
  Problem p(tube(1).scene, mesh_of(std::move(raw)));
  p.scene.boundary = {condition({"sides"}, BoundaryKind::symmetric)};
  const Simulation s = p.start();
  for (int n = 0; n < 6; ++n) {
    const Constraint* h = constraint_of(s, n);
    ASSERT_NE(h, nullptr);
    EXPECT_EQ(h->count, n == 0 || n == 3 ? 2 : 1) << "node " << n;
    for (int m = 0; m < h->count; ++m) EXPECT_NEAR(h->d[m][2], 0, 1e-15);
  }
}

}  // namespace
}  // namespace nanson::method
