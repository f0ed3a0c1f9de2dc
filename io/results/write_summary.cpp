// The summary as a table of toml++, which knows how to print JSON, all but null.
#include "io/results/write_summary.hpp"

#include <toml++/toml.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "io/replace_file.hpp"

namespace nanson {
namespace {

/// TOML has no null: NaN stands for it in the table, and `nulls` makes it one in the text.
double number(std::optional<double> value) {
  return value && std::isfinite(*value) ? *value : std::numeric_limits<double>::quiet_NaN();
}

/// Replaces NaN outside strings, where nothing but a number can be spelt so.
std::string nulls(const std::string& json) {
  std::string out;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    if (in_string && json[i] == '\\') out += json[i++];
    else if (json[i] == '"') in_string = !in_string;
    if (!in_string && json.compare(i, 3, "NaN") == 0) {
      out += "null";
      i += 2;
    } else {
      out += json[i];
    }
  }
  return out;
}

toml::array list(const std::vector<std::string>& texts) {
  toml::array array;
  for (const auto& text : texts) array.push_back(text);
  return array;
}

toml::array list(const std::vector<double>& values) {
  toml::array array;
  for (const double value : values) array.push_back(number(value));
  return array;
}

toml::table energy_table(const EnergySummary& e) {
  return toml::table{{"initial", number(e.initial)},       {"kinetic", number(e.kinetic)},
                     {"strain", number(e.strain)},         {"external_work", number(e.external_work)},
                     {"dissipated", number(e.dissipated)}, {"angular_momentum_work", number(e.angular_momentum_work)},
                     {"closure", number(e.closure)},       {"lost_at_start", number(e.lost_at_start)}};
}

toml::table probes_table(const std::map<std::string, std::map<std::string, std::vector<double>>>& probes) {
  toml::table table;
  for (const auto& [probe, fields] : probes) {
    toml::table values;
    for (const auto& [field, components] : fields) values.insert(field, list(components));
    table.insert(probe, std::move(values));
  }
  return table;
}

/// By name, so that a study can ask for sweeps.NAME and setup.NAME; one that is listed twice counts once, with the sum.
toml::table times_table(const std::vector<SweepTime>& sweeps) {
  std::map<std::string, double> seconds;
  for (const auto& sweep : sweeps) seconds[sweep.sweep] += sweep.seconds;
  toml::table table;
  for (const auto& [name, value] : seconds) table.insert(name, number(value));
  return table;
}

toml::table provenance_table(const Provenance& from) {
  return toml::table{{"version", from.version}, {"commit", from.commit}, {"compiler", from.compiler},
                     {"flags", from.flags},     {"cpu", from.cpu},       {"host", from.host}};
}

toml::table extremes_table(const Extremes& e) {
  const auto entry = [](const Extreme& x) { return toml::table{{"value", number(x.value)}, {"t", number(x.t)}}; };
  return toml::table{{"least_tet_ratio", entry(e.least_tet_ratio)},
                     {"least_detF", entry(e.least_detF)},
                     {"most_detF", entry(e.most_detF)},
                     {"least_detF_over_J", entry(e.least_detF_over_J)},
                     {"most_detF_over_J", entry(e.most_detF_over_J)},
                     {"checkerboard", entry(e.checkerboard)},
                     {"speed", entry(e.speed)}};
}

/// Empty without a projection.
toml::table projection_table(const std::optional<ProjectionSummary>& p) {
  if (!p) return {};
  return toml::table{{"solver", p->solver},
                     {"stabilisation", number(p->stabilisation)},
                     {"drift_control", number(p->drift_control)},
                     {"tolerance", number(p->tolerance)},
                     {"iterations", p->iterations},
                     {"iterations_per_stage", number(p->iterations_per_stage)},
                     {"solves_per_stage", number(p->solves_per_stage)},
                     {"residual", number(p->residual)},
                     {"closed", p->closed}};
}

/// Empty where the model does not count.
toml::table throughput_table(const std::optional<Throughput>& t) {
  if (!t) return {};
  return toml::table{{"bytes_per_node_step", number(t->bytes_per_node_step)},
                     {"flops_per_node_step", number(t->flops_per_node_step)},
                     {"GB_s", number(t->GB_s)},
                     {"GF_s", number(t->GF_s)},
                     {"update_GB_s", number(t->update_GB_s)},
                     {"bandwidth_share", number(t->bandwidth_share)}};
}

std::optional<double> peak_per_node(const Summary& s) {
  if (!s.peak_bytes || s.nodes == 0) return std::nullopt;
  return *s.peak_bytes / static_cast<double>(s.nodes);
}

void collect_numbers(const toml::table& table, const std::string& before, std::vector<std::string>& keys) {
  for (auto&& [key, node] : table) {
    const std::string name = before + std::string(key.str());
    if (node.is_number()) keys.push_back(name);
    else if (const auto* inner = node.as_table()) collect_numbers(*inner, name + ".", keys);
  }
}

toml::table summary_table(const Summary& s, const Provenance& from) {
  toml::table table{{"status", s.status},
                    {"reason", s.reason},
                    {"cause", s.cause},
                    {"scene", s.scene},
                    {"formulation", s.formulation},
                    {"material", s.material},
                    {"description", s.description},
                    {"stabilisation", s.stabilisation},
                    {"reconstruction", s.reconstruction},
                    {"flux_correction", s.flux_correction},
                    {"boundary_flux", s.boundary_flux},
                    {"upwind_metric", s.upwind_metric},
                    {"pressure_jump", s.pressure_jump},
                    {"parting", number(s.parting)},
                    {"integrator", s.integrator},
                    {"step", s.step},
                    {"split", s.split},
                    {"nodes", s.nodes},
                    {"tets", s.tets},
                    {"edges", s.edges},
                    {"steps", s.steps},
                    {"t_end", number(s.t_end)},
                    {"dt_min", number(s.dt_min)},
                    {"dt_max", number(s.dt_max)},
                    {"threads", s.threads},
                    {"wall_s", number(s.wall_s)},
                    {"cpu_s", number(s.cpu_s)},
                    {"setup_s", number(s.setup_s)},
                    {"ns_per_node_step", number(s.ns_per_node_step)},
                    {"bytes_per_node", number(s.bytes_per_node)},
                    {"peak_bytes", number(s.peak_bytes)},
                    {"peak_bytes_per_node", number(peak_per_node(s))},
                    {"fields_left_out", list(s.fields_left_out)},
                    {"state_hash", s.state_hash},
                    {"energy", energy_table(s.energy)},
                    {"mass", number(s.mass)},
                    {"volume", number(s.volume)},
                    {"keep_angular_momentum", s.keep_angular_momentum},
                    {"angular_momentum_drift", number(s.angular_momentum_drift)},
                    {"linear_momentum_drift", number(s.linear_momentum_drift)},
                    {"min_detF", number(s.min_detF)},
                    {"max_detF", number(s.max_detF)},
                    {"probes", probes_table(s.probes)},
                    {"setup", times_table(s.setup)},
                    {"sweeps", times_table(s.sweeps)},
                    {"provenance", provenance_table(from)}};
  table.insert("checkerboard", number(s.checkerboard));
  table.insert("extremes", extremes_table(s.extremes));
  table.insert("warnings", list(s.warnings));
  table.insert("projection", projection_table(s.projection));
  table.insert("throughput", throughput_table(s.throughput));
  toml::table errors;
  for (const auto& [name, value] : s.errors) errors.insert(name, number(value));
  table.insert("errors", std::move(errors));
  return table;
}

}  // namespace

std::string summary_json(const Summary& summary, const Provenance& from) {
  const auto table = summary_table(summary, from);
  const auto flags = toml::json_formatter::default_flags & ~toml::format_flags::quote_infinities_and_nans;
  std::ostringstream text;
  text << toml::json_formatter{table, flags} << '\n';
  return nulls(text.str());
}

std::vector<std::string> summary_number_keys() {
  Summary all;
  all.projection.emplace();
  all.throughput.emplace();
  for (const char* name : error_names) all.errors[name] = 0;
  std::vector<std::string> keys;
  collect_numbers(summary_table(all, {}), "", keys);
  return keys;
}

void write_summary(const std::filesystem::path& path, const Summary& summary, const Provenance& from) {
  replace_file(path, summary_json(summary, from));
}

}  // namespace nanson
