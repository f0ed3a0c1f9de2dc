// Builds the median dual and checks its identities. The edge list comes from a counting sort of the tets' edges by their lower node; the handful of each node is then sorted.
#include "engine/dual.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/compensated_sum.hpp"

namespace nanson {
namespace {

Vec3 area_in_tet(const Mesh& mesh, const std::array<int, 4>& t, const int (&e)[4]) {
  const Vec3 &a = mesh.X[t[e[0]]], &b = mesh.X[t[e[1]]], &c = mesh.X[t[e[2]]], &d = mesh.X[t[e[3]]];
  const Vec3 C = cross(c - d, (c - a) + (d - b));
  return {C[0] / 24, C[1] / 24, C[2] / 24};
}

/// -V c grad N_a . grad N_b: with the areas A of the faces opposite to a and b, outward, V grad N_a . grad N_b = A_a . A_b/(9 V). [N/m]
double spring_in_tet(const Mesh& mesh, const std::array<int, 4>& t, const int (&e)[4], double c) {
  const Vec3 &a = mesh.X[t[e[0]]], &b = mesh.X[t[e[1]]], &p = mesh.X[t[e[2]]], &q = mesh.X[t[e[3]]];
  const Vec3 A_a = cross(p - b, q - b), minus_A_b = cross(p - a, q - a);  // twice the areas
  return c * dot(A_a, minus_A_b) / (36 * tet_volume(mesh.X[t[0]], mesh.X[t[1]], mesh.X[t[2]], mesh.X[t[3]]));
}

/// The edges without their areas, sorted by (a, b), and the first of every node.
void find_edges(const Mesh& mesh, Dual& dual) {
  const std::size_t nodes = mesh.X.size();
  std::vector<int> begin(nodes + 1, 0);
  for (const auto& t : mesh.tets)
    for (const auto& e : tet_edges) ++begin[std::min(t[e[0]], t[e[1]]) + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<int> upper(static_cast<std::size_t>(begin.back())), next(begin.begin(), begin.end() - 1);
  for (const auto& t : mesh.tets)
    for (const auto& e : tet_edges)
      upper[static_cast<std::size_t>(next[std::min(t[e[0]], t[e[1]])]++)] = std::max(t[e[0]], t[e[1]]);
  dual.first.assign(nodes + 1, 0);
  for (std::size_t a = 0; a < nodes; ++a) {
    const auto from = upper.begin() + begin[a], to = upper.begin() + begin[a + 1];
    std::sort(from, to);
    next[a] = static_cast<int>(std::unique(from, to) - from);
    dual.first[a + 1] = dual.first[a] + next[a];
  }
  dual.edges.reserve(static_cast<std::size_t>(dual.first[nodes]));
  for (std::size_t a = 0; a < nodes; ++a)
    for (int i = 0; i < next[a]; ++i)
      dual.edges.push_back({static_cast<int>(a), upper[static_cast<std::size_t>(begin[a] + i)], {}, 0});
}

std::size_t edge_of(const Dual& dual, int a, int b) {
  const auto before = [](const DualEdge& e, int node) { return e.b < node; };
  return static_cast<std::size_t>(
      std::lower_bound(dual.edges.begin() + dual.first[a], dual.edges.begin() + dual.first[a + 1], b, before)
      - dual.edges.begin());
}

}  // namespace

Dual make_dual(const Mesh& mesh, std::span<const double> modulus) {
  Dual dual;
  find_edges(mesh, dual);
  dual.has_springs = !modulus.empty();
  for (const auto& t : mesh.tets) {
    double c = 0;
    for (const int n : t) c += dual.has_springs ? 0.25 * modulus[n] : 0;
    for (const auto& e : tet_edges) {
      const int a = t[e[0]], b = t[e[1]];
      const Vec3 C = area_in_tet(mesh, t, e);
      DualEdge& edge = dual.edges[edge_of(dual, std::min(a, b), std::max(a, b))];
      edge.C = a < b ? edge.C + C : edge.C - C;
      if (dual.has_springs) edge.stiffness += spring_in_tet(mesh, t, e, c);
    }
  }
  dual.volume.assign(mesh.X.size(), 0.0);
  for (const auto& t : mesh.tets) {
    const double quarter = 0.25 * tet_volume(mesh.X[t[0]], mesh.X[t[1]], mesh.X[t[2]], mesh.X[t[3]]);
    for (int n : t) dual.volume[n] += quarter;
  }
  for (int f = 0; f < static_cast<int>(mesh.faces.size()); ++f) {
    const auto& n = mesh.faces[f].nodes;
    const Vec3 A = cross(mesh.X[n[1]] - mesh.X[n[0]], mesh.X[n[2]] - mesh.X[n[0]]);
    for (int k = 0; k < 3; ++k)
      dual.corners.push_back({n[k], n[(k + 1) % 3], n[(k + 2) % 3], f, {A[0] / 6, A[1] / 6, A[2] / 6}});
  }
  std::stable_sort(dual.corners.begin(), dual.corners.end(),
                   [](const DualCorner& p, const DualCorner& q) { return p.a < q.a; });
  return dual;
}

DualDefects check_dual(const Mesh& mesh, const Dual& dual) {
  DualDefects worst;
  std::vector<Vec3> sum(mesh.X.size(), Vec3{});
  std::vector<double> size(mesh.X.size(), 0.0);
  for (const auto& e : dual.edges) {
    sum[e.a] = sum[e.a] + e.C;
    sum[e.b] = sum[e.b] - e.C;
    size[e.a] += norm(e.C);
    size[e.b] += norm(e.C);
  }
  for (const auto& c : dual.corners) {
    sum[c.a] = sum[c.a] + c.C;
    size[c.a] += norm(c.C);
  }
  for (std::size_t n = 0; n < sum.size(); ++n) worst.closure = std::max(worst.closure, norm(sum[n]) / size[n]);

  CompensatedSum tets, cells;
  std::vector<double> around(dual.edges.size(), 0.0);
  for (const auto& t : mesh.tets) {
    const double V = tet_volume(mesh.X[t[0]], mesh.X[t[1]], mesh.X[t[2]], mesh.X[t[3]]);
    tets += V;
    for (const auto& e : tet_edges) around[edge_of(dual, std::min(t[e[0]], t[e[1]]), std::max(t[e[0]], t[e[1]]))] += V;
  }
  for (double V : dual.volume) cells += V;
  worst.volume = std::abs(cells - tets) / tets;
  for (std::size_t e = 0; e < dual.edges.size(); ++e) {
    const Vec3 D = mesh.X[dual.edges[e].b] - mesh.X[dual.edges[e].a];
    worst.edge = std::max(worst.edge,
                          std::abs(dot(dual.edges[e].C, D) - 0.5 * around[e]) / (norm(dual.edges[e].C) * norm(D)));
  }
  return worst;
}

}  // namespace nanson
