// Reading what the real gmsh writes. Built only where CMake finds the program; GMSH_PROGRAM is its path.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "engine/mesh/mesh_quality.hpp"
#include "io/mesh/read_mesh.hpp"
#include "msh_writer.hpp"

using namespace nanson;

namespace {

/// A half cylinder of two halves in length that share a face; that face has a name too. Point 1 is a construction point.
const std::string geometry = R"(h = 0.3;
Point(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {0, 1, 0, h}; Point(4) = {-1, 0, 0, h};
Circle(1) = {2, 1, 3}; Circle(2) = {3, 1, 4}; Line(3) = {4, 2};
Curve Loop(1) = {1, 2, 3}; Plane Surface(1) = {1};
low() = Extrude {0, 0, 0.5} { Surface{1}; };
high() = Extrude {0, 0, 0.5} { Surface{low(0)}; };
)";
const std::string groups = R"(Physical Volume("soft rubber") = {low(1)};
Physical Volume("steel") = {high(1)};
Physical Surface("built in") = {1};
Physical Surface("glue") = {low(0)};
Physical Surface("tip") = {high(0)};
Physical Curve("axis") = {3};
)";

/// Runs gmsh on a geometry and reads the result.
struct Gmsh {
  TemporaryFolder folder;
  std::vector<std::string> errors;

  Mesh mesh(const std::string& geo, const std::string& options) {
    MeshSpec spec;
    spec.source = MeshSource::file;
    spec.file = {(folder.path() / "out.msh").string(), "scene.toml:1:1"};
    const auto in = folder.write("in.geo", geo);
    const std::string command = std::string("'") + GMSH_PROGRAM + "' -3 " + options + " -o '" + spec.file.name + "' '"
                                + in.string() + "' >/dev/null 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return load_mesh(spec, errors);
  }
};

double volume_of(const Mesh& mesh, const std::string& region) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& n = mesh.tets[t];
    if (mesh.region_names[mesh.tet_region[t]] == region)
      sum += tet_volume(mesh.X[n[0]], mesh.X[n[1]], mesh.X[n[2]], mesh.X[n[3]]);
  }
  return sum;
}

}  // namespace

TEST(ReadGmsh, ReadsAllFourFormsWithRegionsAndPatches) {
  std::size_t tets = 0;
  for (const std::string form : {"-format msh41", "-format msh41 -bin", "-format msh22", "-format msh22 -bin"}) {
    Gmsh gmsh;
    const Mesh mesh = gmsh.mesh(geometry + groups, form);
    ASSERT_TRUE(gmsh.errors.empty()) << form << ": " << gmsh.errors[0];
    EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"soft rubber", "steel"})) << form;
    EXPECT_EQ(mesh.patch_names, (std::vector<std::string>{"built in", "tip"})) << form;
    EXPECT_NEAR(volume_of(mesh, "soft rubber"), std::acos(-1.0) / 4, 0.04);
    EXPECT_NEAR(volume_of(mesh, "steel"), volume_of(mesh, "soft rubber"), 1e-4);
    const auto quality = mesh_quality(mesh);
    EXPECT_NEAR(quality.patches[0].area, std::acos(-1.0) / 2, 0.04);
    EXPECT_NEAR(quality.patches[1].area, quality.patches[0].area, 1e-6);
    EXPECT_EQ(int(quality.unnamed.faces), mesh.unnamed_faces);
    EXPECT_TRUE(tets == 0 || tets == mesh.tets.size()) << form;
    tets = mesh.tets.size();
  }
  EXPECT_GT(tets, 100u);
}

TEST(ReadGmsh, WithoutGroupsAllIsUnnamedAndTheConstructionPointIsLeftOut) {
  for (const std::string form : {"-format msh41", "-format msh22 -bin"}) {
    Gmsh gmsh;
    const Mesh mesh = gmsh.mesh(geometry, form);
    ASSERT_TRUE(gmsh.errors.empty()) << form << ": " << gmsh.errors[0];
    EXPECT_EQ(mesh.region_names, std::vector<std::string>{"unnamed"});
    EXPECT_TRUE(mesh.patch_names.empty());
    EXPECT_EQ(mesh.unnamed_faces, int(mesh.faces.size()));
  }
}

TEST(ReadGmsh, SkipsParametersOfNodes) {
  for (const std::string form : {"-format msh41", "-format msh41 -bin", "-format msh22", "-format msh22 -bin"}) {
    Gmsh gmsh;
    const Mesh mesh = gmsh.mesh(geometry + groups, form + " -setnumber Mesh.SaveParametric 1");
    ASSERT_TRUE(gmsh.errors.empty()) << form << ": " << gmsh.errors[0];
    EXPECT_NEAR(volume_of(mesh, "steel"), std::acos(-1.0) / 4, 0.04);
  }
}

TEST(ReadGmsh, RefusesSecondOrderAndPartitionedMeshes) {
  for (const std::string form : {"-format msh41", "-format msh22", "-format msh41 -bin", "-format msh22 -bin"}) {
    Gmsh gmsh;
    gmsh.mesh(geometry + groups, "-order 2 " + form);
    ASSERT_EQ(gmsh.errors.size(), 1u);
    EXPECT_NE(gmsh.errors[0].find("mesh with first order elements"), std::string::npos) << gmsh.errors[0];
  }
  Gmsh gmsh;
  gmsh.mesh(geometry + groups, "-part 2 -format msh41");
  ASSERT_EQ(gmsh.errors.size(), 1u);
  EXPECT_NE(gmsh.errors[0].find("partitioned"), std::string::npos) << gmsh.errors[0];
}

TEST(ReadGmsh, RefusesPrismsOfExtrudedLayers) {
  Gmsh gmsh;
  gmsh.mesh(
      "h = 0.5;\nPoint(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {0, 1, 0, h};\n"
      "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 1};\nCurve Loop(1) = {1, 2, 3}; Plane Surface(1) = {1};\n"
      "out() = Extrude {0, 0, 1} { Surface{1}; Layers{2}; Recombine; };\nPhysical Volume(\"v\") = {out(1)};\n",
      "-format msh41");
  ASSERT_EQ(gmsh.errors.size(), 1u);
  EXPECT_NE(gmsh.errors[0].find("element type 6 (6-node prism)"), std::string::npos) << gmsh.errors[0];
}
