// [[boundary]] entries: values of each kind, functions of time, and kinds that meet on one face.
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/scene_text.hpp"

namespace nanson {
namespace {

std::string entry(const std::string& face, const std::string& kind, const std::string& more = {}) {
  return "[[boundary]]\nface = \"" + face + "\"\nkind = \"" + kind + "\"\n" + more;
}

std::vector<BoundarySpec> read_boundary(const std::string& entries) {
  const SceneResult r = read_text(small_scene + entries);
  EXPECT_TRUE(r.errors.empty()) << entries << joined(r.errors);
  return r.scene.boundary;
}

void expect_error(const std::string& entries, const std::string& error) {
  const SceneResult r = read_text(small_scene + entries);
  ASSERT_EQ(r.errors.size(), 1u) << entries << joined(r.errors);
  EXPECT_TRUE(r.errors[0].starts_with(error)) << "  expected " << error << joined(r.errors);
}

TEST(Scene, BoundaryKindsReadTheirValue) {
  EXPECT_EQ(read_boundary(entry("a", "traction", "t = [1, 2, 3]\n"))[0].traction, (Vec3{1, 2, 3}));
  EXPECT_EQ(read_boundary(entry("a", "pressure", "p = -5\n"))[0].pressure, -5);
  EXPECT_EQ(read_boundary(entry("a", "velocity", "v = [1, 2, 3]\n"))[0].velocity, (Vec3{1, 2, 3}));
  for (const std::string kind : {"fixed", "free", "symmetric", "skew_symmetric"})
    EXPECT_EQ(word(read_boundary(entry("a", kind))[0].kind), kind);
}

TEST(Scene, BoundaryFacesAreOneNameOrAList) {
  EXPECT_EQ(read_boundary(entry("a", "fixed"))[0].faces.size(), 1u);
  const auto list = read_boundary("[[boundary]]\nface = [\"a\", \"b\"]\nkind = \"fixed\"\n");
  ASSERT_EQ(list[0].faces.size(), 2u);
  EXPECT_EQ(list[0].faces[1].name, "b");
  expect_error("[[boundary]]\nface = []\nkind = \"fixed\"\n",
               "scene.toml:12:8: boundary.0.face = []: must name at least one face");
  expect_error("[[boundary]]\nface = [\"a\", 1]\nkind = \"fixed\"\n",
               "scene.toml:12:14: boundary.0.face.1 = 1: must be a string");
}

TEST(Scene, VelocityLeavesFreeComponents) {
  const BoundarySpec b = read_boundary(entry("a", "velocity", "v = [1.5, \"free\", 0]\n"))[0];
  EXPECT_EQ(b.held, (std::array<bool, 3>{true, false, true}));
  EXPECT_EQ(b.velocity, (Vec3{1.5, 0, 0}));
  expect_error(entry("a", "velocity", "v = [1, \"fre\", 0]\n"),
               "scene.toml:14:9: boundary.0.v.1 = \"fre\": must be a number or \"free\"");
  expect_error(entry("a", "velocity", "v = [1, true, 0]\n"),
               "scene.toml:14:9: boundary.0.v.1 = true: must be a number");
  expect_error(entry("a", "velocity", "v = [1, inf, 0]\n"), "scene.toml:14:9: boundary.0.v.1 = inf: must be finite");
  expect_error(entry("a", "velocity", "v = [1, 2]\n"),
               "scene.toml:14:5: boundary.0.v = [1, 2]: must be three numbers, or \"free\" in place of some");
  expect_error(entry("a", "velocity", "v = 1\n"), "scene.toml:14:5: boundary.0.v = 1: must be three numbers");
  expect_error(entry("a", "velocity", "v = [\"free\", \"free\", \"free\"]\n"),
               "scene.toml:14:5: boundary.0.v = [\"free\", \"free\", \"free\"]: holds no component");
}

TEST(Scene, BoundaryKindsRequireTheirValue) {
  expect_error(entry("a", "traction"), "scene.toml:11:1: boundary.0.t: is missing");
  expect_error(entry("a", "pressure"), "scene.toml:11:1: boundary.0.p: is missing");
  expect_error(entry("a", "velocity"), "scene.toml:11:1: boundary.0.v: is missing");
}

TEST(Scene, KeysOfOtherBoundaryKindsAreRefused) {
  expect_error(entry("a", "fixed", "t = [1, 2, 3]\n"),
               "scene.toml:14:5: boundary.0.t = [1, 2, 3]: is not a key of fixed");
  expect_error(entry("a", "symmetric", "v = [1, 2, 3]\n"),
               "scene.toml:14:5: boundary.0.v = [1, 2, 3]: is not a key of symmetric");
  expect_error(entry("a", "pressure", "p = 1\nt = [1, 2, 3]\n"),
               "scene.toml:15:5: boundary.0.t = [1, 2, 3]: is not a key of pressure, whose keys are p");
  expect_error(entry("a", "traction", "t = [1, 2, 3]\np = 1\n"),
               "scene.toml:15:5: boundary.0.p = 1: is not a key of traction, whose keys are t");
}

TEST(Scene, TimeFunctionsReadTheirKeys) {
  const auto read = [](const std::string& time) {
    return read_boundary(entry("a", "pressure", "p = 1\ntime = " + time + "\n"))[0].time;
  };
  EXPECT_EQ(read("{ kind = \"constant\" }").kind, TimeKind::constant);
  EXPECT_EQ(read("{ kind = \"ramp\", until = 2 }").until, 2);
  const TimeFunction sine = read("{ kind = \"sine\", frequency = 3, phase = -1 }");
  EXPECT_EQ(sine.frequency, 3);
  EXPECT_EQ(sine.phase, -1);
  EXPECT_EQ(read("{ kind = \"sine\", frequency = 3 }").phase, 0);
  const TimeFunction pulse = read("{ kind = \"pulse\", from = 1, until = 2 }");
  EXPECT_EQ(pulse.from, 1);
  EXPECT_EQ(pulse.until, 2);
  const TimeFunction logistic = read("{ kind = \"logistic\", rate = 4, centre = 5, until = 6 }");
  EXPECT_EQ(logistic.rate, 4);
  EXPECT_EQ(logistic.centre, 5);
  EXPECT_EQ(logistic.until, 6);
  EXPECT_EQ(read("{ kind = \"table\", points = [[0, 1], [0.5, 2.5]] }").points,
            (std::vector<std::pair<double, double>>{{0, 1}, {0.5, 2.5}}));
}

TEST(Scene, TimeFunctionsCheckTheirParameters) {
  const auto refuse = [](const std::string& time, const std::string& error) {
    expect_error(entry("a", "pressure", "p = 1\ntime = { kind = " + time + " }\n"), "scene.toml:15:" + error);
  };
  refuse("\"ramp\", until = 0", "33: boundary.0.time.until = 0: must be above 0");
  refuse("\"ramp\"", "8: boundary.0.time.until: is missing");
  refuse("\"sine\", frequency = 0", "37: boundary.0.time.frequency = 0: must be above 0");
  refuse("\"sine\"", "8: boundary.0.time.frequency: is missing");
  refuse("\"sine\", frequency = 1, phase = inf", "48: boundary.0.time.phase = inf: must be finite");
  refuse("\"pulse\", from = 2, until = 2", "44: boundary.0.time.until = 2: must be above from = 2");
  refuse("\"pulse\", until = 2", "8: boundary.0.time.from: is missing");
  refuse("\"pulse\", from = 2", "8: boundary.0.time.until: is missing");
  refuse("\"logistic\", rate = 0, centre = 1, until = 1", "36: boundary.0.time.rate = 0: must be above 0");
  refuse("\"logistic\", rate = 1, centre = 1, until = 0", "59: boundary.0.time.until = 0: must be above 0");
  refuse("\"logistic\", centre = 1, until = 1", "8: boundary.0.time.rate: is missing");
  refuse("\"logistic\", rate = 1, until = 1", "8: boundary.0.time.centre: is missing");
  refuse("\"logistic\", rate = 1, centre = 1", "8: boundary.0.time.until: is missing");
  refuse("\"table\"", "8: boundary.0.time.points: is missing, or file");
  refuse("\"table\", points = 1", "35: boundary.0.time.points = 1: must be a list of at least two points [t, factor]");
  refuse("\"table\", points = [[0, 1]]",
         "35: boundary.0.time.points = [[0, 1]]: must be a list of at least two points");
  refuse("\"table\", points = [[0, 1], [0, 2]]",
         "44: boundary.0.time.points.1 = [0, 2]: must come after the point at t = 0");
  refuse("\"table\", points = [[0, 1], [1, 2, 3]]",
         "44: boundary.0.time.points.1 = [1, 2, 3]: must be two numbers [t, factor]");
  refuse("\"table\", points = [[0, 1], 1]", "44: boundary.0.time.points.1 = 1: must be two numbers");
  refuse("\"table\", points = [[0, 1], [1, inf]]", "48: boundary.0.time.points.1.1 = inf: must be finite");
  refuse("\"table\", points = [[0, 1], [\"1\", 1]]", "45: boundary.0.time.points.1.0 = \"1\": must be a number");
  refuse("\"constant\", until = 1", "37: boundary.0.time.until = 1: is not a key of constant");
  refuse("\"ramp\", until = 1, phase = 0", "44: boundary.0.time.phase = 0: is not a key of ramp, whose keys are until");
}

TEST(Scene, TimeTablesComeFromFilesToo) {
  const test::TemporaryFolder folder;
  const auto read = [&](const std::string& csv, const std::string& more = "") {
    test::write_text(folder / "pulse.csv", csv);
    test::write_text(
        folder / "scene.toml",
        small_scene
            + entry("xmax", "pressure", "p = 1\ntime = { kind = \"table\", file = \"pulse.csv\"" + more + " }\n"));
    return read_scene(folder / "scene.toml", {});
  };
  using Points = std::vector<std::pair<double, double>>;
  const auto points = [&](const std::string& csv, const std::string& more = "") {
    const SceneResult r = read(csv, more);
    EXPECT_TRUE(r.errors.empty()) << r.errors[0];
    return r.scene.boundary.back().time.points;
  };
  EXPECT_EQ(points("0,1\n0.5,2.5\n"), (Points{{0, 1}, {0.5, 2.5}}));
  EXPECT_EQ(points("# a pulse\nt [s],factor [-]\r\n0, 1\r\n5e-1, 2.5"), (Points{{0, 1}, {0.5, 2.5}}))
      << "heading, comment, no last line end";
  EXPECT_EQ(points("n,f,t\n1,3,0\n2,4,1\n", ", columns = [3, 2]"), (Points{{0, 3}, {1, 4}}));
  const auto refuse = [&](const std::string& csv, const std::string& more, const std::string& why) {
    const SceneResult r = read(csv, more);
    ASSERT_EQ(r.errors.size(), 1u);
    EXPECT_NE(r.errors[0].find(why), std::string::npos) << r.errors[0];
  };
  refuse("0,1\n", "", "file = \"pulse.csv\": must hold at least two points");
  refuse("t,f\n0,1\n0,2\n", "", "row 3: t = 0 must come after 0");
  refuse("t,f\n0,1\n1,x\n", "", "row 3: \"1\", \"x\" are not two numbers");
  refuse("0,1\n1,2\n", ", columns = [1, 3]", "has 2 columns, no column 3");
  refuse("0,1\n1,2\n", ", columns = [0, 1]", "columns = [0, 1]: must be two column numbers from 1 on");
  refuse("0,1\n1,2\n", ", points = [[0, 1], [1, 2]]", "cannot stand beside points");
  refuse("0,1\n1,2,3\n", "", "line 2 has 3 fields");
}

TEST(Scene, TimeIsRefusedOnKindsWithoutAValue) {
  const std::string ramp = "time = { kind = \"ramp\", until = 1 }\n", constant = "time = { kind = \"constant\" }\n";
  for (const std::string kind : {"fixed", "free", "symmetric", "skew_symmetric"}) {
    expect_error(entry("a", kind, ramp),
                 "scene.toml:14:8: boundary.0.time: kind " + kind + " has no value that could change in time");
    read_boundary(entry("a", kind, constant));
  }
  read_boundary(entry("a", "traction", "t = [1, 2, 3]\n" + ramp));
  read_boundary(entry("a", "velocity", "v = [1, 2, 3]\n" + ramp));
}

TEST(Scene, KindsThatCombineMayShareAFace) {
  const std::string t = entry("a", "traction", "t = [1, 2, 3]\n"), p = entry("a", "pressure", "p = 1\n"),
                    sliding = entry("a", "velocity", "v = [0, \"free\", \"free\"]\n");
  for (const std::string& both : {t + p, t + entry("a", "symmetric"), p + entry("a", "skew_symmetric"),
                                  entry("a", "symmetric") + p, sliding + t, p + sliding})
    read_boundary(both);
  read_boundary(entry("a", "fixed") + entry("b", "fixed"));
}

TEST(Scene, KindsThatExcludeEachOtherNameBothPlaces) {
  const std::string t = entry("a", "traction", "t = [1, 2, 3]\n"), p = entry("a", "pressure", "p = 1\n"),
                    v = entry("a", "velocity", "v = [0, 0, 0]\n");
  const auto join = [](const std::string& b, const std::string& a) {
    return "kind " + b + " cannot join kind " + a + " of scene.toml:12:8: ";
  };
  const auto later = [](const std::string& line) { return "scene.toml:" + line + ":8: boundary.1.face = \"a\": "; };
  expect_error(entry("a", "fixed") + entry("a", "symmetric"),
               later("15") + join("symmetric", "fixed") + "the face would be held twice");
  expect_error(entry("a", "skew_symmetric") + entry("a", "symmetric"),
               later("15") + join("symmetric", "skew_symmetric") + "the face would be held twice");
  expect_error(entry("a", "fixed") + v, later("15") + join("velocity", "fixed") + "the face would be held twice");
  expect_error(entry("a", "fixed") + entry("a", "fixed"), later("15") + join("fixed", "fixed") + "the same kind twice");
  expect_error(t + t, later("16") + join("traction", "traction") + "the same kind twice");
  expect_error(p + p, later("16") + join("pressure", "pressure") + "the same kind twice");
  expect_error(entry("a", "free") + entry("a", "free"), later("15") + join("free", "free") + "the same kind twice");
  expect_error(entry("a", "fixed") + t, later("15") + join("traction", "fixed") + "a load does nothing");
  expect_error(p + entry("a", "fixed"), later("16") + join("fixed", "pressure") + "a load does nothing");
  expect_error(v + p, later("16") + join("pressure", "velocity") + "a load does nothing");
  expect_error(entry("a", "free") + p, later("15") + join("pressure", "free") + "a free face takes nothing else");
  expect_error(t + entry("a", "free"), later("16") + join("free", "traction") + "a free face takes nothing else");
  expect_error("[[boundary]]\nface = [\"a\", \"b\", \"a\"]\nkind = \"fixed\"\n",
               "scene.toml:12:19: boundary.0.face.2 = \"a\": kind fixed cannot join kind fixed of scene.toml:12:9: the "
               "list names it twice");
}

TEST(Scene, AThirdEntryIsComparedWithAllBefore) {
  expect_error(entry("a", "pressure", "p = 1\n") + entry("a", "symmetric") + entry("a", "skew_symmetric"),
               "scene.toml:19:8: boundary.2.face = \"a\": kind skew_symmetric cannot join kind symmetric of "
               "scene.toml:16:8: the face would be held twice");
}

}  // namespace
}  // namespace nanson
