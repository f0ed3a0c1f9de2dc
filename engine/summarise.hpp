// The summary of a finished run.
#pragma once
#include "engine/history.hpp"
#include "engine/summary.hpp"

namespace nanson {

Summary summarise(const Simulation& s, const std::vector<Probe>& probes, const std::string& status,
                  const std::string& reason);

/// What a user wants to see at the end: status, time and scheme; steps and seconds; energy balance and errors; worst tet and det F.
std::vector<std::string> closing_lines(const Summary& s);

}  // namespace nanson
