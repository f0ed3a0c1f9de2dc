// What the sweeps of a run made of the machine, by the byte and flop model of engine/work.hpp.
#pragma once
#include <optional>

#include "engine/simulation.hpp"
#include "engine/summary.hpp"

namespace nanson {

/// Of the sweeps gradient and flux_update_stress; nothing where the model does not count (pFp, hencky_j2, current areas, several materials) or no step was taken.
/// `update_bandwidth` [bytes/s] as measured, 0 if it was not.
std::optional<Throughput> throughput(const Simulation& s, double update_bandwidth);

}  // namespace nanson
