// Geometries that the real gmsh program meshes. Built only where CMake finds it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "io/mesh/read_mesh.hpp"
#include "tests/support/temporary_folder.hpp"

namespace nanson {
namespace {

struct Loading {
  Mesh mesh;
  std::vector<std::string> errors;
};

Loading load_geometry(const std::filesystem::path& geo) {
  Loading out;
  MeshSpec spec;
  spec.source = MeshSource::file;
  spec.file = {geo.string(), "scene.toml:3:8"};
  out.mesh = load_mesh(spec, out.errors);
  return out;
}

double volume(const Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.tets) sum += tet_volume(mesh.X[t[0]], mesh.X[t[1]], mesh.X[t[2]], mesh.X[t[3]]);
  return sum;
}

TEST(GeometryGmsh, IsMeshedWithItsNamesAndEveryTimeTheSame) {
  const test::TemporaryFolder folder;
  const auto geo = folder / "a b.geo";
  test::write_text(geo,
                   "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 2};\nPhysical Volume(\"bar\") = "
                   "{1};\nPhysical Surface(\"foot\") = {5};\n"
                   "Mesh.CharacteristicLengthMax = 0.5;\n");
  const Loading first = load_geometry(geo), second = load_geometry(geo);
  ASSERT_TRUE(first.errors.empty()) << first.errors[0];
  EXPECT_EQ(first.mesh.region_names, std::vector<std::string>{"bar"});
  EXPECT_EQ(first.mesh.patch_names, std::vector<std::string>{"foot"});
  EXPECT_NEAR(volume(first.mesh), 2, 1e-12);
  EXPECT_EQ(first.mesh.X, second.mesh.X);
  EXPECT_EQ(first.mesh.tets, second.mesh.tets);
}

TEST(GeometryGmsh, ItsMistakesAreReportedInGmshsWords) {
  const test::TemporaryFolder folder;
  const auto geo = folder / "wrong.geo";
  test::write_text(geo, "Box(1) = {0, 0, 0, width, 1, 2};\n");
  const auto errors = load_geometry(geo).errors;
  ASSERT_GE(errors.size(), 1u);
  EXPECT_TRUE(errors[0].starts_with("scene.toml:3:8: mesh.file = \"" + geo.string() + "\": gmsh: ")) << errors[0];
}

TEST(GeometryGmsh, TheGeometriesOfTheScenesHaveTheirVolumeAndSize) {
  struct Case {
    const char* geo;
    double volume, tolerance;  // [m^3] of the exact body; the mesh is faceted
    std::size_t least, most;   // nodes
  };
  const double cone = std::numbers::pi * (16 + 8 + 4);
  for (const Case& c : {Case{"satellite.geo", cone + 4 * 3.5, 0.03, 2200, 2800},
                        Case{"punch.geo", 0.5 - 9 * 0.005 * std::numbers::pi, 0.035, 1000, 1600},
                        Case{"stent.geo", 0, 0, 1200, 2000}}) {
    const Loading read = load_geometry(std::string(NANSON_SOURCE_DIR) + "/configs/meshes/" + c.geo);
    ASSERT_TRUE(read.errors.empty()) << read.errors[0];
    if (c.volume > 0) {
      EXPECT_NEAR(volume(read.mesh), c.volume, c.tolerance * c.volume) << c.geo;
    }
    EXPECT_GE(read.mesh.X.size(), c.least) << c.geo;
    EXPECT_LE(read.mesh.X.size(), c.most) << c.geo;
  }
}

}  // namespace
}  // namespace nanson
