// Fills the stable keys of summary.json.
#include "engine/summarise.hpp"

#include <fmt/format.h>

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
  const Energies e = energies(s);
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
  const Extrema x = extrema(s);
  out.min_detF = x.min_detF;
  out.max_detF = x.max_detF;
  out.errors = exact_errors(s);
  for (const Probe& q : probes)
    for (const std::string& name : q.spec.fields) {
      double v[9];
      const FieldName& f = field_named(name);
      probe(s, q.place, f, v);
      out.probes[q.spec.name][name].assign(v, v + f.components);
    }
  out.setup = s.team.setup.sweeps;
  out.sweeps = s.team.clock.sweeps;
  out.checkerboard = checkerboard(s);
  if (p.formulation == Formulation::pFp) out.projection = projection_summary(s);
  return out;
}

std::string closing_line(const Summary& s) {
  std::string line = fmt::format(
      "{} {} {} {} reconstruction, flux correction {}: {} nodes, {} steps, {:.3g} s, {:.0f} ns per node-step", s.status,
      s.formulation, s.material, s.reconstruction, s.flux_correction, s.nodes, s.steps, s.wall_s, s.ns_per_node_step);
  for (const char* k : {"p1_L2", "P11_L2"})
    if (const auto at = s.errors.find(k); at != s.errors.end()) line += fmt::format(", {} {:.2e}", k, at->second);
  if (s.projection)
    line += fmt::format(", {:.1f} {} iterations a stage", s.projection->iterations_per_stage, s.projection->solver);
  if (s.throughput) line += fmt::format(", {:.1f} GF/s, {:.1f} GB/s", s.throughput->GF_s, s.throughput->GB_s);
  if (s.throughput && s.throughput->bandwidth_share)
    line += fmt::format(" ({:.0f} % of the update bandwidth)", 100 * *s.throughput->bandwidth_share);
  if (s.peak_bytes)
    line += fmt::format(", at most {:.4g} MB resident ({:.2f} kB a node)", 1e-6 * *s.peak_bytes,
                        1e-3 * *s.peak_bytes / static_cast<double>(s.nodes));
  if (s.energy.closure) line += fmt::format(", energy closure {:.1e}", *s.energy.closure);
  return line;
}

}  // namespace nanson
