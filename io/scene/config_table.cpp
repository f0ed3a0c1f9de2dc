// Values of the right type and range, and the keys of a table that are unknown, misplaced or missing.
#include "io/scene/config_table.hpp"

#include <algorithm>
#include <cmath>

namespace nanson {

namespace {

bool within(Diagnostics& d, const toml::node& node, const std::string& path, double v, const Range& r) {
  std::string why;
  if (!std::isfinite(v)) why = "must be finite";
  else if (!(v > r.above)) why = fmt::format("must be above {}", r.above);
  else if (!(v < r.below)) why = fmt::format("must be below {}", r.below);
  else if (!(v >= r.from)) why = fmt::format("must be at least {}", r.from);
  else if (!(v <= r.to)) why = fmt::format("must be at most {}", r.to);
  if (!why.empty()) report(d, node, path, why);
  return why.empty();
}

template <class T>
bool read_three(Diagnostics& d, const toml::node& node, const std::string& path, std::array<T, 3>& value,
                const Range& range, std::string_view what) {
  const auto* list = node.as_array();
  if (!list || list->size() != 3) {
    report(d, node, path, fmt::format("must be three {}", what));
    return false;
  }
  std::array<T, 3> three{};
  bool ok = true;
  for (std::size_t i = 0; i < 3; ++i)
    ok = read_value(d, (*list)[i], fmt::format("{}.{}", path, i), three[i], range) && ok;
  if (ok) value = three;
  else d.wrong.insert(path);
  return ok;
}

bool contains(std::span<const std::string_view> keys, std::string_view key) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

}  // namespace

bool read_value(Diagnostics& d, const toml::node& node, const std::string& path, double& value, const Range& range) {
  if (!node.is_number()) {
    report(d, node, path, "must be a number");
    return false;
  }
  // not node.value<double>(): that is empty for integers that a double cannot hold exactly
  const double v = node.is_integer() ? static_cast<double>(node.as_integer()->get()) : node.as_floating_point()->get();
  if (!within(d, node, path, v, range)) return false;
  value = v;
  return true;
}

bool read_value(Diagnostics& d, const toml::node& node, const std::string& path, long& value, const Range& range) {
  if (!node.is_integer()) {
    report(d, node, path, "must be a whole number");
    return false;
  }
  if (!within(d, node, path, static_cast<double>(node.as_integer()->get()), range)) return false;
  value = node.as_integer()->get();
  return true;
}

bool read_value(Diagnostics& d, const toml::node& node, const std::string& path, int& value, const Range& range) {
  Range fits = range;
  fits.from = std::max<double>(range.from, std::numeric_limits<int>::min());
  fits.to = std::min<double>(range.to, std::numeric_limits<int>::max());
  long wide = 0;
  if (!read_value(d, node, path, wide, fits)) return false;
  value = static_cast<int>(wide);
  return true;
}

bool read_value(Diagnostics& d, const toml::node& node, const std::string& path, std::array<double, 3>& value,
                const Range& range) {
  return read_three(d, node, path, value, range, "numbers");
}

bool read_value(Diagnostics& d, const toml::node& node, const std::string& path, std::array<int, 3>& value,
                const Range& range) {
  return read_three(d, node, path, value, range, "whole numbers");
}

bool read_value(Diagnostics& d, const toml::node& node, const std::string& path, bool& value) {
  if (const auto* b = node.as_boolean()) {
    value = b->get();
    return true;
  }
  report(d, node, path, "must be true or false");
  return false;
}

bool read_value(Diagnostics& d, const toml::node& node, const std::string& path, std::string& value) {
  if (const auto* s = node.as_string()) {
    value = s->get();
    return true;
  }
  report(d, node, path, "must be a string");
  return false;
}

bool read_value(Diagnostics& d, const toml::node& node, const std::string& path, std::vector<Word>& value) {
  const auto* list = node.as_array();
  if (!list) {
    report(d, node, path, "must be a list of names");
    return false;
  }
  std::vector<Word> names;
  bool ok = true;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const toml::node& entry = (*list)[i];
    Word name{{}, place_of(entry.source()), fmt::format("{}.{}", path, i)};
    ok = read_value(d, entry, name.path, name.text) && ok;
    names.push_back(std::move(name));
  }
  if (ok) value = std::move(names);
  else d.wrong.insert(path);
  return ok;
}

int read_word(Diagnostics& d, const toml::node& node, const std::string& path,
              std::span<const std::string_view> allowed) {
  const auto* s = node.as_string();
  const auto hit = s ? std::find(allowed.begin(), allowed.end(), s->get()) : allowed.end();
  if (hit != allowed.end()) return static_cast<int>(hit - allowed.begin());
  report(d, node, path, s ? unknown_word("word", s->get(), allowed) : "must be one of " + join_words(allowed));
  return -1;
}

Table::Table(const toml::table& entries, std::string path, Diagnostics& diagnostics)
    : entries_(entries), path_(std::move(path)), diagnostics_(diagnostics) {}

const toml::node* Table::find(std::string_view key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
  return entries_.get(key);
}

std::string Table::path(std::string_view key) const {
  return path_.empty() ? shown_key(key) : path_ + "." + shown_key(key);
}

Place Table::place(std::string_view key) const {
  const toml::node* node = entries_.get(key);
  return place_of(node ? node->source() : entries_.source());
}

void Table::only(std::string_view kind, std::span<const std::string_view> own, std::span<const std::string_view> all) {
  for (const std::string_view key : all) {
    if (contains(own, key) || std::find(passed_.begin(), passed_.end(), key) != passed_.end()) continue;
    passed_.emplace_back(key);
    const std::string keys = own.empty() ? "" : fmt::format(", whose keys are {}", join_words(own));
    if (has(key)) report(diagnostics_, *entries_.get(key), path(key), fmt::format("is not a key of {}{}", kind, keys));
  }
}

void Table::pass(std::span<const std::string_view> keys) { passed_.insert(passed_.end(), keys.begin(), keys.end()); }

void Table::fail(std::string_view key, std::string_view why) {
  diagnostics_.wrong.insert(path(key));
  if (const toml::node* node = find(key)) report(diagnostics_, *node, path(key), why);
  else report(diagnostics_, place(key), fmt::format("{}: {}", path(key), why));
}

void Table::missing(std::vector<std::string> keys, std::string text) {
  for (const std::string& key : keys) diagnostics_.wrong.insert(path(key));
  missing_.push_back({std::move(keys), std::move(text)});
}

const toml::node* Table::find(const Key& key) {
  diagnostics_.asked.insert(&key);
  if (!key.rules.example.empty()) sections_.push_back(&key);
  const toml::node* node = find(key.name());
  if (node || !key.rules.required) return node;
  std::string hint;
  if (key.value.type == KeyType::choice) hint = ", allowed: " + join_words(key.value.words());
  else if (!key.rules.example.empty()) hint = ", written " + shape(key);
  missing({std::string(key.name())}, fmt::format("{}: is missing{}", path(key.name()), hint));
  return nullptr;
}

std::vector<std::string> Table::names() const {
  std::vector<std::pair<Place, std::string>> placed;  // toml++ sorts keys by the alphabet
  for (auto&& [key, node] : entries_) placed.emplace_back(place_of(key.source()), key.str());
  std::sort(placed.begin(), placed.end());
  std::vector<std::string> names;
  for (auto& [place, name] : placed) names.push_back(std::move(name));
  return names;
}

void Table::finish() {
  std::vector<std::string> meant;
  for (auto&& [key, node] : entries_) {
    const std::string name(key.str());
    const auto is_name = [&](const std::string& k) { return k == name; };
    if (std::any_of(known_.begin(), known_.end(), is_name) || std::any_of(passed_.begin(), passed_.end(), is_name))
      continue;
    meant.push_back(nearest_word(name, known_));
    std::string why = unknown_word("key", name, known_);
    for (const Key* section : sections_)
      if (section->name() == meant.back()) why += "; written " + shape(*section);
    report(diagnostics_, place_of(key.source()), path(name), node, why);
  }
  for (const Missing& m : missing_) {
    const auto misspelt = [&](const std::string& key) {
      return std::find(meant.begin(), meant.end(), key) != meant.end();
    };
    if (!std::any_of(m.keys.begin(), m.keys.end(), misspelt)) report(diagnostics_, place_of(entries_.source()), m.text);
  }
}

}  // namespace nanson
