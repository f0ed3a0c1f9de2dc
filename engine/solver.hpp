// A simulation: the whole of a scene in memory, and the time loop over it.
#pragma once
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/clock.hpp"
#include "engine/current_geometry.hpp"
#include "engine/manufactured.hpp"
#include "engine/mixture.hpp"
#include "engine/projection.hpp"
#include "engine/registry.hpp"
#include "engine/state.hpp"
#include "engine/tets.hpp"
#include "engine/watch.hpp"

namespace nanson {

inline constexpr int part_row = 16;  // sums of a part that are taken in one sweep

/// Sums that a run carries from its start: what momentum and energy are compared with.
struct Ledger {
  double mass = 0, volume = 0;                          // [kg], [m^3]
  double lost_at_start = 0;                             // [J] kinetic energy that the supports removed from v(0)
  double initial_energy = 0;                            // [J]
  Vec3 initial_momentum{}, initial_angular_momentum{};  // [kg m/s], [kg m^2/s]
  Vec3 impulse{};                                       // [N s] of loads, body force and supports
  Vec3 angular_impulse{};                               // [N m s] of the same, TVD-RK2 only
  double external_work = 0;                             // [J] of loads and supports; monitor.energy: and of body force
  double dissipated = 0;                                // [J] monitor.energy
  double angular_momentum_work = 0;                     // [J] of the angular momentum projection
  double initial_fallen = 0;                            // [J] Energies::fallen at the start
  double largest_work = 0;                              // [J] largest |external_work| so far
  long balanced_step = 0;                               // last history row at which energy had not grown
};

struct Breakdown {
  int node = -1;           // of the mesh
  std::string text;        // where, when and why
  std::string_view cause;  // detF | J | inverted_tet | not_finite | dt_collapse | energy_growth | iteration_limit
};

struct Simulation {
  const Scene* scene = nullptr;
  const Mesh* mesh = nullptr;
  Order order;
  std::vector<double> volume;  // [m^3] dual, mesh numbering
  Boundary boundary;
  State state;
  Mixture mixture;                            // several materials only
  Projection projection;                      // pFp only
  Manufactured manufactured;                  // its body force; empty in all other scenes
  Tets tets;                                  // empty where nobody looks at them
  CurrentGeometry current;                    // current areas only
  PartFunctions functions, lagged_functions;  // of a stage; of one that takes the flux correction of the stage before
  Coefficients coefficients;
  std::vector<PartReport> reports;       // one a part
  std::vector<Aligned<double>> scratch;  // one a thread
  int threads = 1;
  long edges = 0;

  double t = 0, dt = 0;  // [s]
  double first_dt = 0, dt_min = 0, dt_max = 0;
  long step = 0;
  double wall_s = 0, cpu_s = 0;  // [s] of the time loop
  Ledger ledger;
  Clock setup, clock;  // of what comes before the time loop (mesh, dual, metis, order, state, initial), of its sweeps
  Watch watch;
  std::optional<Breakdown> breakdown;
  std::string_view stopped_by;       // max_steps | max_wall_s | signal
  std::vector<double> acceleration;  // [1/s] per boundary condition: rate of the time factor over the step
  std::vector<double> part_sums;     // one a part, for sums in a fixed order
  std::vector<std::array<double, part_row>> part_rows;  // several a part
  std::vector<double> initial_mismatch;                 // [-] monitor.involutions: F - grad x at the start, 9 a row
  Vec3 arm_origin{};                                    // [m] keep_angular_momentum: what its arms are counted from
};

/// Undeformed density of a row [kg/m^3].
inline double density(const Simulation& s, int n) {
  return s.mixture.empty() ? s.coefficients.material.rho : s.mixture.rho[static_cast<std::size_t>(n)];
}

/// What a run tells the outside; the engine itself touches no file.
struct Observer {
  std::function<void(const Simulation&)> on_step;     // after every step
  std::function<void(const Simulation&)> on_history;  // every history_every steps, at the start and at the end
  std::function<void(const Simulation&)>
      on_frame;  // every output.every, at the start and at the end; simulation.breakdown marks the broken one
  std::function<std::string()> stop;  // a reason to end after this step, or nothing
};

/// Dual, order, boundary, state at t = 0 and its stress.
Simulation make_simulation(const Scene& scene, const Mesh& mesh, int threads);

/// Runs to the scene's end. Returns the status: done | breakdown | stopped, with the reason in `reason`.
std::string run(Simulation& s, const Observer& observer, std::string& reason);

/// Edges and corners as fluxes see them: with the current area vectors that `find_current_areas` found last where the description has some.
EdgeArrays flux_edges(const Simulation& s);
CornerArrays flux_corners(const Simulation& s);

/// Current area vectors of the state U (nothing to do with description = "total").
void find_current_areas(Simulation& s, const double* U);

/// One step of size s.dt.
void advance(Simulation& s);

/// The largest step that the scene's rule allows for the present state [s].
double allowed_step(const Simulation& s);

/// Bytes a node of everything that a step reads or writes.
double bytes_per_node(const Simulation& s);

/// Places with the smallest step: mesh nodes and their step [s], worst first.
std::vector<std::pair<int, double>> limiting_nodes(const Simulation& s, int count);

}  // namespace nanson
