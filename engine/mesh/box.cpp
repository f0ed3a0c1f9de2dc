// The built-in box: cells of a regular grid, six tets each (Kuhn's split along a main diagonal of the cell).
#include <algorithm>
#include <random>

#include "engine/mesh/cell_split.hpp"

namespace nanson {
namespace {

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
    return split == Split::alternating ? parity_mirror(cell[0], cell[1], cell[2]) : 0;
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

Cell corners_of(const Grid& grid, const std::array<int, 3>& cell) {
  Cell corners;
  for (int bits = 0; bits < 8; ++bits) corners[static_cast<std::size_t>(bits)] = grid.corner(cell, bits);
  return corners;
}

/// The layer that the middle of a cell lies in.
int layer_of(const MeshSpec& spec, const std::array<int, 3>& cell) {
  const std::size_t k = static_cast<std::size_t>(spec.regions.axis);
  const double middle = spec.origin[k] + spec.size[k] * (cell[k] + 0.5) / spec.cells[k];
  const auto& at = spec.regions.at;
  return static_cast<int>(std::lower_bound(at.begin(), at.end(), middle) - at.begin());
}

}  // namespace

RawMesh make_box(const MeshSpec& spec) {
  const Grid grid{spec.cells, spec.split};
  RawMesh mesh;
  mesh.X = grid_nodes(spec);
  mesh.region_names = spec.regions.names;
  mesh.patch_names = {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};
  mesh.tets.reserve(std::size_t(6) * spec.cells[0] * spec.cells[1] * spec.cells[2]);
  for (int k = 0; k < spec.cells[2]; ++k)
    for (int j = 0; j < spec.cells[1]; ++j)
      for (int i = 0; i < spec.cells[0]; ++i) {
        const std::array<int, 3> cell{i, j, k};
        const Cell corners = corners_of(grid, cell);
        const int mirror = grid.mirror(cell);
        add_tets(corners, mirror, mesh);
        mesh.tet_region.resize(mesh.tets.size(), layer_of(spec, cell));
        for (int axis = 0; axis < 3; ++axis) {
          if (cell[axis] == 0) add_triangles(corners, mirror, axis, 0, 2 * axis, mesh);
          if (cell[axis] == spec.cells[axis] - 1) add_triangles(corners, mirror, axis, 1, 2 * axis + 1, mesh);
        }
      }
  return mesh;
}

}  // namespace nanson
