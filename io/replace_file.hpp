// A text file that is either the old one or the new one, never half of it.
#pragma once
#include <filesystem>
#include <string_view>

namespace nanson {

/// Writes `path`.tmp and renames it to `path`. Throws std::runtime_error that names the file and the reason; the old file then stands as it was.
void replace_file(const std::filesystem::path& path, std::string_view text);

}  // namespace nanson
