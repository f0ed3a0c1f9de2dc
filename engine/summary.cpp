// The table of summary.json: status and reason first, what a run was, what it cost, what it kept, what it ended with.
#include "engine/summary.hpp"

#include <limits>

namespace nanson {
namespace {

SummaryValue number(std::optional<double> value) { return value.value_or(std::numeric_limits<double>::quiet_NaN()); }

SummaryValue error(const Summary& s, const char* name) {
  const auto at = s.errors.find(name);
  return at == s.errors.end() ? SummaryValue{} : SummaryValue{at->second};
}

template <auto member>
SummaryValue of(const Summary& s) {
  using T = std::remove_cvref_t<decltype(s.*member)>;
  if constexpr (std::is_same_v<T, int>) return static_cast<long>(s.*member);
  else if constexpr (std::is_same_v<T, std::optional<double>>) return number(s.*member);
  else return s.*member;
}

template <auto member>
SummaryValue of_energy(const Summary& s) {
  return number(s.energy.*member);
}

template <auto member>
SummaryValue extreme(const Summary& s) {
  return (s.extremes.*member).value;
}
template <auto member>
SummaryValue extreme_t(const Summary& s) {
  return (s.extremes.*member).t;
}

/// Of a part that not every run has.
template <auto part, auto member>
SummaryValue of_part(const Summary& s) {
  if (!(s.*part)) return {};
  using T = std::remove_cvref_t<decltype((*(s.*part)).*member)>;
  if constexpr (std::is_same_v<T, std::optional<double>>) return number((*(s.*part)).*member);
  else return (*(s.*part)).*member;
}

template <auto member>
constexpr auto of_projection = of_part<&Summary::projection, member>;
template <auto member>
constexpr auto of_throughput = of_part<&Summary::throughput, member>;

using S = Summary;
using E = EnergySummary;
using X = Extremes;
using P = ProjectionSummary;
using T = Throughput;

constexpr SummaryEntry table[] = {
    {"status", "", "done | breakdown | stopped", of<&S::status>},
    {"reason", "", "why it did not end as asked", of<&S::reason>},
    {"cause", "", "one word for the reason", of<&S::cause>},
    {"scene", "", "its name", of<&S::scene>},
    {"nodes", "-", "nodes of the mesh", of<&S::nodes>},
    {"tets", "-", "tets of the mesh", of<&S::tets>},
    {"edges", "-", "edges of the mesh", of<&S::edges>},
    {"steps", "-", "steps that were done", of<&S::steps>},
    {"t_end", "s", "time that was reached", of<&S::t_end>},
    {"dt_min", "s", "smallest step", of<&S::dt_min>},
    {"dt_max", "s", "largest step", of<&S::dt_max>},
    {"mass", "kg", "mass of the body", of<&S::mass>},
    {"volume", "m^3", "undeformed volume of the body", of<&S::volume>},
    {"energy.initial", "J", "total energy at the start, after the supports took hold", of_energy<&E::initial>},
    {"energy.kinetic", "J", "kinetic energy at the end", of_energy<&E::kinetic>},
    {"energy.strain", "J", "strain energy at the end, with plastic work", of_energy<&E::strain>},
    {"energy.external_work", "J", "work of loads, body force and moving supports (monitor.energy)",
     of_energy<&E::external_work>},
    {"energy.dissipated", "J", "energy that the stabilisation took (monitor.energy)", of_energy<&E::dissipated>},
    {"energy.angular_momentum_work", "J", "work of physics.keep_angular_momentum (with monitor.energy)",
     of_energy<&E::angular_momentum_work>},
    {"energy.closure", "-",
     "energy that is not accounted for, share of the largest of initial energy and work (monitor.energy)",
     of_energy<&E::closure>},
    {"energy.lost_at_start", "J", "kinetic energy that the supports removed from the initial velocity",
     of_energy<&E::lost_at_start>},
    {"linear_momentum_drift", "-", "momentum that the impulses do not account for, share of sum Omega |p|",
     of<&S::linear_momentum_drift>},
    {"angular_momentum_drift", "-", "angular momentum that the impulses do not account for, share of sum Omega |x| |p|",
     of<&S::angular_momentum_drift>},
    {"min_detF", "-", "least determinant of F at the end", of<&S::min_detF>},
    {"max_detF", "-", "largest determinant of F at the end", of<&S::max_detF>},
    {"warnings", "", "what the run said while it went on", of<&S::warnings>},
    {"extremes.least_tet_ratio.value", "-",
     "least deformed over undeformed volume of a tet over the run; below 0: inside out", extreme<&X::least_tet_ratio>},
    {"extremes.least_tet_ratio.t", "s", "and when", extreme_t<&X::least_tet_ratio>},
    {"extremes.least_detF.value", "-", "least determinant of F over the run", extreme<&X::least_detF>},
    {"extremes.least_detF.t", "s", "and when", extreme_t<&X::least_detF>},
    {"extremes.most_detF.value", "-", "largest determinant of F over the run", extreme<&X::most_detF>},
    {"extremes.most_detF.t", "s", "and when", extreme_t<&X::most_detF>},
    {"extremes.least_detF_over_J.value", "-", "least det F over the carried J over the run (pFJ | pFHJ)",
     extreme<&X::least_detF_over_J>},
    {"extremes.least_detF_over_J.t", "s", "and when", extreme_t<&X::least_detF_over_J>},
    {"extremes.most_detF_over_J.value", "-", "largest det F over the carried J over the run (pFJ | pFHJ)",
     extreme<&X::most_detF_over_J>},
    {"extremes.most_detF_over_J.t", "s", "and when", extreme_t<&X::most_detF_over_J>},
    {"extremes.checkerboard.value", "-", "largest checkerboard measure over the run", extreme<&X::checkerboard>},
    {"extremes.checkerboard.t", "s", "and when", extreme_t<&X::checkerboard>},
    {"extremes.speed.value", "m/s", "largest speed of a node over the run", extreme<&X::speed>},
    {"extremes.speed.t", "s", "and when", extreme_t<&X::speed>},
    {"checkerboard", "-", "of the pressure at the end: 0 smooth, 1 a checkerboard", of<&S::checkerboard>},
    {"errors.p1_L1", "-", "error of the momentum p_1 against the exact solution, where there is one, L1",
     [](const S& s) { return error(s, "p1_L1"); }},
    {"errors.p1_L2", "-", "the same, L2", [](const S& s) { return error(s, "p1_L2"); }},
    {"errors.P11_L1", "-", "error of the stress P_11, L1", [](const S& s) { return error(s, "P11_L1"); }},
    {"errors.P11_L2", "-", "the same, L2", [](const S& s) { return error(s, "P11_L2"); }},
    {"errors.P11_L1_t0", "-", "the same, L1, against the size of P_11 at the start",
     [](const S& s) { return error(s, "P11_L1_t0"); }},
    {"errors.P11_L2_t0", "-", "the same, L2", [](const S& s) { return error(s, "P11_L2_t0"); }},
    {"projection.solver", "", "cg | pseudo_time", of_projection<&P::solver>},
    {"projection.stabilisation", "-", "beta", of_projection<&P::stabilisation>},
    {"projection.drift_control", "-", "theta", of_projection<&P::drift_control>},
    {"projection.tolerance", "-", "of the volume constraint, against the velocity gradient",
     of_projection<&P::tolerance>},
    {"projection.iterations", "-", "iterations of the run (pFp)", of_projection<&P::iterations>},
    {"projection.iterations_per_stage", "-", "iterations of a stage, mean", of_projection<&P::iterations_per_stage>},
    {"projection.solves_per_stage", "-", "solves of a stage, mean", of_projection<&P::solves_per_stage>},
    {"projection.residual", "-", "volume constraint left over by the last stage, share of the velocity gradient",
     of_projection<&P::residual>},
    {"projection.closed", "", "no free surface: the mean pressure is kept at 0", of_projection<&P::closed>},
    {"formulation", "", "as in the scene", of<&S::formulation>},
    {"material", "", "the law, or region and law of each", of<&S::material>},
    {"description", "", "as in the scene", of<&S::description>},
    {"stabilisation", "", "as in the scene", of<&S::stabilisation>},
    {"reconstruction", "", "as in the scene", of<&S::reconstruction>},
    {"flux_correction", "", "as in the scene", of<&S::flux_correction>},
    {"boundary_flux", "", "as in the scene", of<&S::boundary_flux>},
    {"upwind_metric", "", "as in the scene", of<&S::upwind_metric>},
    {"pressure_jump", "", "as in the scene", of<&S::pressure_jump>},
    {"parting", "-", "as in the scene, M/mu", of<&S::parting>},
    {"tet_stiffness", "-", "as in the scene, modulus over mu", of<&S::tet_stiffness>},
    {"tet_barrier", "-", "as in the scene, modulus over mu", of<&S::tet_barrier>},
    {"keep_angular_momentum", "", "as in the scene", of<&S::keep_angular_momentum>},
    {"integrator", "", "as in the scene", of<&S::integrator>},
    {"step", "", "as in the scene", of<&S::step>},
    {"split", "", "mesh.split, or what the mesh was made from", of<&S::split>},
    {"threads", "-", "threads", of<&S::threads>},
    {"wall_s", "s", "wall time of the time loop", of<&S::wall_s>},
    {"cpu_s", "s", "processor time of the time loop", of<&S::cpu_s>},
    {"setup_s", "s", "wall time before it, the mesh included", of<&S::setup_s>},
    {"ns_per_node_step", "ns", "wall time a node and step", of<&S::ns_per_node_step>},
    {"bytes_per_node", "bytes", "memory that a step reads or writes, a node", of<&S::bytes_per_node>},
    {"peak_bytes", "bytes", "memory of the process, at most", of<&S::peak_bytes>},
    {"peak_bytes_per_node", "bytes", "the same, a node",
     [](const S& s) {
       const bool known = s.peak_bytes && s.nodes > 0;
       return known ? SummaryValue{*s.peak_bytes / static_cast<double>(s.nodes)} : number(std::nullopt);
     }},
    {"throughput.bytes_per_node_step", "bytes", "moved a node and step, by the model",
     of_throughput<&T::bytes_per_node_step>},
    {"throughput.flops_per_node_step", "-", "operations a node and step, by the model",
     of_throughput<&T::flops_per_node_step>},
    {"throughput.GB_s", "GB/s", "reached by the sweeps", of_throughput<&T::GB_s>},
    {"throughput.GF_s", "GF/s", "reached by the sweeps", of_throughput<&T::GF_s>},
    {"throughput.update_GB_s", "GB/s", "bandwidth of a plain update, measured after the run (not with --quiet)",
     of_throughput<&T::update_GB_s>},
    {"throughput.bandwidth_share", "-", "of it that the sweeps reached", of_throughput<&T::bandwidth_share>},
    {"fields_left_out", "", "what the scene does not pay for", of<&S::fields_left_out>},
    {"state_hash", "", "of the last state: equal for bitwise equal states", of<&S::state_hash>},
};

}  // namespace

std::span<const SummaryEntry> summary_entries() { return table; }

}  // namespace nanson
