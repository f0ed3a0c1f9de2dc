// Fills the stable keys of summary.json.
#include "engine/summarise.hpp"

#include <fmt/format.h>

#include <cmath>

#include "engine/monitor.hpp"

namespace nanson {

namespace {

ProjectionSummary projection_summary(const Simulation& s) {
  const ProjectionSpec& spec = s.domain.scene->projection;
  const Projection& p = s.state.projection;
  const double stages = p.stages > 0 ? static_cast<double>(p.stages) : 1;
  return {std::string(word(spec.solver)),
          spec.stabilisation,
          spec.drift_control,
          spec.tolerance,
          p.iterations,
          static_cast<double>(p.iterations) / stages,
          static_cast<double>(p.rounds) / stages,
          p.residual,
          s.domain.projection.closed};
}

/// The law, or "region law, region law" with several materials.
std::string material_words(const Scene& scene) {
  if (scene.materials.empty()) return std::string(word(scene.material.law));
  std::string all;
  for (const MaterialSpec& m : scene.materials)
    for (const Named& region : m.regions)
      all += fmt::format("{}{} {}", all.empty() ? "" : ", ", region.name, word(m.law));
  return all;
}

}  // namespace

Summary summarise(const Simulation& s, const std::vector<Probe>& probes, const std::string& status,
                  const std::string& reason) {
  const Scene& scene = *s.domain.scene;
  const PhysicsSpec& p = scene.physics;
  Summary out;
  out.status = status;
  out.reason = reason;
  out.cause = s.breakdown ? s.breakdown->cause : s.stopped_by;
  out.scene = scene.name;
  out.formulation = word(p.formulation);
  out.material = material_words(scene);
  out.reconstruction = word(p.reconstruction);
  out.flux_correction = word(p.flux_correction);
  out.boundary_flux = word(p.boundary_flux);
  out.upwind_metric = word(p.upwind_metric);
  out.description = word(p.description);
  out.stabilisation = word(p.stabilisation);
  out.pressure_jump = word(p.pressure_jump);
  out.parting = p.parting;
  out.tet_stiffness = p.tet_stiffness;
  out.tet_barrier = p.tet_barrier;
  out.integrator = word(scene.time.integrator);
  out.step = word(scene.time.step);
  out.split = scene.mesh.source == MeshSource::box ? word(scene.mesh.split) : word(scene.mesh.source);
  out.nodes = s.domain.order.nodes;
  out.tets = static_cast<long>(s.domain.mesh->tets.size());
  out.edges = s.domain.edges;
  out.steps = s.state.step;
  out.t_end = s.state.t;
  out.dt_min = s.state.dt_min;
  out.dt_max = s.state.dt_max;
  out.threads = s.team.threads;
  out.wall_s = s.team.wall_s;
  out.cpu_s = s.team.cpu_s;
  out.setup_s = s.team.setup.total();
  out.ns_per_node_step = s.state.step > 0
                             ? 1e9 * s.team.wall_s / (static_cast<double>(s.state.step) * s.domain.order.nodes)
                             : 0;
  out.bytes_per_node = bytes_per_node(s);
  out.fields_left_out = fields_left_out(scene);
  out.state_hash = state_hash(s);
  const auto [e, x] = seen(s);
  out.energy.initial = s.books.initial_energy;
  out.energy.kinetic = e.kinetic;
  out.energy.strain = e.strain;
  out.energy.lost_at_start = s.books.lost_at_start;
  if (scene.monitor.energy) {
    out.energy.external_work = s.books.external_work;
    out.energy.dissipated = s.books.dissipated;
    out.energy.closure = energy_closure(s, e);
  }
  if (scene.monitor.energy && p.keep_angular_momentum) out.energy.angular_momentum_work = s.books.angular_momentum_work;
  out.keep_angular_momentum = p.keep_angular_momentum;
  out.mass = s.books.mass;
  out.volume = s.books.volume;
  out.angular_momentum_drift = angular_momentum_drift(s);
  out.linear_momentum_drift = linear_momentum_drift(s);
  out.min_detF = x.min_detF;
  out.max_detF = x.max_detF;
  out.errors = exact_errors(s);
  for (const Probe& q : probes)
    for (const std::string& name : q.spec.fields) {
      double v[9];
      const Field& f = field_named(name);
      probe(s, q.place, f, v);
      out.probes[q.spec.name][name].assign(v, v + f.components);
    }
  out.setup = s.team.setup.sweeps;
  out.sweeps = s.team.clock.sweeps;
  out.checkerboard = checkerboard(s).measure;
  out.extremes = s.watch.extremes;
  for (const Warning& w : s.watch.warnings) out.warnings.push_back(w.text);
  if (p.formulation == Formulation::pFp) out.projection = projection_summary(s);
  return out;
}

namespace {

/// "det F 0.61 (t = 0.012 s) to 1.3 (t = 0.04 s)".
std::string range(const char* name, const Extreme& least, const Extreme& most) {
  return fmt::format("{} {:.3g} (t = {:.4g} s) to {:.3g} (t = {:.4g} s)", name, least.value, least.t, most.value,
                     most.t);
}

std::string time_line(const Summary& s) {
  std::string line = fmt::format(
      "{} steps in {:.3g} s on {} thread{}, {:.3g} s of processor time, {:.0f} ns a node and "
      "step",
      s.steps, s.wall_s, s.threads, s.threads == 1 ? "" : "s", s.cpu_s, s.ns_per_node_step);
  if (s.projection)
    line += fmt::format(", {:.1f} {} iterations a stage", s.projection->iterations_per_stage, s.projection->solver);
  if (s.throughput) line += fmt::format(", {:.1f} GF/s, {:.1f} GB/s", s.throughput->GF_s, s.throughput->GB_s);
  if (s.throughput && s.throughput->bandwidth_share)
    line += fmt::format(" ({:.0f} % of the update bandwidth)", 100 * *s.throughput->bandwidth_share);
  if (s.peak_bytes) line += fmt::format(", at most {:.4g} MB", 1e-6 * *s.peak_bytes);
  return line;
}

std::string energy_line(const Summary& s) {
  std::string line = fmt::format("energy: kinetic {:.4g} J, strain {:.4g} J, at the start {:.4g} J; ", s.energy.kinetic,
                                 s.energy.strain, s.energy.initial);
  line += s.energy.closure ? fmt::format("the balance closes to {:.1e}", *s.energy.closure)
                           : "the balance is audited with monitor.energy = true only";
  for (const char* k : {"p1_L2", "P11_L2"})
    if (const auto at = s.errors.find(k); at != s.errors.end()) line += fmt::format(", error {} {:.2e}", k, at->second);
  return line;
}

std::string geometry_line(const Summary& s) {
  const Extremes& e = s.extremes;
  std::string line = std::isnan(e.least_tet_ratio.value) ? "tets not looked at (monitor.geometry = \"off\")"
                                                         : fmt::format("worst tet {:.3g} of its volume (t = {:.4g} s)",
                                                                       e.least_tet_ratio.value, e.least_tet_ratio.t);
  if (e.least_tet_ratio.value <= 0) line += ": INSIDE OUT";
  line += ", " + range("det F", e.least_detF, e.most_detF);
  if (!std::isnan(e.least_detF_over_J.value))
    line += fmt::format(", det F/J {:.3g} to {:.3g}", e.least_detF_over_J.value, e.most_detF_over_J.value);
  return line;
}

}  // namespace

std::vector<std::string> closing_lines(const Summary& s) {
  return {fmt::format("{} at t = {:.6g} s: {} {} {} reconstruction, flux correction {}, {} nodes", s.status, s.t_end,
                      s.formulation, s.material, s.reconstruction, s.flux_correction, s.nodes),
          time_line(s), energy_line(s), geometry_line(s)};
}

}  // namespace nanson
