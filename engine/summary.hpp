// Everything that summary.json holds, as plain data; an empty optional is written as null.
#pragma once
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/watch.hpp"

namespace nanson {

struct EnergySummary {
  double initial = 0, kinetic = 0, strain = 0;               // [J]
  std::optional<double> external_work, dissipated, closure;  // [J], [J], [-]: only with monitor.energy
  std::optional<double> angular_momentum_work;               // [J] of keep_angular_momentum: only with both
  std::optional<double> lost_at_start;  // [J] kinetic energy that the constraints removed from v(0)
};

struct SweepTime {
  std::string sweep;
  double seconds = 0;
};

/// What the projection of formulation pFp did.
struct ProjectionSummary {
  std::string solver;
  double stabilisation = 0, drift_control = 0, tolerance = 0;
  long iterations = 0;  // of the run
  double iterations_per_stage = 0, solves_per_stage = 0;
  double residual = 0;  // of the last stage, relative to the velocity gradient
  bool closed = false;  // no free surface: the mean pressure is kept at 0
};

/// What the sweeps gradient and flux_update_stress made of the machine, by the model of engine/work.hpp.
struct Throughput {
  double bytes_per_node_step = 0, flops_per_node_step = 0;  // of the model
  double GB_s = 0, GF_s = 0;                                // reached
  std::optional<double> update_GB_s, bandwidth_share;       // measured after the run, not with --quiet; share of it [-]
};

struct Summary {
  std::string status = "done";  // done | breakdown | stopped
  std::string reason;           // why it did not end as asked; empty when done
  std::string cause;            // one word for the reason (solver.hpp); empty when done
  std::string scene, formulation, material, description, stabilisation, reconstruction, flux_correction;
  double parting = 0;                         // [-] M/mu
  double tet_stiffness = 0, tet_barrier = 0;  // [-] of the tets' modulus
  std::string boundary_flux, upwind_metric, pressure_jump, integrator, step, split;
  long nodes = 0, tets = 0, edges = 0, steps = 0;
  double t_end = 0, dt_min = 0, dt_max = 0;  // [s]
  int threads = 1;
  double wall_s = 0, cpu_s = 0;  // [s] time loop only
  double setup_s = 0;            // [s] before it, the mesh included: the sum of `setup`
  double ns_per_node_step = 0;
  double bytes_per_node = 0;         // that a step reads or writes
  std::optional<double> peak_bytes;  // resident at most, of the whole process
  std::vector<std::string> fields_left_out;
  std::string state_hash;
  EnergySummary energy;
  double mass = 0, volume = 0;  // [kg], [m^3]
  bool keep_angular_momentum = false;
  std::optional<double> angular_momentum_drift;  // [-] ssp_rk3: only without supports and loads
  double linear_momentum_drift = 0;              // [-]
  double min_detF = 0, max_detF = 0;             // [-] of the last state
  std::map<std::string, double> errors;          // empty without an exact solution
  std::map<std::string, std::map<std::string, std::vector<double>>> probes;  // last values
  std::vector<SweepTime> setup, sweeps;
  double checkerboard = 0;  // [-] of the pressure, 0 smooth, 1 a checkerboard
  Extremes extremes;        // over the run
  std::vector<std::string> warnings;
  std::optional<ProjectionSummary> projection;  // pFp only
  std::optional<Throughput> throughput;         // where the model counts
};

/// NaN is written as null, std::monostate not at all.
using SummaryValue = std::variant<std::monostate, double, long, bool, std::string, std::vector<std::string>>;

/// An entry of summary.json: the one table of them, from which the file is written and a study knows what it may ask for. Besides these stand
/// probes.PROBE.FIELD (a list), and setup.NAME and sweeps.NAME [s].
struct SummaryEntry {
  std::string_view name;            // energy.closure: closure in the table energy
  std::string_view unit, sentence;  // the unit is empty where the entry is no number
  SummaryValue (*value)(const Summary&);
};
std::span<const SummaryEntry> summary_entries();

}  // namespace nanson
