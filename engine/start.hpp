// From a scene and its mesh to a simulation at t = 0.
#pragma once
#include "engine/simulation.hpp"

namespace nanson {

Team make_team(int threads);

/// Initial state, its stress, and the books opened with it.
Simulation start(Domain domain, Team team);

/// Stress and step bound of the present state.
void find_stress(Simulation& s);

Simulation make_simulation(const Scene& scene, const Mesh& mesh, int threads);

}  // namespace nanson
