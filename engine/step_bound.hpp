// The largest step, and where it is set.
#pragma once
#include <utility>
#include <vector>

#include "engine/simulation.hpp"

namespace nanson {

/// The largest step that the scene's rule allows for the present state [s].
double allowed_step(const Simulation& s);

/// Places with the smallest step: mesh nodes and their step [s], worst first.
std::vector<std::pair<int, double>> limiting_nodes(const Simulation& s, int count);

}  // namespace nanson
