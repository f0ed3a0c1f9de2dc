// One line for what a key holds, one or more for what it means.
#include "io/scene/key_pages.hpp"

#include <algorithm>
#include <cstdlib>

#include "io/scene/words.hpp"

namespace nanson {
namespace {

constexpr std::size_t width = 100;  // [columns] of a terminal

std::string type_text(const Key& key) {
  switch (key.value.type) {
    case KeyType::flag: return "true | false";
    case KeyType::whole: return "whole number";
    case KeyType::number: return "number";
    case KeyType::text: return "text";
    case KeyType::choice: return join_words(key.value.words());
    case KeyType::whole3: return "three whole numbers";
    case KeyType::number3: return "three numbers";
    case KeyType::number3_or_mass: return "three numbers or \"mass\"";
    case KeyType::number3_or_free: return "three numbers, or \"free\" in place of some";
    case KeyType::numbers: return "list of numbers";
    case KeyType::points: return "list of pairs of numbers";
    case KeyType::names: return key.value.words ? "list of " + join_words(key.value.words()) : "list of names";
    case KeyType::name_or_names: return "name or list of names";
    case KeyType::table: return "table";
    case KeyType::named_tables: return "table of tables, each under its name";
    case KeyType::tables: return "list of tables";
    case KeyType::table_or_tables: return "table or list of tables";
    case KeyType::settings: return "table of scene keys and values";
    case KeyType::variations: return "table of scene keys and values to combine";
    case KeyType::file_or_tables: return "file name or list of tables";
  }
  return "";
}

std::string range_text(const Range& r) {
  std::string text;
  const auto add = [&](double limit, std::string_view word) {
    if (limit > -1e300 && limit < 1e300) text += fmt::format("{} {} {:g}", text.empty() ? "" : " and", word, limit);
  };
  add(r.above, "above");
  add(r.from, "at least");
  add(r.below, "below");
  add(r.to, "at most");
  return text;
}

/// The path as it is written in a file: "[[boundary]]", "[mesh]".
std::string heading(const Key& key) {
  const bool list = key.value.type == KeyType::tables;
  return list ? fmt::format("[[{}]]", key.path) : fmt::format("[{}]", key.path);
}

std::string label(const Key& key, std::string_view name) {
  return key.rules.of.empty() ? std::string(name) : fmt::format("{} ({})", name, key.rules.of);
}

std::string shape_of(const Key& section) { return fmt::format("{} = {}", section.name(), section.rules.example); }

/// The file itself (nullptr), then every section, with the keys that stand directly in it.
template <class Tell>
void for_each_section(std::span<const Key> keys, Tell&& tell) {
  const auto in = [&](std::string_view path) {
    std::vector<const Key*> own;
    for (const Key& k : keys)
      if (!is_section(k) && k.section() == path) own.push_back(&k);
    return own;
  };
  tell(nullptr, in(""));
  for (const Key& k : keys)
    if (is_section(k)) tell(&k, in(k.path));
}

}  // namespace

std::string table_cell(std::string text) {
  for (std::size_t i = 0; (i = text.find('|', i)) != text.npos; i += 2) text.insert(i, 1, '\\');
  return text;
}

std::string wrapped(const std::string& text, std::size_t indent) {
  std::string out(indent, ' ');
  std::size_t column = indent;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = std::min(text.find(' ', i), text.size());
    if (column > indent && column + 1 + end - i > width) {
      out += '\n' + std::string(indent, ' ');
      column = indent;
    }
    if (column > indent) {
      out += ' ';
      ++column;
    }
    out += text.substr(i, end - i);
    column += end - i;
    i = end + 1;
  }
  return out + '\n';
}

bool is_meant(std::string_view path, std::string_view name) {
  const bool inside = path.starts_with(name) && path.size() > name.size() && path[name.size()] == '.';
  return name.empty() || path == name || inside || path.substr(path.rfind('.') + 1) == name;
}

bool is_section(const Key& key) { return !key.rules.example.empty(); }

std::string shown_default(const Key& key) {
  if (key.rules.required || !key.value.initial) return "";
  const std::string text = key.value.initial();
  const bool number = key.value.type == KeyType::whole || key.value.type == KeyType::number;
  if (text == "\"\"" || (number && !key.rules.range.holds(std::strtod(text.c_str(), nullptr)))) return "";
  return text;
}

std::string value_text(const Key& key) {
  std::string text = type_text(key) + range_text(key.rules.range);
  if (!key.unit.empty()) text += fmt::format(" [{}]", key.unit);
  const std::string initial = shown_default(key);
  if (key.rules.required) text += ", required";
  if (!initial.empty()) text += ", default " + initial;
  return text;
}

std::string keys_text(std::span<const Key> keys, std::string_view name) {
  std::string text;
  for_each_section(keys, [&](const Key* section, const std::vector<const Key*>& own) {
    const bool headed = section && is_meant(section->path, name);
    if (headed)
      text += fmt::format("{}{}\n{}{}", text.empty() ? "" : "\n", heading(*section),
                          wrapped(std::string(section->sentence), 2), wrapped(shape_of(*section), 2));
    for (const Key* k : own) {
      if (!is_meant(k->path, name)) continue;
      text += wrapped(fmt::format("{}: {}", label(*k, headed ? k->name() : k->path), value_text(*k)), 2);
      text += wrapped(std::string(k->sentence), 6);
    }
  });
  return text;
}

std::string keys_markdown(std::span<const Key> keys) {
  std::string text;
  for_each_section(keys, [&](const Key* section, const std::vector<const Key*>& own) {
    if (section)
      text += fmt::format("\n### `{}`\n{}{}: `{}`\n", heading(*section), section->sentence,
                          section->rules.required ? "; required" : "", shape_of(*section));
    if (!own.empty()) text += "| key | value | default | meaning |\n|---|---|---|---|\n";
    for (const Key* k : own) {
      const std::string unit = k->unit.empty() ? "" : fmt::format(" [{}]", k->unit), initial = shown_default(*k);
      text += fmt::format("| {} | {} | {} | {} |\n", table_cell(label(*k, fmt::format("`{}`", k->name()))),
                          table_cell(type_text(*k) + range_text(k->rules.range) + unit),
                          k->rules.required ? "required"
                          : initial.empty() ? ""
                                            : fmt::format("`{}`", table_cell(initial)),
                          table_cell(std::string(k->sentence)));
    }
  });
  return text;
}

std::string settings_text(std::span<const Key> keys) {
  std::vector<std::string> lines;
  const auto add = [&](std::string line) {
    if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(std::move(line));
  };
  for (const Key& k : keys) {
    if (is_section(k) || k.path.find("NAME") != k.path.npos) continue;
    if (k.value.type == KeyType::choice)
      for (const std::string_view word : k.value.words()) add(fmt::format("{}={}", k.path, word));
    else if (k.value.type == KeyType::flag)
      for (const char* word : {"true", "false"}) add(fmt::format("{}={}", k.path, word));
    else add(fmt::format("{}=", k.path));
  }
  return join_words(lines, "\n") + "\n";
}

std::vector<std::string> key_names(std::span<const Key> keys) {
  std::vector<std::string> names;
  for (const Key& k : keys)
    for (const std::string_view name : {k.path, k.section(), k.name()})
      if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.emplace_back(name);
  return names;
}

}  // namespace nanson
