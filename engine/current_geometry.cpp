// The tets around every edge, the three corners of every face, and the sweeps that make area vectors of positions.
#include "engine/current_geometry.hpp"

#include <algorithm>
#include <numeric>

#include "engine/parts.hpp"
#include "kernels/current_geometry_part.hpp"

namespace nanson {
namespace {

/// Pairs (c, d) of the tets at every edge, tet by tet: the two copies of a cut edge sum in the same order.
void place_rings(CurrentGeometry& g, const Mesh& mesh, const Order& o) {
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

void pair_corners(CurrentGeometry& g, const Mesh& mesh, const Order& o) {
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

CurrentGeometry make_current_geometry(Description description, const Mesh& mesh, const Order& o) {
  CurrentGeometry g;
  if (!has_current_areas(description)) return g;
  const std::size_t rows = static_cast<std::size_t>(o.rows);
  g.x.assign(row::x * rows, 0.0);
  g.dJ.assign(rows, 0.0);
  for (int k = 0; k < 3; ++k) {
    g.c[k].assign(o.C[k].size(), 0.0);
    g.corner[k].assign(o.corner_C[k].size(), 0.0);
  }
  pair_corners(g, mesh, o);
  if (description == Description::updated) place_rings(g, mesh, o);
  else g.map.assign(row::H * rows, 0.0);
  return g;
}

std::size_t current_geometry_bytes(const CurrentGeometry& g) {
  std::size_t doubles = g.x.size() + g.map.size() + g.dJ.size();
  for (int k = 0; k < 3; ++k) doubles += g.c[k].size() + g.corner[k].size();
  return 8 * doubles + 4 * (g.ring.size() + g.cd.size() + g.at_b.size() + g.at_c.size());
}

EdgeArrays flux_edges(const Simulation& s) {
  EdgeArrays e = s.order.edges();
  for (int k = 0; k < 3 && has_current_areas(s.scene->physics.description); ++k) e.c[k] = s.current.c[k].data();
  return e;
}

CornerArrays flux_corners(const Simulation& s) {
  CornerArrays c = s.order.corners();
  if (!has_current_areas(s.scene->physics.description)) return c;
  for (int k = 0; k < 3; ++k) c.c_gamma[k] = s.current.corner[k].data();
  c.at_b = s.current.at_b.data();
  c.at_c = s.current.at_c.data();
  return c;
}

void find_current_areas(Simulation& s, const double* U) {
  const Description description = s.scene->physics.description;
  if (!has_current_areas(description)) return;
  CurrentGeometry& g = s.current;
  const CurrentAreas areas{g.x.data(),
                           g.map.data(),
                           g.ring.data(),
                           g.cd.data(),
                           {g.c[0].data(), g.c[1].data(), g.c[2].data()},
                           {g.corner[0].data(), g.corner[1].data(), g.corner[2].data()}};
  const auto edges = s.order.edges();
  const auto corners = s.order.corners();
  const auto lists = s.order.lists();
  Rows rows{};
  rows.X = s.state.X.data();
  for_parts(s, [&](int p, Scratch) { positions_part(s.order.parts[p], U, areas); });
  if (description == Description::updated) {
    for_parts(s, [&](int p, Scratch) { dual_areas_part(s.order.parts[p], edges, corners, lists, areas); });
  } else {
    for_parts(s, [&](int p, Scratch) { area_map_part(s.order.parts[p], edges, corners, lists, rows, areas); });
    for_parts(s, [&](int p, Scratch) { mapped_areas_part(s.order.parts[p], edges, corners, lists, areas); });
  }
}

}  // namespace nanson
