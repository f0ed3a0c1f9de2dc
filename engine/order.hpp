// Order of nodes and edges in memory: METIS parts that fit a core's L2, reverse Cuthill-McKee inside, edges as structure of arrays grouped by part.
#pragma once
#include <string>
#include <vector>

#include "engine/aligned.hpp"
#include "engine/dual.hpp"
#include "kernels/part.hpp"

namespace nanson {

/// Nodes a part: never depends on threads. Measured at 115k nodes (column, one thread): 512, 1024, 2048 take 297, 306, 285 ns per node-step;
/// smaller meshes take smaller parts, so that threads have some to share.
constexpr int part_size(int nodes) { return nodes < 32768 ? 1024 : 2048; }

/// Meshes from here on write {v, Sigma_J} and {P|H} past the caches. Measured (cube, one thread): 12 % less time at 35,937 nodes, 5 % at 4,913, none at 2,197, 5 % more at 729.
inline constexpr int streaming_nodes = 4096;

struct Order {
  int nodes = 0;              // of the mesh
  int rows = 0;               // nodes and padding
  std::vector<int> row_of;    // mesh node -> row
  std::vector<int> node_of;   // row -> mesh node, -1 for padding
  std::vector<Part> parts;    // constraint ranges are filled by engine/boundary
  bool metis_failed = false;  // parts of one RCM numbering were cut instead
  double metis_s = 0;         // [s] that METIS took

  Aligned<std::int32_t> a, b;  // edges
  Aligned<double> C[3];
  Aligned<double> rho_cp, rho_cs, rho_cJ;  // several materials only, filled in by engine/mixture; rho_cJ with a parting
  Aligned<double> stiffness;               // [N/m] tet_stiffness only
  Aligned<std::int32_t> out, in, in_edges, in_nodes, corner;  // node lists
  Aligned<std::int32_t> corner_b, corner_c, corner_load;
  Aligned<double> corner_C[3];
  std::vector<int> corner_face;                          // corner -> index into Mesh::faces
  int most_nodes = 0, most_edges = 0, most_corners = 0;  // of a part

  EdgeArrays edges() const {
    return {a.data(),      b.data(),      {C[0].data(), C[1].data(), C[2].data()},        {},
            rho_cp.data(), rho_cs.data(), rho_cJ.empty() ? rho_cp.data() : rho_cJ.data(), stiffness.data()};
  }
  CornerArrays corners() const {
    return {corner_b.data(),
            corner_c.data(),
            {corner_C[0].data(), corner_C[1].data(), corner_C[2].data()},
            corner_load.data()};
  }
  NodeLists lists() const { return {out.data(), in.data(), in_edges.data(), in_nodes.data(), corner.data()}; }
};

/// `try_metis` = false takes the road of a METIS that fails. With a `group` a node, each part's rows are sorted by group, RCM inside, and every group is padded.
Order make_order(const Dual& dual, int nodes, bool try_metis = true, const std::vector<int>& group = {});

}  // namespace nanson
