// The linear solve of a projection, K delta = R: conjugate gradients or the paper's pseudo-time iteration (method, section 10).
#pragma once
#include "engine/parts.hpp"

namespace nanson {

struct PressureSolve {
  int iterations = 0;
  double norm = 0;              // sqrt(sum R^2/Omega) of the linear residual that is left
};

/// Rows of the projection of a stage that starts from `from` and ends in `to` (0 or 1).
ProjectionRows projection_rows(Simulation& s, int from, int to);

/// Adds delta to the pressure and its force to the velocity until the norm is at most `goal` or `most` iterations are spent; `norm` is that of R.
PressureSolve solve_pressure(Simulation& s, const ProjectionRows& rows, double norm, double goal, int most);

/// Sums of term(part) over the parts without padding, in an order that no thread count changes.
template <class Term>
Three sum_three(Simulation& s, Term term) {
  const std::size_t count = s.projection.parts.size();
  std::vector<double>& sums = s.projection.part_sums;
  for_parts(s, [&](int p, Scratch) {
    const Three t = term(s.projection.parts[static_cast<std::size_t>(p)]);
    for (std::size_t k = 0; k < 3; ++k) sums[k * count + static_cast<std::size_t>(p)] = t.s[k];
  });
  Three sum;
  for (std::size_t k = 0; k < 3; ++k) sum.s[k] = tree_sum({&sums[k * count], count});
  return sum;
}

}  // namespace nanson
