// The tets' own energies in the plain loop, tet by tet (method, section 17).
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "bench/naive_loop.hpp"

namespace nanson {
namespace {

using Matrix = Eigen::Matrix<double, 3, 4>;

/// Gradients of the four shape functions, and the volume.
struct Shape {
  Matrix gradient;
  double volume;
};
template <class Place>
Shape shape_of(const std::array<int, 4>& t, Place place) {
  Eigen::Matrix3d edges;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) edges(i, k) = place(t[k + 1])[i] - place(t[0])[i];
  Shape s;
  s.volume = edges.determinant() / 6;
  s.gradient.rightCols<3>() = edges.inverse().transpose();
  s.gradient.col(0) = -s.gradient.rightCols<3>().rowwise().sum();
  return s;
}

/// Mean over the materials around a node, and over the nodes of a tet.
double mean_of(const NaiveLoop& n, const std::array<int, 4>& t, double MaterialConstants::*constant) {
  double sum = 0;
  for (const int a : t)
    for (const NaiveLaw& law : n.laws) sum += 0.25 * law.share[a] * (law.constants.*constant);
  return sum;
}

}  // namespace

/// k_ab = -sum_T V c grad N_a . grad N_b.
void find_springs(NaiveLoop& n) {
  std::map<std::pair<int, int>, double> k;
  for (const auto& t : n.tets) {
    const Shape s = shape_of(t, [&](int a) { return n.X[a].data(); });
    const double c = mean_of(n, t, &MaterialConstants::tet_stiffness);
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b)
        if (t[a] < t[b]) k[{t[a], t[b]}] -= s.volume * c * s.gradient.col(a).dot(s.gradient.col(b));
  }
  for (const NaiveEdge& e : n.edges) n.springs.push_back(k.at({std::min(e.a, e.b), std::max(e.a, e.b)}));
}

void spring_pass(NaiveLoop& n, const std::vector<NaiveNode>& U) {
  const double rest = n.dJ.empty() ? 1 : 0;  // current areas: springs without a length of their own
  for (std::size_t e = 0; e < n.edges.size(); ++e) {
    const int a = n.edges[e].a, b = n.edges[e].b;
    for (int i = 0; i < 3; ++i) {
      const double f = n.springs[e] * (U[b].x[i] - U[a].x[i] - rest * (n.X[b][i] - n.X[a][i]));
      n.force[a][i] += f;
      n.force[b][i] -= f;
    }
  }
}

/// V m phi(r), r = J_T / mean det F_a, phi = ln^2(r/0.3)/2 below 0.3, straight below a thousandth of it.
void crushing_pass(NaiveLoop& n, const std::vector<NaiveNode>& U) {
  std::fill(n.crushing.begin(), n.crushing.end(), Vec3{});
  std::vector<double> weight(n.row.size(), 0.0);
  for (const auto& t : n.tets) {
    const double volume = shape_of(t, [&](int a) { return n.X[a].data(); }).volume;
    const Shape now = shape_of(t, [&](int a) { return U[a].x; });
    double mean = 0;
    for (const int a : t) mean += 0.25 * determinant_of(U[a].F);
    const double r = now.volume / volume / mean, at = std::max(r, 3e-4);
    if (r >= 0.3) continue;
    const double slope = mean_of(n, t, &MaterialConstants::tet_barrier) * std::log(at / 0.3) / at;
    for (int a = 0; a < 4; ++a) {
      for (int i = 0; i < 3; ++i) n.crushing[t[a]][i] -= slope / mean * now.volume * now.gradient(i, a);  // V dJ_T/dx
      weight[t[a]] -= volume / 4 * slope * r / mean;
    }
  }
  for (std::size_t a = 0; a < weight.size(); ++a)
    for (int i = 0; i < 3; ++i)
      for (int I = 0; I < 3; ++I) {
        const int j = (i + 1) % 3, k = (i + 2) % 3, J = (I + 1) % 3, K = (I + 2) % 3;
        const auto& F = U[a].F;
        const double share = weight[a] / n.volume[a];
        n.stress[a].P[i][I] += share * (F[j][J] * F[k][K] - F[j][K] * F[k][J]);
        if (i == I && !n.dJ.empty())  // the Cauchy stress in place of H: (det F/J) I
          n.stress[a].H[i][I] += share
                                 * (n.scene->physics.formulation == Formulation::pF ? 1 : determinant_of(F) / U[a].J);
      }
}

}  // namespace nanson
