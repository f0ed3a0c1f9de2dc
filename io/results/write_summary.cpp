// The summary as JSON, in the order of its table.
#include "io/results/write_summary.hpp"

#include <nlohmann/json.hpp>

#include "io/replace_file.hpp"

namespace nanson {
namespace {

using Json = nlohmann::ordered_json;  // keeps the order; writes what is not finite as null

Json json(const SummaryValue& value) {
  return std::visit(
      [](const auto& v) -> Json {
        if constexpr (std::is_same_v<std::decay_t<decltype(v)>, std::monostate>) return nullptr;
        else return v;
      },
      value);
}

/// "energy.closure": closure in the object energy.
Json& place(Json& root, std::string_view name) {
  const std::size_t dot = name.find('.');
  Json& here = root[std::string(name.substr(0, dot))];
  return dot == name.npos ? here : place(here, name.substr(dot + 1));
}

/// By name, so that a study can ask for sweeps.NAME and setup.NAME; one that is listed twice counts once, with the sum.
Json times(const std::vector<SweepTime>& sweeps) {
  std::map<std::string, double> seconds;
  for (const auto& sweep : sweeps) seconds[sweep.sweep] += sweep.seconds;
  return seconds;
}

}  // namespace

std::string summary_json(const Summary& s, const Provenance& from) {
  Json root;
  for (const SummaryEntry& entry : summary_entries()) {
    const SummaryValue value = entry.value(s);
    if (!std::holds_alternative<std::monostate>(value)) place(root, entry.name) = json(value);
  }
  root["probes"] = s.probes;
  root["setup"] = times(s.setup);
  root["sweeps"] = times(s.sweeps);
  root["provenance"] = {{"version", from.version}, {"commit", from.commit}, {"compiler", from.compiler},
                        {"flags", from.flags},     {"cpu", from.cpu},       {"host", from.host}};
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::vector<std::string> summary_numbers() {
  std::vector<std::string> names;
  for (const SummaryEntry& entry : summary_entries())
    if (!entry.unit.empty()) names.emplace_back(entry.name);
  return names;
}

void write_summary(const std::filesystem::path& path, const Summary& summary, const Provenance& from) {
  replace_file(path, summary_json(summary, from));
}

}  // namespace nanson
