// A scene as a whole: what is read, what is required, what is unknown, in which order errors come, and that no text breaks the reader.
#include <random>

#include "tests/unit/scene_text.hpp"

namespace nanson {
namespace {

TEST(Scene, EveryKeyOfTheSampleArrives) {
  const SceneResult r = read_text(column_scene);
  ASSERT_TRUE(r.errors.empty()) << joined(r.errors);
  EXPECT_TRUE(r.mesh_valid);
  const Scene& s = r.scene;
  EXPECT_EQ(s.name, "column");
  EXPECT_EQ(s.file.filename(), "scene.toml");
  EXPECT_EQ(s.text, column_scene);
  EXPECT_EQ(s.mesh.source, MeshSource::box);
  EXPECT_EQ(s.mesh.origin, (Vec3{-0.5, -0.5, 0}));
  EXPECT_EQ(s.mesh.size, (Vec3{1, 1, 6}));
  EXPECT_EQ(s.mesh.cells, (std::array<int, 3>{4, 4, 24}));
  EXPECT_EQ(s.mesh.split, Split::kuhn);
  EXPECT_EQ(s.mesh.perturb, 0.1);
  EXPECT_EQ(s.material.law, Law::neo_hookean);
  EXPECT_EQ(s.material.density, 1100);
  EXPECT_EQ(s.material.youngs_modulus, 17e6);
  EXPECT_EQ(s.material.poissons_ratio, 0.45);
  EXPECT_EQ(s.material.volumetric, Volumetric::barrier);
  EXPECT_EQ(s.material.isochoric, Isochoric::J);
  EXPECT_EQ(s.physics.formulation, Formulation::pFHJ);
  EXPECT_EQ(s.physics.pressure_jump, PressureJump::tensor);
  EXPECT_EQ(s.physics.reconstruction, Reconstruction::linear);
  EXPECT_EQ(s.physics.flux_correction, FluxCorrection::full);
  EXPECT_EQ(s.physics.boundary_flux, BoundaryFlux::paper);
  EXPECT_EQ(s.physics.upwind_metric, UpwindMetric::paper);
  EXPECT_EQ(s.initial.field, InitialField::twist);
  EXPECT_EQ(s.initial.twist_omega, 105);
  EXPECT_EQ(s.initial.height, 6);
  EXPECT_EQ(s.body_force, (Vec3{0, 0, -9.81}));
  EXPECT_EQ(s.time.end, 0.1);
  EXPECT_EQ(s.time.cfl, 0.25);
  EXPECT_EQ(s.time.integrator, Integrator::ssp_rk3);
  EXPECT_EQ(s.time.step, StepRule::edge);
  EXPECT_EQ(s.time.dt_max, 1e-4);
  EXPECT_EQ(s.time.dt_collapse, 1e-3);
  EXPECT_EQ(s.time.max_steps, 500);
  EXPECT_EQ(s.time.max_wall_s, 60);
  EXPECT_EQ(s.output.every, 0.005);
  EXPECT_EQ(s.output.history_every, 10);
  EXPECT_EQ(s.output.fields, (std::vector<std::string>{"displacement", "pressure"}));
  EXPECT_EQ(s.output.compress, 1);
  EXPECT_TRUE(s.monitor.energy);
  EXPECT_EQ(s.monitor.energy_growth, EnergyGrowth::stop);
  EXPECT_EQ(s.monitor.energy_tolerance, 0.02);
}

TEST(Scene, BoundariesAndProbesRememberTheirPlaces) {
  const SceneResult r = read_text(column_scene);
  ASSERT_TRUE(r.errors.empty()) << joined(r.errors);
  ASSERT_EQ(r.scene.boundary.size(), 2u);
  const BoundarySpec& load = r.scene.boundary[1];
  EXPECT_EQ(r.scene.boundary[0].kind, BoundaryKind::fixed);
  EXPECT_EQ(load.kind, BoundaryKind::traction);
  EXPECT_EQ(load.traction, (Vec3{0, 0, -1e3}));
  EXPECT_EQ(load.time.kind, TimeKind::ramp);
  EXPECT_EQ(load.time.until, 0.01);
  ASSERT_EQ(load.faces.size(), 2u);
  EXPECT_EQ(load.faces[0].name, "zmax");
  EXPECT_TRUE(load.faces[0].where.ends_with("scene.toml:35:9")) << load.faces[0].where;
  EXPECT_EQ(load.faces[1].name, "xmax");
  EXPECT_TRUE(load.faces[1].where.ends_with("scene.toml:35:17")) << load.faces[1].where;
  ASSERT_EQ(r.scene.output.probes.size(), 1u);
  const ProbeSpec& tip = r.scene.output.probes[0];
  EXPECT_EQ(tip.name, "tip");
  EXPECT_EQ(tip.at, (Vec3{0.5, 0.5, 6}));
  EXPECT_EQ(tip.fields, (std::vector<std::string>{"x", "velocity"}));
  EXPECT_TRUE(tip.where.ends_with("scene.toml:58:32")) << tip.where;
}

TEST(Scene, ProbesKeepTheOrderOfTheFile) {
  const std::string probe = " = { at = [0, 0, 0], fields = [\"x\"] }";
  const SceneResult r = read_text(small_scene + "[output.probes]\nzulu" + probe + "\nalpha" + probe + "\nmike" + probe
                                  + "\n");
  ASSERT_EQ(r.scene.output.probes.size(), 3u) << joined(r.errors);
  EXPECT_EQ(r.scene.output.probes[0].name, "zulu");
  EXPECT_EQ(r.scene.output.probes[1].name, "alpha");
  EXPECT_EQ(r.scene.output.probes[2].name, "mike");
}

TEST(Scene, WhatIsNotWrittenHasTheDefaultOfThePlainStructs) {
  const SceneResult r = read_text(small_scene);
  ASSERT_TRUE(r.errors.empty()) << joined(r.errors);
  const Scene& s = r.scene;
  EXPECT_EQ(s.mesh.origin, (Vec3{0, 0, 0}));
  EXPECT_EQ(s.mesh.cells, (std::array<int, 3>{1, 1, 1}));
  EXPECT_EQ(s.mesh.split, Split::alternating);
  EXPECT_EQ(s.physics.formulation, Formulation::pFJ);
  EXPECT_EQ(s.physics.flux_correction, FluxCorrection::none);
  EXPECT_EQ(s.initial.field, InitialField::rest);
  EXPECT_TRUE(s.boundary.empty());
  EXPECT_EQ(s.time.dt_max, 0);
  EXPECT_EQ(s.output.every, 0);
  EXPECT_EQ(s.output.fields, (std::vector<std::string>{"displacement", "velocity", "pressure"}));
  EXPECT_FALSE(s.monitor.energy);
}

TEST(Scene, SectionsWithoutAKeyKeepItsDefault) {
  EXPECT_EQ(read_text(small_scene + "[output]\nevery = 1\n").scene.output.fields,
            (std::vector<std::string>{"displacement", "velocity", "pressure"}));
}

TEST(Scene, CflDefaultFollowsTheIntegrator) {
  EXPECT_EQ(read_text(small_scene).scene.time.cfl, 0.3);
  EXPECT_EQ(read_text(small_scene + "integrator = \"tvd_rk2\"\n").scene.time.cfl, 0.3);
  EXPECT_EQ(read_text(small_scene + "integrator = \"ssp_rk3\"\n").scene.time.cfl, 0.6);
  EXPECT_EQ(read_text(small_scene + "integrator = \"ssp_rk3\"\ncfl = 0.3\n").scene.time.cfl, 0.3);
}

TEST(Scene, RequiredKeysAreMissedAtTheirTable) {
  expect_each_refused(small_scene,
                      {
                          {"scene = \"small\"", "", "scene.toml:1:1: scene: is missing"},
                          {"box = { size = [1, 2, 3] }", "",
                           "scene.toml:2:1: mesh: exactly one of box | cylinder | needle | file is needed"},
                          {"size = [1, 2, 3]", "", "scene.toml:3:7: mesh.box.size: is missing"},
                          {"law = \"linear_elastic\"", "",
                           "scene.toml:4:1: material.law: is missing, allowed: linear_elastic | neo_hookean | "
                           "mooney_rivlin | hencky_j2"},
                          {"density = 1000", "", "scene.toml:4:1: material.density: is missing"},
                          {"youngs_modulus = 1e6", "", "scene.toml:4:1: material.youngs_modulus: is missing"},
                          {"poissons_ratio = 0.3", "", "scene.toml:4:1: material.poissons_ratio: is missing"},
                          {"end = 1", "", "scene.toml:9:1: time.end: is missing"},
                          {"[time]\nend = 1\n", "", "scene.toml:1:1: time: is missing"},
                          {"[mesh]\nbox = { size = [1, 2, 3] }\n", "", "scene.toml:1:1: mesh: is missing"},
                          {small_scene.substr(small_scene.find("[material]"),
                                              small_scene.find("[time]") - small_scene.find("[material]")),
                           "", "scene.toml:1:1: material: is missing"},
                      });
  expect_each_refused(
      column_scene,
      {
          {"face = \"zmin\"", "", "scene.toml:30:1: boundary.0.face: is missing"},
          {"kind = \"fixed\"", "", "scene.toml:30:1: boundary.0.kind: is missing, allowed: fixed | free"},
          {"at = [0.5, 0.5, 6.0], ", "", "scene.toml:58:25: output.probes.tip.at: is missing"},
          {", fields = [\"x\", \"velocity\"]", "", "scene.toml:58:25: output.probes.tip.fields: is missing"},
          {"kind = \"ramp\", ", "", "scene.toml:38:8: boundary.1.time.kind: is missing"},
      });
}

TEST(Scene, UnknownKeyNamesTheNearestOneAndReplacesItsMissingLine) {
  expect_each_refused(
      small_scene,
      {
          {"density", "denisty",
           "scene.toml:6:1: material.denisty = 1000: unknown key, did you mean \"density\"? allowed: law | density"},
          {"[time]", "[tyme]", "scene.toml:9:2: tyme: unknown key, did you mean \"time\"?"},
          {"box = {", "bxo = {",
           "scene.toml:3:1: mesh.bxo: unknown key, did you mean \"box\"? allowed: box | cylinder | needle | file"},
          {"[material]", "[materiel]", "scene.toml:4:2: materiel: unknown key, did you mean \"material\"?"},
      });
}

TEST(Scene, UnknownKeyFarFromAllListsWhatIsAllowed) {
  expect_each_refused(
      small_scene,
      {
          {"end = 1", "end = 1\ntitle = 2",
           "scene.toml:11:1: time.title = 2: unknown key, allowed: end | integrator | cfl"},
          {"scene =", "title = 1\nscene =", "scene.toml:1:1: title = 1: unknown key, allowed: scene | mesh | material"},
      });
}

TEST(Scene, EverySectionRefusesUnknownKeys) {
  const auto error = [](const std::string& place, const std::string& key) {
    return "scene.toml:" + place + ": " + key + " = 1: unknown key,";
  };
  expect_each_refused(column_scene, {
                                        {"\n[mesh]", "qq = 1\n[mesh]", error("2:1", "qq")},
                                        {"origin", "qq = 1, origin", error("4:13", "mesh.box.qq")},
                                        {"\n[material]", "qq = 1\n[material]", error("8:1", "mesh.qq")},
                                        {"\n[physics]", "qq = 1\n[physics]", error("16:1", "material.qq")},
                                        {"\n[initial]", "qq = 1\n[initial]", error("24:1", "physics.qq")},
                                        {"\n[[boundary]]", "qq = 1\n[[boundary]]", error("29:1", "initial.qq")},
                                        {"\n[body_force]", "qq = 1\n[body_force]", error("39:1", "boundary.1.qq")},
                                        {"until = 0.01", "until = 0.01, qq = 1", error("38:39", "boundary.1.time.qq")},
                                        {"\n[time]", "qq = 1\n[time]", error("42:1", "body_force.qq")},
                                        {"\n[output]", "qq = 1\n[output]", error("52:1", "time.qq")},
                                        {"\n[monitor]", "qq = 1\n[monitor]", error("59:1", "output.qq")},
                                        {"tip = { at", "tip = { qq = 1, at", error("58:27", "output.probes.tip.qq")},
                                        {"\nenergy ", "\nqq = 1\nenergy ", error("61:1", "monitor.qq")},
                                    });
}

TEST(Scene, FeaturesThatAreNotBuiltAreUnknown) {
  expect_each_refused(small_scene,
                      {
                          {"linear_elastic", "ogden",
                           "scene.toml:5:7: material.law = \"ogden\": unknown word, allowed: linear_elastic | "
                           "neo_hookean | mooney_rivlin | hencky_j2"},
                          {"[material]", "[[material]]", "scene.toml:4:1: material.0.region: is missing"},
                          {"end = 1", "end = 1\ndamping = 1.0", "scene.toml:11:1: time.damping = 1.0: unknown key"},
                      });
  expect_each_refused(column_scene, {});
}

TEST(Scene, SectionsOfTheWrongShapeAreRefused) {
  expect_each_refused(
      small_scene, {
                       {"scene = \"small\"", "scene = \"small\"\nphysics = 3",
                        "scene.toml:2:11: physics = 3: must be a table, written physics = { formulation = \"pFJ\" }"},
                       {"scene = \"small\"", "scene = \"small\"\nboundary = { face = \"a\" }",
                        "scene.toml:2:12: boundary: must be a list of tables, written boundary = [{ face = \"zmin\", "
                        "kind = \"fixed\" }]"},
                       {"scene = \"small\"", "scene = \"small\"\nboundary = [ 1 ]",
                        "scene.toml:2:14: boundary.0 = 1: must be a table, written boundary = [{ face = \"zmin\""},
                       {"box = { size = [1, 2, 3] }", "box = 1", "scene.toml:3:7: mesh.box = 1: must be a table"},
                       {"[time]", "[output]\nprobes = { tip = 3 }\n[time]",
                        "scene.toml:10:18: output.probes.tip = 3: must be a table"},
                   });
}

TEST(Scene, NameMustBePlainBecauseItBecomesAFolder) {
  expect_each_refused(small_scene,
                      {
                          {"\"small\"", "\"two words\"",
                           "scene.toml:1:9: scene = \"two words\": names a folder: use letters, digits, - and _ only"},
                          {"\"small\"", "\"../up\"", "scene.toml:1:9: scene = \"../up\": names a folder"},
                          {"\"small\"", "\"\"", "scene.toml:1:9: scene = \"\": names a folder"},
                          {"\"small\"", "7", "scene.toml:1:9: scene = 7: must be a string"},
                      });
  expect_each_accepted(small_scene, {{"small", "Az_0-9"}});
}

TEST(Scene, SyntaxErrorHasItsLineAndColumn) {
  const SceneResult r = read_text("scene = \"x\"\nmesh = 3 4\n");
  ASSERT_EQ(r.errors.size(), 1u) << joined(r.errors);
  EXPECT_TRUE(r.errors[0].starts_with("scene.toml:2:10: Error while parsing key-value pair")) << r.errors[0];
  EXPECT_FALSE(r.mesh_valid);
  const SceneResult twice = read_text(small_scene + "end = 2\n");
  ASSERT_EQ(twice.errors.size(), 1u);
  EXPECT_NE(twice.errors[0].find("redefine"), std::string::npos) << twice.errors[0];
}

TEST(Scene, FileThatIsNotThereSaysSo) {
  const TempFolder folder;
  const std::string absent = (folder.path / "absent.toml").string();
  EXPECT_EQ(read_scene(absent).errors, (std::vector<std::string>{absent + ": no such file"}));
  EXPECT_EQ(read_scene(folder.path).errors, (std::vector<std::string>{folder.path.string() + ": is not a file"}));
  EXPECT_FALSE(read_scene(absent).mesh_valid);
  const std::vector<std::string> also = read_scene(absent, {"abc"}).errors;
  ASSERT_EQ(also.size(), 2u) << joined(also);
  EXPECT_EQ(also[0], absent + ": no such file");
  EXPECT_TRUE(also[1].starts_with("--set #1: abc: "));
}

TEST(Scene, MeshIsValidAlthoughOtherSectionsAreWrong) {
  EXPECT_TRUE(read_text(edited(column_scene, "1100.0", "-1.0")).mesh_valid);
  EXPECT_FALSE(read_text(edited(column_scene, "24]", "0]")).mesh_valid);
  EXPECT_FALSE(read_text(edited(column_scene, "split ", "spilt ")).mesh_valid);
  EXPECT_FALSE(read_text(edited(column_scene, "[mesh]", "[mehs]")).mesh_valid);
}

TEST(Scene, AllErrorsOfAFileComeAtOnceInItsOrder) {
  const std::string bad = R"(title = "x"
scene = "twisting column"
[monitor]
energy = 1
[mesh]
box   = { origin = [-0.5, -0.5, 0.0], size = [1.0, 1.0, 0] }
cells = [4, 4, 2.0]
split = "kuh"
[material]
law            = "neohookean"
denisty        = 1100.0
youngs_modulus = "17.0e6"
poissons_ratio = 0.5
[physics]
formulation   = "pF"
pressure_jump = "tensor"
[initial]
field = "twist"
omega = nan
v     = 3
[[boundary]]
face = ["zmin", "zmax", "zmin"]
kind = "fixed"
[[boundary]]
face = "zmax"
kind = "pressure"
t    = [1, 2, 3]
[output]
fields = ["x", "velocty", "x"]
probes = { tip = { at = [0, 0], fields = [] } }
)";
  const std::vector<std::string> expected = {
      "scene.toml:1:1: title = \"x\": unknown key, allowed: scene | mesh | material | physics | projection | initial | "
      "boundary | body_force | time | output | monitor",
      "scene.toml:1:1: time: is missing, written time = { end = 0.01 }",
      "scene.toml:2:9: scene = \"twisting column\": names a folder: use letters, digits, - and _ only",
      "scene.toml:4:10: monitor.energy = 1: must be true or false",
      "scene.toml:6:57: mesh.box.size.2 = 0: must be above 0",
      "scene.toml:7:16: mesh.cells.2 = 2.0: must be a whole number",
      "scene.toml:8:9: mesh.split = \"kuh\": unknown word, did you mean \"kuhn\"? allowed: alternating | kuhn",
      "scene.toml:10:18: material.law = \"neohookean\": unknown word, did you mean \"neo_hookean\"? allowed: "
      "linear_elastic | neo_hookean | mooney_rivlin | hencky_j2",
      "scene.toml:11:1: material.denisty = 1100.0: unknown key, did you mean \"density\"? allowed: law | density | "
      "youngs_modulus | poissons_ratio | volumetric | "
      "isochoric",
      "scene.toml:12:18: material.youngs_modulus = \"17.0e6\": must be a number",
      "scene.toml:13:18: material.poissons_ratio = 0.5: must be below 0.5 unless physics.formulation = \"pFp\"",
      "scene.toml:16:17: physics.pressure_jump = \"tensor\": needs an evolved J: formulation = \"pFJ\" or \"pFHJ\"",
      "scene.toml:17:1: initial.height: is missing",
      "scene.toml:19:9: initial.omega = nan: must be finite",
      "scene.toml:20:9: initial.v = 3: is not a key of twist, whose keys are omega | height",
      "scene.toml:22:25: boundary.0.face.2 = \"zmin\": kind fixed cannot join kind fixed of scene.toml:22:9: the list "
      "names it twice",
      "scene.toml:24:1: boundary.1.p: is missing",
      "scene.toml:25:8: boundary.1.face = \"zmax\": kind pressure cannot join kind fixed of scene.toml:22:17: a load "
      "does nothing on a face that is held in all "
      "directions",
      "scene.toml:27:8: boundary.1.t = [1, 2, 3]: is not a key of pressure, whose keys are p",
      "scene.toml:29:16: output.fields.1 = \"velocty\": unknown field, did you mean \"velocity\"? allowed: x | "
      "displacement | velocity | pressure | P | F | H | J | "
      "detF | von_mises | plastic_strain",
      "scene.toml:29:27: output.fields.2 = \"x\": is named twice",
      "scene.toml:30:25: output.probes.tip.at = [0, 0]: must be three numbers",
      "scene.toml:30:42: output.probes.tip.fields = []: must name at least one field",
      "--set #1: abc: must be KEY=VALUE, like material.density=1000.0",
      "--set #2: output.compress = 10: must be at most 9"};
  EXPECT_EQ(read_text(bad, {"abc", "output.compress=10"}).errors, expected);
}

TEST(Scene, LongValuesAreCutInMessages) {
  const SceneResult r = read_text(edited(
      small_scene, "density = 1000", "density = \"" + std::string(71, 'x') + "\u00e9" + std::string(1000, 'y') + "\""));
  ASSERT_EQ(r.errors.size(), 1u);
  EXPECT_EQ(r.errors[0], "scene.toml:6:11: material.density = \"" + std::string(71, 'x') + " ...: must be a number");
}

/// What the solver relies on in a scene that was read without errors.
void expect_usable(const Scene& s) {
  EXPECT_FALSE(s.name.empty());
  EXPECT_TRUE(s.mesh.source == MeshSource::file || (s.mesh.size[0] > 0 && s.mesh.cells[0] >= 1));
  EXPECT_TRUE(s.material.density > 0 && s.material.youngs_modulus > 0 && s.material.poissons_ratio < 0.5);
  EXPECT_TRUE(s.time.end > 0 && s.time.cfl > 0);
  for (const BoundarySpec& b : s.boundary) EXPECT_FALSE(b.faces.empty());
  for (const ProbeSpec& p : s.output.probes) EXPECT_FALSE(p.fields.empty() || p.where.empty());
}

TEST(Scene, DamagedTextGivesErrorsOrAUsableScene) {
  std::mt19937 random(20240607);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  int valid = 0, refused = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string text = column_scene;
    for (std::size_t n = 1 + below(3); n > 0 && !text.empty(); --n) {
      const std::size_t at = below(text.size()), length = std::min(1 + below(i % 10 == 0 ? 200 : 4), text.size() - at);
      switch (below(4)) {
        case 0: text.erase(at, length); break;
        case 1: text.insert(at, text.substr(at, length)); break;
        case 2: text[at] = static_cast<char>(random() % 256); break;
        default: text.insert(below(text.size()), text.substr(at, length));
      }
    }
    const SceneResult r = read_text(text);
    for (const std::string& e : r.errors) EXPECT_TRUE(e.starts_with("scene.toml:")) << e;
    if (r.errors.empty()) expect_usable(r.scene);
    ++(r.errors.empty() ? valid : refused);
  }
  EXPECT_GT(valid, 50);  // the damage hit spaces or digits
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace nanson
