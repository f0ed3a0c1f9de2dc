// The rules for single values, for keys that belong to one kind only, and between sections; one edit of a valid scene a rule.
#include <cmath>

#include "tests/unit/scene_text.hpp"

namespace nanson {
namespace {

/// The small scene with lines in place of its material, and with sections appended.
std::string with_material(const std::string& lines) {
  return edited(small_scene, "law = \"linear_elastic\"\ndensity = 1000\nyoungs_modulus = 1e6\npoissons_ratio = 0.3",
                lines);
}
std::string with(const std::string& sections) { return small_scene + sections; }

void expect_error(const std::string& scene, const std::string& error) {
  const SceneResult r = read_text(scene);
  ASSERT_EQ(r.errors.size(), 1u) << error << joined(r.errors);
  EXPECT_TRUE(r.errors[0].starts_with(error)) << "  expected " << error << joined(r.errors);
}

void expect_valid(const std::string& scene) {
  const SceneResult r = read_text(scene);
  EXPECT_TRUE(r.errors.empty()) << scene << joined(r.errors);
}

TEST(Scene, NumbersStayInTheirRange) {
  expect_each_refused(
      column_scene,
      {
          {"[1.0, 1.0, 6.0]", "[1.0, 0.0, 6.0]", "scene.toml:4:54: mesh.box.size.1 = 0.0: must be above 0"},
          {"[4, 4, 24]", "[4, 0, 24]", "scene.toml:5:15: mesh.cells.1 = 0: must be at least 1"},
          {"[4, 4, 24]", "[4, 4, 3000000000]",
           "scene.toml:5:18: mesh.cells.2 = 3000000000: must be at most 2147483647"},
          {"= 0.1\n\n[mat", "= 0.41\n\n[mat", "scene.toml:7:11: mesh.perturb = 0.41: must be at most 0.4"},
          {"= 0.1\n\n[mat", "= -0.1\n\n[mat", "scene.toml:7:11: mesh.perturb = -0.1: must be at least 0"},
          {"1100.0", "0.0", "scene.toml:11:18: material.density = 0.0: must be above 0"},
          {"17.0e6", "0", "scene.toml:12:18: material.youngs_modulus = 0: must be above 0"},
          {"0.45", "0.5", "scene.toml:13:18: material.poissons_ratio = 0.5: must be below 0.5"},
          {"0.45", "-1.0", "scene.toml:13:18: material.poissons_ratio = -1.0: must be above -1"},
          {"height = 6.0", "height = 0", "scene.toml:28:10: initial.height = 0: must not be zero"},
          {"= 0.1\ncfl", "= 0\ncfl", "scene.toml:44:15: time.end = 0: must be above 0"},
          {"0.25", "0.0", "scene.toml:45:15: time.cfl = 0.0: must be above 0"},
          {"0.25", "2.5", "scene.toml:45:15: time.cfl = 2.5: must be at most 2"},
          {"1.0e-4", "0.0", "scene.toml:48:15: time.dt_max = 0.0: must be above 0"},
          {"1.0e-3", "0.0", "scene.toml:49:15: time.dt_collapse = 0.0: must be above 0"},
          {"1.0e-3", "1.0", "scene.toml:49:15: time.dt_collapse = 1.0: must be below 1"},
          {"500", "-1", "scene.toml:50:15: time.max_steps = -1: must be at least 0"},
          {"60", "-1", "scene.toml:51:15: time.max_wall_s = -1: must be at least 0"},
          {"0.005", "0", "scene.toml:54:17: output.every = 0: must be above 0"},
          {"every = 10", "every = 0", "scene.toml:55:17: output.history_every = 0: must be at least 1"},
          {"= 1\nprobes", "= 10\nprobes", "scene.toml:57:17: output.compress = 10: must be at most 9"},
          {"= 1\nprobes", "= -1\nprobes", "scene.toml:57:17: output.compress = -1: must be at least 0"},
          {"0.02", "0.0", "scene.toml:63:20: monitor.energy_tolerance = 0.0: must be above 0"},
      });
  expect_each_accepted(column_scene, {{"= 0.1\n\n[mat", "= 0.4\n\n[mat"},
                                      {"= 0.1\n\n[mat", "= 0\n\n[mat"},
                                      {"0.45", "-0.99"},
                                      {"0.45", "0.4999"},
                                      {"height = 6.0", "height = -6"},
                                      {"0.25", "2"},
                                      {"500", "0"},
                                      {"60", "0"},
                                      {"= 1\nprobes", "= 0\nprobes"},
                                      {"= 1\nprobes", "= 9\nprobes"},
                                      {"every = 10", "every = 1"}});
}

TEST(Scene, CurrentAreasAreRefusedWhereTheyAreNotBuilt) {
  const std::string neo = edited(small_scene, "linear_elastic", "neo_hookean");
  for (const std::string d : {"updated", "pseudo_updated"}) {
    const std::string physics = "[physics]\ndescription = \"" + d + "\"\n";
    expect_valid(neo + physics);
    expect_valid(neo + physics
                 + "reconstruction = \"constant\"\nupwind_metric = \"paper\"\nkeep_angular_momentum = true\n");
    for (const char* lines : {"formulation = \"pF\"\n", "formulation = \"pFHJ\"\n", "reconstruction = \"limited\"\n",
                              "entropy_fix = \"edge\"\n", "boundary_flux = \"paper\"\n", "parting = 1\n"})
      expect_valid(neo + physics + lines);
    expect_error(small_scene + physics,
                 "scene.toml:5:7: material.law = \"linear_elastic\": needs description = \"total\": it is linear");
    for (const auto& [line, allowed] : {std::pair<std::string, std::string>{"stabilisation = \"jst\"", "upwind"},
                                        {"pressure_jump = \"tensor\"", "scalar"},
                                        {"flux_correction = \"pressure\"", "none"},
                                        {"flux_correction = \"full\"", "none"}})
      expect_error(neo + physics + line + "\n",
                   "scene.toml:13:" + std::to_string(line.find('"') + 1) + ": physics." + line
                       + ": is not built yet with current area vectors (physics.description), allowed: " + allowed);
    expect_error(neo + physics + "formulation = \"pFp\"\n",
                 "scene.toml:12:15: physics.description = \"" + d + "\": is not built yet with formulation = \"pFp\"");
  }
}

TEST(Scene, MonitorsAreOffUnlessAskedForAndRefusedWhereTheyMeanNothing) {
  const SceneResult off = read_text(small_scene),
                    on = read_text(with("[monitor]\nentropy = true\ninvolutions = true\ngeometry = \"stop\"\n"));
  EXPECT_FALSE(off.scene.monitor.entropy || off.scene.monitor.involutions);
  EXPECT_EQ(off.scene.monitor.geometry, GeometryWatch::warn);
  EXPECT_TRUE(on.errors.empty()) << joined(on.errors);
  EXPECT_TRUE(on.scene.monitor.entropy && on.scene.monitor.involutions);
  EXPECT_EQ(on.scene.monitor.geometry, GeometryWatch::stop);
  const std::string jst = "[physics]\nstabilisation = \"jst\"\n";
  expect_error(
      with(jst + "[monitor]\nentropy = true\n"),
      "scene.toml:14:11: monitor.entropy = true: counts the edges of the upwind stabilisation only, not of jst");
  expect_valid(with(jst + "[monitor]\ninvolutions = true\ngeometry = \"stop\"\n"));
}

TEST(Scene, EnergyIsGuardedWhereItIsMonitored) {
  const std::string why = "needs monitor.energy = true";
  expect_error(with("[monitor]\nenergy_growth = \"stop\"\n"),
               "scene.toml:12:17: monitor.energy_growth = \"stop\": " + why);
  expect_error(with("[monitor]\nenergy_tolerance = 0.02\n"),
               "scene.toml:12:20: monitor.energy_tolerance = 0.02: " + why);
  expect_valid(with("[monitor]\nenergy = true\nenergy_growth = \"stop\"\nenergy_tolerance = 0.02\n"));
  expect_valid(with("[monitor]\nenergy_growth = \"warn\"\nenergy_tolerance = 0.01\n"));
}

TEST(Scene, ValuesHaveTheirType) {
  expect_each_refused(
      column_scene,
      {
          {"1100.0", "\"1100.0\"", "scene.toml:11:18: material.density = \"1100.0\": must be a number"},
          {"1100.0", "true", "scene.toml:11:18: material.density = true: must be a number"},
          {"17.0e6", "inf", "scene.toml:12:18: material.youngs_modulus = inf: must be finite"},
          {"omega  = 105.0", "omega  = nan", "scene.toml:27:10: initial.omega = nan: must be finite"},
          {"-9.81]", "-inf]", "scene.toml:41:16: body_force.g.2 = -inf: must be finite"},
          {"-9.81]", "-9.81, 0.0]", "scene.toml:41:5: body_force.g = [0.0, 0.0, -9.81, 0.0]: must be three numbers"},
          {"[0.0, 0.0, -9.81]", "-9.81", "scene.toml:41:5: body_force.g = -9.81: must be three numbers"},
          {"[0.0, 0.0, -9.81]", "[0.0, \"0.0\", -9.81]",
           "scene.toml:41:11: body_force.g.1 = \"0.0\": must be a number"},
          {"[4, 4, 24]", "[4, 4]", "scene.toml:5:11: mesh.cells = [4, 4]: must be three whole numbers"},
          {"[4, 4, 24]", "[4, 4.0, 24]", "scene.toml:5:15: mesh.cells.1 = 4.0: must be a whole number"},
          {"500", "500.0", "scene.toml:50:15: time.max_steps = 500.0: must be a whole number"},
          {"= true", "= \"true\"", "scene.toml:61:20: monitor.energy = \"true\": must be true or false"},
          {"\"stop\"", "1", "scene.toml:62:20: monitor.energy_growth = 1: must be one of warn | stop"},
          {"[\"displacement\", \"pressure\"]", "\"x\"",
           "scene.toml:56:17: output.fields = \"x\": must be a list of names"},
          {"[\"displacement\", \"pressure\"]", "[\"x\", 3]", "scene.toml:56:23: output.fields.1 = 3: must be a string"},
          {"face = \"zmin\"", "face = 3", "scene.toml:31:8: boundary.0.face = 3: must be a name or a list of names"},
      });
  expect_each_accepted(column_scene, {{"1100.0", "1100"}, {"[0.0, 0.0, -9.81]", "[0, 0, -10]"}});
}

TEST(Scene, WholeNumbersTooLongForADoubleAreStillNumbers) {
  EXPECT_EQ(read_text(edited(small_scene, "density = 1000", "density = 9007199254740993")).scene.material.density,
            9007199254740992.0);
}

TEST(Scene, WordsAreCheckedInEveryChoice) {
  expect_each_refused(
      column_scene,
      {
          {"\"kuhn\"", "\"kuhm\"",
           "scene.toml:6:11: mesh.split = \"kuhm\": unknown word, did you mean \"kuhn\"? allowed: alternating | kuhn"},
          {"\"barrier\"", "\"log\"",
           "scene.toml:14:18: material.volumetric = \"log\": unknown word, allowed: quadratic | barrier"},
          {"\"J\"", "\"j\"", "scene.toml:15:18: material.isochoric = \"j\": unknown word, allowed: F | J"},
          {"\"tensor\"", "\"tenser\"",
           "scene.toml:19:19: physics.pressure_jump = \"tenser\": unknown word, did you mean \"tensor\"? allowed: "
           "scalar | tensor"},
          {"\"full\"", "\"fall\"",
           "scene.toml:21:19: physics.flux_correction = \"fall\": unknown word, did you mean \"full\"?"},
          {"boundary_flux   = \"paper\"", "boundary_flux   = \"x\"",
           "scene.toml:22:19: physics.boundary_flux = \"x\": unknown word"},
          {"upwind_metric   = \"paper\"", "upwind_metric   = \"x\"",
           "scene.toml:23:19: physics.upwind_metric = \"x\": unknown word"},
          {"\"fixed\"", "\"fix\"", "scene.toml:32:8: boundary.0.kind = \"fix\": unknown word"},
          {"\"ramp\"", "\"rmap\"",
           "scene.toml:38:17: boundary.1.time.kind = \"rmap\": unknown word, did you mean \"ramp\"?"},
          {"\"ssp_rk3\"", "\"rk4\"",
           "scene.toml:46:15: time.integrator = \"rk4\": unknown word, allowed: tvd_rk2 | ssp_rk3"},
          {"\"edge\"", "\"edges\"", "scene.toml:47:15: time.step = \"edges\": unknown word, did you mean \"edge\"?"},
          {"\"stop\"", "\"halt\"",
           "scene.toml:62:20: monitor.energy_growth = \"halt\": unknown word, allowed: warn | stop"},
      });
}

TEST(Scene, MeshHasExactlyOneSource) {
  const TempFolder folder;
  folder.write("bar.msh", "");
  const std::string file = edited(small_scene, "box = { size = [1, 2, 3] }", "file = \"bar.msh\"");
  const auto errors = [&](const std::string& text) { return read_scene(folder.write("scene.toml", text)).errors; };
  const auto expect = [&](const std::string& text, const std::string& fragment) {
    ASSERT_EQ(errors(text).size(), 1u) << joined(errors(text));
    EXPECT_NE(errors(text)[0].find(fragment), std::string::npos) << joined(errors(text));
  };
  const SceneResult r = read_scene(folder.write("scene.toml", file));
  EXPECT_TRUE(r.errors.empty()) << joined(r.errors);
  EXPECT_EQ(r.scene.mesh.source, MeshSource::file);
  EXPECT_EQ(r.scene.mesh.file.name, (folder.path / "bar.msh").string());
  EXPECT_EQ(r.scene.mesh.file.where, (folder.path / "scene.toml").string() + ":3:8");
  expect(
      edited(file, "file =", "box = { size = [1, 1, 1] }\nfile ="),
      "scene.toml:4:8: mesh.file = \"bar.msh\": stands beside mesh.box, exactly one of box | cylinder | needle | file");
  expect(edited(file, "file =", "box = { size = [1, 1, 1] }\ncells = [2, 2, 2]\nfile ="),
         "scene.toml:5:8: mesh.file = \"bar.msh\": stands beside mesh.box");
  expect(edited(file, "bar.msh", "rod.msh"),
         "scene.toml:3:8: mesh.file = \"rod.msh\": there is no file " + (folder.path / "rod.msh").string());
  expect(edited(file, "\"bar.msh\"", "\"\""), "mesh.file = \"\": there is no file");
  expect(edited(file, "file =", "cells = [1, 1, 1]\nfile ="),
         "scene.toml:3:9: mesh.cells = [1, 1, 1]: is not a key of file");
  expect(edited(file, "file =", "split = \"kuhn\"\nfile ="),
         "scene.toml:3:9: mesh.split = \"kuhn\": is not a key of file");
  expect(edited(file, "file =", "perturb = 0\nfile ="), "scene.toml:3:11: mesh.perturb = 0: is not a key of file");
}

TEST(Scene, BoxHasNoMoreNodesAndTetsThanAnIntCounts) {
  const auto box = [](const std::string& cells) {
    return edited(small_scene, "[material]", "cells = " + cells + "\n[material]");
  };
  expect_valid(box("[357913941, 1, 1]"));
  expect_error(box("[357913942, 1, 1]"),
               "scene.toml:4:9: mesh.cells = [357913942, 1, 1]: makes 1.43e+09 nodes and 2.15e+09 tets, at most "
               "2147483647 of each");
  expect_error(box("[1000000, 1000000, 1000000]"),
               "scene.toml:4:9: mesh.cells = [1000000, 1000000, 1000000]: makes 1e+18 nodes and 6e+18 tets");
}

TEST(Scene, XiBelongsToMooneyRivlinAndLeavesZetaPositive) {
  const std::string base = "density = 1\nyoungs_modulus = 3.0\npoissons_ratio = 0.0\nlaw = ";  // mu = 1.5
  const double limit = 1.5 / (3 * std::sqrt(3.0));
  EXPECT_EQ(read_text(with_material(base + "\"mooney_rivlin\"\nxi = 0.25")).scene.material.xi, 0.25);
  expect_valid(with_material(base + "\"mooney_rivlin\"\nxi = 0"));
  expect_valid(with_material(base + "\"mooney_rivlin\"\nxi = " + std::to_string(limit - 1e-6)));
  expect_error(with_material(base + "\"mooney_rivlin\"\nxi = " + std::to_string(limit + 1e-6)),
               "scene.toml:9:6: material.xi = 0.288676: must be below mu / (3 sqrt(3)) = 0.288675");
  expect_error(with_material(base + "\"mooney_rivlin\"\nxi = -0.1"),
               "scene.toml:9:6: material.xi = -0.1: must be at least 0");
  expect_error(with_material(base + "\"mooney_rivlin\""), "scene.toml:4:1: material.xi: is missing");
  expect_error(
      with_material("density = 1\nyoungs_modulus = -3.0\npoissons_ratio = 0.0\nlaw = \"mooney_rivlin\"\nxi = 1"),
      "scene.toml:6:18: material.youngs_modulus");
  expect_error(with_material(base + "\"neo_hookean\"\nxi = 0"),
               "scene.toml:9:6: material.xi = 0: is not a key of neo_hookean");
  expect_error(with_material(base + "\"linear_elastic\"\nxi = 0"),
               "scene.toml:9:6: material.xi = 0: is not a key of linear_elastic");
}

TEST(Scene, LinearElasticAcceptsOnlyDefaultsOfWhatItCannotUse) {
  const std::string linear = "law = \"linear_elastic\"";
  expect_each_refused(small_scene,
                      {
                          {linear, linear + "\nvolumetric = \"barrier\"",
                           "scene.toml:6:14: material.volumetric = \"barrier\": has no meaning for linear_elastic and "
                           "hencky_j2, whose energies are their own, allowed: quadratic"},
                          {linear, linear + "\nisochoric = \"J\"",
                           "scene.toml:6:13: material.isochoric = \"J\": has no meaning for linear_elastic and "
                           "hencky_j2, whose energies are their own, allowed: F"},
                      });
  expect_each_accepted(small_scene, {{linear, linear + "\nvolumetric = \"quadratic\"\nisochoric = \"F\""}});
  expect_valid(with("[physics]\nupwind_metric = \"paper\"\n"));
}

TEST(Scene, WithoutAnEvolvedJNothingAsksForOne) {
  const std::string pF = "[physics]\nformulation = \"pF\"\n",
                    why = ": needs an evolved J: formulation = \"pFJ\" or \"pFHJ\"";
  const std::string wave = pF + "[initial]\nfield = \"standing_wave\"\namplitude = 1\n";
  expect_error(with(pF + "pressure_jump = \"tensor\"\n"), "scene.toml:13:17: physics.pressure_jump = \"tensor\"" + why);
  expect_error(with(wave + "J = \"det\"\n"), "scene.toml:16:5: initial.J = \"det\"" + why);
  expect_error(edited(with(pF), "\"linear_elastic\"", "\"neo_hookean\"\nisochoric = \"J\""),
               "scene.toml:6:13: material.isochoric = \"J\"" + why);
  expect_valid(with(pF + "pressure_jump = \"scalar\"\n"));
  expect_valid(with(wave + "J = \"linear\"\n"));
  expect_valid(edited(with(pF), "\"linear_elastic\"", "\"neo_hookean\"\nisochoric = \"F\""));
  expect_valid(
      with("[physics]\nformulation = \"pFHJ\"\npressure_jump = \"tensor\"\n[initial]\nfield = "
           "\"standing_wave\"\namplitude = 1\nJ = \"det\"\n"));
}

TEST(Scene, PartingNeedsAJThatItsEnergyCanMove) {
  const auto rubber = [](const std::string& lines) {
    return edited(with("[physics]\nparting = 1\n" + lines), "linear_elastic", "neo_hookean");
  };
  const auto refused = [&](const std::string& lines, const std::string& why) {
    expect_error(rubber(lines), "scene.toml:12:11: physics.parting = 1: " + why);
  };
  refused("formulation = \"pF\"\n", "needs an evolved J: formulation = \"pFJ\" or \"pFHJ\"");
  refused("formulation = \"pFp\"\n", "needs an evolved J: formulation = \"pFJ\" or \"pFHJ\"");
  refused("stabilisation = \"jst\"\n", "acts through the jump of Sigma_J, which stabilisation = \"jst\" does not take");
  refused("pressure_jump = \"tensor\"\n",
          "acts through the jump of Sigma_J, which pressure_jump = \"tensor\" does not take");
  expect_error(with("[physics]\nparting = 1\n"),
               "scene.toml:12:11: physics.parting = 1: has no meaning for linear_elastic");
  expect_valid(edited(rubber(""), "\"neo_hookean\"", "\"neo_hookean\"\nvolumetric = \"barrier\"\nisochoric = \"J\""));
  expect_error(edited(rubber(""), "parting = 1", "parting = -1"),
               "scene.toml:12:11: physics.parting = -1: must be at least 0");
  expect_error(edited(rubber(""), "parting = 1", "parting = inf"),
               "scene.toml:12:11: physics.parting = inf: must be finite");
  for (const char* lines :
       {"", "formulation = \"pFHJ\"\n", "flux_correction = \"full\"\n", "reconstruction = \"limited\"\n",
        "keep_angular_momentum = true\n", "description = \"updated\"\n"})
    expect_valid(rubber(lines));
  for (const char* lines : {"formulation = \"pF\"\n", "stabilisation = \"jst\"\n", "description = \"updated\"\n"})
    expect_valid(edited(rubber(lines), "parting = 1", "parting = 0"));
  EXPECT_EQ(read_text(rubber("")).scene.physics.parting, 1.0);
}

TEST(Scene, EnergiesOfTheTetsNeedTheAdjointBoundaryAndTheBarrierADetF) {
  const std::string rubber = edited(small_scene, "linear_elastic", "neo_hookean") + "[physics]\n";
  const std::string why = "needs boundary_flux = \"adjoint\": its forces on the nodes of a tet";
  expect_error(rubber + "tet_stiffness = 0.1\nboundary_flux = \"paper\"\n",
               "scene.toml:12:17: physics.tet_stiffness = 0.1: " + why);
  expect_error(rubber + "tet_barrier = 0.5\nboundary_flux = \"paper\"\n",
               "scene.toml:12:15: physics.tet_barrier = 0.5: " + why);
  expect_error(with("[physics]\ntet_barrier = 0.5\n"),
               "scene.toml:12:15: physics.tet_barrier = 0.5: has no meaning for linear_elastic");
  expect_error(rubber + "tet_stiffness = 1.1\n", "scene.toml:12:17: physics.tet_stiffness = 1.1: must be at most 1");
  expect_error(rubber + "tet_barrier = -1\n", "scene.toml:12:15: physics.tet_barrier = -1: must be at least 0");
  expect_valid(with("[physics]\ntet_stiffness = 0.1\n"));
  for (const char* lines :
       {"", "formulation = \"pF\"\n", "formulation = \"pFp\"\n", "stabilisation = \"jst\"\n",
        "reconstruction = \"limited\"\n", "flux_correction = \"full\"\n", "pressure_jump = \"tensor\"\n",
        "keep_angular_momentum = true\n", "description = \"pseudo_updated\"\n"})
    expect_valid(rubber + "tet_stiffness = 0.1\ntet_barrier = 0.5\n" + lines);
}

TEST(Scene, FluxCorrectionNeedsGradients) {
  expect_error(with("[physics]\nreconstruction = \"constant\"\nflux_correction = \"pressure\"\n"),
               "scene.toml:13:19: physics.flux_correction = \"pressure\": needs reconstruction = \"linear\"");
  expect_error(with("[physics]\nreconstruction = \"constant\"\nflux_correction = \"full\"\n"),
               "scene.toml:13:19: physics.flux_correction = \"full\": needs reconstruction = \"linear\"");
  expect_valid(with("[physics]\nreconstruction = \"constant\"\nflux_correction = \"none\"\n"));
  expect_valid(with("[physics]\nflux_correction = \"full\"\n"));
}

TEST(Scene, RulesAreSilentAboutValuesThatAreWrongThemselves) {
  expect_error(with("[physics]\nformulation = \"pFx\"\npressure_jump = \"tensor\"\n"),
               "scene.toml:12:15: physics.formulation = \"pFx\": unknown word");
  expect_error(with("[physics]\nreconstruction = \"const\"\nflux_correction = \"full\"\n"),
               "scene.toml:12:18: physics.reconstruction = \"const\": unknown word");
  expect_error(edited(with("[initial]\nfield = \"standing_wave\"\namplitude = 1\n"), "linear_elastic", "linear"),
               "scene.toml:5:7: material.law = \"linear\": unknown word");
  expect_error(with("[initial]\nfield = \"twists\"\nomega = [1]\nheight = 0\n"),
               "scene.toml:12:9: initial.field = \"twists\": unknown word, did you mean \"twist\"?");
  expect_error(with("[[boundary]]\nface = \"a\"\nkind = \"velocity\"\nv = [1, 2]\n[[boundary]]\nface = \"a\"\nkind = "
                    "\"traction\"\nt = [0, 0, 0]\n"),
               "scene.toml:14:5: boundary.0.v = [1, 2]: must be three numbers, or \"free\"");
  expect_error(with("[[boundary]]\nface = \"a\"\nkind = \"velocity\"\nv = [1, 2, inf]\n[[boundary]]\nface = "
                    "\"a\"\nkind = \"pressure\"\np = 1\n"),
               "scene.toml:14:12: boundary.0.v.2 = inf: must be finite");
}

TEST(Scene, InitialFieldsReadTheirOwnKeys) {
  const auto initial = [](const std::string& lines) {
    const SceneResult r = read_text(with("[initial]\n" + lines));
    EXPECT_TRUE(r.errors.empty()) << joined(r.errors);
    return r.scene.initial;
  };
  EXPECT_EQ(initial("field = \"velocity\"\nv = [1, 2, 3]\n").v, (Vec3{1, 2, 3}));
  EXPECT_EQ(initial("field = \"rotation\"\nomega = [1, 2, 3]\n").omega, (Vec3{1, 2, 3}));
  EXPECT_FALSE(initial("field = \"rotation\"\nomega = [1, 2, 3]\ncentre = \"mass\"\n").centre);
  EXPECT_EQ(initial("field = \"rotation\"\nomega = [1, 2, 3]\ncentre = [4, 5, 6]\n").centre, (Vec3{4, 5, 6}));
  const InitialSpec plate = initial("field = \"plate_mode\"\namplitude = 1\nomega = 2\nB = 3\n");
  EXPECT_EQ(plate.amplitude, 1);
  EXPECT_EQ(plate.mode_omega, 2);
  EXPECT_EQ(plate.B, 3);
  const InitialSpec punch = initial("field = \"punch\"\nv0 = 700\nheight = 0.5\n");
  EXPECT_EQ(punch.v0, 700);
  EXPECT_EQ(punch.height, 0.5);
  const InitialSpec standing = initial("field = \"standing_wave\"\namplitude = 0.5\nJ = \"det\"\n");
  EXPECT_EQ(standing.amplitude, 0.5);
  EXPECT_EQ(standing.J, InitialJ::det);
  const InitialSpec plane = initial(
      "field = \"plane_wave\"\namplitude = 0.5\nlength = 2\ndirection = [3, 0, 4]\nJ = \"linear\"\n");
  EXPECT_EQ(plane.length, 2);
  EXPECT_NEAR(plane.direction[0], 0.6, 1e-15);
  EXPECT_NEAR(plane.direction[2], 0.8, 1e-15);
  EXPECT_EQ(initial("field = \"plane_wave\"\namplitude = 0.5\nlength = 2\n").direction, (Vec3{1, 0, 0}));
}

TEST(Scene, DirectionIsNormalisedWithoutOverOrUnderflow) {
  const std::string wave = "[initial]\nfield = \"plane_wave\"\namplitude = 1\nlength = 1\ndirection = ";
  EXPECT_NEAR(read_text(with(wave + "[1e300, 1e300, 0]\n")).scene.initial.direction[0], std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(read_text(with(wave + "[0, 1e-300, 1e-300]\n")).scene.initial.direction[1], std::sqrt(0.5), 1e-15);
  expect_error(with(wave + "[0, 0.0, 0]\n"), "scene.toml:15:13: initial.direction = [0, 0.0, 0]: must not be zero");
}

TEST(Scene, KeysOfOtherInitialFieldsAreRefused) {
  const auto initial = [](const std::string& lines) { return with("[initial]\n" + lines); };
  expect_error(initial("field = \"rotation\"\nomega = [0, 0, 1]\nheight = 1\n"),
               "scene.toml:14:10: initial.height = 1: is not a key of rotation, whose keys are omega | centre");
  expect_error(initial("v = [0, 0, 1]\n"), "scene.toml:12:5: initial.v = [0, 0, 1]: is not a key of rest");
  expect_error(initial("field = \"velocity\"\nv = [0, 0, 1]\nomega = 1\n"),
               "scene.toml:14:9: initial.omega = 1: is not a key of velocity");
  expect_error(initial("field = \"twist\"\nomega = 1\nheight = 1\ncentre = \"mass\"\n"),
               "scene.toml:15:10: initial.centre = \"mass\": is not a key of twist");
  expect_error(initial("field = \"twist\"\nomega = 1\nheight = 1\nB = 1\n"),
               "scene.toml:15:5: initial.B = 1: is not a key of twist");
  expect_error(initial("field = \"twist\"\nomega = 1\nheight = 1\nJ = \"linear\"\n"),
               "scene.toml:15:5: initial.J = \"linear\": is not a key of twist");
  expect_error(initial("field = \"standing_wave\"\namplitude = 1\nlength = 1\n"),
               "scene.toml:14:10: initial.length = 1: is not a key of standing_wave");
  expect_error(initial("field = \"standing_wave\"\namplitude = 1\ndirection = [1, 0, 0]\n"),
               "scene.toml:14:13: initial.direction = [1, 0, 0]: is not a key of standing_wave");
  expect_error(initial("field = \"rest\"\namplitude = 1\n"),
               "scene.toml:13:13: initial.amplitude = 1: is not a key of rest");
}

TEST(Scene, AngularMomentumIsKeptUnderTvdRk2Only) {
  EXPECT_TRUE(read_text(with("[physics]\nkeep_angular_momentum = true\n")).scene.physics.keep_angular_momentum);
  EXPECT_FALSE(read_text(small_scene).scene.physics.keep_angular_momentum);
  const std::string rk3 = edited(small_scene, "end = 1\n", "end = 1\nintegrator = \"ssp_rk3\"\n");
  expect_valid(rk3 + "[physics]\nkeep_angular_momentum = false\n");
  expect_error(rk3 + "[physics]\nkeep_angular_momentum = true\n",
               "scene.toml:13:25: physics.keep_angular_momentum = true: needs time.integrator = \"tvd_rk2\": for the "
               "stages of ssp_rk3 no arms are built");
}

TEST(Scene, InitialFieldsRequireTheirKeys) {
  const auto missing = [](const std::string& lines, const std::string& key) {
    expect_error(with("[initial]\n" + lines), "scene.toml:11:1: initial." + key + ": is missing");
  };
  missing("field = \"velocity\"\n", "v");
  missing("field = \"rotation\"\n", "omega");
  missing("field = \"twist\"\nheight = 1\n", "omega");
  missing("field = \"twist\"\nomega = 1\n", "height");
  missing("field = \"plate_mode\"\nomega = 1\nB = 1\n", "amplitude");
  missing("field = \"plate_mode\"\namplitude = 1\nB = 1\n", "omega");
  missing("field = \"plate_mode\"\namplitude = 1\nomega = 1\n", "B");
  missing("field = \"standing_wave\"\n", "amplitude");
  missing("field = \"plane_wave\"\nlength = 1\n", "amplitude");
  missing("field = \"punch\"\nheight = 1\n", "v0");
  missing("field = \"punch\"\nv0 = 1\n", "height");
  missing("field = \"plane_wave\"\namplitude = 1\n", "length");
}

TEST(Scene, CentreIsMassOrThreeNumbers) {
  const std::string rotation = "[initial]\nfield = \"rotation\"\nomega = [0, 0, 1]\ncentre = ";
  expect_error(with(rotation + "\"origin\"\n"),
               "scene.toml:14:10: initial.centre = \"origin\": must be \"mass\" or three numbers");
  expect_error(with(rotation + "[0, 0]\n"), "scene.toml:14:10: initial.centre = [0, 0]: must be three numbers");
}

TEST(Scene, WavesNeedTheLinearLawAndALength) {
  const std::string standing = with("[initial]\nfield = \"standing_wave\"\namplitude = 1\n"),
                    plane = with("[initial]\nfield = \"plane_wave\"\namplitude = 1\nlength = 1\n");
  expect_error(edited(standing, "linear_elastic", "neo_hookean"),
               "scene.toml:12:9: initial.field = \"standing_wave\": needs material.law = \"linear_elastic\"");
  expect_error(edited(plane, "linear_elastic", "neo_hookean"),
               "scene.toml:12:9: initial.field = \"plane_wave\": needs material.law = \"linear_elastic\"");
  expect_error(edited(plane, "length = 1", "length = 0"), "scene.toml:14:10: initial.length = 0: must be above 0");
  expect_valid(standing);
  expect_valid(plane);
}

TEST(Scene, OutputFieldsAreKnownAndNamedOnce) {
  expect_each_refused(
      column_scene,
      {
          {"\"displacement\", ", "\"displacemnt\", ",
           "scene.toml:56:18: output.fields.0 = \"displacemnt\": unknown field, did you mean \"displacement\"? "
           "allowed: x |"},
          {"\"displacement\", ", "\"pressure\", ", "scene.toml:56:30: output.fields.1 = \"pressure\": is named twice"},
          {"[\"x\", \"velocity\"]", "[\"x\", \"v\"]",
           "scene.toml:58:64: output.probes.tip.fields.1 = \"v\": unknown field, allowed: x | displacement | velocity"},
          {"[\"x\", \"velocity\"]", "[\"x\", \"x\"]",
           "scene.toml:58:64: output.probes.tip.fields.1 = \"x\": is named twice"},
          {"[\"x\", \"velocity\"]", "[]",
           "scene.toml:58:58: output.probes.tip.fields = []: must name at least one field"},
          {"[0.5, 0.5, 6.0]", "[0.5, 0.5, nan]", "scene.toml:58:43: output.probes.tip.at.2 = nan: must be finite"},
      });
  expect_each_accepted(
      column_scene,
      {{"[\"displacement\", \"pressure\"]", "[]"},
       {"[\"displacement\", \"pressure\"]",
        "[\"x\", \"displacement\", \"velocity\", \"pressure\", \"P\", \"F\", \"H\", \"J\", \"detF\", \"von_mises\"]"}});
}

TEST(Scene, ProbeNamesArePlain) {
  expect_each_refused(
      column_scene,
      {
          {"tip =", "\"my tip\" =",
           "scene.toml:58:30: output.probes.\"my tip\": names a column: use letters, digits, - and _ only"},
          {"tip =", "\"\" =", "scene.toml:58:24: output.probes.\"\": names a column"},
      });
  expect_each_accepted(column_scene, {{"tip =", "Tip_2-b ="}});
}

}  // namespace
}  // namespace nanson
