// A JSON parser of the size of the grammar: objects, lists, strings, numbers, true, false, null.
#include "io/read_summary.hpp"

#include <fmt/format.h>

#include <charconv>
#include <stdexcept>

#include "io/read_csv.hpp"
#include "io/text_file.hpp"

namespace nanson {
namespace {

struct NotJson : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class JsonReader {
 public:
  JsonReader(std::string_view text, RunSummary& out) : text_(text), out_(out) {}

  void document() {
    value("", 0);
    space();
    if (at_ != text_.size()) fail();
  }

 private:
  [[noreturn]] void fail() const { throw NotJson(fmt::format("not JSON at character {}", at_)); }
  void space() { while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n' || text_[at_] == '\t' || text_[at_] == '\r')) ++at_; }
  char peek() {
    space();
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool take(std::string_view word) {
    if (!text_.substr(at_).starts_with(word)) return false;
    at_ += word.size();
    return true;
  }
  void expect(char c) { if (peek() != c) fail(); else ++at_; }

  void value(const std::string& name, int depth) {
    if (depth > 50) fail();
    const char c = peek();
    if (c == '{') object(name, depth);
    else if (c == '[') list(name, depth);
    else if (c == '"') out_.texts[name] = string();
    else if (take("true")) out_.texts[name] = "true";
    else if (take("false")) out_.texts[name] = "false";
    else if (!take("null")) out_.numbers[name] = number();
  }

  void object(const std::string& name, int depth) {
    expect('{');
    if (peek() == '}') return expect('}');
    do {
      if (peek() != '"') fail();
      const std::string key = string();
      expect(':');
      value(name.empty() ? key : name + "." + key, depth + 1);
    } while (peek() == ',' && ++at_);
    expect('}');
  }

  void list(const std::string& name, int depth) {
    expect('[');
    if (peek() == ']') return expect(']');
    long i = 0;
    do value(fmt::format("{}.{}", name, i++), depth + 1);
    while (peek() == ',' && ++at_);
    expect(']');
  }

  double number() {
    double v = 0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), v);
    if (error != std::errc() || text_.substr(at_, 2).find_first_of("0123456789") == std::string_view::npos) fail();  // from_chars reads nan and inf too
    at_ = static_cast<std::size_t>(end - text_.data());
    return v;
  }

  unsigned hex4() {
    unsigned v = 0;
    if (at_ + 4 > text_.size() || std::from_chars(text_.data() + at_, text_.data() + at_ + 4, v, 16).ptr != text_.data() + at_ + 4) fail();
    at_ += 4;
    return v;
  }

  std::string string() {
    std::string s;
    for (expect('"'); at_ < text_.size() && text_[at_] != '"'; ++at_) {
      if (text_[at_] != '\\') {
        s += text_[at_];
        continue;
      }
      if (++at_ >= text_.size()) fail();
      constexpr std::string_view from = "\"\\/bfnrt", to = "\"\\/\b\f\n\r\t";
      const std::size_t known = from.find(text_[at_]);
      if (known != std::string_view::npos) {
        s += to[known];
      } else if (text_[at_] == 'u') {
        ++at_;
        const unsigned code = hex4();              // our writer escapes control characters only
        s += code < 0x80 ? static_cast<char>(code) : '?';
        --at_;
      } else {
        fail();
      }
    }
    expect('"');
    return s;
  }

  std::string_view text_;
  RunSummary& out_;
  std::size_t at_ = 0;
};

}  // namespace

std::optional<RunSummary> parse_summary(std::string_view json) {
  RunSummary out;
  try {
    JsonReader(json, out).document();
  } catch (const NotJson&) {
    return std::nullopt;
  }
  return out;
}

std::optional<RunSummary> read_summary(const std::filesystem::path& file) {
  std::string why;
  const auto text = read_text_file(file, why);
  return text ? parse_summary(*text) : std::nullopt;
}

RunHistory read_history(const std::filesystem::path& file) {
  std::string why;
  RunHistory h;
  const auto table = read_csv(file, why);
  if (!table) return h;
  h.t = table->numbers("t"), h.kinetic = table->numbers("kinetic"), h.strain = table->numbers("strain");
  h.external_work = table->numbers("external_work"), h.angular_momentum_work = table->numbers("angular_momentum_work");
  h.min_detF = table->numbers("min_detF"), h.min_J = table->numbers("min_J"), h.min_tet_ratio = table->numbers("min_tet_ratio");
  return h;
}

}  // namespace nanson
