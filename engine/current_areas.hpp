// Edges and corners as the fluxes see them.
#pragma once
#include "engine/parts.hpp"

namespace nanson {

/// Of the undeformed mesh; and with the current area vectors where the description has some.
EdgeArrays flux_edges(const Domain& d, const CurrentGeometry& current);
CornerArrays flux_corners(const Domain& d, const CurrentGeometry& current);
inline EdgeArrays flux_edges(const Simulation& s) { return flux_edges(s.domain, s.state.current); }
inline CornerArrays flux_corners(const Simulation& s) { return flux_corners(s.domain, s.state.current); }

/// Current area vectors of the rows U (nothing to do with description = "total").
void find_current_areas(const Simulation& s, const double* U, CurrentGeometry& current);
inline void find_current_areas(Simulation& s, const double* U) { find_current_areas(s, U, s.state.current); }

}  // namespace nanson
