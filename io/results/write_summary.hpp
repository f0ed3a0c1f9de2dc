// summary.json: the numbers of a run under stable keys, written once at its end.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/summary.hpp"
#include "io/provenance.hpp"

namespace nanson {

/// JSON text; what is missing or not finite is null.
std::string summary_json(const Summary& summary, const Provenance& from);

/// Dotted names of all numbers that a summary may hold, "energy.closure", but for probes and sweeps.
std::vector<std::string> summary_numbers();

/// Throws std::runtime_error with the reason when it cannot be written; an older file then stays as it was.
void write_summary(const std::filesystem::path& path, const Summary& summary, const Provenance& from);

}  // namespace nanson
