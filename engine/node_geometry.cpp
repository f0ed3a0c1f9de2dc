// Places, step lengths and weights of the pseudo-Laplacian, from the dual.
#include "engine/node_geometry.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace nanson {
namespace {

double distance(const Vec3& p, const Vec3& q) { return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]); }

}  // namespace

Aligned<double> place_nodes(const Mesh& mesh, const Dual& dual, const Order& order) {
  Aligned<double> X(row::X * static_cast<std::size_t>(order.rows), 0.0);
  for (std::size_t r = 0; r < order.node_of.size(); ++r) {
    const int n = order.node_of[r];
    for (int k = 0; k < 3 && n >= 0; ++k) X[row::X * r + k] = mesh.X[n][k];
    constexpr double inverse_of_nothing = 1e150;  // [1/m^3] padding counts for nothing in sums over the volume
    X[row::X * r + 3] = n < 0 ? inverse_of_nothing : 1.0 / dual.volume[n];
  }
  return X;
}

Aligned<double> step_lengths(StepRule rule, const Mesh& mesh, const Dual& dual, const Order& order) {
  std::vector<double> length(mesh.X.size(), 1e300), areas(mesh.X.size(), 0.0);
  for (const auto& e : dual.edges) {
    const double h = distance(mesh.X[e.a], mesh.X[e.b]), A = std::hypot(e.C[0], e.C[1], e.C[2]);
    length[e.a] = std::min(length[e.a], h);
    length[e.b] = std::min(length[e.b], h);
    areas[e.a] += A;
    areas[e.b] += A;
  }
  if (rule == StepRule::dual)
    for (std::size_t n = 0; n < length.size(); ++n) length[n] = 6 * dual.volume[n] / areas[n];
  if (rule == StepRule::paper) std::fill(length.begin(), length.end(), *std::min_element(length.begin(), length.end()));
  Aligned<double> of_rows(static_cast<std::size_t>(order.rows), 1e300);
  for (std::size_t n = 0; n < length.size(); ++n) of_rows[static_cast<std::size_t>(order.row_of[n])] = length[n];
  return of_rows;
}

Aligned<double> laplacian_weights(const Mesh& mesh, const Dual& dual, const Order& order) {
  std::vector<Eigen::Vector3d> R(mesh.X.size(), Eigen::Vector3d::Zero());
  std::vector<Eigen::Matrix3d> M(mesh.X.size(), Eigen::Matrix3d::Zero());
  for (const auto& e : dual.edges) {
    const Eigen::Vector3d D = Eigen::Map<const Eigen::Vector3d>(mesh.X[e.b].data())
                              - Eigen::Map<const Eigen::Vector3d>(mesh.X[e.a].data());
    R[e.a] += D;
    R[e.b] -= D;
    M[e.a] += D * D.transpose();
    M[e.b] += D * D.transpose();
  }
  Aligned<double> lambda(row::lambda * static_cast<std::size_t>(order.rows), 0.0);
  for (std::size_t n = 0; n < mesh.X.size(); ++n) {
    const Eigen::Vector3d l = -M[n].ldlt().solve(R[n]);
    for (int k = 0; k < 3; ++k) lambda[static_cast<std::size_t>(row::lambda * order.row_of[n] + k)] = l[k];
  }
  return lambda;
}

}  // namespace nanson
