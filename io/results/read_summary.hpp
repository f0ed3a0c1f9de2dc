// summary.json and history.csv read back, for verdicts and tables.
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nanson {

/// summary.json flattened: "energy.closure", "probes.tip.x.0"; null is left out.
struct RunSummary {
  std::map<std::string, double> numbers;
  std::map<std::string, std::string> texts;
};

/// The columns of history.csv that a verdict needs; an empty one was not recorded.
struct RunHistory {
  std::vector<double> t;                                                      // [s]
  std::vector<double> kinetic, strain, external_work, angular_momentum_work;  // [J]
  std::vector<double> min_detF, min_J, min_tet_ratio;                         // [-]
};

/// JSON flattened to dotted names; nothing when it is not whole, valid JSON.
std::optional<RunSummary> parse_summary(std::string_view json);
std::optional<RunSummary> read_summary(const std::filesystem::path& file);

/// Empty columns where there is no file, or no such column.
RunHistory read_history(const std::filesystem::path& file);

}  // namespace nanson
