// Area vectors of the current configuration, found anew in every stage: what Updated and pseudo Updated Lagrangian fluxes take (paper, section 3.3).
#pragma once
#include "engine/aligned.hpp"
#include "engine/order.hpp"

namespace nanson {

/// The tets around edges and corners; empty with description = "total".
struct TetRings {
  Aligned<std::int32_t> ring, cd;    // per edge: the pairs (c, d) of the tets at it (updated)
  Aligned<std::int32_t> at_b, at_c;  // per corner: the same face's corners at b and c
};
TetRings make_tet_rings(Description description, const Mesh& mesh, const Order& order);

/// Of a stage; empty with description = "total".
struct CurrentGeometry {
  Aligned<double> x, map;           // {x, 0} [m]; columns of H_x (pseudo_updated)
  Aligned<double> c[3], corner[3];  // [m^2] of edges and corners, in the order's numbering
  Aligned<double> dJ;               // [1/s] a node
};

}  // namespace nanson
