// The largest resident set of this process so far.
#pragma once
#include <optional>

namespace nanson {

/// Mesh, set-up and time loop, whatever was largest [bytes]; nothing where the system does not tell. Not getrusage: there a run that a study starts has at least
/// the study's own peak, which the kernel hands on.
std::optional<double> peak_bytes();

}  // namespace nanson
