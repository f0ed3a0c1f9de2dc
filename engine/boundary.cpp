// Collects, per node and patch, one unit normal for each smooth group of faces, and joins the held directions of all patches into an orthonormal set.
#include "engine/boundary.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace nanson {
namespace {

constexpr double feature_angle = std::numbers::pi
                                 / 6;    // [rad] faces of one patch that meet at a larger angle form a crease
constexpr double same_direction = 1e-3;  // [rad] closer directions are one

/// Area-averaged unit normals of a node's corners on one patch, one for each smooth group (a wedge of 1 degree keeps its two).
std::vector<Vec3> group_normals(const std::vector<Vec3>& areas) {
  std::vector<int> group(areas.size());
  for (std::size_t i = 0; i < areas.size(); ++i) {
    group[i] = static_cast<int>(i);
    for (std::size_t j = 0; j < i; ++j)
      if (dot(unit(areas[i]), unit(areas[j])) > std::cos(feature_angle) && group[j] != group[i]) {
        const int from = std::max(group[i], group[j]), to = std::min(group[i], group[j]);
        std::replace(group.begin(), group.begin() + static_cast<std::ptrdiff_t>(i) + 1, from, to);
      }
  }
  std::map<int, Vec3> sum;
  for (std::size_t i = 0; i < areas.size(); ++i)
    for (int k = 0; k < 3; ++k) sum[group[i]][k] += areas[i][k];
  std::vector<Vec3> normals;
  for (const auto& g : sum) normals.push_back(unit(g.second));
  return normals;
}

struct Held {
  Vec3 d;
  double speed;  // [m/s] prescribed along d at factor 1
};

std::vector<Held> held_directions(const BoundarySpec& c, const std::vector<Vec3>& normals) {
  std::vector<Held> held;
  const Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  switch (c.kind) {
    case BoundaryKind::fixed:
      for (const Vec3& e : axes) held.push_back({e, 0});
      break;
    case BoundaryKind::velocity:
      for (int k = 0; k < 3; ++k)
        if (c.held[k]) held.push_back({axes[k], c.velocity[k]});
      break;
    case BoundaryKind::symmetric:
      for (const Vec3& n : normals) held.push_back({n, 0});
      break;
    case BoundaryKind::skew_symmetric:
      for (const Vec3& n : normals) {
        const int k = std::abs(n[0]) < 0.6 ? 0 : 1;
        const Vec3 s = unit(cross(n, axes[k]));
        held.push_back({s, 0});
        held.push_back({cross(n, s), 0});
      }
      break;
    default: break;
  }
  return held;
}

/// Adds a direction to an orthonormal set unless it lies within `same_direction` of its span; its prescribed speed becomes that of the new member.
void join(Constraint& h, const Held& held, int condition, int face) {
  Vec3 r = held.d;
  double weight[3] = {held.speed, 0, 0};
  int source[3] = {condition, -1, -1};
  const auto add = [&](int from, double w) {
    for (int s = 0; s < 3; ++s)
      if (source[s] == from || source[s] == -1) {
        source[s] = from;
        weight[s] += w;
        return;
      }
  };
  for (int m = 0; m < h.count; ++m) {
    const double along = dot(held.d, {h.d[m][0], h.d[m][1], h.d[m][2]});
    for (int k = 0; k < 3; ++k) r[k] -= along * h.d[m][k];
    for (int s = 0; s < 3; ++s)
      if (h.weight[m][s] != 0) add(h.source[m][s], -along * h.weight[m][s]);
  }
  const double size = std::sqrt(dot(r, r));
  if (h.count == 3 || size < same_direction) return;
  for (int k = 0; k < 3; ++k) h.d[h.count][k] = r[k] / size;
  h.face[h.count] = face;
  for (int s = 0; s < 3; ++s) {
    h.source[h.count][s] = std::max(0, source[s]);
    h.weight[h.count][s] = source[s] < 0 ? 0 : weight[s] / size;
  }
  ++h.count;
}

bool holds(BoundaryKind k) {
  return k == BoundaryKind::fixed || k == BoundaryKind::symmetric || k == BoundaryKind::skew_symmetric
         || k == BoundaryKind::velocity;
}

void add_supports(const Mesh& mesh, const Order& o, const BoundarySpec& c, int condition, int patch, int face,
                  std::map<int, Constraint>& by_row) {
  std::map<int, std::vector<Vec3>> areas;  // row -> its corners' area vectors on the patch
  for (int n = 0; n < o.rows; ++n)
    for (int g = o.corner[n]; g < o.corner[n + 1]; ++g)
      if (mesh.faces[o.corner_face[g]].patch == patch)
        areas[n].push_back({o.corner_C[0][g], o.corner_C[1][g], o.corner_C[2][g]});
  for (const auto& [n, list] : areas) {
    Constraint& h = by_row[n];
    h.node = n;
    for (const Held& held : held_directions(c, group_normals(list))) join(h, held, condition, face);
  }
}

void add_loads(Boundary& out, const Mesh& mesh, Order& o, const BoundarySpec& c, int condition, int patch,
               std::vector<int>& load_of_face) {
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (mesh.faces[f].patch != patch) continue;
    const auto& n = mesh.faces[f].nodes;
    Vec3 e1, e2;
    for (int k = 0; k < 3; ++k) {
      e1[k] = mesh.X[n[1]][k] - mesh.X[n[0]][k];
      e2[k] = mesh.X[n[2]][k] - mesh.X[n[0]][k];
    }
    const Vec3 A = cross(e1, e2);
    const double third = std::sqrt(dot(A, A)) / 6;
    const std::array<int, 3> rows{o.row_of[n[0]], o.row_of[n[1]], o.row_of[n[2]]};
    if (load_of_face[f] < 0) {
      load_of_face[f] = static_cast<int>(out.slot_nodes.size());
      out.slot_nodes.push_back(rows);
    }
    out.loaded.push_back({load_of_face[f], rows, c.kind, scaled(c.traction, third), c.pressure, condition});
  }
}

}  // namespace

Boundary make_boundary(const Scene& scene, const Mesh& mesh, Order& order) {
  Boundary out;
  out.conditions = scene.boundary;
  std::map<int, Constraint> by_row;
  std::vector<int> load_of_face(mesh.faces.size(), -1);
  std::vector<char> mentioned(mesh.patch_names.size(), 0);
  for (std::size_t i = 0; i < scene.boundary.size(); ++i) {
    const BoundarySpec& c = scene.boundary[i];
    for (const Named& face : c.faces) {
      const auto at = std::find(mesh.patch_names.begin(), mesh.patch_names.end(), face.name);
      const int patch = static_cast<int>(at - mesh.patch_names.begin());
      mentioned[static_cast<std::size_t>(patch)] = 1;
      if (holds(c.kind)) {
        add_supports(mesh, order, c, static_cast<int>(i), patch, static_cast<int>(out.held_faces.size()), by_row);
        out.held_faces.push_back(face.name);
      } else if (c.kind != BoundaryKind::free) {
        add_loads(out, mesh, order, c, static_cast<int>(i), patch, load_of_face);
      }
    }
  }
  for (std::size_t p = 0; p < mentioned.size(); ++p)
    if (!mentioned[p]) out.free_faces.push_back(mesh.patch_names[p]);
  for (std::size_t g = 0; g < order.corner_face.size(); ++g)
    order.corner_load[g] = load_of_face[static_cast<std::size_t>(order.corner_face[g])];
  for (const auto& entry : by_row) out.constraints.push_back(entry.second);
  std::size_t next = 0;
  for (Part& p : order.parts) {
    p.constraint_begin = static_cast<int>(next);
    while (next < out.constraints.size() && out.constraints[next].node < p.node_end) ++next;
    p.constraint_end = static_cast<int>(next);
  }
  return out;
}

}  // namespace nanson
