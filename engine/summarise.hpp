// The summary of a finished run.
#pragma once
#include "engine/history.hpp"
#include "engine/summary.hpp"

namespace nanson {

Summary summarise(const Simulation& s, const std::vector<Probe>& probes, const std::string& status,
                  const std::string& reason);

/// The closing line: scheme, nodes, steps, wall, ns per node-step, errors if an exact solution is known, energy closure.
std::string closing_line(const Summary& s);

}  // namespace nanson
