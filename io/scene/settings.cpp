// --set: parsed with TOML's own rules for keys and values, then moved into the tree so that positions stay with the nodes.
#include "io/scene/settings.hpp"

#include <algorithm>
#include <cctype>
#include <optional>

#include <fmt/format.h>

#include "io/scene/parse_toml.hpp"
#include "io/scene/words.hpp"

namespace nanson {

namespace {

bool is_bare_word(std::string_view text) {
  constexpr std::string_view signs = "_-+./:~";
  const auto fits = [&](unsigned char c) {
    return std::isalnum(c) || c >= 0x80 || signs.find(static_cast<char>(c)) != std::string_view::npos;
  };
  return !text.empty() && std::all_of(text.begin(), text.end(), fits);
}

void reject(const Setting& s, std::string_view why, Diagnostics& d) {
  report(d, Place{s.number}, fmt::format("{}: {}", s.text, why));
}

std::optional<std::vector<std::string>> parse_path(std::string_view key) {
  std::vector<std::string> path;
  try {
    const toml::table tree = parse_toml(std::string(key) + " = 0");
    if (tree.empty()) return std::nullopt;  // the key was a comment
    for (const toml::table* t = &tree; t; t = t->begin()->second.as_table()) path.emplace_back(t->begin()->first.str());
  } catch (const toml::parse_error&) {
    return std::nullopt;
  }
  return path;
}

std::optional<toml::table> parse_value(std::string_view value, long number, std::string& why) {
  try {
    return parse_toml(fmt::format("value = {}", value), source_of_setting(number));
  } catch (const toml::parse_error& e) {
    why = e.description();
  }
  if (!is_bare_word(value)) return std::nullopt;
  try {
    return parse_toml(fmt::format("value = \"{}\"", value), source_of_setting(number));
  } catch (const toml::parse_error&) {
    return std::nullopt;  // not UTF-8, as `why` says
  }
}

/// Names under which a list entry is known: the faces or regions it is for.
std::vector<std::string> names_of(const toml::node& entry) {
  std::vector<std::string> names;
  const auto* t = entry.as_table();
  const toml::node* face = t ? t->get(t->contains("face") ? "face" : "region") : nullptr;
  const auto add = [&](const toml::node& n) {
    if (const auto* s = n.as_string()) names.push_back(s->get());
  };
  if (face) add(*face);
  if (const auto* list = face ? face->as_array() : nullptr)
    for (const toml::node& n : *list) add(n);
  return names;
}

/// The entry of a list that `part` numbers or names; -1 with the reason when there is not exactly one.
long find_entry(const toml::array& list, const std::string& part, std::string& why) {
  std::vector<std::string> known;
  long hit = -1, hits = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    known.push_back(std::to_string(i));
    if (known.back() == part) return static_cast<long>(i);
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    for (const std::string& name : names_of(list[i])) {
      if (std::find(known.begin(), known.end(), name) == known.end()) known.push_back(name);
      if (name != part || hit == static_cast<long>(i)) continue;
      hit = static_cast<long>(i);
      ++hits;
    }
  }
  if (hits > 1) why = fmt::format("{} entries name \"{}\", use a number", hits, part);
  if (hits == 0) why = unknown_word(fmt::format("list entry \"{}\"", part), part, known);
  return hits == 1 ? hit : -1;
}

/// A table without entries that says it came from the setting; only the parser can mark a node so.
toml::table made_by(long number) {
  toml::table holder = toml::parse("made = {}", source_of_setting(number));
  return std::move(*holder.get_as<toml::table>("made"));
}

toml::key key_by(const std::string& name, const toml::table& holder) {
  return toml::key{name, holder.begin()->first.source()};
}

}  // namespace

std::vector<Setting> parse_settings(const std::vector<std::string>& texts, Diagnostics& d) {
  std::vector<Setting> settings;
  long number = 0;
  for (const std::string& text : texts) {
    Setting s{++number, text, {}, {}};
    const std::size_t equals = text.find('=');
    const bool one_line = std::none_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; });
    if (!one_line) {
      reject(Setting{s.number, shown_key(text), {}, {}}, "must be one line without control characters", d);
      continue;
    }
    const auto path = equals == std::string::npos ? std::nullopt : parse_path(std::string_view(text).substr(0, equals));
    if (!path) {
      reject(s, "must be KEY=VALUE, like material.density=1000.0", d);
      continue;
    }
    std::string why;
    auto holder = parse_value(std::string_view(text).substr(equals + 1), s.number, why);
    if (!holder) {
      reject(s, fmt::format("the value is neither TOML nor a bare word: {}", why), d);
      continue;
    }
    s.path = *path;
    s.holder = std::move(*holder);
    settings.push_back(std::move(s));
  }
  return settings;
}

void apply(toml::table& root, Setting s, Diagnostics& d) {
  toml::node* here = &root;
  toml::node& value = *s.holder.get("value");
  std::string walked;
  for (std::size_t i = 0; i < s.path.size(); ++i) {
    const std::string& part = s.path[i];
    const bool last = i + 1 == s.path.size();
    if (auto* list = here->as_array()) {
      std::string why;
      const long entry = find_entry(*list, part, why);
      if (entry < 0) return reject(s, fmt::format("{}: {}", walked, why), d);
      if (last) list->replace(list->cbegin() + entry, std::move(value));
      else here = list->get(static_cast<std::size_t>(entry));
    } else if (auto* table = here->as_table()) {
      if (last) table->insert_or_assign(key_by(part, s.holder), std::move(value));
      else here = &table->insert(key_by(part, s.holder), made_by(s.number)).first->second;
    } else {
      return reject(s, fmt::format("{} = {} has no entries", walked, shown(*here)), d);
    }
    if (!walked.empty()) walked += '.';
    walked += shown_key(part);
  }
}

}  // namespace nanson
