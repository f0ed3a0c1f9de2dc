// Study files: every error at once with its place; settings of runs are checked before anything runs, at the place that sets them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "io/study/read_study.hpp"
#include "io/study/study_scenes.hpp"
#include "scene_text.hpp"
#include "tests/support/temporary_folder.hpp"

namespace nanson {
namespace {

const std::string cube_study = R"(study = "cube"
kind  = "convergence"
scene = "small.toml"
[set]
"time.cfl" = 0.25
[vary]
"physics.formulation" = ["pF", "pFJ"]
"mesh.cells" = [[2, 2, 2], [4, 4, 4]]
[report]
x = "cpu_s"
y = ["energy.strain", "checkerboard"]
lines = "physics.formulation"
rate_over = "mesh.cells"
max_wall_s = 60
)";

const std::string cube_scene = small_scene
                               + "[output]\nprobes = { tip = { at = [1, 2, 3], fields = [\"x\", \"J\"] } }\n";

/// Reads, and prepares when it can be read; the folder's name is cut from the errors.
struct Prepared {
  StudyResult read;
  std::vector<StudyRun> runs;
  std::vector<std::string> errors;
};

Prepared prepared(const std::string& text, const std::string& scene = cube_scene) {
  const test::TemporaryFolder folder;
  test::write_text(folder / "small.toml", edited(scene, "size = [1, 2, 3] }", "size = [1, 2, 3] }\ncells = [1, 1, 1]"));
  test::write_text(folder / "study.toml", text);
  test::write_text(folder / "peers.csv", "label,cpu_s,checkerboard\nother,1.5,0.25\n");
  Prepared p;
  p.read = read_study(folder / "study.toml");
  p.errors = p.read.errors;
  if (p.errors.empty()) p.runs = prepare(p.read.study, p.errors);
  const std::string prefix = folder.path().string() + "/";
  for (std::string& e : p.errors)
    for (auto i = e.find(prefix); i != std::string::npos; i = e.find(prefix)) e.erase(i, prefix.size());
  return p;
}

void expect_errors(const std::string& text, const std::vector<std::string>& starts) {
  const Prepared p = prepared(text);
  ASSERT_EQ(p.errors.size(), starts.size()) << joined(p.errors);
  for (std::size_t i = 0; i < starts.size(); ++i)
    EXPECT_TRUE(p.errors[i].starts_with(starts[i])) << "expected " << starts[i] << joined(p.errors);
}

TEST(Study, AllOfItIsRead) {
  const Prepared p = prepared(cube_study);
  ASSERT_TRUE(p.errors.empty()) << joined(p.errors);
  const Study& s = p.read.study;
  EXPECT_EQ(s.name, "cube");
  EXPECT_EQ(s.kind, StudyKind::convergence);
  EXPECT_EQ(s.threads, 1);
  ASSERT_EQ(s.vary.size(), 2u);
  EXPECT_EQ(s.vary[0].key, "physics.formulation") << "the file's order, not the alphabet's";
  EXPECT_EQ(s.vary[1].values[1].value, "[4, 4, 4]");
  EXPECT_EQ(s.report.x, "cpu_s");
  EXPECT_EQ(s.report.y, (std::vector<std::string>{"energy.strain", "checkerboard"}));
  EXPECT_EQ(s.report.lines, std::vector<std::string>{"physics.formulation"});
  EXPECT_EQ(s.report.x_scale, AxisScale::log);
  EXPECT_EQ(s.report.max_wall_s, 60);
  EXPECT_EQ(p.runs.size(), 4u);
}

TEST(Study, EveryErrorHasItsPlace) {
  expect_errors(
      edited(edited(cube_study, "kind  = \"convergence\"", "kind  = \"converge\"\ncolour = 3"),
             "lines = \"physics.formulation\"", "lines = \"physics.form\""),
      {"study.toml:2:9: kind = \"converge\": unknown word, allowed: convergence | stability | compare | sweep",
       "study.toml:3:1: colour = 3: unknown key, allowed: study | kind | scene | threads | set | vary | case | report",
       "study.toml:13:9: report.lines = \"physics.form\": unknown varied key"});
  expect_errors(edited(cube_study, "max_wall_s = 60", "max_wall = 60"),
                {"study.toml:14:1: report.max_wall = 60: unknown key, did you mean \"max_wall_s\"?"});
  expect_errors(edited(cube_study, "study = \"cube\"\n", ""), {"study.toml:1:1: study: is missing"});
  expect_errors(edited(cube_study, "\"cube\"", "\"a/b\""), {"study.toml:1:9: study = \"a/b\": names a folder"});
  expect_errors(edited(cube_study, "scene = \"small.toml\"\n", ""),
                {"study.toml:1:1: scene: is missing, or every [[case]] needs its own"});
  expect_errors("study = \"x\"\nkind = \"sweep\"\nscene = \"small.toml\"\n",
                {"study.toml:1:1: a study needs [vary] or [[case]]",
                 "study.toml:1:1: report.y: is missing: what the plots show"});
  expect_errors("study = \n", {"study.toml:1:9: "});
}

TEST(Study, VariedKeysAreListsUnderQuotedNames) {
  expect_errors(edited(cube_study, "[\"pF\", \"pFJ\"]", "\"pF\""),
                {"study.toml:7:25: vary.\"physics.formulation\" = \"pF\": must be a list of values, at least one, or a "
                 "range { from, to, count }",
                 "study.toml:12:9: report.lines = \"physics.formulation\": unknown varied key"});
  expect_errors(edited(cube_study, "\"mesh.cells\" = [[2", "mesh.cells = [[2"),
                {"study.toml:8:1: vary.mesh: must be section and key in quotes, like \"mesh.cells\"",
                 "study.toml:13:13: report.rate_over = \"mesh.cells\": unknown varied key"});
  expect_errors(edited(cube_study, "\"pF\", \"pFJ\"", "\"pF\", \"pF\""),
                {"study.toml:7:32: vary.\"physics.formulation\" = \"pF\": is listed twice"});
}

TEST(Study, RangesAreEvenlySpacedOrInRatios) {
  const auto values = [](const std::string& range) {
    std::vector<std::string> texts;
    const Prepared p = prepared(cube_study + "[vary.\"time.end\"]\n" + range);
    EXPECT_TRUE(p.errors.empty()) << joined(p.errors);
    for (const StudyAxis& axis : p.read.study.vary)
      if (axis.key == "time.end")
        for (const StudySetting& s : axis.values) texts.push_back(s.value);
    return texts;
  };
  EXPECT_EQ(values("from = 0.1\nto = 0.4\ncount = 4\n"), (std::vector<std::string>{"0.1", "0.2", "0.3", "0.4"}));
  EXPECT_EQ(values("from = 1\nto = 100\ncount = 3\nscale = \"log\"\n"),
            (std::vector<std::string>{"1.0", "10.0", "100.0"}));
  expect_errors(cube_study + "[vary.\"time.end\"]\nfrom = 0\nto = 1\ncount = 1\nscale = \"log\"\nstep = 2\n",
                {"study.toml:18:9: vary.\"time.end\".count = 1: must be at least 2",
                 "study.toml:19:9: vary.\"time.end\".scale = \"log\": needs from and to above 0",
                 "study.toml:20:1: vary.\"time.end\".step = 2: unknown key"});
}

TEST(Study, UnknownQuantitiesAreRefusedBeforeAnythingRuns) {
  expect_errors(edited(cube_study, "\"cpu_s\"", "\"cpu_z\""),
                {"study.toml:10:5: report.x = \"cpu_z\": unknown quantity, did you mean \"cpu_s\"?"});
  expect_errors(edited(cube_study, "\"energy.strain\"", "\"energy.strian\""),
                {"study.toml:11:6: report.y.0 = \"energy.strian\": unknown quantity, did you mean \"energy.strain\"?"});
  expect_errors(
      edited(cube_study, "\"energy.strain\"", "\"errors.p1_L2\""),
      {"study.toml:11:6: report.y.0 = \"errors.p1_L2\": no exact solution of this scene is known (small.toml)"});
  expect_errors(edited(cube_study, "\"energy.strain\"", "\"energy.closure\""),
                {"study.toml:11:6: report.y.0 = \"energy.closure\": needs monitor.energy = true"});
  expect_errors(
      edited(cube_study, "\"energy.strain\"", "\"probes.tip.y.0\""),
      {"study.toml:11:6: report.y.0 = \"probes.tip.y.0\": unknown probe value, did you mean \"probes.tip.x.0\"?"});
  EXPECT_TRUE(prepared(edited(cube_study, "\"energy.strain\"", "\"probes.tip.x.2\"")).errors.empty());
}

TEST(Study, SettingsOfEveryRunAreCheckedAtThePlaceThatSetsThem) {
  expect_errors(edited(edited(cube_study, "\"pFJ\"]", "\"pJF\"]"), "0.25", "-1"),
                {"study.toml:5:14: time.cfl = -1: must be above 0",
                 "study.toml:7:32: physics.formulation = \"pJF\": unknown word"});
  expect_errors(edited(cube_study, "[4, 4, 4]", "[4, 4]"),
                {"study.toml:8:28: mesh.cells = [4, 4]: must be three whole numbers"});
  expect_errors(edited(cube_study, "\"time.cfl\"", "\"time.clf\""),
                {"study.toml:5:14: time.clf = 0.25: unknown key, did you mean \"cfl\"?"});
  const Prepared p = prepared(cube_study, edited(cube_scene, "density = 1000", "density = -1"));
  ASSERT_EQ(p.errors.size(), 1u) << "four runs share it, it is said once" << joined(p.errors);
  EXPECT_TRUE(p.errors[0].starts_with("small.toml:")) << p.errors[0];
}

TEST(Study, CasesHaveNamesAndSettings) {
  const std::string cases = R"(study = "c"
kind = "compare"
scene = "small.toml"
[[case]]
name = "lean"
set = { "physics.formulation" = "pF", "physics.reconstruction" = "constant" }
[[case]]
name = "rich"
[report]
y = "cpu_s"
baseline = "lean"
)";
  const Prepared p = prepared(cases);
  ASSERT_TRUE(p.errors.empty()) << joined(p.errors);
  ASSERT_EQ(p.runs.size(), 2u);
  EXPECT_EQ(p.runs[0].arguments.back(), "physics.reconstruction=\"constant\"");
  EXPECT_NE(p.runs[0].hash, p.runs[1].hash);
  expect_errors(edited(cases, "\"rich\"", "\"lean\""),
                {"study.toml:8:8: case.1.name = \"lean\": must be a name of its own"});
  expect_errors(edited(cases, "baseline = \"lean\"", "baseline = \"leen\""),
                {"study.toml:11:12: report.baseline = \"leen\": unknown case, did you mean \"lean\"?"});
  expect_errors(edited(cases, "\"constant\"", "\"constnat\""),
                {"study.toml:6:66: physics.reconstruction = \"constnat\": unknown word, did you mean \"constant\"?"});
}

TEST(Study, ReferencePointsStandInTheFileOrBesideIt) {
  const Prepared inside = prepared(cube_study
                                   + "[[report.reference]]\nlabel = \"other\"\ncpu_s = 1.5\ncheckerboard = 0.25\n");
  const Prepared beside = prepared(cube_study + "reference = \"peers.csv\"\n");
  for (const Prepared* p : {&inside, &beside}) {
    ASSERT_TRUE(p->errors.empty()) << joined(p->errors);
    ASSERT_EQ(p->read.study.report.reference.size(), 1u);
    EXPECT_EQ(p->read.study.report.reference[0].label, "other");
    EXPECT_EQ(p->read.study.report.reference[0].values,
              (std::map<std::string, double>{{"cpu_s", 1.5}, {"checkerboard", 0.25}}));
  }
  expect_errors(cube_study + "[[report.reference]]\nlabel = \"other\"\ncpu_s = 1.5\n",
                {"study.toml:15:1: a reference point needs one of energy.strain | checkerboard"});
  expect_errors(cube_study + "reference = \"none.csv\"\n",
                {"study.toml:15:13: report.reference = \"none.csv\": none.csv: no such file"});
}

const std::string map_study = R"(study = "m"
kind  = "stability"
scene = "small.toml"
[vary]
"time.cfl" = [0.1, 0.2]
[report]
y = ["checkerboard"]
)";
const std::string bars_study =
    "study = \"b\"\nkind = \"compare\"\nscene = \"small.toml\"\n[[case]]\nname = \"as it is\"\n[report]\ny = "
    "\"cpu_s\"\n";

TEST(Study, KeysThatItsKindDoesNotShowAreRefused) {
  EXPECT_TRUE(prepared(map_study).errors.empty());
  EXPECT_TRUE(prepared(bars_study).errors.empty());
  const std::string of_a_map =
      ": is not a key of a stability map, whose keys are title | text | x | y | rate_over | max_wall_s | "
      "energy_tolerance | checkerboard_max";
  for (const char* line : {"lines = \"time.cfl\"", "panels = \"time.cfl\"", "x_scale = \"log\"", "y_scale = \"log\"",
                           "baseline = \"a\"", "reference = \"peers.csv\"", "reference_note = \"a\""}) {
    const Prepared p = prepared(map_study + line + "\n");
    ASSERT_EQ(p.errors.size(), 1u) << line << joined(p.errors);
    EXPECT_EQ(p.errors[0],
              fmt::format("study.toml:8:{}: report.{}{}", std::string_view(line).find('=') + 3, line, of_a_map));
  }
  for (const char* line : {"x = \"cpu_s\"", "lines = \"case\"", "y_scale = \"log\""}) {
    const Prepared p = prepared(bars_study + line + "\n");
    ASSERT_EQ(p.errors.size(), 1u) << line << joined(p.errors);
    EXPECT_NE(p.errors[0].find("is not a key of a comparison"), std::string::npos) << p.errors[0];
  }
  expect_errors(cube_study + "baseline = \"a\"\n",
                {"study.toml:15:12: report.baseline = \"a\": is not a key of a study with curves"});
  expect_errors(cube_study + "reference_note = \"a\"\n",
                {"study.toml:15:18: report.reference_note = \"a\": is about report.reference, which is missing"});
}

TEST(Study, WhatNothingCanBeRunOrShownFromIsRefused) {
  expect_errors(edited(map_study, "\"time.cfl\" = [0.1, 0.2]\n", ""),
                {"study.toml:4:1: vary: must be a table of scene keys and lists of values, at least one"});
  expect_errors(edited(bars_study, "[[case]]\nname = \"as it is\"\n", "case = []\n"),
                {"study.toml:4:8: case = []: must have at least one entry"});
  for (const std::string& text : {edited(cube_study, "y = [\"energy.strain\", \"checkerboard\"]\n", ""),
                                  edited(bars_study, "y = \"cpu_s\"\n", "")}) {
    const Prepared p = prepared(text);
    ASSERT_EQ(p.errors.size(), 1u) << joined(p.errors);
    EXPECT_NE(p.errors[0].find("report.y: is missing: what the plots show"), std::string::npos) << p.errors[0];
  }
  expect_errors(cube_study.substr(0, cube_study.find("[report]")),
                {"study.toml:1:1: report.y: is missing: what the plots show"});
  expect_errors(edited(cube_study, "[\"energy.strain\", \"checkerboard\"]", "[]"),
                {"study.toml:11:5: report.y = []: must name at least one quantity"});
  EXPECT_TRUE(prepared(map_study.substr(0, map_study.find("[report]"))).errors.empty()) << "a map shows verdicts";
}

TEST(StudyHash, ChangesWithWhatTheRunIsMadeOf) {
  const auto hash = [](const std::string& study, const std::string& scene = cube_scene) {
    const Prepared p = prepared(study, scene);
    return p.runs.empty() ? "none" + joined(p.errors) : p.runs[0].hash;
  };
  const std::string base = hash(cube_study);
  EXPECT_EQ(hash(edited(cube_study, "max_wall_s = 60", "max_wall_s = 61")), base)
      << "what is judged is not what is run";
  EXPECT_EQ(hash(cube_study, "# a comment\n" + cube_scene), base);
  EXPECT_NE(hash(edited(cube_study, "0.25", "0.26")), base);
  EXPECT_NE(hash(edited(cube_study, "scene = ", "threads = 2\nscene = ")), base);
  EXPECT_NE(hash(cube_study, edited(cube_scene, "density = 1000", "density = 1001")), base);
  EXPECT_EQ(hash(edited(cube_study, "\"time.cfl\" = 0.25", "\"material.density\" = 1000\n\"time.cfl\" = 0.25")), base)
      << "set to what the scene says anyway";
}

TEST(StudyHash, ChangesWithTheContentOfTheMeshFile) {
  const test::TemporaryFolder folder;
  std::string mesh = test::read_text(std::string(NANSON_SOURCE_DIR) + "/configs/meshes/cantilever_cylinder.msh");
  test::write_text(folder / "small.toml", edited(small_scene, "box = { size = [1, 2, 3] }", "file = \"mesh.msh\""));
  test::write_text(folder / "study.toml", edited(edited(cube_study, "\"mesh.cells\" = [[2, 2, 2], [4, 4, 4]]",
                                                        "\"mesh.file\" = [\"mesh.msh\"]"),
                                                 "rate_over = \"mesh.cells\"\n", ""));
  const auto hash = [&] {
    test::write_text(folder / "mesh.msh", mesh);
    std::vector<std::string> errors;
    const StudyResult read = read_study(folder / "study.toml");
    EXPECT_TRUE(read.errors.empty()) << joined(read.errors);
    const auto runs = prepare(read.study, errors);
    EXPECT_TRUE(errors.empty()) << joined(errors);
    return runs.at(0).hash;
  };
  const std::string before = hash();
  EXPECT_EQ(hash(), before);
  mesh += "\n";
  EXPECT_NE(hash(), before);
}

TEST(Study, RunsWithOtherRegionsHaveAMeshOfTheirOwn) {
  const std::string layers =
      R"("mesh.regions" = [{ axis = "z", at = [1.5], names = ["low", "high"] }, { axis = "z", at = [1.5], names = ["low", "top"] }])";
  const std::string text = edited(
      edited(edited(cube_study, "\"mesh.cells\" = [[2, 2, 2], [4, 4, 4]]", layers), "rate_over = \"mesh.cells\"\n", ""),
      "[set]\n", "[set]\n\"mesh.cells\" = [1, 1, 4]\n");
  const Prepared p = prepared(text, edited(cube_scene, "[material]\n", "[[material]]\nregion = [\"low\", \"high\"]\n"));
  ASSERT_EQ(p.errors.size(), 2u) << joined(p.errors);
  EXPECT_NE(joined(p.errors).find("material.0.region = \"high\": unknown region"), std::string::npos)
      << joined(p.errors);
  EXPECT_NE(joined(p.errors).find("no [[material]] is for region \"top\""), std::string::npos) << joined(p.errors);
}

TEST(TomlText, IsReadBackByASetting) {
  for (const char* text : {"1", "0.25", "1e-10", "3.0", "\"a \\\"b\\\" = c\"", "true", "[1, 2, 3]",
                           "[[0.0, 1.5], [1.0, 2.0]]", "{ kind = \"ramp\", until = 0.01 }", "[]", "{  }"}) {
    const toml::table one = toml::parse("v = " + std::string(text));
    const std::string again = toml_text(*one.get("v"));
    EXPECT_EQ(toml_text(*toml::parse("v = " + again).get("v")), again);
    EXPECT_TRUE(toml::parse("v = " + again) == one) << text << " became " << again;
  }
}

TEST(Study, ThoseOfTheRepositoryAreValid) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(NANSON_SOURCE_DIR) + "/configs/studies")) {
    if (entry.path().extension() != ".toml") continue;
    ++count;
    StudyResult r = read_study(entry.path());
    if (r.errors.empty()) prepare(r.study, r.errors);
    EXPECT_TRUE(r.errors.empty()) << entry.path() << joined(r.errors);
  }
  EXPECT_GE(count, 15);
}

}  // namespace
}  // namespace nanson
