// Every nodal row that a scene carries: allocated by role, only what its physics needs.
#pragma once
#include <string>
#include <vector>

#include "engine/aligned.hpp"
#include "engine/boundary.hpp"
#include "engine/order.hpp"

namespace nanson {

struct State {
  Aligned<double> X;            // {X, 1/Omega}
  Aligned<double> U[2];         // state at the start of the step (and after it), state of a stage
  Aligned<double> H[2];         // pFHJ
  Aligned<double> W[2], PH[2];  // of the stage, and being written for the next
  Aligned<double> G;            // linear reconstruction
  Aligned<double> dP;           // full flux correction
  Aligned<double> q;            // pressure correction, one an edge
  Aligned<double> GP;           // tensor pressure jump
  Aligned<double> L, lambda;    // limiter (limited); pseudo-Laplacian and its weights (jst)
  Aligned<double> plastic;      // hencky_j2
  Aligned<double> step_length;  // [m] per node: dt = cfl min l/c
  Aligned<double> loads;        // [N] 4 a loaded face
  std::vector<double> reactions,
      mean_reactions;  // reaction_row a constraint: of the last stage, mean of the last step's stages
  bool has_lagged_correction =
      false;  // the flux correction of the last stage is there for the next step's first: dG in U[1], dP within PH[now]
  int now = 0;  // which of W, PH belongs to the present state
};

/// Zero or undeformed everywhere; padding rows are undeformed nodes of unit volume with an infinite step length.
State make_state(const Scene& scene, const Mesh& mesh, Dual dual, const Order& order, const Boundary& boundary);

/// The rows of a stage that takes the rates of U[from] and writes U[to], and the next W and PH.
Rows stage_rows(State& state, int from, int to);

/// Bytes a node of all arrays of state and order, and in words what the scene does not pay for.
double bytes_per_node(const State& state, const Order& order);
std::vector<std::string> fields_left_out(const Scene& scene);

}  // namespace nanson
