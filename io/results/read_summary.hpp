// summary.json and history.csv read back, for verdicts and tables.
#pragma once
#include <filesystem>
#include <optional>
#include <string_view>

#include "io/study/verdict.hpp"

namespace nanson {

/// JSON flattened to dotted names; nothing when it is not whole, valid JSON.
std::optional<RunSummary> parse_summary(std::string_view json);
std::optional<RunSummary> read_summary(const std::filesystem::path& file);

/// Empty columns where there is no file, or no such column.
RunHistory read_history(const std::filesystem::path& file);

}  // namespace nanson
