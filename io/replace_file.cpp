// Write, close, rename; the first of the three that fails gives the reason.
#include "io/replace_file.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "io/posix_file.hpp"

namespace nanson {

void replace_file(const std::filesystem::path& path, std::string_view text) {
  auto tmp = path;
  tmp += ".tmp";
  Descriptor file(tmp, O_WRONLY | O_CREAT | O_TRUNC);
  int error = file ? write_all(file.get(), text) : errno;
  if (const int late = file.close(); error == 0) error = late;
  if (error == 0 && std::rename(tmp.c_str(), path.c_str()) != 0) error = errno;
  if (error == 0) return;
  ::unlink(tmp.c_str());
  throw std::runtime_error(fmt::format("{}: could not be written: {}", path.string(), std::strerror(error)));
}

}  // namespace nanson
