// Angular momentum projection of a TVD-RK2 stage: the smallest change of the internal forces that makes their torque zero (method, section 7).
#pragma once
#include "engine/simulation.hpp"

namespace nanson {

/// What the sums of a stage leave behind: scratch.force of each part is summed while it lasts, inside the fused sweep.
void sum_moments(const Simulation& s, const Rows& rows, const double* arms, int part, const Scratch& scratch);

/// After the sweep: one solve, then the correction of v in U_new and W_new, and of the stage's reactions. Returns its power [W].
double keep_angular_momentum(Simulation& s, const Rows& rows, const Coefficients& k, const double* arms);

}  // namespace nanson
