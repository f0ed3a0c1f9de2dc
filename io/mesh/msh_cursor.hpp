// Walks through the bytes of a .msh file, text or binary, and knows where it is when something is wrong.
#pragma once
#include <charconv>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace nanson {

/// What is wrong with a .msh file; starts with the place: "12: ..." (line) or " byte 345: ...".
struct MshError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class MshCursor {
 public:
  explicit MshCursor(std::string_view bytes)
      : begin_(bytes.data()), at_(begin_), token_(begin_), end_(begin_ + bytes.size()) {}

  /// Whether read() takes binary values; names and headings are always text.
  bool binary = false;

  /// The next value, stored as OnDisk where the file is binary. Integers are widened: tags beyond 2^31 occur in text files.
  template <class OnDisk>
  auto read() {
    using Value = std::conditional_t<std::is_integral_v<OnDisk>, std::int64_t, OnDisk>;
    if (!binary) return number<Value>();
    token_ = at_;
    if (std::size_t(end_ - at_) < sizeof(OnDisk)) fail_at_end();
    OnDisk value;
    std::memcpy(&value, at_, sizeof value);
    at_ += sizeof value;
    return Value(value);
  }

  /// The next value as text, in both kinds of file.
  template <class Value>
  Value number() {
    skip_space();
    Value value{};
    const auto [stop, problem] = std::from_chars(at_, end_, value);
    if (problem != std::errc{} || (stop != end_ && !is_space(*stop))) fail_number(std::is_integral_v<Value>);
    at_ = stop;
    return value;
  }

  /// A count of items that each take at least so many bytes, checked against what the file can still hold.
  template <class OnDisk>
  std::size_t count(std::string_view what, std::size_t text_bytes, std::size_t binary_bytes) {
    return checked_count(read<OnDisk>(), what, binary ? binary_bytes : text_bytes);
  }
  std::size_t checked_count(std::int64_t count, std::string_view what, std::size_t bytes) const;

  bool at_end();  // nothing but white space is left
  std::string_view word();
  std::string_view rest_of_line();  // and steps over its end
  void end_of_line();               // nothing else may follow on this line: binary data starts right after it
  void expect(std::string_view word);
  void skip_past(std::string_view line);  // to the end of the next line that starts with these characters
  [[noreturn]] void fail(const std::string& what) const;  // at the token read last

 private:
  static bool is_space(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }
  void skip_space() {
    while (at_ != end_ && is_space(*at_)) ++at_;
    token_ = at_;
  }
  [[noreturn]] void fail_at_end() const;
  [[noreturn]] void fail_number(bool whole) const;

  const char *begin_, *at_, *token_, *end_;
};

}  // namespace nanson
