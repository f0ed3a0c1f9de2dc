// --set: values over the file, new tables, list entries by number and by face, and errors at "--set #n".
#include <random>

#include "tests/unit/scene_text.hpp"

namespace nanson {
namespace {

Scene read_set(const std::vector<std::string>& settings, const std::string& scene = column_scene) {
  const SceneResult r = read_text(scene, settings);
  EXPECT_TRUE(r.errors.empty()) << joined(settings) << joined(r.errors);
  return r.scene;
}

void expect_error(const std::vector<std::string>& settings, const std::string& error,
                  const std::string& scene = column_scene) {
  const SceneResult r = read_text(scene, settings);
  ASSERT_EQ(r.errors.size(), 1u) << joined(settings) << joined(r.errors);
  EXPECT_TRUE(r.errors[0].starts_with(error)) << "  expected " << error << joined(r.errors);
}

TEST(Set, ReplacesTheValueOfTheFile) {
  EXPECT_EQ(read_set({"material.density=2000.0"}).material.density, 2000);
  EXPECT_EQ(read_set({"mesh.cells=[1, 2, 3]"}).mesh.cells, (std::array<int, 3>{1, 2, 3}));
  EXPECT_EQ(read_set({"scene=\"other\""}).name, "other");
  EXPECT_EQ(
      read_set({"monitor.energy=false", "monitor.energy_growth=warn", "monitor.energy_tolerance=0.01"}).monitor.energy,
      false);
  EXPECT_EQ(read_set({"initial={ field = \"velocity\", v = [1, 2, 3] }"}).initial.v, (Vec3{1, 2, 3}));
}

TEST(Set, BareWordIsAString) {
  EXPECT_EQ(read_set({"scene=other-2"}).name, "other-2");
  EXPECT_EQ(read_set({"time.integrator=tvd_rk2"}).time.integrator, Integrator::tvd_rk2);
  EXPECT_EQ(read_set({"output.fields=[\"F\"]"}).output.fields, (std::vector<std::string>{"F"}));
  expect_error({"mesh.split=07"}, "--set #1: mesh.split = \"07\": unknown word");
}

TEST(Set, TheLastOneWins) { EXPECT_EQ(read_set({"time.end=2", "time.end=3"}).time.end, 3); }

TEST(Set, MakesMissingKeysAndTables) {
  const Scene s = read_set(
      {"output.every=0.5", "output.probes.tip.at=[1, 2, 3]", "output.probes.tip.fields=[\"x\"]", "time.cfl=0.1"},
      small_scene);
  EXPECT_EQ(s.output.every, 0.5);
  EXPECT_EQ(s.time.cfl, 0.1);
  ASSERT_EQ(s.output.probes.size(), 1u);
  EXPECT_EQ(s.output.probes[0].at, (Vec3{1, 2, 3}));
  EXPECT_EQ(s.output.probes[0].where, "--set #2");
  expect_error({"output.probes.tip.at=[1, 2, 3]"}, "--set #1: output.probes.tip.fields: is missing", small_scene);
}

TEST(Set, FindsListEntriesByNumber) {
  EXPECT_EQ(read_set({"boundary.1.t=[7, 8, 9]"}).boundary[1].traction, (Vec3{7, 8, 9}));
  EXPECT_EQ(read_set({"boundary.0.kind=symmetric"}).boundary[0].kind, BoundaryKind::symmetric);
  EXPECT_EQ(read_set({"mesh.box.size.2=7.5"}).mesh.size, (Vec3{1, 1, 7.5}));
  EXPECT_EQ(read_set({"boundary.1={ face = \"ymin\", kind = \"free\" }"}).boundary[1].faces[0].name, "ymin");
}

TEST(Set, FindsBoundariesByAFaceTheyName) {
  EXPECT_EQ(read_set({"boundary.zmin.kind=skew_symmetric"}).boundary[0].kind, BoundaryKind::skew_symmetric);
  EXPECT_EQ(read_set({"boundary.xmax.t=[7, 8, 9]"}).boundary[1].traction, (Vec3{7, 8, 9}));
  EXPECT_EQ(read_set({"boundary.xmax.time.until=0.5"}).boundary[1].time.until, 0.5);
  EXPECT_EQ(read_set({"boundary.zmin.face=ymin", "boundary.ymin.kind=symmetric"}).boundary[0].kind,
            BoundaryKind::symmetric);
  EXPECT_EQ(read_set({"boundary.\"top face\".kind=symmetric"}, edited(column_scene, "\"zmin\"", "\"top face\""))
                .boundary[0]
                .kind,
            BoundaryKind::symmetric);
}

TEST(Set, NewListIsWrittenAsAValue) {
  const Scene s = read_set({"boundary=[{ face = \"zmin\", kind = \"fixed\" }]"}, small_scene);
  ASSERT_EQ(s.boundary.size(), 1u);
  EXPECT_EQ(s.boundary[0].faces[0].where, "--set #1");
  expect_error(
      {"boundary.zmin.kind=fixed"},
      "--set #1: boundary: must be a list of tables, written boundary = [{ face = \"zmin\", kind = \"fixed\" }]",
      small_scene);
}

TEST(Set, UnknownListEntryIsRefused) {
  expect_error({"boundary.zmn.kind=free"},
               "--set #1: boundary.zmn.kind=free: boundary: unknown list entry \"zmn\", did you mean \"zmin\"? "
               "allowed: 0 | 1 | zmin | zmax | xmax");
  expect_error({"boundary.2.kind=free"},
               "--set #1: boundary.2.kind=free: boundary: unknown list entry \"2\", allowed: 0 | 1");
  expect_error({"time.end=1", "mesh.cells.3=2"},
               "--set #2: mesh.cells.3=2: mesh.cells: unknown list entry \"3\", allowed: 0 | 1 | 2");
  const std::string twice = column_scene + "[[boundary]]\nface = \"zmax\"\nkind = \"pressure\"\np = 1\n";
  expect_error({"boundary.zmax.kind=free"},
               "--set #1: boundary.zmax.kind=free: boundary: 2 entries name \"zmax\", use a number", twice);
  expect_error(
      {"boundary.top.kind=free"},
      "--set #1: boundary.top.kind=free: boundary: unknown list entry \"top\", allowed: 0 | 1 | 2 | zmin | zmax | xmax",
      twice);
}

TEST(Set, ErrorsInItsValueAreReportedAtIt) {
  expect_error({"material.density=1", "material.poissons_ratio=0.5"},
               "--set #2: material.poissons_ratio = 0.5: must be below 0.5");
  expect_error({"mesh.box.size=[1, 0, 1]"}, "--set #1: mesh.box.size.1 = 0: must be above 0");
  expect_error({"mesh.cells.1=0"}, "--set #1: mesh.cells.1 = 0: must be at least 1");
  expect_error({"time.end=inf"}, "--set #1: time.end = inf: must be finite");
  expect_error({"time.end=1e400"}, "--set #1: time.end = \"1e400\": must be a number");
  expect_error({"time.endd=1"}, "--set #1: time.endd = 1: unknown key, did you mean \"end\"?");
  expect_error({"tme.end=1"}, "--set #1: tme: unknown key, did you mean \"time\"?");
  expect_error({"boundary.0.p=1"}, "--set #1: boundary.0.p = 1: is not a key of fixed");
  expect_error({"boundary.zmin.face=zmax"},
               "scene.toml:35:9: boundary.1.face.0 = \"zmax\": kind traction cannot join kind fixed of --set #1: a "
               "load does nothing");
  expect_error({"mesh.file=absent.msh"}, "--set #1: mesh.file = \"absent.msh\": there is no file ",
               edited(small_scene, "box = { size = [1, 2, 3] }", ""));
}

TEST(Set, ErrorsOfTheFileKeepTheirPlaceBesideIt) {
  const SceneResult r = read_text(edited(column_scene, "1100.0", "0.0"), {"time.end=0", "material.youngs_modulus=0"});
  EXPECT_EQ(r.errors, (std::vector<std::string>{"scene.toml:11:18: material.density = 0.0: must be above 0",
                                                "--set #1: time.end = 0: must be above 0",
                                                "--set #2: material.youngs_modulus = 0: must be above 0"}));
}

TEST(Set, RepairsAnErrorOfTheFile) {
  EXPECT_EQ(read_set({"material.density=3"}, edited(column_scene, "1100.0", "0.0")).material.density, 3);
}

TEST(Set, MalformedSettingsAreRefused) {
  const std::string form = "must be KEY=VALUE, like material.density=1000.0";
  expect_error({"abc"}, "--set #1: abc: " + form);
  expect_error({"=3"}, "--set #1: =3: " + form);
  expect_error({"time.end=1", "time..end=1"}, "--set #2: time..end=1: " + form);
  expect_error({"#=2"}, "--set #1: #=2: " + form);
  expect_error({"a b=2"}, "--set #1: a b=2: " + form);
  expect_error({"[time]=2"}, "--set #1: [time]=2: " + form);
  expect_error({"time.end="}, "--set #1: time.end=: the value is neither TOML nor a bare word");
  expect_error({"mesh.cells=[1, 2"},
               "--set #1: mesh.cells=[1, 2: the value is neither TOML nor a bare word: Error while parsing array");
  expect_error({"scene=two words"}, "--set #1: scene=two words: the value is neither TOML nor a bare word");
  expect_error({"scene=\xff\xfe"}, "--set #1: scene=");
  expect_error({"time.end=1\nq=3"}, "--set #1: \"time.end=1\\nq=3\": must be one line without control characters");
  expect_error({"time.end.x=1"}, "--set #1: time.end.x=1: time.end = 0.1 has no entries");
}

TEST(Set, MalformedSettingsAreListedAlsoWhenTheFileIsNotToml) {
  const SceneResult r = read_text("scene = ", {"abc"});
  ASSERT_EQ(r.errors.size(), 2u) << joined(r.errors);
  EXPECT_TRUE(r.errors[0].starts_with("scene.toml:1:"));
  EXPECT_TRUE(r.errors[1].starts_with("--set #1: abc"));
}

TEST(Set, IsKeptInTheTextAsComments) {
  EXPECT_EQ(read_set({"time.end=2", "scene=b"}).text, column_scene + "# --set time.end=2\n# --set scene=b\n");
  const std::string open = small_scene.substr(0, small_scene.size() - 1);
  EXPECT_EQ(read_set({"time.cfl=1"}, open).text, small_scene + "# --set time.cfl=1\n");
}

TEST(Set, DamagedSettingsGiveErrorsOrAScene) {
  const std::vector<std::string> good = {"material.density=2000.0", "boundary.zmin.kind=fixed", "mesh.cells.1=[1, 2]",
                                         "output.probes.tip.at=[1, 2, 3]", "scene=\"a\""};
  std::mt19937 random(7);
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::string> settings;
    for (int n = 0; n < 3; ++n) {
      std::string s = good[random() % good.size()];
      const std::size_t at = random() % s.size();
      if (random() % 3 == 0) s.erase(at, 1 + random() % 3);
      else if (random() % 2 == 0) s.insert(at, s.substr(random() % s.size(), 1 + random() % 5));
      else s[at] = static_cast<char>(random() % 256);
      settings.push_back(s);
    }
    for (const std::string& e : read_text(column_scene, settings).errors)
      EXPECT_TRUE(e.starts_with("--set #") || e.starts_with("scene.toml:")) << e;
  }
}

}  // namespace
}  // namespace nanson
