// Current areas of the plain loop and what is made with them (paper, eq. 48, 49).
#include <Eigen/Dense>
#include <algorithm>

#include "bench/naive_gradients.hpp"

namespace nanson {
namespace {

/// Adds C to the current edge between a and b, turned when that runs from b to a.
void add_area(NaiveLoop& n, int a, int b, const Eigen::Vector3d& C) {
  const auto at = std::lower_bound(
      n.current_edges.begin(), n.current_edges.end(), std::pair(std::min(a, b), std::max(a, b)),
      [](const NaiveEdge& e, const std::pair<int, int>& k) { return std::pair(e.a, e.b) < k; });
  for (int i = 0; i < 3; ++i) at->C[i] += a < b ? C[i] : -C[i];
}

/// Median dual of the current positions: in every tet, per edge, the two triangles (edge midpoint, face centroid, tet centroid), turned from a to b.
void dual_of_x(NaiveLoop& n, const std::vector<NaiveNode>& U) {
  for (NaiveEdge& e : n.current_edges) e.C[0] = e.C[1] = e.C[2] = 0;
  for (const auto& t : n.tets) {
    Eigen::Vector3d x[4];
    for (int v = 0; v < 4; ++v) x[v] = Eigen::Vector3d(U[t[v]].x);
    const Eigen::Vector3d middle = (x[0] + x[1] + x[2] + x[3]) / 4;
    for (const auto& e : tet_edges) {
      const Eigen::Vector3d m = (x[e[0]] + x[e[1]]) / 2, f = (x[e[0]] + x[e[1]] + x[e[2]]) / 3,
                            g = (x[e[0]] + x[e[1]] + x[e[3]]) / 3;
      add_area(n, t[e[0]], t[e[1]], 0.5 * (f - m).cross(middle - m) + 0.5 * (middle - m).cross(g - m));
    }
  }
  for (std::size_t k = 0; k < n.corners.size(); ++k) {
    const NaiveCorner& c = n.corners[k];
    const Eigen::Vector3d a(U[c.a].x), A = (Eigen::Vector3d(U[c.b].x) - a).cross(Eigen::Vector3d(U[c.c].x) - a) / 6;
    n.current_corners[k] = {A[0], A[1], A[2]};
  }
}

/// H_x = cof(grad x), edges its mean times C (paper, eq. 49).
void areas_by_map(NaiveLoop& n, const std::vector<NaiveNode>& U) {
  add_gradients<3>(
      n, [&](int a) { return U[a].x; }, n.grad_x);
  for (std::size_t a = 0; a < n.H_x.size(); ++a)
    for (int i = 0; i < 3; ++i)
      for (int I = 0; I < 3; ++I) {
        const int j = (i + 1) % 3, k = (i + 2) % 3, J = (I + 1) % 3, K = (I + 2) % 3;
        n.H_x[a][i][I] = n.grad_x[a][j][J] * n.grad_x[a][k][K] - n.grad_x[a][j][K] * n.grad_x[a][k][J];
      }
  for (std::size_t k = 0; k < n.edges.size(); ++k)
    for (int i = 0; i < 3; ++i) {
      const NaiveEdge& e = n.edges[k];
      n.current_edges[k].C[i] = 0.5 * (dot(n.H_x[e.a][i].data(), e.C) + dot(n.H_x[e.b][i].data(), e.C));
    }
}

/// Area vector of a face's third at its node m, of which the corner is c: the face's own, or that of the node's map.
Vec3 corner_area(const NaiveLoop& n, std::size_t corner, int m) {
  if (n.H_x.empty()) return n.current_corners[corner];
  Vec3 out;
  for (int i = 0; i < 3; ++i) out[i] = dot(n.H_x[m][i].data(), n.corners[corner].C);
  return out;
}

}  // namespace

/// Current areas and what moves J: (48d) as the paper writes it; with relative velocities where the areas do not close (method, section 8).
void current_geometry_pass(NaiveLoop& n, const std::vector<NaiveNode>& U) {
  const bool mapped = n.scene->physics.description == Description::pseudo_updated;
  if (mapped) areas_by_map(n, U);
  else dual_of_x(n, U);
  std::fill(n.dJ.begin(), n.dJ.end(), 0.0);
  for (const NaiveEdge& e : n.current_edges)
    for (int i = 0; i < 3; ++i) {
      const double v_a = n.W[e.a][i], v_b = n.W[e.b][i];
      n.dJ[e.a] += (mapped ? v_b - v_a : v_a + v_b) / 2 * e.C[i];
      n.dJ[e.b] -= (mapped ? v_a - v_b : v_a + v_b) / 2 * e.C[i];
    }
  for (std::size_t k = 0; k < n.corners.size(); ++k) {
    const NaiveCorner& c = n.corners[k];
    const Vec3 area = corner_area(n, k, c.a);
    for (int i = 0; i < 3; ++i)
      n.dJ[c.a] += ((6 * n.W[c.a][i] + n.W[c.b][i] + n.W[c.c][i]) / 8 - (mapped ? n.W[c.a][i] : 0.0)) * area[i];
  }
}

/// Adjoint boundary flux t_a - (6 t_a + t_b + t_c)/8, t = sigma c_gamma at each of the face's nodes.
void current_boundary_flux(NaiveLoop& n) {
  for (std::size_t k = 0; k < n.corners.size(); ++k) {
    const NaiveCorner& c = n.corners[k];
    const int node[3] = {c.a, c.b, c.c};
    const double weight[3] = {1 - 6.0 / 8, -1.0 / 8, -1.0 / 8};
    for (int m = 0; m < 3; ++m) {
      const Vec3 area = corner_area(n, k, node[m]);
      for (int i = 0; i < 3; ++i) n.force[c.a][i] += weight[m] * dot(n.stress[node[m]].H[i], area.data());
    }
  }
}

}  // namespace nanson
