// A stage of the incompressible scheme {p, F, p}: an explicit step with the old pressure, then the projection of velocity and pressure (method, section 10).
#pragma once
#include <string>

#include "engine/simulation.hpp"

namespace nanson {

/// A Runge-Kutta stage whose Euler step is projected before it is averaged: U_to = old U^n + stage U**.
struct ProjectedStage {
  int number;  // from 0
  double old, stage;
  int from, to;  // rows of U
};

/// After the explicit part has put U + dt dU/dt into state.U[1]: projects it, averages, and takes the next stress.
/// Returns why the run must not go on, or nothing.
std::string project_stage(Simulation& s, const ProjectedStage& rk);

}  // namespace nanson
