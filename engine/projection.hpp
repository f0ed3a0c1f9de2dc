// What the incompressible scheme adds to domain and state: which nodes it projects and what holds them; edge rows, cofactors, volume taken by the stabilisation, vectors of the
// iteration, and its counts.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "engine/aligned.hpp"
#include "engine/boundary.hpp"
#include "engine/mixture.hpp"
#include "kernels/projection.hpp"

namespace nanson {

/// Never changes after set-up; empty unless the formulation is pFp.
struct ProjectionSetup {
  std::vector<Part> parts;         // those of the order without their padding
  std::vector<std::int32_t> held;  // row -> its constraint, -1 without
  double total_volume = 0;         // [m^3]
  bool closed =
      false;  // every boundary node is held along its normal and 1/kappa = 0: the pressure's constant is free, its mean is kept at 0
  ProjectionCoefficients coefficients;  // without dt
  Aligned<double> inverse_kappa;        // [1/Pa] a row: sum_r Omega_a,r/(Omega_a kappa_r); several materials only
};
ProjectionSetup make_projection_setup(const Scene& scene, const Order& order, const Boundary& boundary,
                                      const Aligned<double>& X, const MaterialConstants& material,
                                      const Mixture& mixture);

struct Projection {
  Aligned<double> E, B;  // per edge, per corner
  Aligned<double> H, V;  // nodal rows
  Aligned<double> volume[2],
      taken[2];  // Q [-] and its rate [m^3/s]: at the start of the step (and after it), of a stage
  Aligned<double> fixed, lag, inverse_diagonal, weight_sum, R, d, Kd;
  Aligned<double> removed;                      // [N] 3 a constraint
  long iterations = 0, rounds = 0, stages = 0;  // of the run: iterations, solves with a residual of their own, stages
  double residual = 0;                          // of the last stage, relative to the tolerance's scale
  long step_iterations = 0;                     // of the last step
  std::function<bool()> asked_to_stop;          // looked at by solves that go on for long; empty: never
};

}  // namespace nanson
