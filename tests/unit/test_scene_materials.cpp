// [[material]] and mesh.regions: what is read, and what is refused with its place.
#include <gtest/gtest.h>

#include "engine/solver.hpp"
#include "io/mesh/read_mesh.hpp"
#include "tests/unit/msh_writer.hpp"
#include "tests/unit/scene_text.hpp"

namespace nanson {
namespace {

const std::string two_materials = R"(scene = "two"
[mesh]
box = { size = [2, 1, 1] }
cells = [4, 2, 2]
regions = { axis = "x", at = [0.5], names = ["left", "right"] }
[[material]]
region = "left"
law = "neo_hookean"
density = 1000
youngs_modulus = 1e6
poissons_ratio = 0.3
[[material]]
region = ["right"]
law = "hencky_j2"
density = 3000
youngs_modulus = 2e6
poissons_ratio = 0.3
yield_stress = 1e4
hardening_modulus = 0
[time]
end = 1
)";

std::vector<std::string> mesh_errors(const std::string& text) {
  const SceneResult r = read_text(text);
  EXPECT_TRUE(r.errors.empty()) << joined(r.errors);
  std::vector<std::string> errors;
  const Mesh mesh = load_mesh(r.scene.mesh, errors);
  EXPECT_TRUE(errors.empty()) << joined(errors);
  errors = check_names(r.scene, mesh);
  for (std::string& e : errors) e.erase(0, e.find("scene.toml"));
  return errors;
}

TEST(SceneMaterials, SeveralAreRead) {
  const SceneResult r = read_text(two_materials, {"material.right.density=4000", "material.0.poissons_ratio=0.2"});
  ASSERT_TRUE(r.errors.empty()) << joined(r.errors);
  ASSERT_EQ(r.scene.materials.size(), 2u);
  EXPECT_EQ(r.scene.materials[0].regions[0].name, "left");
  EXPECT_EQ(r.scene.materials[1].regions[0].name, "right");
  EXPECT_EQ(r.scene.materials[1].law, Law::hencky_j2);
  EXPECT_EQ(r.scene.materials[1].density, 4000);
  EXPECT_EQ(r.scene.materials[0].poissons_ratio, 0.2);
  EXPECT_EQ(mesh_errors(two_materials), std::vector<std::string>{});
}

TEST(SceneMaterials, OneForAllRegionsIsOneMaterial) {
  const std::string one = edited(
      edited(two_materials, "\"left\"\nlaw", "[\"left\", \"right\"]\nlaw"),
      two_materials.substr(two_materials.rfind("[[material]]"),
                           two_materials.find("[time]") - two_materials.rfind("[[material]]")),
      "");
  const SceneResult r = read_text(one);
  EXPECT_TRUE(r.errors.empty()) << joined(r.errors);
  EXPECT_TRUE(r.scene.materials.empty());
  EXPECT_EQ(r.scene.material.density, 1000);
  EXPECT_EQ(mesh_errors(one), std::vector<std::string>{});
}

TEST(SceneMaterials, WrongEntriesAreRefused) {
  expect_each_refused(
      two_materials,
      {
          {"region = \"left\"\n", "", "scene.toml:6:1: material.0.region: is missing"},
          {"region = \"left\"", "region = []",
           "scene.toml:7:10: material.0.region = []: must name at least one region"},
          {"region = \"left\"", "region = 3",
           "scene.toml:7:10: material.0.region = 3: must be a name or a list of names"},
          {"[\"right\"]", "[\"right\", \"left\"]",
           "scene.toml:13:20: material.1.region.1 = \"left\": has the material of scene.toml:7:10 already"},
          {"density = 3000", "density = -1", "scene.toml:15:11: material.1.density = -1: must be above 0"},
          {"density = 3000", "density = 3000\nvolumetric = \"barrier\"",
           "scene.toml:16:14: material.1.volumetric = \"barrier\": has no meaning for linear_elastic and hencky_j2"},
          {"poissons_ratio = 0.3\nyield", "poissons_ratio = 0.5\nyield",
           "scene.toml:17:18: material.1.poissons_ratio = 0.5: must be below 0.5"},
          {"neo_hookean", "linear_elastic",
           "scene.toml:14:7: material.1.law = \"hencky_j2\": cannot stand beside that of material.0"},

      });
  expect_each_refused(small_scene, {{"law =", "region = \"box\"\nlaw =",
                                     "scene.toml:5:10: material.region = \"box\": is a key of [[material]] only"}});
}

TEST(SceneMaterials, SeveralStandBesideEveryChoiceButOfTheOtherSchemes) {
  const auto physics = [](const std::string& line) {
    return edited(two_materials, "[time]", "[physics]\n" + line + "\n[time]");
  };
  for (const char* line : {"formulation = \"pFHJ\"", "pressure_jump = \"tensor\"", "reconstruction = \"limited\"",
                           "flux_correction = \"pressure\"", "flux_correction = \"full\"", "upwind_metric = \"paper\"",
                           "entropy_fix = \"edge\"", "keep_angular_momentum = true", "description = \"updated\"",
                           "description = \"pseudo_updated\"", "parting = 0.5"}) {
    const SceneResult r = read_text(physics(line));
    EXPECT_TRUE(r.errors.empty()) << line << joined(r.errors);
  }
  const SceneResult jst = read_text(physics("stabilisation = \"jst\""));
  ASSERT_EQ(jst.errors.size(), 1u) << joined(jst.errors);
  EXPECT_TRUE(
      jst.errors[0].starts_with("scene.toml:21:17: physics.stabilisation = \"jst\": with several materials needs "
                                "\"upwind\""))
      << jst.errors[0];
  const SceneResult wave = read_text(
      edited(two_materials, "[time]", "[initial]\nfield = \"plane_wave\"\namplitude = 1\nlength = 1\n[time]"));
  ASSERT_EQ(wave.errors.size(), 1u) << joined(wave.errors);
  EXPECT_TRUE(wave.errors[0].starts_with(
      "scene.toml:21:9: initial.field = \"plane_wave\": is the exact solution of one material"))
      << wave.errors[0];
  const SceneResult projected = read_text(physics("formulation = \"pFp\""));
  ASSERT_EQ(projected.errors.size(), 1u) << joined(projected.errors);
  EXPECT_NE(projected.errors[0].find("material.1.law = \"hencky_j2\": is not built yet with formulation = \"pFp\""),
            std::string::npos)
      << projected.errors[0];
}

TEST(SceneMaterials, LayersOfTheBox) {
  const SceneResult r = read_text(edited(two_materials, "[0.5], names = [\"left\", \"right\"]",
                                         "[0.5, 1.5], names = [\"left\", \"right\", \"rest\"]"));
  ASSERT_TRUE(r.errors.empty()) << joined(r.errors);
  const RawMesh raw = make_box(r.scene.mesh);
  int tets[3]{};
  for (const int region : raw.tet_region) ++tets[region];
  EXPECT_EQ(tets[0], 24);
  EXPECT_EQ(tets[1], 48);
  EXPECT_EQ(tets[2], 24);
  expect_each_refused(
      two_materials,
      {
          {"[0.5]", "[0.6]",
           "scene.toml:5:31: mesh.regions.at.0 = 0.6: cuts through cells: the nearest plane between two of the 4 is at "
           "0.5"},
          {"[0.5]", "[2]", "scene.toml:5:31: mesh.regions.at.0 = 2: must lie inside the box, between 0 and 2"},
          {"[0.5], names = [\"left\", \"right\"]", "[1, 0.5], names = [\"left\", \"right\", \"c\"]",
           "scene.toml:5:34: mesh.regions.at.1 = 0.5: must lie above the plane before it"},
          {"names = [\"left\", \"right\"]", "names = [\"left\"]",
           "scene.toml:5:45: mesh.regions.names = [\"left\"]: must be 2 names, one more than planes"},
          {"names = [\"left\", \"right\"]", "names = [\"left\", \"left\"]",
           "scene.toml:5:54: mesh.regions.names.1 = \"left\": is named twice"},
          {"axis = \"x\"", "axis = \"r\"",
           "scene.toml:5:20: mesh.regions.axis = \"r\": unknown word, allowed: x | y | z"},
          {"at = [0.5]", "at = 0.5", "scene.toml:5:30: mesh.regions.at = 0.5: must be a list of the planes"},
      });
}

TEST(SceneMaterials, AllErrorsOfTheMeshComeAtOnce) {
  const std::vector<std::string> errors = mesh_errors(edited(
      edited(two_materials, "region = \"left\"", "region = \"lefd\""), "region = [\"right\"]", "region = [\"top\"]"));
  EXPECT_EQ(
      errors,
      (std::vector<std::string>{
          "scene.toml:7:10: material.0.region = \"lefd\": unknown region, did you mean \"left\"? allowed: left | right",
          "scene.toml:13:11: material.1.region = \"top\": unknown region, allowed: left | right",
          "scene.toml:7:10: material: no [[material]] is for region \"left\" of the mesh, which has 24 tets",
          "scene.toml:7:10: material: no [[material]] is for region \"right\" of the mesh, which has 72 tets"}));
}

TEST(SceneMaterials, PlasticRegionsMayTouch) {
  const std::string both = edited(two_materials, "\"neo_hookean\"",
                                  "\"hencky_j2\"\nyield_stress = 1e4\nhardening_modulus = 0");
  EXPECT_TRUE(mesh_errors(both).empty()) << joined(mesh_errors(both));
}

/// Two blocks of a gmsh file, physical volumes "soft" and "hard", joined at x = 1: the mass is that of the volumes, in every form of the file.
TEST(SceneMaterials, PhysicalVolumesOfGmshHaveTheirOwnMaterial) {
  MeshSpec spec;
  spec.size = {3, 1, 1};
  spec.cells = {3, 2, 2};
  spec.regions = {Axis::x, {1}, {"soft", "hard"}};
  const RawMesh box = make_box(spec);
  MshFile file;
  file.names = {{{3, 1}, "soft"}, {{3, 2}, "hard"}};
  file.X = box.X;
  for (std::size_t n = 0; n < box.X.size(); ++n) file.tags.push_back(static_cast<std::int64_t>(n + 1));
  for (int r = 0; r < 2; ++r) {
    MshEntity volume{3, r + 1, {r + 1}, 4, {}};
    for (std::size_t t = 0; t < box.tets.size(); ++t)
      if (box.tet_region[t] == r)
        volume.elements.push_back({box.tets[t][0] + 1, box.tets[t][1] + 1, box.tets[t][2] + 1, box.tets[t][3] + 1});
    file.entities.push_back(volume);
  }
  const TemporaryFolder folder;
  const std::string path = folder.write("two.msh", write_msh22(file, {false, false})).string();
  std::string text = edited(two_materials,
                            "box = { size = [2, 1, 1] }\ncells = [4, 2, 2]\nregions = { axis = \"x\", at = [0.5], "
                            "names = [\"left\", \"right\"] }",
                            "file = \"" + path + "\"");
  text = edited(edited(text, "\"left\"", "\"soft\""), "\"right\"", "\"hard\"");
  const SceneResult r = read_text(text);
  ASSERT_TRUE(r.errors.empty()) << joined(r.errors);
  std::vector<std::string> errors;
  const Mesh mesh = load_mesh(r.scene.mesh, errors);
  ASSERT_TRUE(errors.empty()) << joined(errors);
  EXPECT_EQ(check_names(r.scene, mesh), std::vector<std::string>{});
  const Simulation s = make_simulation(r.scene, mesh, 1);
  EXPECT_NEAR(s.books.mass, 1000 * 1 + 3000 * 2, 1e-9);
}

}  // namespace
}  // namespace nanson
