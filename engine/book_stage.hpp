// What goes into the books: after the sweeps of a stage, after the stage, after the step.
#pragma once
#include "engine/forces.hpp"

namespace nanson {

/// After the sweeps: one stage's share of dissipation, whose power the edge loops have left in part_sums; `rows` are those that the stage took its rates of.
void book_dissipation(Simulation& s, const Rows& rows, double weighted_dt);

/// {p, F, p}, after the projection: what its drift control has taken, at the pressures that the stage leaves.
void book_drift_control(Simulation& s, double weighted_dt);
/// After a stage: its share `mean` in the mean reactions, in the supports' work, and in impulse and angular impulse of all that acts.
void book_stage(Simulation& s, const double* arms, double mean, bool first);
/// After a step: the plastic work of its new state.
void book_plastic_work(Simulation& s);

/// Force of a named support on the body, mean of the last step's stages [N]: minus what the projection removes from the assembled force.
Vec3 reaction(const Simulation& s, int face);

}  // namespace nanson
