// VmHWM of /proc/self/status, which starts anew with every program.
#include "io/peak_memory.hpp"

#include <cstdlib>
#include <fstream>
#include <string>

namespace nanson {

std::optional<double> peak_bytes() {
  constexpr std::string_view key = "VmHWM:";
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(key)) return 1024 * std::strtod(line.c_str() + key.size(), nullptr);
  return std::nullopt;
}

}  // namespace nanson
