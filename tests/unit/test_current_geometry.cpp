// Current area vectors: the median dual of the deformed mesh from the tets at each edge, and the mapped ones.
#include "engine/current_geometry.hpp"

#include <gtest/gtest.h>

#include <deque>

#include "engine/current_areas.hpp"
#include "engine/solver.hpp"
#include "tests/unit/meshes.hpp"

using namespace nanson;
using namespace nanson::test;

namespace {

struct CurrentDual : ::testing::TestWithParam<Split> {
  std::deque<Scene> scenes;                        // simulations point into them
  Mesh mesh = box({13, 12, 10}, GetParam(), 0.2);  // two parts
  Simulation start(Description d) {
    Scene& scene = scenes.emplace_back();
    scene.material.density = 1000;
    scene.material.youngs_modulus = 1e6;
    scene.material.poissons_ratio = 0.3;
    scene.time.end = 1;
    scene.physics.description = d;
    return make_simulation(scene, mesh, 1);
  }
  /// Moves every node to x(X), finds the areas, and hands back the mesh as it is now.
  template <class Map>
  Mesh move(Simulation& s, Map map) {
    Mesh moved = mesh;
    for (std::size_t n = 0; n < mesh.X.size(); ++n) {
      moved.X[n] = map(mesh.X[n]);
      for (int i = 0; i < 3; ++i) s.state.U[0][row::U * s.domain.order.row_of[n] + 4 * (i + 1) + 3] = moved.X[n][i];
    }
    find_current_areas(s, s.state.U[0].data());
    return moved;
  }
};
INSTANTIATE_TEST_SUITE_P(Splits, CurrentDual, ::testing::Values(Split::alternating, Split::kuhn),
                         [](const auto& info) { return std::string(word(info.param)); });

Vec3 bent(const Vec3& X) {
  return {X[0] + 0.2 * std::sin(X[1] + X[2]), 1.1 * X[1] - 0.1 * X[0] * X[2], 0.9 * X[2] + 0.15 * std::cos(2 * X[0])};
}

/// Largest |sum c_ab + sum c_gamma| / sum |c| over the nodes.
double closure(const Simulation& s) {
  const EdgeArrays e = flux_edges(s);
  const CornerArrays g = flux_corners(s);
  std::vector<Vec3> sum(s.domain.order.rows, Vec3{});
  std::vector<double> size(s.domain.order.rows, 0.0);
  for (int r = 0; r < s.domain.order.rows; ++r) {
    const auto add = [&](double sign, const double* const(&c)[3], int k) {
      for (int i = 0; i < 3; ++i) sum[r][i] += sign * c[i][k];
      size[r] += norm({c[0][k], c[1][k], c[2][k]});
    };
    for (int k = s.domain.order.out[r]; k < s.domain.order.out[r + 1]; ++k) add(1, e.c, k);
    for (int k = s.domain.order.in[r]; k < s.domain.order.in[r + 1]; ++k) add(-1, e.c, s.domain.order.in_edges[k]);
    for (int k = s.domain.order.corner[r]; k < s.domain.order.corner[r + 1]; ++k) add(1, g.c_gamma, k);
  }
  double worst = 0;
  for (int r = 0; r < s.domain.order.rows; ++r)
    if (s.domain.order.node_of[r] >= 0) worst = std::max(worst, norm(sum[r]) / size[r]);
  return worst;
}

/// Largest difference of edges and corners to another order's, relative to the largest area.
double difference(const Simulation& s, const Order& expected) {
  const EdgeArrays e = flux_edges(s);
  const CornerArrays g = flux_corners(s);
  double worst = 0, largest = 0;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < expected.out.back(); ++k) {
      worst = std::max(worst, std::abs(e.c[i][k] - expected.C[i][k]));
      largest = std::max(largest, edge_size(expected.edges(), k));
    }
    for (std::size_t k = 0; k < expected.corner_C[i].size(); ++k)
      worst = std::max(worst, std::abs(g.c_gamma[i][k] - expected.corner_C[i][k]));
  }
  return worst / largest;
}

}  // namespace

TEST_P(CurrentDual, IsTheUndeformedOneWhereNothingMoved) {
  for (auto d : {Description::updated, Description::pseudo_updated}) {
    Simulation s = start(d);
    ASSERT_EQ(s.domain.order.parts.size(), 2u);
    move(s, [](const Vec3& X) { return X; });
    EXPECT_LT(difference(s, s.domain.order), d == Description::updated ? 1e-15 : 1e-14) << word(d);
  }
}

TEST_P(CurrentDual, IsTheMedianDualOfTheDeformedMesh) {
  Simulation s = start(Description::updated);
  const Mesh moved = move(s, bent);
  const Order expected = make_order(make_dual(moved), static_cast<int>(moved.X.size()));
  ASSERT_TRUE(expected.row_of == s.domain.order.row_of);  // the order is of the graph alone
  EXPECT_LT(difference(s, expected), 1e-15);
  EXPECT_GT(difference(s, s.domain.order), 0.01);
}

TEST_P(CurrentDual, ClosesAndMappedAreasDoNot) {
  Simulation s = start(Description::updated);
  move(s, bent);
  EXPECT_LT(closure(s), 1e-15);
  Simulation mapped = start(Description::pseudo_updated);
  move(mapped, bent);
  EXPECT_GT(closure(mapped), 1e-6);
}

// Under x = A X the median dual of the moved mesh is cof A times the undeformed one, and so is the map of every node.
TEST_P(CurrentDual, UnderALinearMapBothAreCofATimesC) {
  const auto linear = [](const Vec3& X) {
    return Vec3{1.2 * X[0] + 0.3 * X[1], 0.9 * X[1] - 0.2 * X[2], 0.1 * X[0] + 1.1 * X[2]};
  };
  Simulation updated = start(Description::updated), mapped = start(Description::pseudo_updated);
  const Mesh moved = move(updated, linear);
  move(mapped, linear);
  const Order expected = make_order(make_dual(moved), static_cast<int>(moved.X.size()));
  EXPECT_LT(difference(updated, expected), 1e-15);
  EXPECT_LT(difference(mapped, expected), 1e-13);
}

TEST_P(CurrentDual, CornersKnowTheOtherTwoOfTheirFace) {
  const Simulation s = start(Description::updated);
  const CornerArrays g = flux_corners(s);
  std::vector<int> owner(s.domain.order.corner_face.size());
  for (int r = 0; r < s.domain.order.rows; ++r)
    for (int k = s.domain.order.corner[r]; k < s.domain.order.corner[r + 1]; ++k) owner[k] = r;
  for (std::size_t k = 0; k < owner.size(); ++k) {
    EXPECT_EQ(owner[g.at_b[k]], g.b[k]);
    EXPECT_EQ(owner[g.at_c[k]], g.c[k]);
    EXPECT_EQ(s.domain.order.corner_face[g.at_b[k]], s.domain.order.corner_face[k]);
    EXPECT_EQ(s.domain.order.corner_face[g.at_c[k]], s.domain.order.corner_face[k]);
  }
}

TEST(CurrentGeometry, ATotalLagrangianSceneHasNone) {
  const Mesh mesh = box({2, 2, 2});
  const Dual dual = make_dual(mesh);
  const TetRings rings = make_tet_rings(Description::total, mesh, make_order(dual, static_cast<int>(mesh.X.size())));
  EXPECT_TRUE(rings.ring.empty() && rings.cd.empty() && rings.at_b.empty() && rings.at_c.empty());
  Scene scene;
  scene.mesh.cells = {2, 2, 2};
  scene.mesh.size = {1, 1, 1};
  scene.material.density = scene.material.youngs_modulus = 1;
  const Simulation s = make_simulation(scene, mesh, 1);
  EXPECT_TRUE(s.state.current.x.empty() && s.state.current.c[0].empty() && s.state.current.dJ.empty());
}
