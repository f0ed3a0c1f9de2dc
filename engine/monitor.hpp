// What a run watches: energies, momenta, extrema, the energy audit, and where and why it broke down or is ruined.
#pragma once
#include <optional>

#include "engine/simulation.hpp"

namespace nanson {

struct Momenta {
  Vec3 linear{}, angular{};                    // [kg m/s], [kg m^2/s] about the origin
  double linear_scale = 0, angular_scale = 0;  // sum Omega |p|, sum Omega |x| |p|
};

/// Power that the stabilisation takes out of the edges (method, section 3): negative where it feeds one.
struct EntropyProduction {
  double least = 0, total = 0;  // [W] of an edge, of all
  double negative_share = 0;    // [-] of the edges
};
/// Largest components.
struct Involutions {
  double F = 0;         // [-] change of F - grad x since the start, which is O(h^2) when F(0) is analytic
  double H = 0, J = 0;  // [-] H - cof F (pFHJ); J - det F (pFJ, pFHJ)
};
Energies energies(const Simulation& s);
Momenta momenta(const Simulation& s);
/// In one sweep over the parts.
Extrema extrema(const Simulation& s);

EntropyProduction entropy_production(const Simulation& s);
Involutions involutions(const Simulation& s);

/// F - grad x, 9 a row: what a run with monitor.involutions keeps of its start.
Aligned<double> gradient_mismatch(const Simulation& s);

/// A sentence when time.cfl is above the largest that was sound with this scheme (configs/studies/measured/stability_cfl).
std::optional<std::string> cfl_warning(const Scene& scene);

/// Takes the present state into s.watch; every sixteenth time with the checkerboard measure, which costs a sweep over the edges.
void look(Simulation& s);
/// Energies and extrema of the present state: of the last look where it was at this step.
struct Seen {
  Energies energies;
  Extrema extrema;
};
Seen seen(const Simulation& s);
/// What the last look found, as warnings of s.watch or as the reason to go no further.
std::optional<Breakdown> ruin(Simulation& s);
/// Adds a warning unless there is one of its cause.
void warn(Simulation& s, std::string_view cause, std::string text);

/// |kinetic + strain + dissipated - external_work - angular_momentum_work - initial| over the larger of the initial energy and the largest
/// external work so far (method, section 11); needs monitor.energy.
double energy_closure(const Simulation& s, const Energies& e);

/// |sum Omega p - start - impulse| / sum Omega |p|.
double linear_momentum_drift(const Simulation& s);
/// |L - L(0) - angular impulse| / sum Omega |x| |p|; nothing under ssp_rk3 when supports or loads exert a torque: its exact arms are known for TVD-RK2 only.
std::optional<double> angular_momentum_drift(const Simulation& s);

/// Checkerboard measure of the swept pressure: sqrt(sum W (p_b - p_a - (g_a + g_b)/2 . D)^2 / sum W (p_b - p_a)^2) over the edges, W = |C|/|D|, g the Green-Gauss
/// gradient: 0 for a linear field, 1 for a checkerboard, O(h) for a smooth one (method, section 11). With several materials only edges between nodes
/// count whose neighbours are all of the same one; NaN where none has a difference of pressure.
struct Checkerboard {
  double measure = 0;  // [-]
  double size = 0;     // [N^2] sum W (p_b - p_a)^2
};
Checkerboard checkerboard(const Simulation& s);

/// Rows whose state is unphysical after a stage: names node, position, J, det F, its tets and regions.
Breakdown locate_breakdown(const Simulation& s, int stage);
Breakdown collapse(const Simulation& s, double allowed);
/// A sentence when the total energy has exceeded initial + external work for some steps: by more than monitor.energy_tolerance of them, without monitor.energy
/// by more than all of them, which no sound run does.
std::optional<std::string> energy_growth(Simulation& s);

/// Tets around a mesh node, for messages.
std::vector<int> tets_around(const Mesh& mesh, int node);

}  // namespace nanson
