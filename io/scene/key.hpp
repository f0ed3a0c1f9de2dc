// A key of an input file, said once: the reader, its errors, `nanson keys`, the schema for editors and completion are made from such tables.
#pragma once
#include <array>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

namespace nanson {

/// Bounds of a number: `above` and `below` exclude their limit, `from` and `to` include it.
struct Range {
  double above = -std::numeric_limits<double>::infinity();
  double below = std::numeric_limits<double>::infinity();
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();

  constexpr bool holds(double v) const { return v > above && v < below && v >= from && v <= to; }
};

enum class KeyType {
  flag,
  whole,
  number,
  text,
  choice,           // one of the words
  whole3,           // three whole numbers
  number3,          // three numbers
  number3_or_mass,  // or "mass"
  number3_or_free,  // or "free" in place of some
  numbers,          // a list
  points,           // a list of pairs
  names,            // a list; of the words where there are some
  name_or_names,    // one or a list
  table,            // a section
  named_tables,     // its keys are names that the user gives, its values tables
  tables,           // a list of them, [[...]]
  table_or_tables,  // either
  settings,         // keys of a scene with values
  variations,       // keys of a scene with lists of values or ranges
  file_or_tables,   // a file's name or a list of tables
};

/// What a key holds: the words of a choice, and the default, which stands in the struct that the key is read into.
struct KeyValue {
  KeyType type;
  std::vector<std::string_view> (*words)() = nullptr;
  std::string (*initial)() = nullptr;  // as TOML writes it, which is JSON too
};

struct KeyRules {
  bool required = false;
  Range range = {};
  std::string_view of = {};       // "twist | punch": the words of the section's kind that have this key; empty: all
  std::string_view example = {};  // of a section: the shape that errors show
  bool one_of = false;            // one of several keys of the section, exactly one of which is written
};

struct Key {
  std::string_view path;  // "material.density"; NAME stands for a name that the user gives
  KeyValue value;
  std::string_view unit;      // "-" without dimension, empty for what is no number
  std::string_view sentence;  // never empty
  KeyRules rules = {};

  constexpr std::string_view name() const { return path.substr(path.rfind('.') + 1); }
  constexpr std::string_view section() const {
    return path.substr(0, path.rfind('.') == path.npos ? 0 : path.rfind('.'));
  }
  /// True when the key belongs to things of this kind, `word`.
  constexpr bool is_of(std::string_view word) const {
    for (std::string_view rest = rules.of; !rest.empty();) {
      const std::size_t bar = rest.find(" | ");
      if (rest.substr(0, bar) == word) return true;
      rest = bar == rest.npos ? std::string_view{} : rest.substr(bar + 3);
    }
    return rules.of.empty();
  }
};

/// The key of that path, for a word of its section's kind where several share the path. Does not compile when there is none.
consteval const Key& find_key(std::span<const Key> keys, std::string_view path, std::string_view of) {
  for (const Key& k : keys)
    if (k.path == path && (of.empty() || k.is_of(of))) return k;
  throw "no such key in the table";
}

/// Every key has its sentence, every number its unit.
consteval bool all_said(std::span<const Key> keys) {
  for (const Key& k : keys) {
    const KeyType t = k.value.type;
    const bool number = (t >= KeyType::whole && t <= KeyType::number) || (t >= KeyType::whole3 && t <= KeyType::points);
    if (k.sentence.empty() || number == k.unit.empty()) return false;
  }
  return true;
}

namespace key_detail {

template <class T>
constexpr KeyType type_of() {
  if constexpr (std::is_same_v<T, bool>) return KeyType::flag;
  else if constexpr (std::is_integral_v<T>) return KeyType::whole;
  else if constexpr (std::is_floating_point_v<T>) return KeyType::number;
  else if constexpr (std::is_enum_v<T>) return KeyType::choice;
  else if constexpr (std::is_same_v<T, std::string>) return KeyType::text;
  else if constexpr (std::is_same_v<T, std::array<int, 3>>) return KeyType::whole3;
  else if constexpr (std::is_same_v<T, std::array<double, 3>>) return KeyType::number3;
  else return KeyType::names;
}

inline std::string text_of(bool value) { return value ? "true" : "false"; }
inline std::string text_of(long value) { return fmt::format("{}", value); }
inline std::string text_of(int value) { return fmt::format("{}", value); }
inline std::string text_of(double value) {
  const std::string text = fmt::format("{}", value);
  return text.find_first_of(".e") == text.npos ? text + ".0" : text;
}
inline std::string text_of(const std::string& value) { return fmt::format("\"{}\"", value); }
template <class Choice>
requires std::is_enum_v<Choice> std::string text_of(Choice value) {
  return fmt::format("\"{}\"", words(value)[static_cast<std::size_t>(value)]);
}
template <class Entries>
requires requires(const Entries& e) { e.begin(); }
std::string text_of(const Entries& entries) {
  std::string text;
  for (const auto& entry : entries) text += (text.empty() ? "" : ", ") + text_of(entry);
  return fmt::format("[{}]", text);
}

template <class Choice>
std::vector<std::string_view> words_of() {
  const auto all = words(Choice{});
  return {all.begin(), all.end()};
}

template <class Struct, class T>
Struct owner(T Struct::*);
template <class Struct, class T>
T held(T Struct::*);

template <auto member>
std::string initial() {
  return text_of(decltype(owner(member)){}.*member);
}

template <auto member>
constexpr KeyValue value() {
  using T = decltype(held(member));
  KeyValue v{type_of<T>(), nullptr, &initial<member>};
  if constexpr (std::is_enum_v<T>) v.words = &words_of<T>;
  return v;
}

}  // namespace key_detail

/// The type, words and default of the struct's member that a key is read into: of<&TimeSpec::cfl>.
template <auto member>
inline constexpr KeyValue of = key_detail::value<member>();

}  // namespace nanson
