// Size and shape of a mesh, in one pass over the tets and one over the boundary.
#include "engine/mesh/mesh_quality.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/compensated_sum.hpp"

namespace nanson {
namespace {

double distance2(const Vec3& a, const Vec3& b) {
  return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]);
}

double triangle_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  Vec3 u, v;
  for (int i = 0; i < 3; ++i) {
    u[i] = b[i] - a[i];
    v[i] = c[i] - a[i];
  }
  return std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
}

void add_tet(const Mesh& mesh, int t, MeshQuality& q, CompensatedSum& total) {
  std::array<Vec3, 4> x;
  for (int v = 0; v < 4; ++v) x[v] = mesh.X[mesh.tets[t][v]];
  for (int v = 0; v < 4; ++v)
    for (int w = 0; w < v; ++w) {
      const double length = std::sqrt(distance2(x[v], x[w]));
      q.min_edge = std::min(q.min_edge, length);
      q.max_edge = std::max(q.max_edge, length);
    }
  const double volume = tet_volume(x[0], x[1], x[2], x[3]), shape = mean_ratio(x[0], x[1], x[2], x[3]);
  total += volume;
  q.min_volume = std::min(q.min_volume, volume);
  q.max_volume = std::max(q.max_volume, volume);
  ++q.histogram[std::clamp(int(shape * 10), 0, 9)];
  if (shape < q.worst) {
    q.worst = shape;
    q.worst_tet = t;
    for (int c = 0; c < 3; ++c) q.worst_centre[c] = (x[0][c] + x[1][c] + x[2][c] + x[3][c]) / 4;
  }
}

}  // namespace

double mean_ratio(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double edges2 = distance2(a, b) + distance2(a, c) + distance2(a, d) + distance2(b, c) + distance2(b, d)
                        + distance2(c, d);
  const double root = std::cbrt(3 * std::max(0.0, tet_volume(a, b, c, d)));
  return 12 * root * root / edges2;
}

MeshQuality mesh_quality(const Mesh& mesh) {
  constexpr double huge = std::numeric_limits<double>::max();
  MeshQuality q;
  q.nodes = mesh.X.size();
  q.tets = mesh.tets.size();
  q.boundary_faces = mesh.faces.size();
  q.min_edge = q.min_volume = q.worst = huge;
  CompensatedSum volume;
  for (int t = 0; t < int(mesh.tets.size()); ++t) add_tet(mesh, t, q, volume);
  q.volume = volume;
  for (const auto& name : mesh.patch_names) q.patches.push_back({name});
  std::vector<CompensatedSum> area(q.patches.size() + 1);  // last: without a name
  for (const auto& face : mesh.faces) {
    const std::size_t patch = face.patch < 0 ? q.patches.size() : static_cast<std::size_t>(face.patch);
    ++(face.patch < 0 ? q.unnamed : q.patches[patch]).faces;
    area[patch] += triangle_area(mesh.X[face.nodes[0]], mesh.X[face.nodes[1]], mesh.X[face.nodes[2]]);
  }
  for (std::size_t p = 0; p < q.patches.size(); ++p) q.patches[p].area = area[p];
  q.unnamed.area = area.back();
  return q;
}

std::string to_text(const MeshQuality& q) {
  const auto& c = q.worst_centre;
  std::string text = fmt::format("nodes {}, tets {}, boundary faces {}\n", q.nodes, q.tets, q.boundary_faces);
  text += fmt::format("volume {:.6g} m^3, of a tet {:.3g} to {:.3g} m^3; ", q.volume, q.min_volume, q.max_volume);
  text += fmt::format("edges {:.3g} to {:.3g} m\n", q.min_edge, q.max_edge);
  text += fmt::format("worst mean ratio {:.3f} (1 is regular): tet {} at ({:.6g}, {:.6g}, {:.6g})\n", q.worst,
                      q.worst_tet, c[0], c[1], c[2]);
  text += "tets by mean ratio";
  for (int bin = 0; bin < 10; ++bin)
    if (q.histogram[bin]) text += fmt::format("  {:.1f}-{:.1f}: {}", bin / 10.0, (bin + 1) / 10.0, q.histogram[bin]);
  text += "\n";
  for (const auto& patch : q.patches)
    text += fmt::format("face {}: {} triangles, {:.6g} m^2\n", patch.name, patch.faces, patch.area);
  if (q.unnamed.faces)
    text += fmt::format("boundary triangles without a name: {} ({:.6g} m^2), traction free\n", q.unnamed.faces,
                        q.unnamed.area);
  return text;
}

}  // namespace nanson
