// History: time, energies, momenta, extrema, reactions by named face, probes.
#include "engine/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "engine/book_stage.hpp"
#include "engine/monitor.hpp"

namespace nanson {
namespace {

constexpr const char* axis[] = {"x", "y", "z"};

/// Components of a field in a column's name: none, x y z, or 11 12 ... 33.
std::string component(const FieldName& f, int c) {
  if (f.components == 1) return "";
  if (f.components == 3) return fmt::format("_{}", axis[c]);
  return fmt::format("_{}{}", c / 3 + 1, c % 3 + 1);
}

void add_monitor_columns(const Scene& scene, std::vector<HistoryColumn>& c) {
  const MonitorSpec& m = scene.monitor;
  const Formulation f = scene.physics.formulation;
  if (m.entropy) c.insert(c.end(), {{"entropy_min", "W"}, {"entropy_sum", "W"}, {"entropy_negative_share", "-"}});
  if (m.involutions) c.push_back({"involution_F", "-"});
  if (m.involutions && f == Formulation::pFHJ) c.push_back({"involution_H", "-"});
  if (m.involutions && evolves_J(f)) c.push_back({"involution_J", "-"});
  if (m.geometry != GeometryWatch::off) c.push_back({"min_tet_ratio", "-"});
  if (m.geometry != GeometryWatch::off && evolves_J(f))
    c.insert(c.end(), {{"min_detF_over_J", "-"}, {"max_detF_over_J", "-"}});
}

void add_monitor_values(const Simulation& s, std::vector<double>& row) {
  const MonitorSpec& m = s.domain.scene->monitor;
  const Formulation f = s.domain.scene->physics.formulation;
  if (m.entropy) {
    const EntropyProduction e = entropy_production(s);
    row.insert(row.end(), {e.least, e.total, e.negative_share});
  }
  if (m.involutions) {
    const Involutions i = involutions(s);
    row.push_back(i.F);
    if (f == Formulation::pFHJ) row.push_back(i.H);
    if (evolves_J(f)) row.push_back(i.J);
  }
  if (m.geometry == GeometryWatch::off) return;
  const Extrema& x = seen(s).extrema;
  row.push_back(x.min_tet_ratio);
  if (evolves_J(f)) row.insert(row.end(), {x.min_detF_over_J, x.max_detF_over_J});
}

}  // namespace

const FieldName& field_named(std::string_view name) {
  const auto at = std::find_if(field_names.begin(), field_names.end(),
                               [&](const FieldName& f) { return f.name == name; });
  if (at == field_names.end()) throw std::invalid_argument("no field is called " + std::string(name));
  return *at;
}

std::vector<Probe> place_probes(const Scene& scene, const Mesh& mesh) {
  std::vector<Probe> probes;
  for (const ProbeSpec& p : scene.output.probes) probes.push_back({p, place_probe(mesh, p.at)});
  return probes;
}

std::vector<HistoryColumn> history_columns(const Simulation& s, const std::vector<Probe>& probes) {
  std::vector<HistoryColumn> c{{"step", "-"}, {"t", "s"}, {"dt", "s"}, {"kinetic", "J"}, {"strain", "J"}};
  if (s.domain.scene->monitor.energy)
    c.insert(c.end(), {{"external_work", "J"}, {"dissipated", "J"}, {"closure", "-"}});
  if (s.domain.scene->monitor.energy && s.domain.scene->physics.keep_angular_momentum)
    c.push_back({"angular_momentum_work", "J"});
  for (const char* k : axis) c.push_back({fmt::format("momentum_{}", k), "kg m/s"});
  for (const char* k : axis) c.push_back({fmt::format("angular_momentum_{}", k), "kg m^2/s"});
  c.insert(c.end(), {{"min_detF", "-"}, {"max_detF", "-"}, {"min_J", "-"}, {"max_J", "-"}, {"max_speed", "m/s"}});
  if (!s.state.plastic.empty()) c.push_back({"max_plastic_strain", "-"});
  add_monitor_columns(*s.domain.scene, c);
  if (s.domain.scene->physics.formulation == Formulation::pFp)
    c.insert(c.end(), {{"projection_iterations", "1/stage"}, {"projection_residual", "-"}});
  for (const std::string& face : s.domain.boundary.held_faces)
    for (const char* k : axis) c.push_back({fmt::format("reaction_{}_{}", face, k), "N"});
  for (const Probe& p : probes)
    for (const std::string& name : p.spec.fields) {
      const FieldName& f = field_named(name);
      for (int k = 0; k < f.components; ++k)
        c.push_back({fmt::format("{}_{}{}", p.spec.name, name, component(f, k)), std::string(f.unit)});
    }
  return c;
}

std::vector<double> history_row(const Simulation& s, const std::vector<Probe>& probes) {
  const auto [e, x] = seen(s);
  const Momenta m = momenta(s);
  std::vector<double> row{static_cast<double>(s.state.step), s.state.t, s.state.dt, e.kinetic, e.strain};
  if (s.domain.scene->monitor.energy)
    row.insert(row.end(), {s.books.external_work, s.books.dissipated, energy_closure(s, e)});
  if (s.domain.scene->monitor.energy && s.domain.scene->physics.keep_angular_momentum)
    row.push_back(s.books.angular_momentum_work);
  row.insert(row.end(), m.linear.begin(), m.linear.end());
  row.insert(row.end(), m.angular.begin(), m.angular.end());
  row.insert(row.end(), {x.min_detF, x.max_detF, x.min_J, x.max_J, x.max_speed});
  if (!s.state.plastic.empty()) row.push_back(x.max_plastic_strain);
  add_monitor_values(s, row);
  if (s.domain.scene->physics.formulation == Formulation::pFp)
    row.insert(row.end(), {0.5 * static_cast<double>(s.state.projection.step_iterations), s.state.projection.residual});
  for (std::size_t face = 0; face < s.domain.boundary.held_faces.size(); ++face) {
    const Vec3 R = reaction(s, static_cast<int>(face));
    row.insert(row.end(), R.begin(), R.end());
  }
  for (const Probe& p : probes)
    for (const std::string& name : p.spec.fields) {
      double v[9];
      const FieldName& f = field_named(name);
      probe(s, p.place, f, v);
      row.insert(row.end(), v, v + f.components);
    }
  return row;
}

}  // namespace nanson
