// Input decks of Abaqus and CalculiX: sets, surfaces, regions and what is refused, on two tets that share a face.
#include <gtest/gtest.h>

#include <algorithm>

#include "io/mesh/read_inp.hpp"
#include "io/mesh/read_mesh.hpp"
#include "tests/support/temporary_folder.hpp"

namespace nanson {
namespace {

const std::string nodes = R"(** two tets
*Heading
 a title, with a comma
*NODE, NSET=Nall
 1, 0., 0., 0.
 2, 1.0D0, 0., 0.
 3, +0., 1., 0.
 4, 0., 0., 1.
 10, 1., 1., 1.
 99, 5., 5., 5.
)";
const std::string tets = R"(*ELEMENT, TYPE=C3D4, ELSET=Eall
 1, 1, 2, 3, 4
 2, 2, 3,
 4, 10
)";

struct Reading {
  RawMesh raw;
  Mesh mesh;
  std::vector<std::string> errors, notes;

  long faces_of(const std::string& patch) const {
    const auto at = std::find(mesh.patch_names.begin(), mesh.patch_names.end(), patch);
    if (at == mesh.patch_names.end()) return 0;
    const int p = static_cast<int>(at - mesh.patch_names.begin());
    return std::count_if(mesh.faces.begin(), mesh.faces.end(), [&](const Face& f) { return f.patch == p; });
  }
};

Reading read(const std::string& deck, const UsedNames& used = {}) {
  const test::TemporaryFolder folder;
  Reading r;
  test::write_text(folder / "a.inp", deck);
  r.raw = read_inp(folder / "a.inp", used, r.errors, r.notes);
  const std::string where = (folder / "a.inp").string();
  for (auto* texts : {&r.errors, &r.notes})
    for (std::string& t : *texts)
      for (std::size_t i = 0; (i = t.find(where)) != t.npos;) t.replace(i, where.size(), "a.inp");
  if (!r.errors.empty()) return r;
  RawMesh raw = r.raw;
  keep_used_patches(raw, used);
  r.mesh = finish_mesh(raw, r.errors);
  return r;
}

TEST(ReadInp, NodesAndTetsOverLinesInAnyCase) {
  const Reading r = read(nodes + tets);
  ASSERT_TRUE(r.errors.empty()) << r.errors[0];
  EXPECT_EQ(r.raw.X.size(), 5u) << "node 99 is of no tet";
  EXPECT_EQ(r.raw.X[4], (Vec3{1, 1, 1}));
  EXPECT_EQ(r.raw.tets, (std::vector<std::array<int, 4>>{{0, 1, 2, 3}, {1, 2, 3, 4}}));
  EXPECT_EQ(r.raw.region_names, std::vector<std::string>{"Eall"});
  EXPECT_EQ(r.notes, std::vector<std::string>{"a.inp: 1 nodes of no tet were left out"});
  EXPECT_EQ(r.mesh.faces.size(), 6u);
  EXPECT_EQ(r.faces_of("Nall"), 6) << "all nodes: all of the boundary";
  const Reading floor = read(nodes + tets + "*NSET, NSET=floor\n1, 2, 3\n");
  EXPECT_EQ(floor.faces_of("Nall"), 5);
  EXPECT_EQ(floor.faces_of("floor"), 1) << "the smaller of two that the scene does not name";
}

TEST(ReadInp, FacesAreSurfacesOfElementsAndOfNodesAndNodeSets) {
  const Reading r = read(nodes + tets + R"(*NSET, NSET=floor
1, 2, 3
*NSET, NSET=Grown, GENERATE
1, 4, 1
*ELSET, ELSET=one
1
*SURFACE, NAME=Front
one, S2
*SURFACE, NAME=whole, TYPE=ELEMENT
2
*SURFACE, NAME=low, TYPE=NODE
FLOOR,
)",
                         {{"Front", "whole", "floor"}, {}});
  ASSERT_TRUE(r.errors.empty()) << r.errors[0];
  EXPECT_EQ(r.faces_of("Front"), 1);
  EXPECT_EQ(r.faces_of("whole"), 3) << "the face between the tets is none";
  EXPECT_EQ(r.faces_of("floor"), 1) << "is the same triangle as low, which the scene does not name";
  EXPECT_EQ(r.faces_of("low"), 0);
  const auto front = std::find_if(r.mesh.faces.begin(), r.mesh.faces.end(), [&](const Face& f) {
    return f.patch >= 0 && r.mesh.patch_names[f.patch] == "Front";
  });
  std::array<int, 3> at = front->nodes;
  std::sort(at.begin(), at.end());
  EXPECT_EQ(at, (std::array<int, 3>{0, 1, 3})) << "S2 of a tet: nodes 1, 4, 2";
}

TEST(ReadInp, TwoUsedNamesOfOneTriangleAreRefused) {
  const Reading r = read(nodes + tets + "*NSET, NSET=a\n1, 2, 3\n*NSET, NSET=b\n1, 2, 3\n", {{"a", "b"}, {}});
  ASSERT_EQ(r.errors.size(), 1u);
  EXPECT_NE(r.errors[0].find("is in the patches \"a\" and \"b\""), std::string::npos) << r.errors[0];
}

TEST(ReadInp, TriangleElementsNameFaces) {
  const Reading r = read(
      nodes + tets + "*ELEMENT, TYPE=CPS3, ELSET=Surface6\n7, 1, 2, 3\n8, 1, 2, 4\n*ELSET, ELSET=lid\n8,\n",
      {{"lid"}, {}});
  ASSERT_TRUE(r.errors.empty()) << r.errors[0];
  EXPECT_EQ(r.faces_of("lid"), 1);
  EXPECT_EQ(r.faces_of("Surface6"), 1) << "without the one that the scene calls lid";
}

TEST(ReadInp, RegionsAreThoseOfTheSceneThenOfSectionsThenOfElements) {
  const std::string sets = "*ELSET, ELSET=soft\n1\n*ELSET, ELSET=hard\n2\n";
  EXPECT_EQ(read(nodes + tets + sets).raw.region_names, std::vector<std::string>{"Eall"});
  const Reading sections = read(nodes + tets + sets + "*SOLID SECTION, ELSET=hard, MATERIAL=steel\n");
  EXPECT_EQ(sections.raw.region_names, (std::vector<std::string>{"hard", "Eall"}));
  EXPECT_EQ(sections.raw.tet_region, (std::vector<int>{1, 0}));
  const Reading used = read(nodes + tets + sets, {{}, {"soft", "hard"}});
  EXPECT_EQ(used.raw.region_names, (std::vector<std::string>{"soft", "hard"}));
  const Reading twice = read(nodes + tets + sets + "*ELSET, ELSET=all\nsoft, hard\n", {{}, {"soft", "all"}});
  EXPECT_EQ(twice.errors,
            std::vector<std::string>{
                "a.inp:19: element 1 is in the sets \"soft\" and \"all\", and the scene has a material for each"});
}

TEST(ReadInp, OnePartAndItsInstanceAreRead) {
  const Reading r = read("*Part, name=P\n" + nodes + tets + "*End Part\n*Assembly, name=A\n*Instance, name=P-1, part=P\n 1., 0., 0.\n*End Instance\n"
                         "*Nset, nset=floor, instance=P-1\n1, 2, 3\n*Nset, nset=all\nP-1.Nall\n*End Assembly\n", {{"floor"}, {}});
  ASSERT_TRUE(r.errors.empty()) << r.errors[0];
  EXPECT_EQ(r.raw.X[0], (Vec3{1, 0, 0}));
  EXPECT_EQ(r.faces_of("floor"), 1);
}

TEST(ReadInp, SaysWhatItSkips) {
  const Reading r = read(nodes + tets + "*ELEMENT, TYPE=T3D2, ELSET=rod\n5, 1, 2\n6, 2, 3\n*MATERIAL, NAME=steel\n*ELASTIC\n2e11, 0.3\n*STEP\n*STATIC\n0.1, 1.\n*CLOAD\n1, 2, 3\n*CLOAD\n2, 2, 3\n*END STEP\n");
  ASSERT_TRUE(r.errors.empty()) << r.errors[0];
  ASSERT_EQ(r.notes.size(), 3u);
  EXPECT_EQ(r.notes[1], "a.inp: elements that are neither tets nor triangles were left out: T3D2 (2)");
  EXPECT_EQ(r.notes[2],
            "a.inp: only the mesh is read of it, materials, supports and loads are the scene's; skipped: *CLOAD (2), "
            "*ELASTIC, *MATERIAL, *STATIC, *STEP");
}

TEST(ReadInp, FilesIncludeOthers) {
  const test::TemporaryFolder folder;
  test::write_text(folder / "nodes.txt", nodes);
  test::write_text(folder / "a.inp", "*INCLUDE, INPUT=nodes.txt\n" + tets);
  std::vector<std::string> errors, notes;
  EXPECT_EQ(read_inp(folder / "a.inp", {}, errors, notes).tets.size(), 2u);
  EXPECT_TRUE(errors.empty());
  test::write_text(folder / "b.inp", "*INCLUDE, INPUT=b.inp\n");
  test::write_text(folder / "c.inp", "\n*INCLUDE, INPUT=none.inp\n");
  read_inp(folder / "b.inp", {}, errors, notes);
  read_inp(folder / "c.inp", {}, errors, notes);
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_NE(errors[0].find("b.inp:1: files include each other more than 16 deep"), std::string::npos) << errors[0];
  EXPECT_NE(errors[1].find("c.inp:2: "), std::string::npos) << errors[1];
}

TEST(ReadInp, WhatIsWrongIsToldWithItsLine) {
  const auto first_error = [](const std::string& deck) {
    const Reading r = read(deck);
    return r.errors.empty() ? "" : r.errors[0];
  };
  EXPECT_EQ(first_error("*NODE\n1, 0, x, 0\n"), "a.inp:2: \"x\" is no coordinate");
  EXPECT_EQ(first_error("*NODE\n1\n"), "a.inp:2: a node is its number and three coordinates");
  EXPECT_EQ(first_error(nodes + "*ELEMENT, TYPE=C3D8\n"), "a.inp:11: elements C3D8 are no tetrahedra: mesh with C3D4");
  EXPECT_EQ(first_error(nodes + "*ELEMENT, TYPE=C3D10\n"),
            "a.inp:11: elements C3D10 are of second order: write the mesh with C3D4");
  EXPECT_EQ(first_error(nodes + "*ELEMENT, TYPE=C3D4\n1, 1, 2\n*NSET, NSET=a\n"),
            "a.inp:13: the file goes on before the last element has all its nodes");
  EXPECT_EQ(first_error(nodes + "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4, 5\n"),
            "a.inp:12: an element is its number and 4 nodes");
  EXPECT_EQ(first_error(nodes + "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 7\n"),
            "a.inp: element 1 has the node 7, which the deck does not give");
  EXPECT_EQ(first_error(nodes + tets + "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n"), "a.inp: element 1 is given twice");
  EXPECT_EQ(first_error(nodes + tets + "*NSET, NSET=a\nb\n"),
            "a.inp:16: \"b\" is neither a number nor a set that stands above");
  EXPECT_EQ(first_error(nodes + tets + "*SURFACE, NAME=a\nEall, S5\n"),
            "a.inp:16: \"S5\" is no face of a tet, allowed: S1 | S2 | S3 | S4");
  EXPECT_EQ(first_error(nodes + tets + "*SURFACE, NAME=a\nnone, S1\n"), "a.inp:16: there is no set \"none\"");
  EXPECT_EQ(first_error("*PART, NAME=a\n*END PART\n*PART, NAME=b\n").substr(0, 23), "a.inp:3: a second *PART");
  EXPECT_EQ(first_error("*NGEN\n"), "a.inp:1: *NGEN makes or moves nodes: write the deck with all of them in place");
}

TEST(ReadInp, EveryCutIsReadOrRefused) {
  const std::string deck = nodes + tets + "*SURFACE, NAME=Front\nEall, S2\n";
  for (std::size_t n = 0; n < deck.size(); ++n) {
    const Reading r = read(deck.substr(0, n));
    EXPECT_TRUE(!r.errors.empty() || !r.mesh.tets.empty()) << n;
  }
}

}  // namespace
}  // namespace nanson
