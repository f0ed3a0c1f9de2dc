// What the writers wrote, read back: numbers and texts under the dotted names of their keys.
#include "io/results/read_summary.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "io/read_csv.hpp"
#include "io/text_file.hpp"

namespace nanson {
namespace {

/// null is left out.
void flatten(const nlohmann::json& value, const std::string& name, RunSummary& out) {
  if (value.is_number()) out.numbers[name] = value.get<double>();
  else if (value.is_string()) out.texts[name] = value.get<std::string>();
  else if (value.is_boolean()) out.texts[name] = value.get<bool>() ? "true" : "false";
  else
    for (const auto& [key, inner] : value.items()) flatten(inner, name.empty() ? key : name + "." + key, out);
}

}  // namespace

std::optional<RunSummary> parse_summary(std::string_view json) {
  const auto read = nlohmann::json::parse(json, nullptr, false);
  if (read.is_discarded()) return std::nullopt;
  RunSummary out;
  flatten(read, "", out);
  return out;
}
std::optional<RunSummary> read_summary(const std::filesystem::path& file) {
  std::string why;
  const auto text = read_text_file(file, why);
  return text ? parse_summary(*text) : std::nullopt;
}

RunHistory read_history(const std::filesystem::path& file) {
  std::string why;
  RunHistory h;
  const auto table = read_csv(file, why);
  if (!table) return h;
  h.t = table->numbers("t");
  h.kinetic = table->numbers("kinetic");
  h.strain = table->numbers("strain");
  h.external_work = table->numbers("external_work");
  h.angular_momentum_work = table->numbers("angular_momentum_work");
  h.min_detF = table->numbers("min_detF");
  h.min_J = table->numbers("min_J");
  h.min_tet_ratio = table->numbers("min_tet_ratio");
  return h;
}

}  // namespace nanson
