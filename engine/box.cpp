// The built-in box: cells of a regular grid, six tets each (Kuhn's split along a main diagonal of the cell).
#include <random>
#include <utility>

#include "engine/mesh.hpp"

namespace nanson {
namespace {

/// Corners of a cell are three bits, x first: 0 is the lower corner, 7 the upper. A tet is a path from 0 to 7 along three
/// edges; in the last three the two middle corners are swapped, which makes them right-handed.
constexpr std::array<std::array<int, 4>, 6> kuhn_tets{{{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 3, 2, 7}, {0, 6, 4, 7}, {0, 5, 1, 7}}};

constexpr int odd_bits(int bits) { return (bits ^ bits >> 1 ^ bits >> 2) & 1; }

struct Grid {
  std::array<int, 3> cells;
  Split split;

  int node(int i, int j, int k) const { return (k * (cells[1] + 1) + j) * (cells[0] + 1) + i; }
  int corner(const std::array<int, 3>& cell, int bits) const {
    return node(cell[0] + (bits & 1), cell[1] + (bits >> 1 & 1), cell[2] + (bits >> 2 & 1));
  }
  /// Directions in which the split of this cell is mirrored. Neighbours in x differ in the bit of x only, which leaves
  /// the diagonals of their common face alone: the mesh conforms for any number of cells.
  int mirror(const std::array<int, 3>& cell) const {
    return split == Split::alternating ? (cell[0] & 1) | (cell[1] & 1) << 1 | (cell[2] & 1) << 2 : 0;
  }
};

std::vector<Vec3> grid_nodes(const MeshSpec& spec) {
  const auto& n = spec.cells;
  std::mt19937_64 random(20240229);
  const auto uniform = [&] { return double(random() >> 11) * 0x1p-52 - 1; };  // [-1, 1), the same on every platform
  std::vector<Vec3> X;
  X.reserve(std::size_t(n[0] + 1) * (n[1] + 1) * (n[2] + 1));
  for (int k = 0; k <= n[2]; ++k)
    for (int j = 0; j <= n[1]; ++j)
      for (int i = 0; i <= n[0]; ++i) {
        const std::array<int, 3> at{i, j, k};
        bool inner = true;
        for (int c = 0; c < 3; ++c) inner = inner && at[c] > 0 && at[c] < n[c];
        Vec3 x;
        for (int c = 0; c < 3; ++c) {
          x[c] = spec.origin[c] + spec.size[c] * at[c] / n[c];
          if (inner) x[c] += spec.perturb * spec.size[c] / n[c] * uniform();
        }
        X.push_back(x);
      }
  return X;
}

void add_tets(const Grid& grid, const std::array<int, 3>& cell, RawMesh& mesh) {
  const int mirror = grid.mirror(cell);
  for (const auto& path : kuhn_tets) {
    std::array<int, 4> tet;
    for (int v = 0; v < 4; ++v) tet[v] = grid.corner(cell, path[v] ^ mirror);
    if (odd_bits(mirror)) std::swap(tet[1], tet[2]);
    mesh.tets.push_back(tet);
  }
}

/// The two triangles of a cell on face `side` (0 lower, 1 upper) of direction `axis`: the diagonal joins the cell's main diagonal.
void add_triangles(const Grid& grid, const std::array<int, 3>& cell, int axis, int side, RawMesh& mesh) {
  const int mirror = grid.mirror(cell);
  const int base = (side << axis) ^ (mirror & 1 << axis), b = 1 << (axis + 1) % 3, c = 1 << (axis + 2) % 3;
  for (const int middle : {b, c}) {
    mesh.triangles.push_back({grid.corner(cell, base ^ mirror), grid.corner(cell, (base | middle) ^ mirror),
                              grid.corner(cell, (base | b | c) ^ mirror)});
    mesh.triangle_patch.push_back(2 * axis + side);
  }
}

}  // namespace

RawMesh make_box(const MeshSpec& spec) {
  const Grid grid{spec.cells, spec.split};
  RawMesh mesh;
  mesh.X = grid_nodes(spec);
  mesh.region_names = {"box"};
  mesh.patch_names = {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};
  mesh.tets.reserve(std::size_t(6) * spec.cells[0] * spec.cells[1] * spec.cells[2]);
  for (int k = 0; k < spec.cells[2]; ++k)
    for (int j = 0; j < spec.cells[1]; ++j)
      for (int i = 0; i < spec.cells[0]; ++i) {
        const std::array<int, 3> cell{i, j, k};
        add_tets(grid, cell, mesh);
        for (int axis = 0; axis < 3; ++axis) {
          if (cell[axis] == 0) add_triangles(grid, cell, axis, 0, mesh);
          if (cell[axis] == spec.cells[axis] - 1) add_triangles(grid, cell, axis, 1, mesh);
        }
      }
  mesh.tet_region.assign(mesh.tets.size(), 0);
  return mesh;
}

}  // namespace nanson
