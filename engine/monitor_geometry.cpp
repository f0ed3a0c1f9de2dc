// Tets turned inside out and the parting of J from det F: the scheme survives both, the reader should know (method, section 11).
#include <fmt/format.h>

#include <algorithm>

#include "engine/monitor.hpp"

namespace nanson {
namespace {

constexpr double parted = 2;  // [-] det F/J, or its inverse, from which on a run warns

const double* U_row(const Simulation& s, int node) {
  return &s.state.U[0][static_cast<std::size_t>(row::U * s.domain.order.row_of[static_cast<std::size_t>(node)])];
}

double deformed_over_undeformed(const Simulation& s, const std::array<int, 4>& tet) {
  Vec3 X[4], x[4];
  for (std::size_t v = 0; v < 4; ++v) {
    X[v] = s.domain.mesh->X[static_cast<std::size_t>(tet[v])];
    for (std::size_t i = 0; i < 3; ++i) x[v][i] = U_row(s, tet[v])[4 * (i + 1) + 3];
  }
  return tet_volume(x[0], x[1], x[2], x[3]) / tet_volume(X[0], X[1], X[2], X[3]);
}

double detF_over_J(const double* U) {
  Tensor<double> F;
  for (int m = 0; m < 9; ++m) F[m % 3][m / 3] = U[4 * (m / 3 + 1) + m % 3];
  return determinant(F, cofactor(F)) / U[3];
}

}  // namespace

Geometry geometry(const Simulation& s) {
  Geometry g;
  double least_tet = 1e300;
  const int tets = static_cast<int>(s.domain.mesh->tets.size());
#pragma omp parallel for schedule(static) num_threads(s.team.threads) reduction(min : least_tet)
  for (int t = 0; t < tets; ++t)
    least_tet = std::min(least_tet, deformed_over_undeformed(s, s.domain.mesh->tets[static_cast<std::size_t>(t)]));
  g.min_tet_ratio = least_tet;
  if (!evolves_J(s.domain.scene->physics.formulation)) return g;
  g.min_detF_over_J = 1e300;
  g.max_detF_over_J = -1e300;
  for (int n = 0; n < s.domain.order.nodes; ++n) {
    const double ratio = detF_over_J(U_row(s, n));
    g.min_detF_over_J = std::min(g.min_detF_over_J, ratio);
    g.max_detF_over_J = std::max(g.max_detF_over_J, ratio);
  }
  return g;
}

std::optional<std::string> geometry_warning(const Simulation& s) {
  const Geometry g = geometry(s);
  if (g.min_detF_over_J >= 1 / parted && g.max_detF_over_J <= parted) return std::nullopt;
  return fmt::format(
      "J and det F part: at step {}, t = {:.6e} s, det F/J ranges from {:.3g} to {:.3g}; a finer mesh, physics.parting "
      "or formulation = \"pF\" may help",
      s.state.step, s.state.t, g.min_detF_over_J, g.max_detF_over_J);
}

}  // namespace nanson
