// Reading .msh files: what arrives, and that everything wrong is refused in words. Files of the real gmsh: test_read_gmsh.cpp.
#include <gtest/gtest.h>

#include <algorithm>

#include "io/mesh/read_mesh.hpp"
#include "msh_writer.hpp"

using namespace nanson;

namespace {

/// A box of 2 x 1 x 1 cells: left half in group "soft rubber", right half in none; xmin "clamped", xmax "tip load, lbf", a wall in no
/// group, points and lines. Node tags 10, 13, 16, ...
MshFile sample() {
  MeshSpec spec;
  spec.size = {2, 1, 1};
  spec.cells = {2, 1, 1};
  const RawMesh box = make_box(spec);
  MshFile file;
  file.X = box.X;
  const auto tag = [](int a) { return std::int64_t{10} + 3 * a; };
  for (std::size_t a = 0; a < box.X.size(); ++a) file.tags.push_back(tag(int(a)));
  file.names = {{{3, 7}, "soft rubber"}, {{2, 1}, "clamped"}, {{2, 2}, "tip load, lbf"}, {{1, 5}, "a line"}};
  file.entities = {{0, 1, {}, 15, {{tag(0)}, {tag(2)}}},
                   {1, 1, {5}, 1, {{tag(0), tag(1)}}},
                   {2, 1, {1}, 2, {}},
                   {2, 2, {2}, 2, {}},
                   {2, 3, {}, 2, {}},
                   {3, 1, {7}, 4, {}},
                   {3, 2, {}, 4, {}}};
  for (std::size_t i = 0; i < box.triangles.size(); ++i) {
    const auto& t = box.triangles[i];
    const int patch = box.triangle_patch[i];
    file.entities[patch == 0 ? 2 : patch == 1 ? 3 : 4].elements.push_back({tag(t[0]), tag(t[1]), tag(t[2])});
  }
  for (std::size_t i = 0; i < box.tets.size(); ++i) {
    const auto& t = box.tets[i];
    file.entities[i < 6 ? 5 : 6].elements.push_back({tag(t[0]), tag(t[1]), tag(t[2]), tag(t[3])});
  }
  return file;
}

struct Reading {
  RawMesh mesh;
  std::vector<std::string> errors;
};

Reading read(const std::string& content) {
  Reading reading;
  reading.mesh = read_msh(content, "mesh.msh", reading.errors);
  return reading;
}

void expect_refused(const std::string& content, const std::string& beginning, const std::string& word) {
  const auto errors = read(content).errors;
  ASSERT_EQ(errors.size(), 1u) << testing::PrintToString(errors);
  EXPECT_TRUE(errors[0].starts_with(beginning)) << errors[0] << "\ndoes not start with " << beginning;
  EXPECT_NE(errors[0].find(word), std::string::npos) << errors[0] << "\nlacks " << word;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

void expect_equal(const RawMesh& a, const RawMesh& b) {
  EXPECT_EQ(a.X, b.X);
  EXPECT_EQ(a.tets, b.tets);
  EXPECT_EQ(a.tet_region, b.tet_region);
  EXPECT_EQ(a.region_names, b.region_names);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.triangle_patch, b.triangle_patch);
  EXPECT_EQ(a.patch_names, b.patch_names);
}

constexpr MshForm text22{false, false}, text41{true, false}, binary22{false, true}, binary41{true, true};

/// A tet with one element line more, in version 2.2.
std::string tet22(const std::string& extra_element, int elements = 2) {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n$Elements\n"
         + std::to_string(elements) + "\n1 4 2 1 1 1 2 3 4\n" + extra_element + "$EndElements\n";
}

}  // namespace

TEST(ReadMesh, DeliversNodesTetsRegionsAndPatches) {
  const auto [mesh, errors] = read(write_msh(sample(), text41));
  ASSERT_TRUE(errors.empty()) << errors[0];
  EXPECT_EQ(mesh.X, sample().X);
  EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"soft rubber", "unnamed"}));
  EXPECT_EQ(mesh.patch_names, (std::vector<std::string>{"clamped", "tip load, lbf"}));
  EXPECT_EQ(mesh.tets.size(), 12u);
  EXPECT_EQ(mesh.tet_region, (std::vector<int>{0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(mesh.triangle_patch, (std::vector<int>{0, 0, 1, 1}));
  for (const auto& t : mesh.triangles)
    for (const int a : t) EXPECT_EQ(mesh.X[a][0], &t < &mesh.triangles[2] ? 0 : 2);
}

TEST(ReadMesh, AllFourFormsReadIdentically) {
  const RawMesh first = read(write_msh(sample(), text22)).mesh;
  ASSERT_EQ(first.tets.size(), 12u);
  for (const auto& form : all_forms) {
    const auto [mesh, errors] = read(write_msh(sample(), form));
    EXPECT_TRUE(errors.empty()) << form_name(form) << ": " << errors[0];
    expect_equal(mesh, first);
  }
}

TEST(ReadMesh, SkipsParametersOfNodes) {
  const RawMesh plain = read(write_msh(sample(), text22)).mesh;
  for (auto form : all_forms) {
    form.parametric = true;
    const auto [mesh, errors] = read(write_msh(sample(), form));
    EXPECT_TRUE(errors.empty()) << form_name(form) << ": " << errors[0];
    expect_equal(mesh, plain);
  }
}

TEST(ReadMesh, TakesSparseTagsAndTagsBeyond32Bits) {
  const RawMesh plain = read(write_msh(sample(), text22)).mesh;
  const auto with_tags = [](std::int64_t offset, std::int64_t step) {
    MshFile file = sample();
    const auto other = [&](std::int64_t tag) { return offset + step * ((tag - 10) / 3); };
    for (auto& tag : file.tags) tag = other(tag);
    for (auto& entity : file.entities)
      for (auto& element : entity.elements)
        for (auto& tag : element) tag = other(tag);
    return file;
  };
  for (const auto& form : all_forms) expect_equal(read(write_msh(with_tags(5, 100000000), form)).mesh, plain);
  for (const auto& form : {text22, text41, binary41}) {
    expect_equal(read(write_msh(with_tags(5'000'000'000, 1), form)).mesh, plain);
    expect_equal(read(write_msh(with_tags(1, 900'000'000'000'000'000 / 2), form)).mesh, plain);
  }
}

TEST(ReadMesh, SkipsSectionsItDoesNotNeed) {
  const RawMesh plain = read(write_msh(sample(), text22)).mesh;
  for (const auto& form : all_forms) {
    std::string content = replaced(write_msh(sample(), form), "$Elements\n",
                                   "$Periodic\n1\n2 3 1\nAffine 1 0\n$EndPeriodic\n$Elements\n");
    content = "$Comments\nmade by hand: $Nodes 4\n$EndComments\n" + content + "$NodeData\n1\n\"t\"\n$EndNodeData\n";
    const auto [mesh, errors] = read(content);
    EXPECT_TRUE(errors.empty()) << form_name(form) << ": " << errors[0];
    expect_equal(mesh, plain);
  }
}

TEST(ReadMesh, TakesLineEndsOfWindows) {
  std::string content;
  for (const char c : write_msh(sample(), text41)) content += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const auto [mesh, errors] = read(content);
  EXPECT_TRUE(errors.empty()) << errors[0];
  expect_equal(mesh, read(write_msh(sample(), text41)).mesh);
}

TEST(ReadMesh, CallsAGroupWithoutANameByItsTag) {
  MshFile file = sample();
  file.names.clear();
  for (const auto& form : all_forms) {
    const auto mesh = read(write_msh(file, form)).mesh;
    EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"7", "unnamed"}));
    EXPECT_EQ(mesh.patch_names, (std::vector<std::string>{"1", "2"}));
  }
}

TEST(ReadMesh, GroupsOfOneNameAreOnePatch) {
  MshFile file = sample();
  file.names[{2, 2}] = "clamped";
  for (const auto& form : all_forms) {
    const auto mesh = read(write_msh(file, form)).mesh;
    EXPECT_EQ(mesh.patch_names, std::vector<std::string>{"clamped"});
    EXPECT_EQ(mesh.triangle_patch, (std::vector<int>{0, 0, 0, 0}));
  }
}

TEST(ReadMesh, TakesNegativePhysicalTagsAsTurnedSurfaces) {
  MshFile file = sample();
  file.entities[2].physical = {-1};
  for (const auto& form : all_forms)
    expect_equal(read(write_msh(file, form)).mesh, read(write_msh(sample(), form)).mesh);
}

TEST(ReadMesh, ASurfaceInTwoPatchesIsRefusedByTheCheckOfTheMesh) {
  MshFile file = sample();
  file.entities[2].physical = {1, 2};
  for (const auto& form : all_forms) {
    auto [mesh, errors] = read(write_msh(file, form));
    EXPECT_TRUE(errors.empty()) << form_name(form) << ": " << errors[0];
    finish_mesh(mesh, errors);
    ASSERT_EQ(errors.size(), 2u) << form_name(form);
    EXPECT_NE(errors[0].find("\"clamped\" and \"tip load, lbf\""), std::string::npos) << errors[0];
  }
}

TEST(ReadMesh, AVolumeInTwoGroupsIsRefused) {
  MshFile file = sample();
  file.names[{3, 8}] = "steel";
  file.entities[5].physical = {7, 8};
  for (const auto& form : {text41, binary41})
    expect_refused(write_msh(file, form), "mesh.msh: volume 1", "\"soft rubber\" and \"steel\"");
  for (const auto& form : {text22, binary22}) {
    auto [mesh, errors] = read(write_msh(file, form));
    finish_mesh(mesh, errors);
    ASSERT_FALSE(errors.empty());
    EXPECT_NE(errors[0].find("\"soft rubber\" and one in \"steel\""), std::string::npos) << errors[0];
  }
}

TEST(ReadMesh, LeavesOutConstructionPoints) {
  MshFile file = sample();
  file.X.insert(file.X.begin() + 3, {9, 9, 9});  // the centre of a circle, say
  file.tags.insert(file.tags.begin() + 3, 5);
  file.entities[0].elements.push_back({5});
  for (const auto& form : all_forms)
    expect_equal(read(write_msh(file, form)).mesh, read(write_msh(sample(), form)).mesh);
}

TEST(ReadMesh, KeepsOtherNodesOfNoTetForTheCheckOfTheMesh) {
  MshFile file = sample();
  file.X.push_back({9, 9, 9});
  file.tags.push_back(1000);
  auto [mesh, errors] = read(write_msh(file, text41));
  finish_mesh(mesh, errors);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].find("node 12"), std::string::npos) << errors[0];
}

TEST(ReadMesh, AFileCutOffAnywhereIsRefused) {
  for (const auto& form : all_forms) {
    const std::string whole = write_msh(sample(), form);
    for (std::size_t size = 0; size + 1 < whole.size(); ++size) {  // only the very last line end may be missing
      ASSERT_EQ(read(whole.substr(0, size)).errors.size(), 1u)
          << form_name(form) << " cut to " << size << " of " << whole.size() << " bytes";
    }
  }
}

TEST(ReadMesh, DamagedFilesNeverCrash) {
  std::mt19937_64 random(1);
  for (const auto& form : all_forms) {
    const std::string whole = write_msh(sample(), form);
    for (int i = 0; i < 5000; ++i) {
      std::string damaged = whole;
      for (int bytes = 0; bytes < 1 + i % 4; ++bytes) damaged[random() % damaged.size()] = char(random());
      auto [mesh, errors] = read(damaged);
      if (errors.empty()) finish_mesh(std::move(mesh), errors);  // which may well be fine: a coordinate has changed
    }
  }
}

TEST(ReadMesh, CountsBeyondTheSizeOfTheFileAreRefused) {
  const std::string v22 = write_msh(sample(), text22), v41 = write_msh(sample(), text41);
  expect_refused(replaced(v22, "$Nodes\n12\n", "$Nodes\n4000000000000\n"),
                 "mesh.msh:12: the file says 4000000000000 nodes follow", "cut off");
  expect_refused(replaced(v22, "$Nodes\n12\n", "$Nodes\n-3\n"), "mesh.msh:12:", "-3");
  expect_refused(replaced(v41, "$Nodes\n2 12 ", "$Nodes\n2 900000000000000000 "),
                 "mesh.msh:", "900000000000000000 nodes");
  expect_refused(replaced(v41, "$Nodes\n2 12 ", "$Nodes\n2 13 "), "mesh.msh:", "hold 12 nodes, 13 were announced");
  expect_refused(replaced(v41, "$Nodes\n2 12 ", "$Nodes\n2 11 "), "mesh.msh:", "6 nodes where 5 of 11 are left");
}

TEST(ReadMesh, SecondOrderElementsAreRefusedWithTheLine) {
  expect_refused(tet22("2 11 2 1 1 1 2 3 4 1 2 3 4 1 2\n"),
                 "mesh.msh:14: element type 11 (10-node tetrahedron) is not supported", "first order elements");
  expect_refused(tet22("2 9 2 1 1 1 2 3 4 1 2\n"), "mesh.msh:14: element type 9 (6-node triangle)",
                 "first order elements");
  expect_refused(tet22("2 77 2 1 1 1 2 3\n"), "mesh.msh:14: element type 77 is not supported", "");
  MshFile file = sample();
  file.entities[6].type = 11;
  for (const auto& form : all_forms)
    expect_refused(write_msh(file, form), "mesh.msh:", "element type 11 (10-node tetrahedron) is not supported");
}

TEST(ReadMesh, OtherShapesThanTetsAreRefused) {
  expect_refused(tet22("2 5 2 1 1 1 2 3 4 1 2 3 4\n"), "mesh.msh:14: element type 5 (8-node hexahedron)",
                 "tetrahedra only");
  expect_refused(tet22("2 6 2 1 1 1 2 3 4 1 2\n"), "mesh.msh:14: element type 6 (6-node prism)", "tetrahedra only");
  expect_refused(tet22("2 7 2 1 1 1 2 3 4 1\n"), "mesh.msh:14: element type 7 (5-node pyramid)", "tetrahedra only");
}

TEST(ReadMesh, WrongNodesAreRefusedWithTheLine) {
  expect_refused(tet22("2 4 2 1 1 1 2 3 9\n"), "mesh.msh:14: element 2 has the node 9", "not among the nodes");
  expect_refused(replaced(tet22("", 1), "4 0 0 1\n", "3 0 0 1\n"), "mesh.msh:", "node 3 is given twice");
  expect_refused(replaced(tet22("", 1), "4 0 0 1\n", "4 0 zero 1\n"), "mesh.msh:9: expected a number, found \"zero\"",
                 "");
  expect_refused(replaced(tet22("", 1), "4 0 0 1\n", "4.5 0 0 1\n"),
                 "mesh.msh:9: expected a whole number, found \"4.5\"", "");
  expect_refused(replaced(tet22("", 1), "4 0 0 1\n", "4 0 0\n"), "mesh.msh:10: expected a number, found \"$EndNodes\"",
                 "");
  expect_refused(replaced(tet22("", 1), "4 0 0 1\n", "4 0 0 1 7\n"), "mesh.msh:9: expected $EndNodes, found \"7\"", "");
}

TEST(ReadMesh, UnknownVersionsAndKindsOfNumbersAreRefused) {
  const std::string file = tet22("", 1);
  expect_refused(replaced(file, "2.2 0 8", "4 0 8"), "mesh.msh:2: version 4 of the .msh format is not supported",
                 "msh41");
  expect_refused(replaced(file, "2.2 0 8", "2.2 3 8"), "mesh.msh:2: file type 3", "binary");
  expect_refused(replaced(file, "2.2 0 8", "2.2 0 4"), "mesh.msh:2: numbers of 4 bytes", "8");
}

TEST(ReadMesh, TheOtherByteOrderIsRefused) {
  for (const auto& form : {binary22, binary41})
    expect_refused(replaced(write_msh(sample(), form), std::string("\1\0\0\0", 4), std::string("\0\0\0\1", 4)),
                   "mesh.msh: byte 20:", "byte order");
}

TEST(ReadMesh, PartitionedMeshesAreRefused) {
  expect_refused(replaced(write_msh(sample(), text41), "$Nodes\n",
                          "$PartitionedEntities\n2\n0\n$EndPartitionedEntities\n$Nodes\n"),
                 "mesh.msh:", "partitioned");
}

TEST(ReadMesh, SectionsInTheWrongOrderOrTwiceAreRefused) {
  const std::string nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";
  expect_refused(replaced(tet22("", 1), nodes, ""), "mesh.msh:4: $Elements must come after $Nodes", "");
  expect_refused(replaced(tet22("", 1), nodes, nodes + nodes), "mesh.msh:11: a second section $Nodes", "");
  expect_refused(replaced(tet22("", 1), "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", ""),
                 "mesh.msh:1: $MeshFormat must come first", "older");
  expect_refused("solid cube\n", "mesh.msh:1: expected the heading of a section", "");
  expect_refused("", "mesh.msh:1: there is no section $Elements", "");
}

TEST(ReadMesh, AFileIsReadLikeItsBytes) {
  const TemporaryFolder folder;
  for (const auto& form : all_forms) {
    std::vector<std::string> errors;
    const std::string content = write_msh(sample(), form);
    expect_equal(read_mesh(folder.write("mesh.msh", content), errors), read(content).mesh);
    EXPECT_TRUE(errors.empty());
    read_mesh(folder.write("cut.msh", content.substr(0, 100)), errors);
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_TRUE(errors[0].starts_with((folder.path() / "cut.msh").string() + ":")) << errors[0];
  }
}

TEST(ReadMesh, FilesThatCannotBeMeshesAreRefused) {
  const TemporaryFolder folder;
  std::vector<std::string> errors;
  read_mesh(folder.path() / "none.msh", errors);
  read_mesh(folder.path(), errors);
  read_mesh(folder.write("mesh.vtk", "x"), errors);
  read_mesh(folder.write("mesh.step", "x"), errors);
  ASSERT_EQ(errors.size(), 4u);
  EXPECT_EQ(errors[0], (folder.path() / "none.msh").string() + ": there is no such file");
  EXPECT_NE(errors[1].find("not a file"), std::string::npos);
  EXPECT_NE(errors[2].find("unknown file ending \".vtk\""), std::string::npos);
  EXPECT_NE(errors[3].find("gmsh -3"), std::string::npos);
}

TEST(LoadMesh, MakesTheBox) {
  MeshSpec spec;
  spec.size = {1, 1, 1};
  spec.cells = {2, 2, 2};
  std::vector<std::string> errors;
  const Mesh mesh = load_mesh(spec, errors);
  EXPECT_TRUE(errors.empty());
  EXPECT_EQ(mesh.tets.size(), 48u);
  EXPECT_EQ(mesh.faces.size(), 48u);
  spec.perturb = 2;
  load_mesh(spec, errors);
  ASSERT_FALSE(errors.empty());
  EXPECT_TRUE(errors[0].starts_with("mesh.box: ")) << errors[0];
}

TEST(LoadMesh, RefusesMoreNodesThanCanBeNumbered) {
  MeshSpec spec;
  spec.size = {1, 1, 1};
  spec.cells = {2000, 2000, 2000};
  std::vector<std::string> errors;
  load_mesh(spec, errors);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].find("fewer cells"), std::string::npos);
}

TEST(LoadMesh, ReadsAndChecksTheFile) {
  const TemporaryFolder folder;
  MeshSpec spec;
  spec.source = MeshSource::file;
  spec.file = {folder.write("mesh.msh", write_msh(sample(), binary41)).string(), "beam.toml:5:8"};
  std::vector<std::string> errors;
  const Mesh mesh = load_mesh(spec, errors);
  ASSERT_TRUE(errors.empty()) << errors[0];
  EXPECT_EQ(mesh.faces.size(), 20u);
  EXPECT_EQ(mesh.unnamed_faces, 16);
}

TEST(LoadMesh, ReadsTheMeshesThatComeWithTheProgram) {
  const auto meshes = std::filesystem::path(NANSON_SOURCE_DIR) / "configs/meshes";
  const auto names = [&](const std::string& file) {
    MeshSpec spec;
    spec.source = MeshSource::file;
    spec.file = {(meshes / file).string(), "scene.toml:1:1"};
    std::vector<std::string> errors;
    const Mesh mesh = load_mesh(spec, errors);
    EXPECT_TRUE(errors.empty()) << errors[0];
    return mesh.patch_names;
  };
  EXPECT_EQ(names("cantilever_cylinder.msh"), (std::vector<std::string>{"clamped", "tip", "side"}));
  EXPECT_EQ(names("plate_with_hole.msh"), (std::vector<std::string>{"left", "right", "hole"}));
  EXPECT_EQ(names("satellite.msh"), std::vector<std::string>{});
  EXPECT_EQ(names("punch.msh"), (std::vector<std::string>{"xmin", "xmax", "ymin", "ymax", "zmin", "zmax", "holes"}));
  EXPECT_EQ(names("stent.msh"), (std::vector<std::string>{"x0", "y0", "z0", "end"}));
}

TEST(LoadMesh, ErrorsStartWithTheFileAndTheLineThatIsWrong) {
  const TemporaryFolder folder;
  MeshSpec spec;
  spec.source = MeshSource::file;
  const auto error = [&](const std::string& content) {
    std::vector<std::string> errors;
    spec.file = {folder.write("mesh.msh", content).string(), "beam.toml:5:8"};
    load_mesh(spec, errors);
    return errors.size() == 1 ? errors[0] : testing::PrintToString(errors);
  };
  EXPECT_TRUE(error(tet22("2 9 2 1 1 1 2 3 4 1 2\n")).starts_with(spec.file.name + ":14: "))
      << error(tet22("2 9 2 1 1 1 2 3 4 1 2\n"));
  EXPECT_TRUE(error(tet22("2 4 2 1 1 1 2 3 4\n")).starts_with(spec.file.name + ": tets 0 and 1"))
      << error(tet22("2 4 2 1 1 1 2 3 4\n"));
  spec.file.name = "nowhere.msh";
  std::vector<std::string> errors;
  load_mesh(spec, errors);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0], "beam.toml:5:8: mesh.file = \"nowhere.msh\": there is no such file");
}
