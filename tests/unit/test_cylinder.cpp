// The built-in quarter cylinder: counts, conformity, faces, volume, shape, symmetry, and the rules of its cells.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "engine/mesh/mesh.hpp"
#include "engine/mesh/mesh_quality.hpp"
#include "tests/unit/scene_text.hpp"

namespace nanson {
namespace {

constexpr double radius = 3.2, length = 5.0, pi = std::numbers::pi;

MeshSpec cylinder(std::array<int, 3> cells) {
  MeshSpec spec;
  spec.source = MeshSource::cylinder;
  spec.radius = radius;
  spec.length = length;
  spec.cells = cells;
  return spec;
}

Mesh finished(std::array<int, 3> cells) {
  std::vector<std::string> errors;
  Mesh mesh = finish_mesh(make_cylinder(cylinder(cells)), errors);
  EXPECT_TRUE(errors.empty()) << errors.front();
  return mesh;
}

TEST(Cylinder, IsAcceptedForAllSmallNumbersOfCells) {
  for (int tangential = 2; tangential <= 10; tangential += 2)
    for (int radial = tangential / 2 + 1; radial <= tangential / 2 + 4; ++radial)
      for (int axial = 1; axial <= 3; ++axial) {
        const Mesh mesh = finished({radial, tangential, axial});
        const int m = tangential / 2, section = m * m + tangential * (radial - m);
        EXPECT_EQ(mesh.tets.size(), 6u * section * axial);
        EXPECT_EQ(mesh.reoriented, 0);
        EXPECT_EQ(mesh.unnamed_faces, 0);
        EXPECT_EQ(mesh.patch_names, (std::vector<std::string>{"x0", "y0", "zmin", "zmax", "side"}));
      }
}

TEST(Cylinder, FacesLieOnTheirSurfaces) {
  const Mesh mesh = finished({5, 6, 4});
  for (const Face& face : mesh.faces)
    for (const int n : face.nodes) {
      const Vec3& X = mesh.X[static_cast<std::size_t>(n)];
      const double off[] = {X[0], X[1], X[2], X[2] - length, std::hypot(X[0], X[1]) - radius};
      EXPECT_NEAR(off[face.patch], 0, face.patch < 4 ? 0 : 1e-14);
    }
}

/// Plane faces x0, y0 are exact; arcs of n chords lack pi^2/(96 n^2) of the length and twice to four times that of the section.
TEST(Cylinder, VolumeAndAreasConvergeToTheCircle) {
  double last[2]{};
  for (const int m : {2, 4, 8}) {
    const MeshQuality q = mesh_quality(finished({2 * m, 2 * m, m}));
    EXPECT_NEAR(q.patches[0].area, radius * length, 1e-12);
    EXPECT_NEAR(q.patches[1].area, radius * length, 1e-12);
    const double volume = 1 - q.volume / (pi * radius * radius * length / 4),
                 side = 1 - q.patches[4].area / (pi * radius * length / 2);
    EXPECT_NEAR(q.patches[2].area * length / q.volume, 1, 1e-12);
    EXPECT_NEAR(q.patches[3].area * length / q.volume, 1, 1e-12);
    EXPECT_GT(volume, 0);
    EXPECT_GT(side, 0);
    if (m > 2) {
      EXPECT_NEAR(last[0] / volume, 4, 0.1);
      EXPECT_NEAR(last[1] / side, 4, 0.1);
    }
    last[0] = volume;
    last[1] = side;
  }
  EXPECT_LT(last[0], 2e-3);
}

TEST(Cylinder, HasNoSlivers) {
  for (const int m : {2, 3, 4, 6}) {
    const double h = radius / (2 * m);
    const int axial = std::max(1, static_cast<int>(length / (1.3 * h)));
    const MeshQuality q = mesh_quality(finished({2 * m, 2 * m, axial}));
    EXPECT_GT(q.worst, 0.35) << m;
    EXPECT_LT(q.max_volume / q.min_volume, 6) << m;
  }
}

TEST(Cylinder, IsSymmetricAboutItsDiagonal) {
  const Mesh mesh = finished({5, 6, 2});
  std::set<std::array<Vec3, 2>> edges;
  const auto at = [&](int n, bool swapped) {
    Vec3 X = mesh.X[static_cast<std::size_t>(n)];
    if (swapped) std::swap(X[0], X[1]);
    return X;
  };
  for (const bool swapped : {false, true})
    for (const auto& t : mesh.tets)
      for (const int a : t)
        for (const int b : t)
          if (swapped) {
            EXPECT_TRUE(edges.contains({at(a, true), at(b, true)}));
          } else {
            edges.insert({at(a, false), at(b, false)});
          }
}

TEST(Scene, CylinderIsReadAndItsCellsAreChecked) {
  const std::string scene = edited(small_scene, "box = { size = [1, 2, 3] }",
                                   "cylinder = { radius = 0.5, length = 2 }\ncells = [3, 4, 5]");
  const SceneResult r = read_text(scene);
  EXPECT_TRUE(r.errors.empty()) << joined(r.errors);
  EXPECT_EQ(r.scene.mesh.source, MeshSource::cylinder);
  EXPECT_EQ(r.scene.mesh.radius, 0.5);
  EXPECT_EQ(r.scene.mesh.length, 2);
  EXPECT_EQ(r.scene.mesh.cells, (std::array<int, 3>{3, 4, 5}));
  expect_each_refused(
      scene,
      {
          {"radius = 0.5", "radius = 0", "scene.toml:3:23: mesh.cylinder.radius = 0: must be above 0"},
          {", length = 2", "", "scene.toml:3:12: mesh.cylinder.length: is missing"},
          {"length = 2", "length = 2, sector = \"half\"",
           "scene.toml:3:49: mesh.cylinder.sector = \"half\": unknown word, allowed: quarter"},
          {"[3, 4, 5]", "[3, 3, 5]",
           "scene.toml:4:9: mesh.cells = [3, 3, 5]: the second number, 3 tangential cells, must be even"},
          {"[3, 4, 5]", "[2, 4, 5]",
           "scene.toml:4:9: mesh.cells = [2, 4, 5]: the first number, 2 radial cells, must be above half the second, "
           "2,"},
          {"cells = [3, 4, 5]", "", "scene.toml:2:1: mesh.cells: is missing"},
          {"cells", "split = \"kuhn\"\ncells", "scene.toml:4:9: mesh.split = \"kuhn\": is not a key of cylinder"},
          {"cells", "box = { size = [1, 1, 1] }\ncells",
           "scene.toml:3:12: mesh.cylinder: stands beside mesh.box, exactly one of box | cylinder | needle | file is "
           "allowed"},
      });
}

}  // namespace
}  // namespace nanson
