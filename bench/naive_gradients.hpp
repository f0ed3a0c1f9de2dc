// Gradients of the plain loop.
#pragma once
#include <algorithm>

#include "bench/naive_loop.hpp"

namespace nanson {

/// Green-Gauss gradient of `count` numbers a node, value(node)[k] and gradient(node)[k][I], with the (6,1,1)/8 rule at the boundary (eq. 29, 43a).
template <int count, class Value>
void add_gradients(const NaiveLoop& n, Value value, std::vector<Table<count, 3>>& gradient) {
  std::fill(gradient.begin(), gradient.end(), Table<count, 3>{});
  for (const NaiveEdge& e : n.edges) {
    const double *U_a = value(e.a), *U_b = value(e.b);
    auto &G_a = gradient[e.a], &G_b = gradient[e.b];
    for (int k = 0; k < count; ++k)
      for (int I = 0; I < 3; ++I) {
        const double average = 0.5 * (U_a[k] + U_b[k]) * e.C[I];
        G_a[k][I] += average;
        G_b[k][I] -= average;
      }
  }
  for (const NaiveCorner& c : n.corners) {
    const double *U_a = value(c.a), *U_b = value(c.b), *U_c = value(c.c);
    for (int k = 0; k < count; ++k)
      for (int I = 0; I < 3; ++I) gradient[c.a][k][I] += (6 * U_a[k] + U_b[k] + U_c[k]) / 8 * c.C[I];
  }
  for (std::size_t a = 0; a < gradient.size(); ++a) {
    const double inverse = 1 / n.volume[a];
    for (auto& row : gradient[a])
      for (double& g : row) g *= inverse;
  }
}

}  // namespace nanson
