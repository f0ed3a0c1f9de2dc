// The order in memory: parts, rows, edges in the parts that they touch, node lists.
#include "engine/order.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <map>
#include <set>

#include "tests/unit/meshes.hpp"

using namespace nanson;
using namespace nanson::test;

namespace {

struct Ordered {
  Mesh mesh;
  Dual dual;
  Order order;
  explicit Ordered(std::array<int, 3> cells, Split split = Split::alternating)
      : mesh(box(cells, split, 0.1)), dual(make_dual(mesh)), order(make_order(dual, static_cast<int>(mesh.X.size()))) {}
  int part_of(int row) const {
    for (std::size_t p = 0; p < order.parts.size(); ++p)
      if (row >= order.parts[p].node_begin && row < order.parts[p].node_end) return static_cast<int>(p);
    return -1;
  }
  int edges() const { return order.out[order.rows]; }
};

/// 3,375 nodes: three parts.
const Ordered& many_parts() {
  static const Ordered ordered({14, 14, 14});
  return ordered;
}

}  // namespace

TEST(Order, PartsTileRowsEdgesAndCorners) {
  const Order& o = many_parts().order;
  ASSERT_EQ(o.parts.size(), 3u);
  EXPECT_FALSE(o.metis_failed);
  int node = 0, edge = 0, corner = 0, most_nodes = 0, most_edges = 0, most_corners = 0;
  for (const Part& p : o.parts) {
    EXPECT_EQ(p.node_begin, node);
    EXPECT_EQ(p.edge_begin, edge);
    EXPECT_EQ(p.corner_begin, corner);
    EXPECT_EQ(p.node_begin % 8, 0);
    EXPECT_EQ(p.node_end % 8, 0);
    node = p.node_end;
    edge = p.edge_end;
    corner = p.corner_end;
    most_nodes = std::max(most_nodes, p.node_end - p.node_begin);
    most_edges = std::max(most_edges, p.edge_end - p.edge_begin);
    most_corners = std::max(most_corners, p.corner_end - p.corner_begin);
  }
  EXPECT_EQ(node, o.rows);
  EXPECT_EQ(edge, many_parts().edges());
  EXPECT_EQ(corner, static_cast<int>(many_parts().dual.corners.size()));
  EXPECT_EQ(o.most_nodes, most_nodes);
  EXPECT_EQ(o.most_edges, most_edges);
  EXPECT_EQ(o.most_corners, most_corners);
}

TEST(Order, PartsAreBalanced) {
  for (const Part& p : many_parts().order.parts) {
    EXPECT_GT(p.node_end - p.node_begin, 1000);
    EXPECT_LT(p.node_end - p.node_begin, 1250);
  }
}

TEST(Order, RowOfAndNodeOfAreInverse) {
  const Order& o = many_parts().order;
  ASSERT_EQ(o.row_of.size(), many_parts().mesh.X.size());
  ASSERT_EQ(o.node_of.size(), static_cast<std::size_t>(o.rows));
  for (int n = 0; n < o.nodes; ++n) EXPECT_EQ(o.node_of[o.row_of[n]], n);
  int padding = 0;
  for (int r = 0; r < o.rows; ++r) padding += o.node_of[r] == -1;
  EXPECT_EQ(padding, o.rows - o.nodes);
}

TEST(Order, PaddingStandsAtTheEndOfItsPartWithoutEdgesOrCorners) {
  const Order& o = many_parts().order;
  for (const Part& p : o.parts) {
    EXPECT_GE(o.node_of[p.node_end - 8], 0);
    for (int r = p.node_begin + 1; r < p.node_end; ++r) {
      if (o.node_of[r] >= 0) {
        EXPECT_GE(o.node_of[r - 1], 0);
      } else {
        EXPECT_EQ(o.out[r], o.out[r + 1]);
        EXPECT_EQ(o.in[r], o.in[r + 1]);
        EXPECT_EQ(o.corner[r], o.corner[r + 1]);
      }
    }
  }
}

TEST(Order, EveryMeshEdgeStandsOnceInItsPartOrOnceInEachOfTwoWithOppositeC) {
  const Ordered& m = many_parts();
  const Order& o = m.order;
  std::map<std::pair<int, int>, std::vector<int>> places;  // mesh nodes -> edges of the order
  for (int e = 0; e < m.edges(); ++e) {
    const int a = o.node_of[o.a[e]], b = o.node_of[o.b[e]];
    places[std::pair(std::min(a, b), std::max(a, b))].push_back(e);
  }
  ASSERT_EQ(places.size(), m.dual.edges.size());
  int cut = 0;
  for (const DualEdge& edge : m.dual.edges) {
    const auto& at = places[std::pair(edge.a, edge.b)];
    const bool inside = m.part_of(o.row_of[edge.a]) == m.part_of(o.row_of[edge.b]);
    ASSERT_EQ(at.size(), inside ? 1u : 2u);
    cut += !inside;
    for (const int e : at) {
      const double sign = o.node_of[o.a[e]] == edge.a ? 1 : -1;
      for (int k = 0; k < 3; ++k) EXPECT_EQ(o.C[k][e], sign * edge.C[k]);
      EXPECT_NEAR(edge_size(o.edges(), e), norm(edge.C), 1e-16);
      EXPECT_EQ(edge_size(o.edges(), e), edge_size(o.edges(), at[0]));
      EXPECT_EQ(edge_size(o.edges(), e), edge_sizes(o.edges(), e)[0]);
      const Part& p = o.parts[m.part_of(o.a[e])];
      EXPECT_GE(e, p.edge_begin);
      EXPECT_LT(e, p.edge_end);
    }
    if (inside) {
      EXPECT_LT(o.a[at[0]], o.b[at[0]]);
    } else {
      EXPECT_EQ(o.a[at[0]], o.b[at[1]]);
    }
  }
  EXPECT_GT(cut, 100);
}

TEST(Order, EdgesOfANodeAreSortedByTheOtherEnd) {
  const Order& o = many_parts().order;
  for (int r = 0; r < o.rows; ++r)
    for (int e = o.out[r]; e < o.out[r + 1]; ++e) {
      EXPECT_EQ(o.a[e], r);
      EXPECT_LT(e == o.out[r] ? -1 : o.b[e - 1], o.b[e]);
    }
}

TEST(Order, NodeListsHoldEveryNeighbourOnce) {
  const Ordered& m = many_parts();
  const Order& o = m.order;
  std::vector<std::multiset<int>> expected(static_cast<std::size_t>(o.rows)), found(static_cast<std::size_t>(o.rows));
  for (const DualEdge& e : m.dual.edges) {
    expected[o.row_of[e.a]].insert(o.row_of[e.b]);
    expected[o.row_of[e.b]].insert(o.row_of[e.a]);
  }
  for (int r = 0; r < o.rows; ++r) {
    for (int e = o.out[r]; e < o.out[r + 1]; ++e) found[r].insert(o.b[e]);
    for (int k = o.in[r]; k < o.in[r + 1]; ++k) {
      EXPECT_EQ(o.b[o.in_edges[k]], r);
      EXPECT_EQ(o.a[o.in_edges[k]], o.in_nodes[k]);
      found[r].insert(o.a[o.in_edges[k]]);
    }
  }
  EXPECT_EQ(found, expected);
}

TEST(Order, CornersStandWithTheirOwner) {
  const Ordered& m = many_parts();
  const Order& o = m.order;
  std::multiset<std::array<int, 4>> expected, found;
  for (const DualCorner& c : m.dual.corners) expected.insert({c.a, c.b, c.c, c.face});
  for (int r = 0; r < o.rows; ++r)
    for (int g = o.corner[r]; g < o.corner[r + 1]; ++g) {
      found.insert({o.node_of[r], o.node_of[o.corner_b[g]], o.node_of[o.corner_c[g]], o.corner_face[g]});
      const Vec3 C{o.corner_C[0][g], o.corner_C[1][g], o.corner_C[2][g]};
      const auto& n = m.mesh.faces[o.corner_face[g]].nodes;
      const Vec3 A = cross((m.mesh.X[n[1]] - m.mesh.X[n[0]]), (m.mesh.X[n[2]] - m.mesh.X[n[0]]));
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(C[k], A[k] / 6, 1e-17);
      EXPECT_EQ(o.corner_load[g], -1);
    }
  EXPECT_EQ(found, expected);
}

TEST(Order, ASmallMeshIsOnePartWhereEveryEdgeStandsOnce) {
  const Ordered small({3, 2, 2}, Split::kuhn);  // 36 nodes
  ASSERT_EQ(small.order.parts.size(), 1u);
  EXPECT_EQ(small.order.rows, 40);
  EXPECT_EQ(small.edges(), static_cast<int>(small.dual.edges.size()));
}

TEST(Order, NumberOfPartsFollowsTheNodes) {
  EXPECT_EQ(Ordered({10, 10, 11}).order.parts.size(), 1u);  // 1,452 nodes
  EXPECT_EQ(Ordered({10, 11, 11}).order.parts.size(), 2u);  // 1,584
}

TEST(Order, IsTheSameForEveryThreadCountAndEveryTime) {
  const int before = omp_get_max_threads();
  for (const int threads : {1, 2, 7}) {
    omp_set_num_threads(threads);
    const Order again = make_order(many_parts().dual, static_cast<int>(many_parts().mesh.X.size()));
    EXPECT_EQ(again.parts.size(), many_parts().order.parts.size());
    EXPECT_EQ(again.node_of, many_parts().order.node_of);
    EXPECT_EQ(again.b, many_parts().order.b);
  }
  omp_set_num_threads(before);
}

TEST(Order, WithoutMetisOneNumberingIsCutIntoPartsThatHoldEverything) {
  const Ordered& with = many_parts();
  const Order o = make_order(with.dual, static_cast<int>(with.mesh.X.size()), false);
  EXPECT_TRUE(o.metis_failed);
  ASSERT_EQ(o.parts.size(), with.order.parts.size());
  std::set<int> nodes;
  for (int r = 0; r < o.rows; ++r) {
    if (o.node_of[r] < 0) continue;
    EXPECT_TRUE(nodes.insert(o.node_of[r]).second);
  }
  EXPECT_EQ(nodes.size(), with.mesh.X.size());
  std::set<std::pair<int, int>> edges;
  for (int e = 0; e < o.out[o.rows]; ++e) edges.insert(std::minmax(o.node_of[o.a[e]], o.node_of[o.b[e]]));
  EXPECT_EQ(edges.size(), with.dual.edges.size());
  EXPECT_EQ(o.corner[o.rows], static_cast<int>(with.dual.corners.size()));
}

TEST(Order, NeighboursInAPartAreNearInMemory) {
  const Ordered& m = many_parts();
  const Order& o = m.order;
  double distance = 0;
  int inside = 0, widest = 0;
  for (int e = 0; e < m.edges(); ++e)
    if (m.part_of(o.a[e]) == m.part_of(o.b[e])) {
      distance += o.b[e] - o.a[e];
      widest = std::max(widest, o.b[e] - o.a[e]);
      ++inside;
    }
  EXPECT_LT(distance / inside, 80);  // 53 of 1,130 rows; a random order has a third of them, 377
  EXPECT_LT(widest, 230);            // 152
}
