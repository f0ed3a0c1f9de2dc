// Median dual of a tetrahedral mesh: edges with area vectors, dual volumes, boundary corners (paper, section 3.1), in the mesh's numbering.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "engine/mesh/mesh.hpp"

namespace nanson {

/// Edges of a tet as even permutations (a, b; c, d) of its nodes: then C = (c - d) x (c + d - a - b) / 24 points from a to b.
inline constexpr int tet_edges[6][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2},
                                        {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}};

struct DualEdge {
  int a, b;              // a < b
  Vec3 C;                // [m^2] from a to b
  double stiffness = 0;  // [N/m] -sum V c grad N_a . grad N_b over the tets at the edge, c their modulus
};

/// A third of a boundary face: owner a, then b and c counter-clockwise from outside.
struct DualCorner {
  int a, b, c;
  int face;  // index into Mesh::faces
  Vec3 C;    // [m^2] outward
};

struct Dual {
  std::vector<DualEdge> edges;      // sorted by (a, b)
  std::vector<int> first;           // edge of every node a, one more than there are nodes
  std::vector<DualCorner> corners;  // sorted by a
  std::vector<double> volume;       // [m^3] Omega_a
  bool has_springs = false;         // edges have a stiffness
};

/// Worst violations of the identities of the median dual, relative.
struct DualDefects {
  double closure = 0;  // |sum C_ab + sum C_gamma| / sum |C|
  double volume = 0;   // |sum Omega - volume of the tets| / volume
  double edge = 0;     // |C_ab . D - 1/2 sum of the tet volumes at ab| / (|C_ab| |D|)
};

/// With a modulus of every node [Pa], of which a tet has the mean of its own, the edges get a stiffness.
Dual make_dual(const Mesh& mesh, std::span<const double> modulus = {});
DualDefects check_dual(const Mesh& mesh, const Dual& dual);

}  // namespace nanson
