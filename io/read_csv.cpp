// Line by line, field by field.
#include "io/read_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "io/print.hpp"
#include "io/text_file.hpp"

namespace nanson {
namespace {

std::vector<std::string> fields_of(std::string_view line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') fields.back() += line[i++];
    else if (line[i] == '"') quoted = !quoted;
    else if (line[i] == ',' && !quoted) fields.emplace_back();
    else if (line[i] != '\r') fields.back() += line[i];
  }
  return fields;
}

bool is_number(const std::string& text) {
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return end == text.c_str() + text.size();
}

}  // namespace

std::optional<std::size_t> CsvTable::column(std::string_view name) const {
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end()) return std::nullopt;
  return static_cast<std::size_t>(at - names.begin());
}

std::vector<double> CsvTable::numbers(std::string_view name) const {
  std::vector<double> values;
  if (const auto c = column(name))
    for (const auto& row : rows) values.push_back(std::strtod(row[*c].c_str(), nullptr));
  return values;
}

std::optional<CsvTable> parse_csv(std::string_view text, std::string& why) {
  CsvTable table;
  for (long number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) break;
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 1);
    if (line.empty() || line.front() == '#') continue;
    std::vector<std::string> fields = fields_of(line);
    if (table.names.empty()) {
      for (std::string& name : fields) table.names.push_back(name.substr(0, name.rfind(" [")));
    } else if (fields.size() == table.names.size()) {
      table.rows.push_back(std::move(fields));
    } else {
      why = fmt::format("line {} has {} fields, the heading {}", number, fields.size(), table.names.size());
      return std::nullopt;
    }
  }
  if (!table.names.empty()) return table;
  why = "has no heading";
  return std::nullopt;
}

std::optional<CsvTable> read_csv(const std::filesystem::path& file, std::string& why) {
  const auto text = read_text_file(file, why);
  return text ? parse_csv(*text, why) : std::nullopt;
}

std::string csv_text(std::string text) {
  if (!text.empty() && std::string_view("=+-@\t\r").find(text[0]) != std::string_view::npos && !is_number(text))
    text = '\'' + text;
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\r' || c == '\n' || c == '\t'; }, ' ');
  text = printable(text);
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

}  // namespace nanson
