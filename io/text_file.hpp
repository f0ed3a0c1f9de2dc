// A text file as a whole, or why it cannot be had.
#pragma once
#include <filesystem>
#include <optional>
#include <string>

namespace nanson {

std::optional<std::string> read_text_file(const std::filesystem::path& file, std::string& why);

}  // namespace nanson
