// Supports: which directions are held at which node.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/unit/supported.hpp"

using namespace nanson;
using namespace nanson::test;

namespace {

constexpr Vec3 ex{1, 0, 0}, ey{0, 1, 0}, ez{0, 0, 1};
constexpr double degree = std::numbers::pi / 180;

bool on(const Vec3& X, int axis, double at) { return std::abs(X[axis] - at) < 1e-12; }

/// A prism over the triangle (0, 0), (1, 0), (cos, sin): patches "low" and "high" meet along its edge at the origin, nodes 0 and 3.
RawMesh wedge(double angle, bool one_patch) {
  RawMesh raw;
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] : {std::pair(0.0, 0.0), std::pair(1.0, 0.0), std::pair(std::cos(angle), std::sin(angle))})
      raw.X.push_back({x, y, z});
  raw.tets = {{0, 1, 2, 5}, {0, 1, 5, 4}, {0, 4, 5, 3}};
  raw.tet_region = {0, 0, 0};
  raw.region_names = {"all"};
  raw.triangles = {{0, 1, 4}, {0, 4, 3}, {0, 2, 5}, {0, 5, 3}};
  raw.triangle_patch = {0, 0, one_patch ? 0 : 1, one_patch ? 0 : 1};
  raw.patch_names = {"low"};
  if (!one_patch) raw.patch_names.push_back("high");
  return raw;
}

/// Quarter of a hollow cylinder, radii 1 and 2, `facets` over 90 degrees; its curved faces are xmin and xmax.
RawMesh quarter_cylinder(int facets) {
  return bent_box({2, facets, 3}, [](const Vec3& p) {
    const double r = 1 + p[0], angle = p[1] * 90 * degree;
    return Vec3{r * std::cos(angle), r * std::sin(angle), p[2]};
  });
}

}  // namespace

TEST(Boundary, FixedHoldsThreeDirectionsOnItsFaceOnly) {
  const Supported s(raw_box({3, 3, 2}), {{{"zmin"}, BoundaryKind::fixed}});
  for (int n = 0; n < s.order.nodes; ++n) {
    const Constraint h = s.at(n);
    EXPECT_EQ(h.count, on(s.mesh.X[n], 2, 2) ? 3 : 0);
    expect_orthonormal(h);
    EXPECT_EQ(norm(prescribed(h, {1})), 0);
  }
}

TEST(Boundary, SymmetricHoldsTheNormalOfABoxFace) {
  const Supported s(raw_box({3, 3, 2}), {{{"xmax"}, BoundaryKind::symmetric}});
  for (int n = 0; n < s.order.nodes; ++n) {
    const Constraint h = s.at(n);
    ASSERT_EQ(h.count, on(s.mesh.X[n], 0, 1) ? 1 : 0);
    if (h.count) {
      EXPECT_NEAR(free_part(h, ex), 0, 1e-15);
    }
  }
}

TEST(Boundary, SymmetricFacesHoldTwoDirectionsAtTheirEdgeAndThreeAtTheirCorner) {
  const Supported s(raw_box({3, 3, 2}), {{{"xmin", "ymin", "zmin"}, BoundaryKind::symmetric}});
  for (int n = 0; n < s.order.nodes; ++n) {
    const Vec3& X = s.mesh.X[n];
    const bool x = on(X, 0, -1), y = on(X, 1, 0.5), z = on(X, 2, 2);
    const Constraint h = s.at(n);
    EXPECT_EQ(h.count, x + y + z);
    expect_orthonormal(h);
    EXPECT_NEAR(free_part(h, ex), !x, 1e-15);
    EXPECT_NEAR(free_part(h, ey), !y, 1e-15);
    EXPECT_NEAR(free_part(h, ez), !z, 1e-15);
  }
}

TEST(Boundary, SkewSymmetricHoldsTheTwoTangents) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::string face = std::string(1, "xyz"[axis]) + "max";
    const Supported s(raw_box({3, 3, 2}), {{{face}, BoundaryKind::skew_symmetric}});
    const double at[3] = {1, 3.5, 3.5};
    const Vec3 axes[3] = {ex, ey, ez};
    for (int n = 0; n < s.order.nodes; ++n) {
      const Constraint h = s.at(n);
      ASSERT_EQ(h.count, on(s.mesh.X[n], axis, at[axis]) ? 2 : 0) << face;
      if (h.count == 0) continue;
      expect_orthonormal(h);
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(free_part(h, axes[k]), k == axis, 1e-15) << face;
    }
  }
}

TEST(Boundary, SkewSymmetricHoldsTheTangentsOfAnObliqueFace) {
  const Supported s(wedge(30 * degree, false), {{{"high"}, BoundaryKind::skew_symmetric}});
  const Constraint h = s.at(2);
  ASSERT_EQ(h.count, 2);
  EXPECT_NEAR(free_part(h, ez), 0, 1e-15);
  EXPECT_NEAR(free_part(h, {std::cos(30 * degree), std::sin(30 * degree), 0}), 0, 1e-15);
  EXPECT_NEAR(free_part(h, {-std::sin(30 * degree), std::cos(30 * degree), 0}), 1, 1e-15);
}

TEST(Boundary, ARollerOnACurvedFaceHoldsOneDirectionANode) {
  const Supported s(quarter_cylinder(6), {{{"xmax"}, BoundaryKind::symmetric}});  // facets meet at 15 degrees
  int held = 0;
  for (int n = 0; n < s.order.nodes; ++n) {
    const Vec3& X = s.mesh.X[n];
    const double r = std::hypot(X[0], X[1]);
    const Constraint h = s.at(n);
    ASSERT_EQ(h.count, std::abs(r - 2) < 1e-12 ? 1 : 0);
    held += h.count;
    if (h.count) {
      EXPECT_GT(std::abs(dot(direction(h, 0), {X[0] / r, X[1] / r, 0})), std::cos(8 * degree));
    }
  }
  EXPECT_EQ(held, 7 * 4);
}

TEST(Boundary, FacetsOfACoarseCylinderAreCreases) {
  const Supported s(quarter_cylinder(2), {{{"xmax"}, BoundaryKind::symmetric}});  // facets meet at 45 degrees
  for (int n = 0; n < s.order.nodes; ++n) {
    const Vec3& X = s.mesh.X[n];
    const bool outer = std::abs(std::hypot(X[0], X[1]) - 2) < 1e-12, crease = outer && std::abs(X[0] - X[1]) < 1e-12;
    EXPECT_EQ(s.at(n).count, crease ? 2 : outer ? 1 : 0);
  }
}

TEST(Boundary, ACreaseOfNinetyDegreesInOnePatchHoldsTwo) {
  RawMesh raw = raw_box({3, 3, 2});
  for (int& patch : raw.triangle_patch) patch = patch == 2 ? 0 : patch;  // ymin becomes part of xmin
  const Supported s(raw, {{{"xmin"}, BoundaryKind::symmetric}});
  for (int n = 0; n < s.order.nodes; ++n) EXPECT_EQ(s.at(n).count, on(s.mesh.X[n], 0, -1) + on(s.mesh.X[n], 1, 0.5));
}

TEST(Boundary, FacesOfOnePatchFormACreaseFromThirtyDegreesOn) {
  for (const double between : {1.0, 20.0, 29.0, 31.0, 40.0, 89.0}) {
    const Supported s(wedge((180 - between) * degree, true), {{{"low"}, BoundaryKind::symmetric}});
    EXPECT_EQ(s.at(0).count, between > 30 ? 2 : 1) << between << " degrees";
    EXPECT_EQ(s.at(1).count, 1);
  }
}

TEST(Boundary, AWedgeOfOneDegreeHoldsTwoDistinctDirections) {
  for (const bool one_patch : {false, true}) {
    const std::vector<std::string> faces = one_patch ? std::vector<std::string>{"low"}
                                                     : std::vector<std::string>{"low", "high"};
    const Supported s(wedge(degree, one_patch), {{faces, BoundaryKind::symmetric}});
    for (const int n : {0, 3}) {
      const Constraint h = s.at(n);
      ASSERT_EQ(h.count, 2) << one_patch;
      expect_orthonormal(h);
      EXPECT_NEAR(free_part(h, ey), 0, 1e-13);
      EXPECT_NEAR(free_part(h, ex), 0, 1e-11);
      EXPECT_NEAR(free_part(h, ez), 1, 1e-13);
    }
    for (const int n : {1, 2, 4, 5}) EXPECT_EQ(s.at(n).count, 1);
  }
}

TEST(Boundary, DirectionsCloserThanAMilliradianAreOne) {
  for (const double angle : {0.5e-3, 2e-3}) {
    const Supported s(wedge(angle, false), {{{"low", "high"}, BoundaryKind::symmetric}});
    EXPECT_EQ(s.at(0).count, angle < 1e-3 ? 1 : 2);
  }
}

TEST(Boundary, ConstraintsStandByRowInTheRangesOfTheirParts) {
  const Supported s(raw_box({14, 14, 14}),
                    {{{"xmin", "zmax"}, BoundaryKind::symmetric}, {{"ymin"}, BoundaryKind::fixed}});
  ASSERT_EQ(s.order.parts.size(), 3u);
  int next = 0, row = -1;
  for (const Part& p : s.order.parts) {
    EXPECT_EQ(p.constraint_begin, next);
    for (int i = p.constraint_begin; i < p.constraint_end; ++i) {
      EXPECT_GE(s.boundary.constraints[i].node, p.node_begin);
      EXPECT_LT(s.boundary.constraints[i].node, p.node_end);
      EXPECT_GT(s.boundary.constraints[i].node, row);
      row = s.boundary.constraints[i].node;
    }
    next = p.constraint_end;
  }
  EXPECT_EQ(next, static_cast<int>(s.boundary.constraints.size()));
  EXPECT_EQ(s.boundary.constraints.size(), 15u * 15 * 3 - 2 * 15 - 15 + 1);
}
