// A stage of the incompressible scheme {p, F, p}: an explicit step with the old pressure, then the projection of velocity and pressure (method, section 10).
#pragma once
#include <string>

#include "engine/simulation.hpp"

namespace nanson {

/// After the explicit part has put U + dt dU/dt into state.U[1]: projects it; the second stage averages with the start of the step. Then the next stress.
/// Returns why the run must not go on, or nothing.
std::string project_stage(Simulation& s, int number);

}  // namespace nanson
