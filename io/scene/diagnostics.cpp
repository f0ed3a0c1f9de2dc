// Places, shown values and the sorted list of errors.
#include "io/scene/diagnostics.hpp"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "io/scene/words.hpp"

namespace nanson {

namespace {

constexpr std::size_t longest_shown = 72;

/// As toml++ prints it, but doubles as short as they can be told apart (0.41, not 0.40999999999999998).
std::string printed(const toml::node& node) {
  if (const auto* number = node.as_floating_point()) return fmt::format("{:#}", number->get());
  if (const auto* list = node.as_array()) {
    std::vector<std::string> entries;
    for (const toml::node& entry : *list) entries.push_back(printed(entry));
    return fmt::format("[{}]", join_words(entries, ", "));
  }
  std::ostringstream out;
  out << toml::toml_formatter{node, toml::format_flags::allow_unicode_strings};
  std::string text = out.str();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace

std::string source_of_setting(long number) { return std::to_string(number); }

Place place_of(const toml::source_region& source) {
  Place p;
  if (source.path) p.setting = std::stol(*source.path);
  if (source.begin) {
    p.line = source.begin.line;
    p.column = source.begin.column;
  }
  return p;
}

std::string where(const Diagnostics& d, const Place& place) {
  return place.setting ? fmt::format("--set #{}", place.setting)
                       : fmt::format("{}:{}:{}", d.file, place.line, place.column);
}

std::string shown(const toml::node& node) {
  std::string text = printed(node);
  if (text.size() <= longest_shown) return text;
  std::size_t cut = longest_shown;
  while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xC0) == 0x80) --cut;  // never inside a UTF-8 sequence
  return text.substr(0, cut) + " ...";
}

std::string shown_key(std::string_view key) {
  if (is_plain(key)) return std::string(key);
  return shown(toml::value<std::string>{std::string(key)});
}

void report(Diagnostics& d, const Place& place, std::string text) { d.found.emplace_back(place, std::move(text)); }

void report(Diagnostics& d, const Place& place, const std::string& path, const toml::node& found,
            std::string_view why) {
  d.wrong.insert(path);
  const bool tables = found.is_table() || found.is_array_of_tables();
  report(d, place, tables ? fmt::format("{}: {}", path, why) : fmt::format("{} = {}: {}", path, shown(found), why));
}

void report(Diagnostics& d, const toml::node& found, const std::string& path, std::string_view why) {
  report(d, place_of(found.source()), path, found, why);
}

void report(Diagnostics& d, const Word& word, std::string_view why) {
  report(d, word.place, word.path, toml::value<std::string>{word.text}, why);
}

std::vector<std::string> listed(Diagnostics d) {
  std::stable_sort(d.found.begin(), d.found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> lines;
  for (const auto& [place, text] : d.found) lines.push_back(fmt::format("{}: {}", where(d, place), text));
  return lines;
}

}  // namespace nanson
