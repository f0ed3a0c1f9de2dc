// `nanson study`: all runs of a study one after another, resumed where it stopped, then tables, plots and a page.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace nanson {

/// Exit code: 0 all runs have a verdict, 2 with `errors` the study or one of its scenes is wrong, 128 + n ended by signal n (the same command goes on from there).
int run_study(const std::filesystem::path& file, const std::optional<std::filesystem::path>& out,
              std::vector<std::string>& errors);

}  // namespace nanson
