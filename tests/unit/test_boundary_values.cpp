// Prescribed velocities along joined directions, which face books a direction, and loads.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/supported.hpp"

using namespace nanson;
using namespace nanson::test;

namespace {

constexpr std::array<bool, 3> x_only{true, false, false}, y_only{false, true, false}, z_only{false, false, true},
    not_y{true, false, true};

/// One tet without a face along an axis; faces a, b, c meet at node 0, face d is the one opposite.
RawMesh oblique_tet() {
  RawMesh raw;
  raw.X = {{0, 0, 0}, {1, 0.1, -0.2}, {0.2, 1, 0.3}, {0.3, 0.4, 1}};
  raw.tets = {{0, 1, 2, 3}};
  raw.tet_region = {0};
  raw.region_names = {"all"};
  raw.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
  raw.triangle_patch = {0, 1, 2, 3};
  raw.patch_names = {"a", "b", "c", "d"};
  return raw;
}

Vec3 unit_normal(const Mesh& mesh, int p, int q, int r) {
  Vec3 n = cross((mesh.X[q] - mesh.X[p]), (mesh.X[r] - mesh.X[p]));
  const double size = norm(n);
  for (double& x : n) x /= size;
  return n;
}

}  // namespace

TEST(BoundaryVelocity, LeavesAFreeComponentFree) {
  const Supported s(raw_box({2, 2, 2}), {{{"zmax"}, BoundaryKind::velocity, {4, 9, -5}, not_y}});
  for (int n = 0; n < s.order.nodes; ++n) {
    const Constraint h = s.at(n);
    const bool on_face = std::abs(s.mesh.X[n][2] - 3.5) < 1e-12;
    ASSERT_EQ(h.count, on_face ? 2 : 0);
    if (!on_face) continue;
    EXPECT_EQ(free_part(h, {0, 1, 0}), 1);
    const Vec3 v = prescribed(h, {0.5}), expected{2, 0, -2.5};
    EXPECT_EQ(v, expected);
  }
}

TEST(BoundaryVelocity, ReproducesItsComponentsOnObliqueDirectionsInEveryOrder) {
  const std::vector<Condition> conditions = {{{"a"}, BoundaryKind::velocity, {2, 0, 0}, x_only},
                                             {{"b"}, BoundaryKind::symmetric},
                                             {{"c"}, BoundaryKind::velocity, {0, -3, 0}, y_only}};
  std::vector<int> order = {0, 1, 2};
  do {
    const Supported s(oblique_tet(), {conditions[order[0]], conditions[order[1]], conditions[order[2]]});
    const Constraint h = s.at(0);
    ASSERT_EQ(h.count, 3);
    expect_orthonormal(h);
    std::vector<double> factor(3);
    const double of_condition[3] = {0.7, 99, 1.9};  // the roller's factor must not enter
    for (int k = 0; k < 3; ++k) factor[k] = of_condition[order[k]];
    const Vec3 v = prescribed(h, factor), n = unit_normal(s.mesh, 0, 1, 3);
    EXPECT_NEAR(v[0], 2 * 0.7, 1e-14);
    EXPECT_NEAR(v[1], -3 * 1.9, 1e-14);
    EXPECT_NEAR(dot(v, n), 0, 1e-14);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(BoundaryVelocity, ReproducesItsComponentBetweenTwoRollers) {
  const Supported s(oblique_tet(),
                    {{{"a", "c"}, BoundaryKind::symmetric}, {{"b"}, BoundaryKind::velocity, {0, 0, 1.5}, z_only}});
  const Constraint h = s.at(0);
  ASSERT_EQ(h.count, 3);
  const Vec3 v = prescribed(h, {99, 2});
  EXPECT_NEAR(v[2], 3, 1e-13);
  EXPECT_NEAR(dot(v, unit_normal(s.mesh, 0, 1, 2)), 0, 1e-14);
  EXPECT_NEAR(dot(v, unit_normal(s.mesh, 0, 2, 3)), 0, 1e-14);
  const Vec3 two = prescribed(s.at(1), {99, 2});  // node 1 lies on a and b only
  EXPECT_EQ(s.at(1).count, 2);
  EXPECT_NEAR(two[2], 3, 1e-13);
  EXPECT_NEAR(dot(two, unit_normal(s.mesh, 0, 1, 2)), 0, 1e-14);
}

TEST(BoundaryVelocity, ThreeConditionsOnOneNodeKeepTheirOwnFactors) {
  const Supported s(oblique_tet(), {{{"a"}, BoundaryKind::velocity, {1, 0, 0}, x_only},
                                    {{"b"}, BoundaryKind::velocity, {0, 1, 0}, y_only},
                                    {{"c"}, BoundaryKind::velocity, {0, 0, 1}, z_only}});
  const Vec3 v = prescribed(s.at(0), {2, 3, 5}), expected{2, 3, 5};
  EXPECT_EQ(v, expected);
}

TEST(BoundaryConflict, TheFirstFaceOfTheSceneBooksTheDirection) {
  const Condition up{{"zmin"}, BoundaryKind::velocity, {0, 0, 1}, z_only},
      away{{"xmin"}, BoundaryKind::velocity, {3, 0, 2}, not_y};
  const int corner = 0;  // on both faces
  {
    const Supported s(raw_box({2, 2, 2}), {up, away});
    const Constraint h = s.at(corner);
    ASSERT_EQ(h.count, 2);
    const Vec3 v = prescribed(h, {1, 10}), expected{30, 0, 1};
    EXPECT_EQ(v, expected);
    EXPECT_EQ(h.face[0], 0);
    EXPECT_EQ(h.face[1], 1);
    EXPECT_EQ(s.boundary.held_faces, (std::vector<std::string>{"zmin", "xmin"}));
  }
  {
    const Supported s(raw_box({2, 2, 2}), {away, up});
    const Constraint h = s.at(corner);
    ASSERT_EQ(h.count, 2);
    const Vec3 v = prescribed(h, {10, 1}), expected{30, 0, 20};
    EXPECT_EQ(v, expected);
    EXPECT_EQ(h.face[0], 0);
    EXPECT_EQ(h.face[1], 0);
    EXPECT_EQ(s.boundary.held_faces, (std::vector<std::string>{"xmin", "zmin"}));
  }
}

TEST(BoundaryConflict, ARollerAfterAClampAddsNothing) {
  const Supported s(raw_box({2, 2, 2}), {{{"zmin"}, BoundaryKind::fixed}, {{"xmin", "ymin"}, BoundaryKind::symmetric}});
  const Constraint h = s.at(0);
  ASSERT_EQ(h.count, 3);
  for (int m = 0; m < 3; ++m) EXPECT_EQ(h.face[m], 0);
  EXPECT_EQ(s.boundary.held_faces.size(), 3u);
}

TEST(BoundaryConflict, AnObliqueRollerBeforeAClampIsCompletedByIt) {
  const Supported s(oblique_tet(), {{{"a"}, BoundaryKind::symmetric}, {{"b"}, BoundaryKind::fixed}});
  const Constraint h = s.at(0);
  ASSERT_EQ(h.count, 3);
  expect_orthonormal(h);
  EXPECT_NEAR(
      free_part({.node = 0, .count = 1, .d = {{h.d[0][0], h.d[0][1], h.d[0][2]}}}, unit_normal(s.mesh, 0, 1, 2)), 0,
      1e-15);
  EXPECT_EQ(h.face[0], 0);
  EXPECT_EQ(h.face[1], 1);
  EXPECT_EQ(h.face[2], 1);
}

TEST(BoundaryLoads, EveryLoadedFaceHasOneRowAndCarriesAThirdOfItsTractionOnEachCorner) {
  Scene scene = scene_of({{{"zmax"}, BoundaryKind::traction},
                          {{"zmax", "xmin"}, BoundaryKind::pressure},
                          {{"zmin"}, BoundaryKind::fixed},
                          {{"ymin"}, BoundaryKind::free}});
  scene.boundary[0].traction = {1, 2, -3};
  scene.boundary[1].pressure = 7;
  const Supported s(box({2, 3, 2}), scene);
  const std::size_t top = 2 * 2 * 3, side = 2 * 3 * 2;
  ASSERT_EQ(s.boundary.slot_nodes.size(), top + side);
  ASSERT_EQ(s.boundary.loaded.size(), 2 * top + side);
  Vec3 force{};
  for (const LoadedFace& f : s.boundary.loaded) {
    EXPECT_EQ(f.node, s.boundary.slot_nodes[f.slot]);
    EXPECT_EQ(f.kind == BoundaryKind::traction, f.condition == 0);
    if (f.condition == 0) {
      for (int k = 0; k < 3; ++k) force[k] += 3 * f.corner_force[k];
    } else {
      EXPECT_EQ(f.pressure, 7);
    }
  }
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(force[k], scene.boundary[0].traction[k] * 2 * 3, 1e-14);
  for (int r = 0; r < s.order.rows; ++r)
    for (int g = s.order.corner[r]; g < s.order.corner[r + 1]; ++g) {
      const std::string& patch = s.mesh.patch_names[s.mesh.faces[s.order.corner_face[g]].patch];
      const int slot = s.order.corner_load[g];
      EXPECT_EQ(slot >= 0, patch == "zmax" || patch == "xmin");
      if (slot < 0) continue;
      const auto& nodes = s.boundary.slot_nodes[slot];
      for (const int corner : {r, s.order.corner_b[g], s.order.corner_c[g]})
        EXPECT_EQ(std::count(nodes.begin(), nodes.end(), corner), 1);
    }
  EXPECT_EQ(s.boundary.free_faces, (std::vector<std::string>{"xmax", "ymax"}));
}
