// Comma-separated tables with a heading, as our own writers and peers' tables have them: quotes and # comment lines, no line breaks inside a field.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nanson {

struct CsvTable {
  std::vector<std::string> names;              // units, " [m]", cut off
  std::vector<std::vector<std::string>> rows;  // as long as names

  std::optional<std::size_t> column(std::string_view name) const;
  /// The column as numbers, "nan" included; empty when there is none of that name.
  std::vector<double> numbers(std::string_view name) const;
};

/// A last line without its end, which a killed run may leave, is left out. Nothing, with the reason, when a row has another number of fields.
std::optional<CsvTable> parse_csv(std::string_view text, std::string& why);
std::optional<CsvTable> read_csv(const std::filesystem::path& file, std::string& why);

/// A field, quoted where it needs to be; one that a spreadsheet would take for a formula gets an apostrophe before it.
std::string csv_text(std::string text);

}  // namespace nanson
