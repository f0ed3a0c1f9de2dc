// From keys to a tree: a section is an object of its keys, a key the schema of its value, a kind a condition on what may stand beside it.
#include "io/scene/key_schema.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "io/scene/key_pages.hpp"

namespace nanson {
namespace {

using Json = nlohmann::ordered_json;
constexpr const char* plain_name = "^[A-Za-z0-9_-]+$";

Json array_of(Json items, std::size_t least, std::size_t most = 0) {
  Json a{{"type", "array"}, {"items", std::move(items)}};
  if (least > 0) a["minItems"] = least;
  if (most > 0) a["maxItems"] = most;
  return a;
}

Json any_of(Json a, Json b) { return {{"anyOf", Json::array({std::move(a), std::move(b)})}}; }

Json number_of(const char* type, const Range& r) {
  Json n{{"type", type}};
  const auto limit = [&](const char* name, double value) {
    if (value > -1e300 && value < 1e300) n[name] = value;
  };
  limit("exclusiveMinimum", r.above);
  limit("exclusiveMaximum", r.below);
  limit("minimum", r.from);
  limit("maximum", r.to);
  return n;
}

Json name_of(const Key& k) {
  Json n{{"type", "string"}};
  if (k.value.words) n["enum"] = k.value.words();
  return n;
}

class Schema {
 public:
  Schema(std::span<const Key> keys, std::span<const Key> settings) : keys_(keys), settings_(settings) {}

  /// The object of a section's keys; `skip` is left out.
  Json object(std::string_view section, std::string_view skip = {}) const {
    Json o{{"type", "object"}, {"additionalProperties", false}};
    const std::vector<const Key*> own = own_keys(section, skip);
    Json required = Json::array(), one_of = Json::array();
    for (const Key* k : own) {
      if (k->name() == "NAME") {
        o["propertyNames"] = {{"pattern", plain_name}};
        o["additionalProperties"] = described(*k);
        continue;
      }
      add_property(o["properties"], *k);
      if (k->rules.required && k->rules.of.empty()) required.push_back(k->name());
      if (k->rules.one_of) one_of.push_back({{"required", Json::array({k->name()})}});
    }
    if (!required.empty()) o["required"] = required;
    if (!one_of.empty()) o["oneOf"] = one_of;
    add_kinds(o, own);
    return o;
  }

 private:
  std::vector<const Key*> own_keys(std::string_view section, std::string_view skip) const {
    std::vector<const Key*> own;
    for (const Key& k : keys_)
      if (k.section() == section && k.name() != skip) own.push_back(&k);
    return own;
  }

  /// Several keys of one name: what any of them allows.
  void add_property(Json& properties, const Key& k) const {
    const std::string name(k.name());
    if (!properties.contains(name)) {
      properties[name] = described(k);
      return;
    }
    Json& before = properties[name];
    if (!before.contains("anyOf") || before.contains("description")) before = {{"anyOf", Json::array({before})}};
    before["anyOf"].push_back(described(k));
  }

  Json described(const Key& k) const {
    Json v = value(k);
    std::string text = k.rules.of.empty() ? "" : fmt::format("({}) ", k.rules.of);
    text += k.sentence;
    if (!k.unit.empty()) text += fmt::format(" [{}]", k.unit);
    v["description"] = text;
    if (const std::string initial = shown_default(k); !initial.empty()) v["default"] = Json::parse(initial);
    return v;
  }

  Json value(const Key& k) const {
    const Json number = number_of("number", k.rules.range), whole = number_of("integer", k.rules.range);
    const Json name{{"type", "string"}};
    switch (k.value.type) {
      case KeyType::flag: return {{"type", "boolean"}};
      case KeyType::whole: return whole;
      case KeyType::number: return number;
      case KeyType::text: return name;
      case KeyType::choice: return {{"enum", k.value.words()}};
      case KeyType::whole3: return array_of(whole, 3, 3);
      case KeyType::number3: return array_of(number, 3, 3);
      case KeyType::number3_or_mass: return any_of({{"const", "mass"}}, array_of(number, 3, 3));
      case KeyType::number3_or_free: return array_of(any_of(number, {{"const", "free"}}), 3, 3);
      case KeyType::numbers: return array_of(number, 1);
      case KeyType::points: return array_of(array_of(number, 2, 2), 2);
      case KeyType::names: return array_of(name_of(k), 0);
      case KeyType::name_or_names: return any_of(name, array_of(name, 0));
      case KeyType::table:
      case KeyType::named_tables: return object(k.path);
      case KeyType::tables: return array_of(object(k.path), 0);
      case KeyType::table_or_tables: {
        Json entry = object(k.path);
        entry["required"].push_back("region");
        return any_of(object(k.path, "region"), array_of(entry, 1));
      }
      case KeyType::settings: return settings_object();
      case KeyType::variations:
        return {{"type", "object"},
                {"minProperties", 1},
                {"propertyNames", {{"pattern", "\\."}}},
                {"additionalProperties", any_of(array_of(Json::object(), 1), object("vary.KEY"))}};
      case KeyType::file_or_tables: {
        Json point = object(k.path);
        point["additionalProperties"] = number;
        return any_of(name, array_of(point, 0));
      }
    }
    return {};
  }

  /// Keys of lists are not known by their path: they stand behind a number or a name.
  Json settings_object() const {
    Json o{{"type", "object"}, {"propertyNames", {{"pattern", "\\."}}}};
    const Schema of_settings(settings_, {});
    for (const Key& k : settings_)
      if (k.path.find('.') != k.path.npos && k.path.find("NAME") == k.path.npos && !k.path.starts_with("boundary."))
        of_settings.add_setting(o["properties"], k);
    return o;
  }
  void add_setting(Json& properties, const Key& k) const {
    if (is_section(k)) return;
    Json one;
    add_property(one, k);
    const std::string path(k.path);
    if (!properties.contains(path)) properties[path] = one[std::string(k.name())];
    else properties[path] = any_of(properties[path], one[std::string(k.name())]);
  }

  /// The words that decide which keys may stand: those of a choice in the section, or keys of which one is written.
  void add_kinds(Json& o, const std::vector<const Key*>& own) const {
    const auto special = std::find_if(own.begin(), own.end(), [](const Key* k) { return !k->rules.of.empty(); });
    if (special == own.end()) return;
    const std::string first((*special)->rules.of.substr(0, (*special)->rules.of.find(" | ")));
    for (const Key* k : own) {
      const auto words = k->value.type == KeyType::choice && k->rules.of.empty() ? k->value.words()
                                                                                 : std::vector<std::string_view>{};
      if (std::find(words.begin(), words.end(), first) != words.end())
        for (const std::string_view word : words) add_kind(o, own, *k, word);
      if (k->rules.one_of) add_kind(o, own, *k, k->name());
    }
  }

  void add_kind(Json& o, const std::vector<const Key*>& own, const Key& kind, std::string_view word) const {
    Json condition{{"required", Json::array({kind.name()})}}, then;
    if (!kind.rules.one_of) condition["properties"] = {{std::string(kind.name()), {{"const", word}}}};
    if (!kind.rules.one_of && shown_default(kind) == fmt::format("\"{}\"", word)) condition.erase("required");
    std::vector<std::string> allowed;
    for (const Key* k : own)
      if (k->rules.of.empty() || k->is_of(word)) allowed.emplace_back(k->name());
    for (const Key* k : own) {
      if (k->rules.of.empty()) continue;
      const std::string name(k->name());
      if (std::find(allowed.begin(), allowed.end(), name) == allowed.end()) then["properties"][name] = false;
      else if (k->is_of(word) && k->rules.required) then["required"].push_back(name);
    }
    if (!then.empty()) o["allOf"].push_back({{"if", condition}, {"then", then}});
  }

  std::span<const Key> keys_, settings_;
};

}  // namespace

std::string json_schema(std::span<const Key> keys, std::string_view title, std::span<const Key> settings) {
  Json root{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  root.update(Schema(keys, settings).object(""));
  return root.dump(1) + '\n';
}

}  // namespace nanson
