// Strict reader of a TOML table: every key that is asked for is remembered, the rest is an error, and so is a required key that nobody wrote.
#pragma once
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "io/scene/diagnostics.hpp"
#include "io/scene/key.hpp"
#include "io/scene/words.hpp"

namespace nanson {

/// What stands at `node`, read into `value`; false when it is wrong, which is then reported and `value` left alone.
bool read_value(Diagnostics& d, const toml::node& node, const std::string& path, double& value,
                const Range& range = {});
bool read_value(Diagnostics& d, const toml::node& node, const std::string& path, long& value, const Range& range = {});
bool read_value(Diagnostics& d, const toml::node& node, const std::string& path, int& value, const Range& range = {});
bool read_value(Diagnostics& d, const toml::node& node, const std::string& path, std::array<double, 3>& value,
                const Range& range = {});
bool read_value(Diagnostics& d, const toml::node& node, const std::string& path, std::array<int, 3>& value,
                const Range& range = {});
bool read_value(Diagnostics& d, const toml::node& node, const std::string& path, bool& value);
bool read_value(Diagnostics& d, const toml::node& node, const std::string& path, std::string& value);
bool read_value(Diagnostics& d, const toml::node& node, const std::string& path, std::vector<Word>& value);

/// The position of a choice in its list of words, -1 when it is none of them.
int read_word(Diagnostics& d, const toml::node& node, const std::string& path,
              std::span<const std::string_view> allowed);

template <class Choice>
requires std::is_enum_v<Choice>
bool read_value(Diagnostics& d, const toml::node& node, const std::string& path, Choice& value) {
  const auto allowed = words(Choice{});
  const int i = read_word(d, node, path, allowed);
  if (i >= 0) value = static_cast<Choice>(i);
  return i >= 0;
}

/// Keys are remembered when they are asked for, finish() reports what nobody asked for. The helpers below call it.
class Table {
 public:
  Table(const toml::table& entries, std::string path, Diagnostics& diagnostics);

  bool has(std::string_view key) const { return entries_.contains(key); }
  const toml::node* find(std::string_view key);  // nullptr when it is not there
  const toml::node* find(const Key& key);        // the same; an error when it is required
  std::string path(std::string_view key) const;  // "material.density"
  Place place(std::string_view key) const;       // of the value; of the table when the key is not there
  Diagnostics& diagnostics() { return diagnostics_; }

  /// True when nothing was reported at `key` so far, so that its value, or its default, may be reasoned with.
  bool sound(std::string_view key) const { return !diagnostics_.wrong.contains(path(key)); }

  /// Leaves `value`, the default, alone when the key is not there. False when what stands there is wrong, or nothing and it is required.
  template <class T>
  bool read(const Key& key, T& value) {
    const toml::node* node = find(key);
    if (!node) return !key.rules.required;
    if constexpr (requires { read_value(diagnostics_, *node, "", value, Range{}); })
      return read_value(diagnostics_, *node, path(key.name()), value, key.rules.range);
    else return read_value(diagnostics_, *node, path(key.name()), value);
  }

  /// Calls reader(Table&) on a sub-table and then reports what it did not read.
  template <class Reader>
  void section(const Key& key, Reader&& reader) {
    if (const toml::node* node = find(key)) section_at(key, key.name(), *node, reader);
  }

  /// Calls reader(Table&) on every entry of a list of tables, which is called "list.0", "list.1", ...
  template <class Reader>
  void list(const Key& key, Reader&& reader) {
    const toml::node* node = find(key);
    if (!node) return;
    const auto* entries = node->as_array();
    if (!entries) return fail(key.name(), fmt::format("must be a list of tables, written {}", shape(key)));
    for (std::size_t i = 0; i < entries->size(); ++i) {
      const std::string name = fmt::format("{}.{}", path(key.name()), i);
      if (const auto* t = (*entries)[i].as_table()) finish_after(*t, name, reader);
      else report(diagnostics_, (*entries)[i], name, fmt::format("must be a table, written {}", shape(key)));
    }
  }

  /// Calls reader(name, Table&) on every entry of a table whose keys are names that the user gives, in the order of the file; `key` is that of an entry.
  template <class Reader>
  void each(const Key& key, Reader&& reader) {
    diagnostics_.asked.insert(&key);
    for (const std::string& name : names()) {
      const auto named = [&](Table& t) { reader(name, t); };
      section_at(key, name, *find(name), named);
    }
  }

  /// Of the keys `all`, which belong to one kind or another, only those of the chosen kind may be written.
  void only(std::string_view kind, std::span<const std::string_view> own, std::span<const std::string_view> all);

  /// Keys about which nothing can be said, because the choice they depend on is wrong.
  void pass(std::span<const std::string_view> keys);

  /// Reports the value of `key`.
  void fail(std::string_view key, std::string_view why);

  /// Reports that something is not there, unless a misspelling of one of `keys` is.
  void missing(std::vector<std::string> keys, std::string text);

  void finish();

 private:
  struct Missing {
    std::vector<std::string> keys;
    std::string text;
  };

  template <class Reader>
  void section_at(const Key& key, std::string_view name, const toml::node& node, Reader& reader) {
    if (const auto* t = node.as_table()) finish_after(*t, path(name), reader);
    else fail(name, fmt::format("must be a table, written {}", shape(key)));
  }
  template <class Reader>
  void finish_after(const toml::table& entries, std::string path, Reader& reader) {
    Table t(entries, std::move(path), diagnostics_);
    reader(t);
    t.finish();
  }
  std::vector<std::string> names() const;
  /// `body_force = { g = [0.0, 0.0, -9.81] }`
  static std::string shape(const Key& key) { return fmt::format("{} = {}", key.name(), key.rules.example); }

  const toml::table& entries_;
  std::string path_;
  Diagnostics& diagnostics_;
  std::vector<std::string> known_;   // asked for, in the order of asking
  std::vector<std::string> passed_;  // not to be read here, and already dealt with
  std::vector<Missing> missing_;
  std::vector<const Key*> sections_;  // of those asked for, the ones whose shape an error can show
};

}  // namespace nanson
