// The median dual: its identities on perturbed boxes (method, section 2), against the polygons it is made of.
#include "engine/dual.hpp"

#include <gtest/gtest.h>

#include <map>

#include "engine/compensated_sum.hpp"
#include "tests/unit/meshes.hpp"

using namespace nanson;
using namespace nanson::test;

namespace {

struct DualOfABox : ::testing::TestWithParam<Split> {
  Mesh mesh = box({4, 3, 5}, GetParam(), 0.2);
  Dual dual = make_dual(mesh);
};
INSTANTIATE_TEST_SUITE_P(Splits, DualOfABox, ::testing::Values(Split::alternating, Split::kuhn),
                         [](const auto& info) { return std::string(word(info.param)); });

Vec3 mean(std::initializer_list<Vec3> points) {
  Vec3 m{};
  for (const Vec3& p : points)
    for (int k = 0; k < 3; ++k) m[k] += p[k] / static_cast<double>(points.size());
  return m;
}

/// Area vector of a triangle, turned to point from a to b.
Vec3 facing(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& D) {
  Vec3 A = cross((q - p), (r - p));
  const double half = dot(A, D) < 0 ? -0.5 : 0.5;
  for (double& x : A) x *= half;
  return A;
}

/// Edge areas from their triangles: in every tet, edge midpoint, face centroid, tet centroid, on both faces at the edge.
std::map<std::pair<int, int>, Vec3> areas_by_triangles(const Mesh& mesh) {
  std::map<std::pair<int, int>, Vec3> areas;
  for (const auto& t : mesh.tets)
    for (int v = 0; v < 4; ++v)
      for (int w = 0; w < 4; ++w) {
        if (t[v] >= t[w]) continue;
        const Vec3 &a = mesh.X[t[v]], &b = mesh.X[t[w]], middle = mean({a, b}),
                   centre = mean({mesh.X[t[0]], mesh.X[t[1]], mesh.X[t[2]], mesh.X[t[3]]});
        for (int u = 0; u < 4; ++u) {
          if (u == v || u == w) continue;
          const Vec3 A = facing(middle, mean({a, b, mesh.X[t[u]]}), centre, (b - a));
          for (int k = 0; k < 3; ++k) areas[{t[v], t[w]}][k] += A[k];
        }
      }
  return areas;
}

}  // namespace

TEST(Dual, TotalsOfManyTetsAgreeToRoundOff) {
  const Mesh many = box({40, 40, 40}, Split::kuhn, 0);
  EXPECT_LT(check_dual(many, make_dual(many)).volume, 1e-15);  // plain sums: 2e-12, growing with the number of tets
}

TEST(CompensatedSum, DoesNotGrowWithTheNumberOfTerms) {
  const double V = 1.0 / (97.0 * 97 * 97) / 6;
  CompensatedSum sum;
  double plain = 0;
  for (int n = 0; n < 6 * 97 * 97 * 97; ++n) {
    sum += V;
    plain += V;
  }
  EXPECT_GT(std::abs(plain - 1), 1e-10);
  EXPECT_LT(std::abs(sum - 1), 4e-16);
  CompensatedSum mixed;
  for (const double x : {1.0, 1e100, 1.0, -1e100}) mixed += x;
  EXPECT_EQ(mixed, 2.0);
}

TEST_P(DualOfABox, HasEveryEdgeOnceSorted) {
  const auto areas = areas_by_triangles(mesh);
  ASSERT_EQ(dual.edges.size(), areas.size());
  auto expected = areas.begin();
  for (const DualEdge& e : dual.edges) EXPECT_EQ(std::pair(e.a, e.b), (expected++)->first);
}

TEST_P(DualOfABox, EdgeAreasAreThoseOfTheirTriangles) {
  const auto areas = areas_by_triangles(mesh);
  for (const DualEdge& e : dual.edges) EXPECT_LE(norm(e.C - areas.at({e.a, e.b})), 1e-14 * norm(e.C));
}

TEST_P(DualOfABox, AreasCloseEveryCell) {
  std::vector<Vec3> sum(mesh.X.size(), Vec3{});
  for (int k = 0; k < 3; ++k) {
    for (const DualEdge& e : dual.edges) {
      sum[e.a][k] += e.C[k];
      sum[e.b][k] -= e.C[k];
    }
    for (const DualCorner& c : dual.corners) sum[c.a][k] += c.C[k];
  }
  for (const Vec3& s : sum) EXPECT_LE(norm(s), 1e-15);
}

TEST_P(DualOfABox, VolumesFillTheMesh) {
  double sum = 0;
  for (const double V : dual.volume) sum += V;
  EXPECT_NEAR(sum, 2 * 3 * 1.5, 1e-13);
}

TEST_P(DualOfABox, AreaTimesEdgeIsHalfTheVolumeAroundTheEdge) {
  std::map<std::pair<int, int>, double> around;
  for (const auto& t : mesh.tets)
    for (const int a : t)
      for (const int b : t)
        if (a < b) around[{a, b}] += volume(mesh, t);
  for (const DualEdge& e : dual.edges)
    EXPECT_NEAR(dot(e.C, (mesh.X[e.b] - mesh.X[e.a])), 0.5 * around[std::pair(e.a, e.b)], 1e-15);
}

TEST_P(DualOfABox, CornersAreThirdsOfTheirFacesAndPointOutward) {
  ASSERT_EQ(dual.corners.size(), 3 * mesh.faces.size());
  std::vector<int> seen(mesh.faces.size(), 0);
  for (std::size_t k = 0; k < dual.corners.size(); ++k) {
    const DualCorner& c = dual.corners[k];
    EXPECT_LE(dual.corners[k == 0 ? 0 : k - 1].a, c.a);
    const Vec3 A = cross((mesh.X[c.b] - mesh.X[c.a]), (mesh.X[c.c] - mesh.X[c.a]));
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(c.C[i], A[i] / 6, 1e-16);
    const int patch = mesh.faces[c.face].patch, axis = patch / 2;  // xmin xmax ymin ymax zmin zmax
    EXPECT_NEAR(c.C[axis], (patch % 2 ? 1 : -1) * norm(c.C), 1e-15);
    ++seen[c.face];
  }
  for (const int s : seen) EXPECT_EQ(s, 3);
}

TEST_P(DualOfABox, CheckFindsNoDefectInASoundDualAndEveryKindInASpoiledOne) {
  const DualDefects sound = check_dual(mesh, dual);
  EXPECT_LE(sound.closure, 1e-14);
  EXPECT_LE(sound.volume, 1e-14);
  EXPECT_LE(sound.edge, 1e-14);
  Dual turned = dual;
  for (double& x : turned.edges[17].C) x = -x;
  EXPECT_GT(check_dual(mesh, turned).closure, 1e-3);
  EXPECT_GT(check_dual(mesh, turned).edge, 1e-3);
  Dual missing = dual;
  missing.volume[7] *= 2;
  EXPECT_GT(check_dual(mesh, missing).volume, 1e-4);
}
