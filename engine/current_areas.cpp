// The sweeps that make area vectors of positions, and edges and corners with these areas.
#include "engine/current_areas.hpp"

#include "kernels/current_geometry_part.hpp"

namespace nanson {

EdgeArrays flux_edges(const Domain& d, const CurrentGeometry& current) {
  EdgeArrays e = d.order.edges();
  for (int k = 0; k < 3 && has_current_areas(d.scene->physics.description); ++k) e.c[k] = current.c[k].data();
  return e;
}

CornerArrays flux_corners(const Domain& d, const CurrentGeometry& current) {
  CornerArrays c = d.order.corners();
  if (!has_current_areas(d.scene->physics.description)) return c;
  for (int k = 0; k < 3; ++k) c.c_gamma[k] = current.corner[k].data();
  c.at_b = d.rings.at_b.data();
  c.at_c = d.rings.at_c.data();
  return c;
}

void find_current_areas(const Simulation& s, const double* U, CurrentGeometry& g) {
  const Description description = s.domain.scene->physics.description;
  if (!has_current_areas(description)) return;
  const CurrentAreas areas{g.x.data(),
                           g.map.data(),
                           s.domain.rings.ring.data(),
                           s.domain.rings.cd.data(),
                           {g.c[0].data(), g.c[1].data(), g.c[2].data()},
                           {g.corner[0].data(), g.corner[1].data(), g.corner[2].data()}};
  const auto edges = s.domain.order.edges();
  const auto corners = s.domain.order.corners();
  const auto lists = s.domain.order.lists();
  Rows rows{};
  rows.X = s.domain.X.data();
  for_parts(s, [&](int p, Scratch) { positions_part(s.domain.order.parts[p], U, areas); });
  if (description == Description::updated) {
    for_parts(s, [&](int p, Scratch) { dual_areas_part(s.domain.order.parts[p], edges, corners, lists, areas); });
  } else {
    for_parts(s, [&](int p, Scratch) { area_map_part(s.domain.order.parts[p], edges, corners, lists, rows, areas); });
    for_parts(s, [&](int p, Scratch) { mapped_areas_part(s.domain.order.parts[p], edges, corners, lists, areas); });
  }
}

}  // namespace nanson
