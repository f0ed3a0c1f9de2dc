// Two trees of TOML, flattened.
#include "io/scene/scene_changes.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <map>
#include <sstream>

#include "io/scene/scene_keys.hpp"

namespace nanson {
namespace {

using Values = std::map<std::string, std::string>;

bool holds_tables(const toml::array& list) {
  return std::ranges::any_of(list, [](const toml::node& n) { return n.is_table(); });
}

/// As numbers are, 1 and 1.0 alike.
std::string text_of(const toml::node& node) {
  if (const auto number = node.value<double>(); number && node.is_number()) return fmt::format("{}", *number);
  if (const auto* word = node.as_string()) return fmt::format("\"{}\"", word->get());
  if (const auto* list = node.as_array()) {
    std::string text;
    for (const toml::node& entry : *list) text += (text.empty() ? "" : ", ") + text_of(entry);
    return fmt::format("[{}]", text);
  }
  std::ostringstream text;
  node.visit([&](const auto& value) { text << value; });
  return text.str();
}

void flatten(const toml::node& node, const std::string& path, Values& out) {
  const std::string before = path.empty() ? "" : path + ".";
  if (const auto* table = node.as_table()) {
    for (const auto& [key, entry] : *table) flatten(entry, before + std::string(key.str()), out);
  } else if (const auto* list = node.as_array(); list && holds_tables(*list)) {
    for (std::size_t i = 0; i < list->size(); ++i) flatten((*list)[i], before + std::to_string(i), out);
  } else {
    out[path] = text_of(node);
  }
}

Values values_of(const std::string& resolved) {
  Values out;
  flatten(toml::parse(resolved), "", out);
  return out;
}

/// "boundary.0.pressure" -> "boundary.pressure".
std::string without_numbers(const std::string& path) {
  std::string out;
  std::istringstream parts(path);
  for (std::string part; std::getline(parts, part, '.');)
    if (part.find_first_not_of("0123456789") != part.npos) out += (out.empty() ? "" : ".") + part;
  return out;
}

/// What a key that is not written stands for; empty where it has no default.
std::string default_of(const std::string& path) {
  const std::string name = without_numbers(path);
  for (const Key& key : scene_keys)
    if (key.path == name && key.value.initial && !key.rules.required)
      return values_of("v = " + key.value.initial())["v"];
  return "";
}

}  // namespace

std::vector<KeyChange> scene_changes(const std::string& before, const std::string& after) {
  Values old_values = values_of(before);
  const Values new_values = values_of(after);
  for (const auto& [key, value] : new_values) old_values.try_emplace(key, default_of(key));
  std::vector<KeyChange> changes;
  for (const auto& [key, value] : old_values) {
    const auto at = new_values.find(key);
    const std::string now = at == new_values.end() ? default_of(key) : at->second;
    if (now != value) changes.push_back({key, value, now});
  }
  return changes;
}

bool may_change_at_restart(std::string_view key) {
  constexpr std::array keys{
      "scene",          "time.end",        "time.cfl",         "time.dt_max",           "time.dt_collapse",
      "time.max_steps", "time.max_wall_s", "monitor.geometry", "monitor.energy_growth", "monitor.energy_tolerance"};
  return key.starts_with("output.") || std::ranges::find(keys, key) != keys.end();
}

std::string change_text(const KeyChange& c) {
  const auto shown = [](const std::string& value) { return value.empty() ? std::string("not written") : value; };
  return fmt::format("{}: {} -> {}", c.key, shown(c.before), shown(c.after));
}

}  // namespace nanson
