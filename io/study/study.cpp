// Expansion of cases and varied values into runs, and their neighbourhood.
#include "io/study/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "engine/hash.hpp"

namespace nanson {
namespace {

void label(PlannedRun& run, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) {
    const std::string value = readable(run.varied.at(key));
    run.label += fmt::format("{}{}", run.label.empty() ? "" : ", ",
                             key == "case" ? value : fmt::format("{} = {}", key, value));
  }
  if (run.label.empty()) run.label = "as it stands";
}

std::vector<PlannedRun> start_of(const Study& study) {
  std::vector<PlannedRun> runs;
  for (const StudyCase& c : study.cases) {
    PlannedRun run{{}, c.scene.empty() ? study.scene : c.scene, study.set, {{"case", c.name}}};
    run.settings.insert(run.settings.end(), c.settings.begin(), c.settings.end());
    runs.push_back(std::move(run));
  }
  if (runs.empty()) runs.push_back({{}, study.scene, study.set, {}});
  return runs;
}

}  // namespace

std::vector<std::string> varied_keys(const Study& study) {
  std::vector<std::string> keys;
  if (!study.cases.empty()) keys.emplace_back("case");
  for (const StudyAxis& axis : study.vary) keys.push_back(axis.key);
  return keys;
}

std::vector<PlannedRun> plan(const Study& study) {
  std::vector<PlannedRun> runs = start_of(study);
  for (const StudyAxis& axis : study.vary) {
    std::vector<PlannedRun> more;
    for (const PlannedRun& run : runs)
      for (const StudySetting& value : axis.values) {
        more.push_back(run);
        more.back().settings.push_back(value);
        more.back().varied[axis.key] = value.value;
      }
    runs = std::move(more);
  }
  const std::vector<std::string> keys = varied_keys(study);
  for (PlannedRun& run : runs) label(run, keys);
  return runs;
}

std::string readable(const std::string& value) {
  const bool quoted = value.size() >= 2 && (value.front() == '"' || value.front() == '\'')
                      && value.back() == value.front();
  return quoted ? value.substr(1, value.size() - 2) : value;
}

std::optional<double> number_in(const std::string& value) {
  const char* from = value.c_str();
  while (*from == '[' || *from == ' ') ++from;
  char* end = nullptr;
  const double number = std::strtod(from, &end);
  if (end == from || !std::isfinite(number)) return std::nullopt;
  return number;
}

std::string name_of(const PlannedRun& run, const std::vector<std::string>& keys) {
  std::string name;
  for (const std::string& key : keys)
    if (const auto at = run.varied.find(key); at != run.varied.end())
      name += fmt::format("{}{}", name.empty() ? "" : ", ", readable(at->second));
  return name;
}

std::vector<int> predecessors(const std::vector<PlannedRun>& runs, const std::string& key) {
  std::vector<int> before(runs.size(), -1);
  std::map<std::map<std::string, std::string>, int> last;  // of each group so far: runs stand in the order of the axis
  for (std::size_t i = 0; i < runs.size(); ++i) {
    std::map<std::string, std::string> group = runs[i].varied;
    if (group.erase(key) == 0) continue;
    const auto [at, is_first] = last.try_emplace(group, static_cast<int>(i));
    if (is_first) continue;
    before[i] = at->second;
    at->second = static_cast<int>(i);
  }
  return before;
}

std::optional<double> observed_rate(double coarse_h, double coarse_error, double fine_h, double fine_error) {
  const bool positive = coarse_h > 0 && fine_h > 0 && coarse_error > 0 && fine_error > 0;
  if (!positive || coarse_h == fine_h || !std::isfinite(coarse_error + fine_error)) return std::nullopt;
  return std::log(coarse_error / fine_error) / std::log(coarse_h / fine_h);
}

std::string text_hash(std::string_view text) {
  Hash hash;
  hash.add(text.data(), text.size());
  return hash.text();
}

}  // namespace nanson
