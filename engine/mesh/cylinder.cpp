// The built-in quarter cylinder: a square core in a ring, swept along Z, in the alternating split of the box.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/mesh/cell_split.hpp"

namespace nanson {
namespace {

constexpr double bulge =
    0.1;  // the core's corner is drawn in by this share: angles of 116 to 122 degrees meet there instead of 90 and 135
constexpr double largest_core = 0.6;  // of the radius, so that a thin ring stays outside the core's corner

/// Cross-section. Core nodes (i, j) with i, j <= m stand at polar angles that the ring's lines continue: its node (layer, t), t the place along the arc, layer 0 on the
/// core's edge, which runs up at i = m and back at j = m. Their parities, i and j against m + layer and t, agree there, so that the split conforms.
struct Section {
  int m, layers;
  double radius;

  int core_nodes() const { return (m + 1) * (m + 1); }
  int nodes() const { return core_nodes() + layers * (2 * m + 1); }
  int core(int i, int j) const { return j * (m + 1) + i; }
  int ring(int layer, int t) const {
    if (layer == 0) return t <= m ? core(m, t) : core(2 * m - t, m);
    return core_nodes() + (layer - 1) * (2 * m + 1) + t;
  }

  double core_size() const { return radius * std::min(largest_core, static_cast<double>(m) / (m + layers)); }
  double slope(int i) const { return i == m ? 1.0 : std::tan(std::numbers::pi / 4 * i / m); }

  std::array<double, 2> core_place(int i, int j) const {
    const double u = slope(i), v = slope(j), s = core_size() * (1 - bulge * (u * v) * (u * v));
    return {s * u, s * v};
  }
  /// By symmetry about the diagonal, so that X = 0 is met exactly.
  std::array<double, 2> ring_place(int layer, int t) const {
    if (t > m) {
      const auto p = ring_place(layer, 2 * m - t);
      return {p[1], p[0]};
    }
    const auto p = core_place(m, t);
    const double inner = std::hypot(p[0], p[1]), share = static_cast<double>(layer) / layers,
                 r = inner + share * (radius - inner);
    return {p[0] * (r / inner), p[1] * (r / inner)};
  }
};

std::vector<std::array<double, 2>> places(const Section& s) {
  std::vector<std::array<double, 2>> at(static_cast<std::size_t>(s.nodes()));
  for (int j = 0; j <= s.m; ++j)
    for (int i = 0; i <= s.m; ++i) at[static_cast<std::size_t>(s.core(i, j))] = s.core_place(i, j);
  for (int layer = 1; layer <= s.layers; ++layer)
    for (int t = 0; t <= 2 * s.m; ++t) at[static_cast<std::size_t>(s.ring(layer, t))] = s.ring_place(layer, t);
  return at;
}

enum Patch { x0, y0, zmin, zmax, side };

/// The cell over four nodes of the section, corner bits (first, second direction), between the levels k and k + 1.
Cell cell_over(const std::array<int, 4>& base, int k, int nodes) {
  Cell cell;
  for (std::size_t bits = 0; bits < 8; ++bits) cell[bits] = base[bits & 3] + (k + static_cast<int>(bits >> 2)) * nodes;
  return cell;
}

void add_ends(const Cell& cell, int mirror, int k, int levels, RawMesh& mesh) {
  if (k == 0) add_triangles(cell, mirror, 2, 0, zmin, mesh);
  if (k == levels - 1) add_triangles(cell, mirror, 2, 1, zmax, mesh);
}

void add_core(const Section& s, int k, int levels, RawMesh& mesh) {
  for (int j = 0; j < s.m; ++j)
    for (int i = 0; i < s.m; ++i) {
      const Cell cell = cell_over({s.core(i, j), s.core(i + 1, j), s.core(i, j + 1), s.core(i + 1, j + 1)}, k,
                                  s.nodes());
      const int mirror = parity_mirror(i, j, k);
      add_tets(cell, mirror, mesh);
      if (i == 0) add_triangles(cell, mirror, 0, 0, x0, mesh);
      if (j == 0) add_triangles(cell, mirror, 1, 0, y0, mesh);
      add_ends(cell, mirror, k, levels, mesh);
    }
}

void add_ring(const Section& s, int k, int levels, RawMesh& mesh) {
  for (int t = 0; t < 2 * s.m; ++t)
    for (int layer = 0; layer < s.layers; ++layer) {
      const Cell cell = cell_over(
          {s.ring(layer, t), s.ring(layer + 1, t), s.ring(layer, t + 1), s.ring(layer + 1, t + 1)}, k, s.nodes());
      const int mirror = parity_mirror(s.m + layer, t, k);
      add_tets(cell, mirror, mesh);
      if (t == 0) add_triangles(cell, mirror, 1, 0, y0, mesh);
      if (t == 2 * s.m - 1) add_triangles(cell, mirror, 1, 1, x0, mesh);
      if (layer == s.layers - 1) add_triangles(cell, mirror, 0, 1, side, mesh);
      add_ends(cell, mirror, k, levels, mesh);
    }
}

}  // namespace

RawMesh make_cylinder(const MeshSpec& spec) {
  const int m = spec.cells[1] / 2, levels = spec.cells[2];
  const Section section{m, spec.cells[0] - m, spec.radius};
  RawMesh mesh;
  mesh.region_names = {"cylinder"};
  mesh.patch_names = {"x0", "y0", "zmin", "zmax", "side"};
  const auto at = places(section);
  mesh.X.reserve(at.size() * static_cast<std::size_t>(levels + 1));
  for (int k = 0; k <= levels; ++k)
    for (const auto& p : at) mesh.X.push_back({p[0], p[1], spec.length * k / levels});
  for (int k = 0; k < levels; ++k) {
    add_core(section, k, levels, mesh);
    add_ring(section, k, levels, mesh);
  }
  mesh.tet_region.assign(mesh.tets.size(), 0);
  return mesh;
}

}  // namespace nanson
