// How the gmsh program is started and what of it is reported, with small scripts in its place; the real one: test_geometry_gmsh.cpp.
#include <gtest/gtest.h>

#include <cstdlib>

#include "io/mesh/read_mesh.hpp"
#include "tests/support/temporary_folder.hpp"

namespace nanson {
namespace {

using test::TemporaryFolder;

/// PATH as a test wants it, and TMPDIR in a folder that can be looked at; both as before afterwards.
class Environment {
 public:
  explicit Environment(const std::string& path, const std::string& temporary) {
    for (const auto& [name, value] : {std::pair<std::string, std::string>{"PATH", path}, {"TMPDIR", temporary}}) {
      const char* before = std::getenv(name.c_str());
      before_.emplace_back(name, before ? std::optional<std::string>(before) : std::nullopt);
      ::setenv(name.c_str(), value.c_str(), 1);
    }
  }
  ~Environment() {
    for (const auto& [name, value] : before_)
      value ? ::setenv(name.c_str(), value->c_str(), 1) : ::unsetenv(name.c_str());
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  std::vector<std::pair<std::string, std::optional<std::string>>> before_;
};

/// A script called gmsh, a geometry, and the errors that loading the geometry gives.
struct FakeGmsh {
  TemporaryFolder folder;
  std::filesystem::path geo = folder / "body.geo", programs = folder / "bin", temporary = folder / "tmp";

  FakeGmsh() {
    std::filesystem::create_directory(programs);
    std::filesystem::create_directory(temporary);
    test::write_text(geo, "Sphere(1) = {0, 0, 0, 1};\n");
  }
  std::vector<std::string> errors(const std::string& script) {
    using std::filesystem::perms;
    if (!script.empty()) {
      test::write_text(programs / "gmsh", "#!/bin/sh\n" + script);
      std::filesystem::permissions(programs / "gmsh", perms::owner_all);
    }
    const Environment environment(programs.string(), temporary.string());
    MeshSpec spec;
    spec.source = MeshSource::file;
    spec.file = {geo.string(), "scene.toml:3:8"};
    std::vector<std::string> errors;
    load_mesh(spec, errors);
    return errors;
  }
  std::string place() const { return "scene.toml:3:8: mesh.file = \"" + geo.string() + "\": "; }
};

TEST(MeshGeometry, WithoutGmshTheErrorNamesThePackage) {
  FakeGmsh fake;
  EXPECT_EQ(fake.errors(""),
            std::vector<std::string>{fake.place()
                                     + "the program gmsh, which meshes it, is not installed: apt-get install gmsh, "
                                       "or mesh it elsewhere and name the .msh file"});
}

TEST(MeshGeometry, GmshsOwnErrorsAndItsExitStatusStandAtTheKey) {
  FakeGmsh fake;
  EXPECT_EQ(
      fake.errors("echo 'Info    : Meshing'\necho \"Error   : 'body.geo', line 1: Unknown variable 'r'\" >&2\necho "
                  "'Error   : no volume'\nexit 3\n"),
      (std::vector<std::string>{fake.place() + "gmsh: 'body.geo', line 1: Unknown variable 'r'",
                                fake.place() + "gmsh: no volume", fake.place() + "gmsh ended with exit status 3"}));
  EXPECT_EQ(fake.errors("echo 'Error   : half done'\nexit 0\n"),
            std::vector<std::string>{fake.place() + "gmsh: half done"});
  EXPECT_EQ(fake.errors("kill -9 $$\n"), std::vector<std::string>{fake.place() + "gmsh was ended by signal 9"});
  EXPECT_EQ(fake.errors("exit 0\n"), std::vector<std::string>{fake.place() + "gmsh wrote no mesh"});
}

TEST(MeshGeometry, ADamagedMeshIsReportedUnderTheNameOfTheGeometry) {
  FakeGmsh fake;
  const auto errors = fake.errors("while [ \"$1\" != -o ]; do shift; done\necho nonsense >\"$2\"\n");
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_TRUE(errors[0].starts_with(fake.geo.string() + ":1: ")) << errors[0];
}

TEST(MeshGeometry, NoShellReadsTheNameAndNothingIsLeftBehind) {
  FakeGmsh fake;
  fake.geo = fake.folder / "-a b'; touch x; $(touch y) #.geo";
  test::write_text(fake.geo, "");
  const std::string log = (fake.folder / "log").string();
  fake.errors("for a in \"$@\"; do echo \"$a\"; done >'" + log + "'\n");
  const std::string words = test::read_text(log);
  EXPECT_TRUE(words.starts_with("-3\n-format\nmsh41\n-nt\n1\n-o\n" + fake.temporary.string())) << words;
  EXPECT_TRUE(words.ends_with("/mesh.msh\n" + fake.geo.string() + "\n")) << words;
  EXPECT_TRUE(std::filesystem::is_empty(fake.temporary));
}

TEST(MeshGeometry, AGeometryThatIsNotThereStartsNothing) {
  FakeGmsh fake;
  fake.geo = fake.folder / "none.geo";
  EXPECT_EQ(fake.errors("exit 3\n"), std::vector<std::string>{fake.place() + "there is no such file"});
}

}  // namespace
}  // namespace nanson
