// The built-in needle: counts, faces, volume and areas, and what symmetric sides hold.
#include <cmath>
#include <numbers>

#include "engine/mesh/mesh_quality.hpp"
#include "tests/unit/scene_text.hpp"
#include "tests/unit/supported.hpp"

namespace nanson {
namespace {

using namespace test;

constexpr double inner = 0.1, outer = 1.0, degree = std::numbers::pi / 180;

RawMesh raw_needle(std::array<int, 3> cells, double angle) {
  MeshSpec spec;
  spec.source = MeshSource::needle;
  spec.inner = inner;
  spec.outer = outer;
  spec.angle = angle;
  spec.cells = cells;
  return make_needle(spec);
}

TEST(Needle, IsAcceptedForAllSmallNumbersOfCells) {
  for (const double angle : {1.0, 20.0, 90.0})
    for (int y = 1; y <= 3; ++y)
      for (int z = 1; z <= 3; ++z)
        for (int radial = 1; radial <= 4; ++radial) {
          const Mesh mesh = finished(raw_needle({y, z, radial}, angle));
          EXPECT_EQ(mesh.tets.size(), 6u * y * z * radial);
          EXPECT_EQ(mesh.X.size(), std::size_t(y + 1) * (z + 1) * (radial + 1));
          EXPECT_EQ(mesh.reoriented, 0);
          EXPECT_EQ(mesh.unnamed_faces, 0);
          EXPECT_EQ(mesh.patch_names, (std::vector<std::string>{"inner", "outer", "sides"}));
        }
}

TEST(Needle, FacesLieOnTheSpheresAndOnThePlanesOfTheSides) {
  const Mesh mesh = finished(raw_needle({2, 3, 5}, 20));
  const double slope = std::tan(10 * degree);
  for (const Face& face : mesh.faces) {
    const Vec3 &a = mesh.X[face.nodes[0]], &b = mesh.X[face.nodes[1]], &c = mesh.X[face.nodes[2]];
    if (face.patch < 2) {
      for (const Vec3& X : {a, b, c}) EXPECT_NEAR(norm(X), face.patch == 0 ? inner : outer, 1e-15);
      continue;
    }
    int planes = 0;
    for (const int axis : {1, 2})
      for (const double side : {-slope, slope}) {
        const auto off = [&](const Vec3& X) { return std::abs(X[axis] - side * X[0]); };
        planes += off(a) < 1e-15 && off(b) < 1e-15 && off(c) < 1e-15;
      }
    EXPECT_EQ(planes, 1);
  }
}

/// One cell across: a frustum of a pyramid, whose end faces stand at X = r/sqrt(1 + 2 t^2), t = tan(angle/2).
TEST(Needle, VolumeAndAreasOfOneCellAcrossAreThoseOfAFrustum) {
  for (const double angle : {1.0, 40.0}) {
    const MeshQuality q = mesh_quality(finished(raw_needle({1, 1, 4}, angle)));
    const double t = std::tan(angle / 2 * degree), to_x = 1 / std::sqrt(1 + 2 * t * t), xi = inner * to_x,
                 xo = outer * to_x;
    EXPECT_NEAR(q.volume / (4 * t * t / 3 * (xo * xo * xo - xi * xi * xi)), 1, 1e-12);
    EXPECT_NEAR(q.patches[0].area / (4 * t * t * xi * xi), 1, 1e-12);
    EXPECT_NEAR(q.patches[1].area / (4 * t * t * xo * xo), 1, 1e-12);
    EXPECT_NEAR(q.patches[2].area / (4 * t * std::sqrt(1 + t * t) * (xo * xo - xi * xi)), 1, 1e-12);
  }
}

TEST(Needle, VolumeAndAreasConvergeToTheSolidAngle) {
  const double solid = 4
                       * std::asin(std::pow(std::sin(20 * degree),
                                            2));  // of a square pyramid whose opposite sides meet at 40 degrees
  double last = 0;
  for (const int n : {2, 4, 8}) {
    const MeshQuality q = mesh_quality(finished(raw_needle({n, n, 2}, 40)));
    const double volume = 1 - q.volume / (solid / 3 * (outer * outer * outer - inner * inner * inner)),
                 area = 1 - q.patches[1].area / (solid * outer * outer);
    EXPECT_GT(volume, 0);
    EXPECT_GT(area, 0);
    EXPECT_LT(area, 0.03);
    if (n > 2) {
      EXPECT_NEAR(last / volume, 4, 0.2);
    }
    last = volume;
  }
}

/// Sides are one patch, but each of the four is a smooth group of its own: its normal at its nodes, two of them at the edges between neighbours.
TEST(Needle, SymmetricSidesHoldTwoDirectionsAtTheEdgesAndOneOnTheSides) {
  for (const int n : {1, 2}) {
    const Supported s(raw_needle({n, n, 3}, 1), {{{"sides"}, BoundaryKind::symmetric}});
    const double c = std::cos(0.5 * degree), sine = std::sin(0.5 * degree), slope = std::tan(0.5 * degree);
    for (int node = 0; node < s.order.nodes; ++node) {
      const Vec3& X = s.mesh.X[node];
      int sides = 0;
      const Constraint h = s.at(node);
      for (const int axis : {1, 2}) {
        if (std::abs(std::abs(X[axis]) - slope * X[0]) > 1e-15) continue;
        ++sides;
        Vec3 normal{-sine, 0, 0};
        normal[axis] = std::copysign(c, X[axis]);
        EXPECT_NEAR(free_part(h, normal), 0, 1e-12);
      }
      EXPECT_EQ(h.count, sides);
      expect_orthonormal(h);
      EXPECT_NEAR(free_part(h, {X[0] / norm(X), X[1] / norm(X), X[2] / norm(X)}), 1, 1e-12);  // moves along its ray
    }
  }
}

TEST(Scene, NeedleIsReadAndChecked) {
  const std::string scene = edited(small_scene, "box = { size = [1, 2, 3] }",
                                   "needle = { inner = 0.1, outer = 1.0, angle = 1 }\ncells = [1, 2, 30]");
  const SceneResult r = read_text(scene);
  EXPECT_TRUE(r.errors.empty()) << joined(r.errors);
  EXPECT_EQ(r.scene.mesh.source, MeshSource::needle);
  EXPECT_EQ(r.scene.mesh.inner, 0.1);
  EXPECT_EQ(r.scene.mesh.outer, 1.0);
  EXPECT_EQ(r.scene.mesh.angle, 1.0);
  EXPECT_EQ(r.scene.mesh.cells, (std::array<int, 3>{1, 2, 30}));
  expect_each_refused(
      scene, {
                 {"inner = 0.1", "inner = 0", "scene.toml:3:20: mesh.needle.inner = 0: must be above 0"},
                 {"outer = 1.0", "outer = 0.1",
                  "scene.toml:3:33: mesh.needle.outer = 0.1: must be above mesh.needle.inner, 0.1"},
                 {", angle = 1", "", "scene.toml:3:10: mesh.needle.angle: is missing"},
                 {"angle = 1", "angle = 91", "scene.toml:3:46: mesh.needle.angle = 91: must be at most 90"},
                 {"[1, 2, 30]", "[1, 0, 30]", "scene.toml:4:13: mesh.cells.1 = 0: must be at least 1"},
                 {"cells = [1, 2, 30]", "", "scene.toml:2:1: mesh.cells: is missing"},
                 {"cells", "perturb = 0.1\ncells", "scene.toml:4:11: mesh.perturb = 0.1: is not a key of needle"},
                 {"cells", "box = { size = [1, 1, 1] }\ncells",
                  "scene.toml:3:10: mesh.needle: stands beside mesh.box, exactly one of box | cylinder | needle | file "
                  "is allowed"},
             });
}

}  // namespace
}  // namespace nanson
