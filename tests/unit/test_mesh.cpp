// finish_mesh: what it repairs, what it finds and what it refuses; mesh quality.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/mesh/mesh.hpp"
#include "engine/mesh/mesh_quality.hpp"

using namespace nanson;

namespace {

/// Two tets at the triangle 1 2 3, one region; the outer face 0 1 2 is named "floor".
RawMesh two_tets() {
  RawMesh raw;
  raw.X = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  raw.tets = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  raw.tet_region = {0, 0};
  raw.region_names = {"body"};
  raw.triangles = {{0, 1, 2}};
  raw.triangle_patch = {0};
  raw.patch_names = {"floor"};
  return raw;
}

RawMesh box(const Vec3& size, std::array<int, 3> cells) {
  MeshSpec spec;
  spec.size = size;
  spec.cells = cells;
  return make_box(spec);
}

std::vector<std::string> errors_of(RawMesh raw) {
  std::vector<std::string> errors;
  finish_mesh(std::move(raw), errors);
  return errors;
}

bool any_contains(const std::vector<std::string>& errors, const std::string& text) {
  return std::any_of(errors.begin(), errors.end(), [&](const auto& e) { return e.find(text) != e.npos; });
}

/// Exactly one error, with these words.
void expect_refused(RawMesh raw, const std::vector<std::string>& words) {
  const auto errors = errors_of(std::move(raw));
  ASSERT_EQ(errors.size(), 1u) << testing::PrintToString(errors);
  for (const auto& word : words) EXPECT_NE(errors[0].find(word), std::string::npos) << errors[0] << "\nlacks: " << word;
}

void add_tet(RawMesh& raw, std::array<int, 4> tet, int region = 0) {
  raw.tets.push_back(tet);
  raw.tet_region.push_back(region);
}

void add_triangle(RawMesh& raw, std::array<int, 3> triangle, const std::string& patch) {
  const auto found = std::find(raw.patch_names.begin(), raw.patch_names.end(), patch);
  raw.triangle_patch.push_back(int(found - raw.patch_names.begin()));
  if (found == raw.patch_names.end()) raw.patch_names.push_back(patch);
  raw.triangles.push_back(triangle);
}

}  // namespace

TEST(Mesh, TetVolumeIsPositiveWhenRightHanded) {
  const Vec3 o{1, 1, 1}, x{3, 1, 1}, y{1, 4, 1}, z{1, 1, 5};
  EXPECT_DOUBLE_EQ(tet_volume(o, x, y, z), 4);
  EXPECT_DOUBLE_EQ(tet_volume(o, y, x, z), -4);
}

TEST(Mesh, TurnsNegativeTetsAndCountsThem) {
  RawMesh raw = two_tets();
  std::swap(raw.tets[0][0], raw.tets[0][1]);
  std::vector<std::string> errors;
  const Mesh mesh = finish_mesh(raw, errors);
  EXPECT_TRUE(errors.empty());
  EXPECT_EQ(mesh.reoriented, 1);
  for (const auto& t : mesh.tets) EXPECT_GT(tet_volume(mesh.X[t[0]], mesh.X[t[1]], mesh.X[t[2]], mesh.X[t[3]]), 0);
}

TEST(Mesh, BoundaryFacesPointOutwardAndKnowTheirTet) {
  std::vector<std::string> errors;
  const Mesh mesh = finish_mesh(two_tets(), errors);
  ASSERT_TRUE(errors.empty());
  ASSERT_EQ(mesh.faces.size(), 6u);
  for (const auto& face : mesh.faces) {
    const auto& tet = mesh.tets[face.tet];
    const int inside = *std::find_if(tet.begin(), tet.end(), [&](int a) {
      return std::find(face.nodes.begin(), face.nodes.end(), a) == face.nodes.end();
    });
    EXPECT_LT(tet_volume(mesh.X[face.nodes[0]], mesh.X[face.nodes[1]], mesh.X[face.nodes[2]], mesh.X[inside]), 0);
  }
}

TEST(Mesh, NamesBoundaryFacesAndCountsTheRest) {
  std::vector<std::string> errors;
  const Mesh mesh = finish_mesh(two_tets(), errors);
  EXPECT_EQ(mesh.unnamed_faces, 5);
  EXPECT_EQ(mesh.patch_names, std::vector<std::string>{"floor"});
  for (const auto& face : mesh.faces) {
    auto nodes = face.nodes;
    std::sort(nodes.begin(), nodes.end());
    EXPECT_EQ(face.patch, (nodes == std::array<int, 3>{0, 1, 2} ? 0 : -1));
  }
}

TEST(Mesh, KeepsNodesTetsAndRegionsInTheirOrder) {
  const RawMesh raw = box({1, 1, 1}, {2, 3, 2});
  std::vector<std::string> errors;
  const Mesh mesh = finish_mesh(raw, errors);
  EXPECT_EQ(mesh.X, raw.X);
  EXPECT_EQ(mesh.tets, raw.tets);
  EXPECT_EQ(mesh.tet_region, raw.tet_region);
  EXPECT_EQ(mesh.region_names, raw.region_names);
}

TEST(Mesh, IgnoresNamedTrianglesBetweenTwoTets) {
  RawMesh raw = two_tets();
  add_triangle(raw, {3, 1, 2}, "interface");
  std::vector<std::string> errors;
  const Mesh mesh = finish_mesh(raw, errors);
  EXPECT_TRUE(errors.empty());
  EXPECT_EQ(mesh.unnamed_faces, 5);
  EXPECT_EQ(mesh.patch_names, std::vector<std::string>{"floor"}) << "a name without boundary faces is dropped";
}

TEST(Mesh, DroppingANameKeepsTheOthersRight) {
  RawMesh raw = two_tets();
  raw.patch_names = {"interface", "unused", "floor"};
  raw.triangles = {{1, 2, 3}, {2, 1, 0}};
  raw.triangle_patch = {0, 2};
  std::vector<std::string> errors;
  const Mesh mesh = finish_mesh(raw, errors);
  ASSERT_EQ(mesh.patch_names, std::vector<std::string>{"floor"});
  EXPECT_EQ(std::count_if(mesh.faces.begin(), mesh.faces.end(), [](const Face& f) { return f.patch == 0; }), 1);
}

TEST(Mesh, AcceptsATriangleGivenTwiceInOnePatch) {
  RawMesh raw = two_tets();
  add_triangle(raw, {2, 0, 1}, "floor");
  EXPECT_TRUE(errors_of(raw).empty());
}

TEST(Mesh, RefusesAMeshWithoutTets) {
  RawMesh raw = two_tets();
  raw.tets.clear();
  raw.tet_region.clear();
  expect_refused(raw, {"no tetrahedra", "gmsh -3"});
  expect_refused(RawMesh{}, {"no tetrahedra"});
}

TEST(Mesh, RefusesCoordinatesThatAreNotFinite) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    RawMesh raw = two_tets();
    raw.X[3][1] = bad;
    expect_refused(raw, {"node 3", "finite"});
  }
}

TEST(Mesh, RefusesNodesOutOfRange) {
  RawMesh raw = two_tets();
  raw.tets[1][3] = 5;
  expect_refused(raw, {"tet 1", "1, 2, 3, 5", "0 to 4"});
  raw.tets[1][3] = -1;
  expect_refused(raw, {"tet 1", "0 to 4"});
  raw = two_tets();
  raw.triangles[0][0] = 7;
  expect_refused(raw, {"triangle 0", "7, 1, 2"});
}

TEST(Mesh, RefusesATetThatNamesANodeTwice) {
  RawMesh raw = two_tets();
  raw.tets[1] = {1, 2, 4, 2};
  expect_refused(raw, {"tet 1", "1, 2, 4, 2", "same"});
}

TEST(Mesh, RefusesRegionsAndPatchesThatDoNotFitTheElements) {
  RawMesh raw = two_tets();
  raw.tet_region.pop_back();
  expect_refused(raw, {"tet_region"});
  raw = two_tets();
  raw.triangle_patch[0] = 1;
  expect_refused(raw, {"triangle_patch"});
}

TEST(Mesh, RefusesFlatTets) {
  for (const double height : {0.0, 1e-13, -1e-13}) {
    RawMesh raw = two_tets();
    raw.X[4] = {1 / 3.0 + height, 1 / 3.0 + height, 1 / 3.0 + height};
    expect_refused(raw, {"tet 1", "1, 2, 3, 4", "flat"});
  }
}

TEST(Mesh, AcceptsThinTetsInAnyUnitOfLength) {
  for (const double unit : {1e-9, 1.0, 1e9}) {
    RawMesh raw = two_tets();
    raw.X[4] = {1 / 3.0 + 1e-6, 1 / 3.0 + 1e-6, 1 / 3.0 + 1e-6};
    for (auto& x : raw.X)
      for (auto& c : x) c *= unit;
    EXPECT_TRUE(errors_of(raw).empty()) << unit;
  }
}

TEST(Mesh, RefusesEqualTets) {
  RawMesh raw = two_tets();
  add_tet(raw, {3, 0, 1, 2});
  expect_refused(raw, {"tets 0 and 2", "0, 1, 2, 3", "remove one"});
}

TEST(Mesh, RefusesATetInTwoRegionsByTheirNames) {
  RawMesh raw = two_tets();
  raw.region_names = {"rubber", "steel"};
  add_tet(raw, {0, 1, 2, 3}, 1);
  expect_refused(raw, {"tets 0 and 2", "\"rubber\"", "\"steel\"", "one physical group only"});
}

TEST(Mesh, RefusesCoincidentNodes) {
  for (const double gap : {0.0, 5e-13}) {
    RawMesh raw = two_tets();  // a third tet with a node of its own where it should use node 1
    raw.X.insert(raw.X.end(), {{1, gap, 0}, {2, 2, 1}});
    add_tet(raw, {2, 4, 5, 6});
    expect_refused(raw, {"nodes 1 and 5", "merge"});
  }
}

TEST(Mesh, FindsCoincidentNodesOnlyWhereTheyAre) {
  RawMesh first = box({1, 1, 1}, {6, 5, 4}), second = box({1, 1, 1}, {6, 5, 4});
  const int offset = int(first.X.size());
  for (auto x : second.X) first.X.push_back({x[0] + 1, x[1], x[2]});
  for (auto t : second.tets) add_tet(first, {t[0] + offset, t[1] + offset, t[2] + offset, t[3] + offset});
  const auto errors = errors_of(first);  // the two boxes touch at x = 1 without sharing the 6 x 5 nodes there
  ASSERT_EQ(errors.size(), 6u);
  for (int i = 0; i < 5; ++i) EXPECT_NE(errors[i].find("are both at (1, "), std::string::npos) << errors[i];
  EXPECT_EQ(errors[5], "... and 25 more pairs of coincident nodes");
}

TEST(Mesh, AcceptsNodesThatAreCloseBesideALargeMesh) {
  RawMesh raw = two_tets();
  const double far = 1e4, small = 1e-6;  // a tiny tet far away
  raw.X.insert(raw.X.end(), {{far, 0, 0}, {far + small, 0, 0}, {far, small, 0}, {far, 0, small}});
  add_tet(raw, {5, 6, 7, 8});
  EXPECT_TRUE(errors_of(raw).empty());
}

TEST(Mesh, RefusesNodesOfNoTet) {
  RawMesh raw = two_tets();
  raw.X.insert(raw.X.begin() + 2, {5, 6, 7});
  for (auto& tet : raw.tets)
    for (int& a : tet) a += a >= 2;
  for (int& a : raw.triangles[0]) a += a >= 2;
  expect_refused(raw, {"node 2", "(5, 6, 7)", "no tet"});
}

TEST(Mesh, RefusesATriangleSharedByThreeTets) {
  RawMesh raw = two_tets();
  raw.X.push_back({2, 2, 2.5});
  add_tet(raw, {1, 2, 3, 5});
  expect_refused(raw, {"face of nodes 1, 2, 3", "3 tets (0, 1, 2)"});
}

TEST(Mesh, RefusesTwoTetsOnOneSideOfAFace) {
  RawMesh raw = two_tets();
  raw.X[4] = {-0.2, -0.3, -0.1};
  expect_refused(raw, {"tets 0 and 1", "overlap", "1, 2, 3"});
}

TEST(Mesh, RefusesATetTurnedInsideOutByItsNode) {
  RawMesh raw = box({2, 2, 2}, {2, 2, 2});
  raw.X[13] = {1, 1, 2.5};  // the centre, pushed through the top
  const auto errors = errors_of(raw);
  EXPECT_TRUE(any_contains(errors, "inside out")) << testing::PrintToString(errors);
}

TEST(Mesh, RefusesANamedTriangleOfNoTet) {
  RawMesh raw = two_tets();
  add_triangle(raw, {0, 1, 4}, "roof");
  expect_refused(raw, {"triangle 1", "\"roof\"", "0, 1, 4", "no face of any tet"});
}

TEST(Mesh, RefusesATriangleInTwoPatches) {
  RawMesh raw = two_tets();
  add_triangle(raw, {1, 0, 2}, "wall");
  expect_refused(raw, {"0, 1, 2", "\"floor\"", "\"wall\""});
}

TEST(Mesh, TellsAtMostFiveErrorsOfAKind) {
  RawMesh raw = two_tets();
  for (int i = 0; i < 12; ++i) raw.X.push_back({5.0 + i, 0, 0});
  const auto errors = errors_of(raw);
  ASSERT_EQ(errors.size(), 6u);
  EXPECT_EQ(errors[5], "... and 7 more nodes of no tet");
}

TEST(Mesh, TellsErrorsOfSeveralKindsAtOnce) {
  RawMesh raw = two_tets();
  raw.X.push_back({0, 0, 0});
  const auto errors = errors_of(raw);
  EXPECT_TRUE(any_contains(errors, "node 5") && any_contains(errors, "nodes 0 and 5"))
      << testing::PrintToString(errors);
}

TEST(Mesh, KeepsTheErrorsThatWereThereBefore) {
  std::vector<std::string> errors{"before"};
  const Mesh mesh = finish_mesh(two_tets(), errors);
  EXPECT_EQ(errors, std::vector<std::string>{"before"});
  EXPECT_EQ(mesh.faces.size(), 6u);
}

TEST(MeshQuality, MeanRatioIsOneForARegularTetAndZeroForAFlatOne) {
  const double h = std::sqrt(3.0) / 2, H = std::sqrt(2.0 / 3);
  EXPECT_NEAR(mean_ratio({0, 0, 0}, {1, 0, 0}, {0.5, h, 0}, {0.5, h / 3, H}), 1, 1e-14);
  EXPECT_DOUBLE_EQ(mean_ratio({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}), 0);
  EXPECT_NEAR(mean_ratio({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 12 * std::pow(0.5, 2 / 3.0) / 9, 1e-14);
}

TEST(MeshQuality, SumsUpABox) {
  std::vector<std::string> errors;
  const MeshQuality q = mesh_quality(finish_mesh(box({2, 3, 4}, {2, 3, 4}), errors));
  EXPECT_EQ(q.nodes, 60u);
  EXPECT_EQ(q.tets, 144u);
  EXPECT_EQ(q.boundary_faces, 104u);
  EXPECT_NEAR(q.volume, 24, 1e-13);
  EXPECT_NEAR(q.min_volume, 1 / 6.0, 1e-14);
  EXPECT_NEAR(q.max_volume, 1 / 6.0, 1e-14);
  EXPECT_DOUBLE_EQ(q.min_edge, 1);
  EXPECT_DOUBLE_EQ(q.max_edge, std::sqrt(3.0));
  EXPECT_NEAR(q.worst, 12 * std::pow(0.5, 2 / 3.0) / 10, 1e-14);
  EXPECT_EQ(q.histogram[7], 144u);
  EXPECT_EQ(q.patches[4].name, "zmin");
  EXPECT_EQ(q.patches[4].faces, 12u);
  EXPECT_NEAR(q.patches[4].area, 6, 1e-14);
  EXPECT_EQ(q.unnamed.faces, 0u);
}

TEST(MeshQuality, NamesTheWorstTetAndWhereItIs) {
  RawMesh raw = two_tets();
  raw.X[4] = {0.4, 0.4, 0.4};
  std::vector<std::string> errors;
  const MeshQuality q = mesh_quality(finish_mesh(raw, errors));
  EXPECT_EQ(q.worst_tet, 1);
  EXPECT_NEAR(q.worst_centre[2], 1.4 / 4, 1e-15);
  EXPECT_EQ(q.unnamed.faces, 5u);
  const std::string text = to_text(q);
  for (const auto* word :
       {"nodes 5, tets 2", "tet 1 at (0.35, 0.35, 0.35)", "face floor: 1 triangles, 0.5 m^2", "without a name: 5"})
    EXPECT_NE(text.find(word), std::string::npos) << text;
}
