// The built-in needle: a square bundle of rays between two spheres, cells along the radius, in the alternating split of the box.
#include <cmath>
#include <numbers>

#include "engine/mesh/cell_split.hpp"

namespace nanson {
namespace {

enum Patch { inner, outer, sides };

/// Cells across Y, across Z and along the radius, and nodes in that order. The angle to X seen along Y or Z is the same all over a side, which is therefore plane.
struct Needle {
  std::array<int, 3> cells;
  double inner, outer;  // [m]
  double angle;         // [rad]

  int node(int i, int j, int k) const { return (k * (cells[1] + 1) + j) * (cells[0] + 1) + i; }
  double slope(int direction, int i) const {
    return std::tan(0.5 * angle * (2 * i - cells[static_cast<std::size_t>(direction)])
                    / cells[static_cast<std::size_t>(direction)]);
  }
  Vec3 place(int i, int j, int k) const {
    const double y = slope(0, i), z = slope(1, j), r = inner + (outer - inner) * k / cells[2],
                 scale = r / std::sqrt(1 + y * y + z * z);
    return {scale, scale * y, scale * z};
  }
};

void add_cell(const Needle& needle, int i, int j, int k, RawMesh& mesh) {
  Cell cell;
  for (int bits = 0; bits < 8; ++bits)
    cell[static_cast<std::size_t>(bits)] = needle.node(i + (bits & 1), j + (bits >> 1 & 1), k + (bits >> 2 & 1));
  const std::array<int, 3> at{i, j, k};
  const int mirror = parity_mirror(i, j, k);
  add_tets(cell, mirror, mesh);
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    if (at[a] == 0) add_triangles(cell, mirror, axis, 0, axis == 2 ? inner : sides, mesh);
    if (at[a] == needle.cells[a] - 1) add_triangles(cell, mirror, axis, 1, axis == 2 ? outer : sides, mesh);
  }
}

}  // namespace

RawMesh make_needle(const MeshSpec& spec) {
  const Needle needle{spec.cells, spec.inner, spec.outer, spec.angle * std::numbers::pi / 180};
  RawMesh mesh;
  mesh.region_names = {"needle"};
  mesh.patch_names = {"inner", "outer", "sides"};
  for (int k = 0; k <= spec.cells[2]; ++k)
    for (int j = 0; j <= spec.cells[1]; ++j)
      for (int i = 0; i <= spec.cells[0]; ++i) mesh.X.push_back(needle.place(i, j, k));
  for (int k = 0; k < spec.cells[2]; ++k)
    for (int j = 0; j < spec.cells[1]; ++j)
      for (int i = 0; i < spec.cells[0]; ++i) add_cell(needle, i, j, k, mesh);
  mesh.tet_region.assign(mesh.tets.size(), 0);
  return mesh;
}

}  // namespace nanson
