// History: time, energies, momenta, extrema, monitors; reactions by named face, probes.
#include "engine/history.hpp"

#include <fmt/format.h>

#include "engine/book_stage.hpp"

namespace nanson {
namespace {

bool audits(const Simulation& s) { return s.domain.scene->monitor.energy; }
bool watches_entropy(const Simulation& s) { return s.domain.scene->monitor.entropy; }
bool watches_involutions(const Simulation& s) { return s.domain.scene->monitor.involutions; }
bool watches_geometry(const Simulation& s) { return s.domain.scene->monitor.geometry != GeometryWatch::off; }
bool carries_J(const Simulation& s) { return evolves_J(s.domain.scene->physics.formulation); }
bool projects(const Simulation& s) { return s.domain.scene->physics.formulation == Formulation::pFp; }

constexpr ColumnKind table[] = {
    {"step", "-", "steps so far", nullptr, [](const Sample& r) { return static_cast<double>(r.s.state.step); }},
    {"t", "s", "time", nullptr, [](const Sample& r) { return r.s.state.t; }},
    {"dt", "s", "size of the last step", nullptr, [](const Sample& r) { return r.s.state.dt; }},
    {"kinetic", "J", "kinetic energy", nullptr, [](const Sample& r) { return r.energy.kinetic; }},
    {"strain", "J", "strain energy, with plastic work", nullptr, [](const Sample& r) { return r.energy.strain; }},
    {"external_work", "J", "work of loads, body force and moving supports since the start (monitor.energy)", audits,
     [](const Sample& r) { return r.s.books.external_work; }},
    {"dissipated", "J", "energy that the stabilisation took since the start (monitor.energy)", audits,
     [](const Sample& r) { return r.s.books.dissipated; }},
    {"closure", "-",
     "energy that is not accounted for, share of the largest of initial energy and work (monitor.energy)", audits,
     [](const Sample& r) { return energy_closure(r.s, r.energy); }},
    {"angular_momentum_work", "J", "work of physics.keep_angular_momentum (with monitor.energy)",
     [](const Simulation& s) { return audits(s) && s.domain.scene->physics.keep_angular_momentum; },
     [](const Sample& r) { return r.s.books.angular_momentum_work; }},
    {"momentum_x", "kg m/s", "linear momentum", nullptr, [](const Sample& r) { return r.momentum.linear[0]; }},
    {"momentum_y", "kg m/s", "linear momentum", nullptr, [](const Sample& r) { return r.momentum.linear[1]; }},
    {"momentum_z", "kg m/s", "linear momentum", nullptr, [](const Sample& r) { return r.momentum.linear[2]; }},
    {"angular_momentum_x", "kg m^2/s", "angular momentum about the origin", nullptr,
     [](const Sample& r) { return r.momentum.angular[0]; }},
    {"angular_momentum_y", "kg m^2/s", "angular momentum about the origin", nullptr,
     [](const Sample& r) { return r.momentum.angular[1]; }},
    {"angular_momentum_z", "kg m^2/s", "angular momentum about the origin", nullptr,
     [](const Sample& r) { return r.momentum.angular[2]; }},
    {"min_detF", "-", "least determinant of F of all nodes", nullptr,
     [](const Sample& r) { return r.extrema.min_detF; }},
    {"max_detF", "-", "largest determinant of F", nullptr, [](const Sample& r) { return r.extrema.max_detF; }},
    {"min_J", "-", "least carried volume map", nullptr, [](const Sample& r) { return r.extrema.min_J; }},
    {"max_J", "-", "largest carried volume map", nullptr, [](const Sample& r) { return r.extrema.max_J; }},
    {"max_speed", "m/s", "largest speed of a node", nullptr, [](const Sample& r) { return r.extrema.max_speed; }},
    {"max_plastic_strain", "-", "largest equivalent plastic strain (law hencky_j2)",
     [](const Simulation& s) { return !s.state.plastic.empty(); },
     [](const Sample& r) { return r.extrema.max_plastic_strain; }},
    {"entropy_min", "W", "least power that the stabilisation takes from an edge (monitor.entropy)", watches_entropy,
     [](const Sample& r) { return r.entropy.least; }},
    {"entropy_sum", "W", "power that the stabilisation takes from all edges (monitor.entropy)", watches_entropy,
     [](const Sample& r) { return r.entropy.total; }},
    {"entropy_negative_share", "-", "share of the edges that are fed by it (monitor.entropy)", watches_entropy,
     [](const Sample& r) { return r.entropy.negative_share; }},
    {"involution_F", "-", "largest change of F - grad x since the start (monitor.involutions)", watches_involutions,
     [](const Sample& r) { return r.involutions.F; }},
    {"involution_H", "-", "largest H - cof F (monitor.involutions, pFHJ)",
     [](const Simulation& s) {
       return watches_involutions(s) && s.domain.scene->physics.formulation == Formulation::pFHJ;
     },
     [](const Sample& r) { return r.involutions.H; }},
    {"involution_J", "-", "largest J - det F (monitor.involutions, pFJ | pFHJ)",
     [](const Simulation& s) { return watches_involutions(s) && carries_J(s); },
     [](const Sample& r) { return r.involutions.J; }},
    {"min_tet_ratio", "-", "least deformed over undeformed volume of a tet; below 0: inside out (monitor.geometry)",
     watches_geometry, [](const Sample& r) { return r.extrema.min_tet_ratio; }},
    {"min_detF_over_J", "-", "how far det F has parted from the carried J (monitor.geometry, pFJ | pFHJ)",
     [](const Simulation& s) { return watches_geometry(s) && carries_J(s); },
     [](const Sample& r) { return r.extrema.min_detF_over_J; }},
    {"max_detF_over_J", "-", "the same, largest (monitor.geometry, pFJ | pFHJ)",
     [](const Simulation& s) { return watches_geometry(s) && carries_J(s); },
     [](const Sample& r) { return r.extrema.max_detF_over_J; }},
    {"projection_iterations", "1/stage", "iterations of the pressure's solver in the last step (pFp)", projects,
     [](const Sample& r) { return 0.5 * static_cast<double>(r.s.state.projection.step_iterations); }},
    {"projection_residual", "-", "volume constraint left over, share of the velocity gradient (pFp)", projects,
     [](const Sample& r) { return r.s.state.projection.residual; }},
};

Sample sample(const Simulation& s) {
  const Seen now = seen(s);
  Sample r{s, now.energies, momenta(s), now.extrema, {}, {}};
  if (watches_entropy(s)) r.entropy = entropy_production(s);
  if (watches_involutions(s)) r.involutions = involutions(s);
  return r;
}

void add_reactions(const Simulation& s, std::vector<HistoryColumn>& columns) {
  for (std::size_t face = 0; face < s.domain.boundary.held_faces.size(); ++face)
    for (std::size_t k = 0; k < 3; ++k)
      columns.push_back({fmt::format("reaction_{}_{}", s.domain.boundary.held_faces[face], "xyz"[k]), "N",
                         [face, k](const Sample& r) { return reaction(r.s, static_cast<int>(face))[k]; }});
}

void add_probes(const std::vector<Probe>& probes, std::vector<HistoryColumn>& columns) {
  for (const Probe& p : probes)
    for (const std::string& name : p.spec.fields) {
      const Field& f = field_named(name);
      for (int c = 0; c < f.components; ++c)
        columns.push_back({fmt::format("{}_{}{}", p.spec.name, name, component_ending(f, c)), std::string(f.unit),
                           [&f, c, place = p.place](const Sample& r) {
                             double v[9];
                             probe(r.s, place, f, v);
                             return v[c];
                           }});
    }
}

}  // namespace

std::span<const ColumnKind> column_kinds() { return table; }

std::vector<Probe> place_probes(const Scene& scene, const Mesh& mesh) {
  std::vector<Probe> probes;
  for (const ProbeSpec& p : scene.output.probes) probes.push_back({p, place_probe(mesh, p.at)});
  return probes;
}

std::vector<HistoryColumn> history_columns(const Simulation& s, const std::vector<Probe>& probes) {
  std::vector<HistoryColumn> columns;
  for (const ColumnKind& c : table)
    if (!c.has || c.has(s)) columns.push_back({std::string(c.name), std::string(c.unit), c.value});
  add_reactions(s, columns);
  add_probes(probes, columns);
  return columns;
}

std::vector<double> history_row(const Simulation& s, const std::vector<HistoryColumn>& columns) {
  const Sample r = sample(s);
  std::vector<double> row;
  for (const HistoryColumn& c : columns) row.push_back(c.value(r));
  return row;
}

}  // namespace nanson
