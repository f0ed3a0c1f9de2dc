// Involutions: what the equations keep and the scheme may lose (method, section 11).
#include <algorithm>
#include <cmath>

#include "engine/monitor.hpp"
#include "engine/parts.hpp"

namespace nanson {
namespace {

Tensor<double> tensor_of(const double* columns) {
  Tensor<double> T;
  for (int m = 0; m < 9; ++m) T[m % 3][m / 3] = columns[4 * (m / 3) + m % 3];
  return T;
}

}  // namespace

/// grad x is the Green-Gauss gradient of the nodal positions, with which dF/dt is computed too.
Aligned<double> gradient_mismatch(const Simulation& s) {
  const auto rows_of = static_cast<std::size_t>(s.domain.order.rows);
  Aligned<double> x(row::W * rows_of, 0.0), G(row::G * rows_of, 0.0);
  const double* U = s.state.U[0].data();
  for (std::size_t r = 0; r < rows_of; ++r)
    std::ranges::copy(state_of_row(U, static_cast<std::ptrdiff_t>(r)).position(), &x[row::W * r]);
  Rows rows{};
  rows.X = s.domain.X.data();
  rows.W = x.data();
  rows.G = G.data();
  const auto edges = s.domain.order.edges();
  const auto corners = s.domain.order.corners();
  const auto lists = s.domain.order.lists();
  for_parts(s, [&](int p, Scratch) {
    gradient_part<false, false, NodeWeights::none>(s.domain.order.parts[static_cast<std::size_t>(p)], edges, corners,
                                                   lists, rows, s.domain.coefficients);
  });
  Aligned<double> mismatch(9 * rows_of, 0.0);
  for (std::size_t r = 0; r < rows_of; ++r) {
    const NodeState u = state_of_row(U, static_cast<std::ptrdiff_t>(r));
    for (std::size_t m = 0; m < 9 && s.domain.order.node_of[r] >= 0; ++m)
      mismatch[9 * r + m] = u.F(static_cast<int>(m % 3), static_cast<int>(m / 3)) - G[row::G * r + 4 * (m / 3) + m % 3];
  }
  return mismatch;
}

Involutions involutions(const Simulation& s) {
  Involutions out;
  const Aligned<double> mismatch = gradient_mismatch(s);
  for (std::size_t i = 0; i < mismatch.size(); ++i)
    out.F = std::max(out.F, std::abs(mismatch[i] - s.state.initial_mismatch[i]));
  if (!evolves_J(s.domain.scene->physics.formulation)) return out;
  for (std::size_t r = 0; r < s.domain.order.node_of.size(); ++r) {
    if (s.domain.order.node_of[r] < 0) continue;
    const NodeState u = state_of_row(s.state.U[0].data(), static_cast<std::ptrdiff_t>(r));
    const Tensor<double> F = u.gradient(), cof = cofactor(F);
    out.J = std::max(out.J, std::abs(u.J() - determinant(F, cof)));
    if (s.state.H[0].empty()) continue;
    const Tensor<double> H = tensor_of(&s.state.H[0][row::H * r]);
    for (int m = 0; m < 9; ++m) out.H = std::max(out.H, std::abs(H[m / 3][m % 3] - cof[m / 3][m % 3]));
  }
  return out;
}

}  // namespace nanson
