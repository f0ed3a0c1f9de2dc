// The linear solve of a projection, K delta = R: conjugate gradients or the paper's pseudo-time iteration (method, section 10).
#pragma once
#include "engine/parts.hpp"

namespace nanson {

struct PressureSolve {
  int iterations = 0;
  double norm = 0;  // sqrt(sum R^2/Omega) of the linear residual that is left
};

/// Those of the scene, with the step.
ProjectionCoefficients projection_coefficients(const Simulation& s);

/// Rows of the projection of a stage that starts from `from` and ends in `to` (0 or 1).
ProjectionRows projection_rows(Simulation& s, int from, int to);

/// Adds delta to the pressure and its force to the velocity until the norm is at most `goal` or `most` iterations are spent; `norm` is that of R.
PressureSolve solve_pressure(Simulation& s, const ProjectionRows& rows, double norm, double goal, int most);

/// Whether a solve that has taken so many iterations is to be given up for a signal or the time: never before the 1,000th.
bool asked_to_stop(const Projection& p, long iterations);

/// Sums of term(part) over the parts without padding, in an order that no thread count changes.
template <class Term>
Three sum_three(const Simulation& s, Term term) {
  const auto sum = sums_over_parts<3>(s, [&](int p, double* out) {
    const Three t = term(s.domain.projection.parts[static_cast<std::size_t>(p)]);
    for (int k = 0; k < 3; ++k) out[k] = t.s[k];
  });
  return {{sum[0], sum[1], sum[2]}};
}

}  // namespace nanson
