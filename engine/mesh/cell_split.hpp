// Hexahedral cells into six tets each, by Kuhn's split along a main diagonal, mirrored or not: what the built-in meshes share.
#pragma once
#include <utility>

#include "engine/mesh/mesh.hpp"

namespace nanson {

/// Nodes of a cell. Corners are three bits, the cell's first direction lowest: 0 is the lower corner, 7 the upper.
using Cell = std::array<int, 8>;

/// A tet is a path from corner 0 to corner 7 along three edges; in the last three the two middle corners are swapped, which makes
/// them right-handed.
inline constexpr std::array<std::array<int, 4>, 6> kuhn_tets{
    {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 3, 2, 7}, {0, 6, 4, 7}, {0, 5, 1, 7}}};

/// Directions in which the cell is mirrored by the alternating split: the diagonals then run from nodes of even to nodes of odd place.
constexpr int parity_mirror(int i, int j, int k) { return (i & 1) | (j & 1) << 1 | (k & 1) << 2; }

inline void add_tets(const Cell& corner, int mirror, RawMesh& mesh) {
  const bool odd = (mirror ^ mirror >> 1 ^ mirror >> 2) & 1;
  for (const auto& path : kuhn_tets) {
    std::array<int, 4> tet;
    for (std::size_t v = 0; v < 4; ++v) tet[v] = corner[static_cast<std::size_t>(path[v] ^ mirror)];
    if (odd) std::swap(tet[1], tet[2]);
    mesh.tets.push_back(tet);
  }
}

/// The two triangles of a cell on face `side` (0 lower, 1 upper) of direction `axis`: the diagonal joins the cell's main diagonal.
inline void add_triangles(const Cell& corner, int mirror, int axis, int side, int patch, RawMesh& mesh) {
  const int base = (side << axis) ^ (mirror & 1 << axis), b = 1 << (axis + 1) % 3, c = 1 << (axis + 2) % 3;
  const auto node = [&](int bits) { return corner[static_cast<std::size_t>(bits ^ mirror)]; };
  for (const int middle : {b, c}) {
    mesh.triangles.push_back({node(base), node(base | middle), node(base | b | c)});
    mesh.triangle_patch.push_back(patch);
  }
}

}  // namespace nanson
