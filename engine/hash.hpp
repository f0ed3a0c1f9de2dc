// FNV-1a, 64 bits: the hash of states and of texts.
#pragma once
#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace nanson {

class Hash {
 public:
  void add(const void* bytes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) h_ = (h_ ^ static_cast<const unsigned char*>(bytes)[i]) * 1099511628211ull;
  }
  std::string text() const { return fmt::format("{:016x}", h_); }  // 16 hexadecimal digits

 private:
  std::uint64_t h_ = 14695981039346656037ull;
};

}  // namespace nanson
