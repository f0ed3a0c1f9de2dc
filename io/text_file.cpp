// Looks before it reads: opening a folder succeeds.
#include "io/text_file.hpp"

#include <fstream>

namespace nanson {

std::optional<std::string> read_text_file(const std::filesystem::path& file, std::string& why) {
  namespace fs = std::filesystem;
  std::error_code error;
  why.clear();
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) why = "no such file";
  else if (!fs::is_regular_file(status)) why = "is not a file";
  if (!why.empty()) return std::nullopt;
  const std::uintmax_t size = fs::file_size(file, error);
  std::string text(error ? 0 : size, '\0');
  std::ifstream in(file, std::ios::binary);
  if (in.read(text.data(), static_cast<std::streamsize>(text.size())) && !error) return text;
  why = "cannot be read";
  return std::nullopt;
}

}  // namespace nanson
