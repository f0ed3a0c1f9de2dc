// The tets around every edge and the three corners of every face.
#include "engine/current_geometry.hpp"

#include <algorithm>
#include <numeric>

namespace nanson {
namespace {

/// Pairs (c, d) of the tets at every edge, tet by tet: the two copies of a cut edge sum in the same order.
void place_rings(TetRings& g, const Mesh& mesh, const Order& o) {
  g.ring.assign(o.a.size() + 1, 0);
  const auto visit = [&](auto use) {
    for (const auto& t : mesh.tets)
      for (const auto& e : tet_edges) {
        const int a = o.row_of[t[e[0]]], b = o.row_of[t[e[1]]], c = o.row_of[t[e[2]]], d = o.row_of[t[e[3]]];
        const auto half = [&](int from, int to, int p, int q) {
          const auto first = o.b.begin() + o.out[from], last = o.b.begin() + o.out[from + 1],
                     at = std::lower_bound(first, last, to);
          if (at != last && *at == to) use(at - o.b.begin(), p, q);
        };
        half(a, b, c, d);
        half(b, a, d, c);
      }
  };
  visit([&](std::ptrdiff_t e, int, int) { ++g.ring[e + 1]; });
  std::partial_sum(g.ring.begin(), g.ring.end(), g.ring.begin());
  g.cd.assign(2 * static_cast<std::size_t>(g.ring.back()), 0);
  std::vector<std::int32_t> next(g.ring.begin(), g.ring.end() - 1);
  visit([&](std::ptrdiff_t e, int c, int d) {
    const std::int32_t i = next[e]++;
    g.cd[2 * i] = c;
    g.cd[2 * i + 1] = d;
  });
}

void pair_corners(TetRings& g, const Mesh& mesh, const Order& o) {
  std::vector<std::array<std::int32_t, 3>> of_face(mesh.faces.size(), {-1, -1, -1});
  const auto place = [&](std::size_t face, int row) {
    const auto& nodes = mesh.faces[face].nodes;
    return std::find(nodes.begin(), nodes.end(), o.node_of[row]) - nodes.begin();
  };
  g.at_b.assign(o.corner_face.size(), 0);
  g.at_c = g.at_b;
  for (int a = 0; a < o.rows; ++a)
    for (std::int32_t k = o.corner[a]; k < o.corner[a + 1]; ++k)
      of_face[o.corner_face[k]][place(o.corner_face[k], a)] = k;
  for (std::size_t k = 0; k < o.corner_face.size(); ++k) {
    const std::size_t face = o.corner_face[k];
    g.at_b[k] = of_face[face][place(face, o.corner_b[k])];
    g.at_c[k] = of_face[face][place(face, o.corner_c[k])];
  }
}

}  // namespace

TetRings make_tet_rings(Description description, const Mesh& mesh, const Order& o) {
  TetRings g;
  if (!has_current_areas(description)) return g;
  pair_corners(g, mesh, o);
  if (description == Description::updated) place_rings(g, mesh, o);
  return g;
}

}  // namespace nanson
