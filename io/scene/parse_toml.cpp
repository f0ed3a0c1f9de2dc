// One pass over the text that knows strings and comments, and nothing else of TOML.
#include "io/scene/parse_toml.hpp"

#include <memory>
#include <string>

namespace nanson {
namespace {

constexpr int most_parts = 64;  // of a dotted key

struct Guard {
  std::string_view text;
  std::size_t at = 0, line_start = 0;
  toml::source_index line = 1;

  [[noreturn]] void refuse(const char* why, std::string_view source) const {
    const auto column = static_cast<toml::source_index>(at - line_start + 1);
    throw toml::parse_error(why, toml::source_position{line, column},
                            source.empty() ? nullptr : std::make_shared<const std::string>(source));
  }

  void step() {
    if (text[at++] != '\n') return;
    ++line;
    line_start = at;
  }

  /// Past the string whose opening quote stands here; one line's string ends with its line, the parser says what is wrong.
  void skip_string() {
    const char quote = text[at];
    const bool several = text.substr(at, 3) == std::string(3, quote);
    at += several ? 3 : 1;
    while (at < text.size()) {
      if (text[at] == quote && (!several || text.substr(at, 3) == std::string(3, quote))) {
        at += several ? 3 : 1;
        return;
      }
      if (text[at] == '\n' && !several) return;
      if (text[at] == '\\' && quote == '"' && at + 1 < text.size() && text[at + 1] != '\n') step();
      step();
    }
  }

  void check(std::string_view source) {
    if (text.starts_with("\xef\xbb\xbf")) at = 3;
    int dots = 0;
    while (at < text.size()) {
      const auto c = static_cast<unsigned char>(text[at]);
      if (c == '"' || c == '\'') {
        skip_string();
        continue;
      }
      if (c == '#') {
        while (at < text.size() && text[at] != '\n') step();
        continue;
      }
      if ((c < 0x20 && c != '\n' && c != '\r' && c != '\t') || c >= 0x7f)
        refuse("only printable ASCII may stand outside of strings and comments", source);
      if (c == '.' && ++dots >= most_parts) refuse("a key of more than 64 parts", source);
      if (std::string_view("=,[]{}\n").find(static_cast<char>(c)) != std::string_view::npos) dots = 0;
      step();
    }
  }
};

}  // namespace

toml::table parse_toml(std::string_view text, std::string_view source) {
  Guard{text}.check(source);
  return toml::parse(text, source);
}

}  // namespace nanson
