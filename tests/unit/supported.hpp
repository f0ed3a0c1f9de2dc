// A mesh with supports, and what they hold, for tests of the boundary.
#pragma once
#include "engine/boundary.hpp"
#include "tests/unit/meshes.hpp"

namespace nanson::test {

struct Condition {
  std::vector<std::string> faces;
  BoundaryKind kind;
  Vec3 velocity{};
  std::array<bool, 3> held{true, true, true};
};

inline Scene scene_of(const std::vector<Condition>& conditions) {
  Scene scene;
  for (const Condition& c : conditions) {
    BoundarySpec spec;
    for (const std::string& face : c.faces) spec.faces.push_back({face, ""});
    spec.kind = c.kind;
    spec.velocity = c.velocity;
    spec.held = c.held;
    scene.boundary.push_back(spec);
  }
  return scene;
}

struct Supported {
  Mesh mesh;
  Order order;
  Boundary boundary;

  Supported(RawMesh raw, const std::vector<Condition>& conditions)
      : Supported(finished(std::move(raw)), scene_of(conditions)) {}
  Supported(Mesh m, const Scene& scene) : mesh(std::move(m)) {
    order = make_order(make_dual(mesh), static_cast<int>(mesh.X.size()));
    boundary = make_boundary(scene, mesh, order);
  }
  /// What a mesh node is held in; count 0 where nothing is.
  Constraint at(int node) const {
    for (const Constraint& h : boundary.constraints)
      if (h.node == order.row_of[node]) return h;
    return {};
  }
};

inline Vec3 direction(const Constraint& h, int m) { return {h.d[m][0], h.d[m][1], h.d[m][2]}; }

/// Part of n that the held directions leave free.
inline double free_part(const Constraint& h, Vec3 n) {
  const Vec3 whole = n;
  for (int m = 0; m < h.count; ++m) {
    const double along = dot(whole, direction(h, m));
    for (int k = 0; k < 3; ++k) n[k] -= along * h.d[m][k];
  }
  return norm(n);
}

/// Velocity that the directions prescribe when condition c has the time factor factor[c].
inline Vec3 prescribed(const Constraint& h, const std::vector<double>& factor) {
  Vec3 v{};
  for (int m = 0; m < h.count; ++m)
    for (int s = 0; s < 3; ++s)
      for (int k = 0; k < 3; ++k)
        if (h.weight[m][s] != 0) v[k] += h.d[m][k] * h.weight[m][s] * factor[static_cast<std::size_t>(h.source[m][s])];
  return v;
}

inline void expect_orthonormal(const Constraint& h) {
  for (int m = 0; m < h.count; ++m)
    for (int n = 0; n <= m; ++n) EXPECT_NEAR(dot(direction(h, m), direction(h, n)), m == n, 1e-11);
}

}  // namespace nanson::test
