// Sections of a study file in its order: what is run.
#include "io/study/read_study.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "io/scene/config_table.hpp"
#include "io/scene/parse_toml.hpp"
#include "io/study/read_study_report.hpp"
#include "io/study/study_keys.hpp"
#include "io/text_file.hpp"

namespace nanson {
namespace {

namespace fs = std::filesystem;

constexpr long most_runs = 100'000;  // each is planned, read and checked before the first one starts

/// Keys of a table in the order of the file; toml++ sorts them by the alphabet.
std::vector<std::pair<std::string, const toml::node*>> entries_of(const toml::table& table) {
  std::vector<std::pair<Place, std::pair<std::string, const toml::node*>>> placed;
  for (auto&& [key, node] : table) placed.push_back({place_of(key.source()), {std::string(key.str()), &node}});
  std::sort(placed.begin(), placed.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::pair<std::string, const toml::node*>> entries;
  for (auto& [place, entry] : placed) entries.push_back(std::move(entry));
  return entries;
}

/// True for "mesh.cells"; a bare word would be a whole section, or an unquoted key that TOML takes for one.
bool is_scene_key(Diagnostics& d, const toml::node& node, const std::string& path, const std::string& key) {
  if (key.find('.') != std::string::npos) return true;
  report(d, node, path,
         fmt::format("must be section and key in quotes, like \"{}.{}\"", key,
                     node.is_table() && !node.as_table()->empty() ? std::string(node.as_table()->begin()->first.str())
                                                                  : "key"));
  return false;
}

void read_settings(Table& t, const Key& key, std::vector<StudySetting>& settings) {
  const std::string_view section = key.name();
  const toml::node* node = t.find(key);
  if (!node) return;
  const auto* table = node->as_table();
  if (!table)
    return t.fail(section, fmt::format("must be a table of scene keys and values, like {}", key.rules.example));
  for (const auto& [name, value] : entries_of(*table)) {
    const std::string path = fmt::format("{}.{}", t.path(section), shown_key(name));
    if (is_scene_key(t.diagnostics(), *value, path, name))
      settings.push_back({name, toml_text(*value), where(t.diagnostics(), place_of(value->source()))});
  }
}

/// { from, to, count, scale }: evenly spaced values, or ratios.
void read_range(Diagnostics& d, const toml::table& table, const std::string& path, StudyAxis& axis) {
  double from = 0, to = 0;
  long count = 0;
  AxisScale scale = AxisScale::linear;
  const std::size_t before = d.found.size();
  Table t(table, path, d);
  d.asked.insert(&study_key("vary.KEY"));
  t.read(study_key("vary.KEY.from"), from);
  t.read(study_key("vary.KEY.to"), to);
  t.read(study_key("vary.KEY.count"), count);
  t.read(study_key("vary.KEY.scale"), scale);
  if (scale == AxisScale::log && !(from > 0 && to > 0)) t.fail("scale", "needs from and to above 0");
  t.finish();
  if (d.found.size() > before) return;
  for (long i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    const double value = i == 0                    ? from
                         : i == count - 1          ? to
                         : scale == AxisScale::log ? from * std::pow(to / from, share)
                                                   : from + share * (to - from);
    axis.values.push_back({axis.key, toml_text(toml::value<double>{std::stod(fmt::format("{:.12g}", value))}),
                           where(d, place_of(table.source()))});  // 0.3, not 0.30000000000000004
  }
}

void read_vary(Table& t, std::vector<StudyAxis>& axes) {
  const toml::node* node = t.find(study_key("vary"));
  if (!node) return;
  const auto* table = node->as_table();
  if (!table || table->empty())
    return t.fail("vary", "must be a table of scene keys and lists of values, at least one");
  Diagnostics& d = t.diagnostics();
  for (const auto& [key, value] : entries_of(*table)) {
    const std::string path = fmt::format("vary.{}", shown_key(key));
    if (!is_scene_key(d, *value, path, key)) continue;
    StudyAxis axis{key, {}};
    const auto* list = value->as_array();
    if (const auto* range = value->as_table()) read_range(d, *range, path, axis);
    else if (!list || list->empty())
      report(d, *value, path, "must be a list of values, at least one, or a range { from, to, count }");
    std::set<std::string> known;
    for (std::size_t i = 0; list && i < list->size(); ++i) {
      const toml::node& one = (*list)[i];
      axis.values.push_back({key, toml_text(one), where(d, place_of(one.source()))});
      if (!known.insert(axis.values.back().value).second) report(d, one, path, "is listed twice");
    }
    if (!axis.values.empty()) axes.push_back(std::move(axis));
  }
}

void read_cases(Table& root, Study& study, const fs::path& folder) {
  std::set<std::string> names;
  root.list(study_key("case"), [&](Table& t) {
    StudyCase c;
    std::string scene;
    if (t.read(study_key("case.name"), c.name) && (c.name.empty() || !names.insert(c.name).second))
      t.fail("name", "must be a name of its own");
    if (t.read(study_key("case.scene"), scene) && t.has("scene")) c.scene = (folder / scene).lexically_normal();
    read_settings(t, study_key("case.set"), c.settings);
    study.cases.push_back(std::move(c));
  });
  if (root.has("case") && root.sound("case") && study.cases.empty()) root.fail("case", "must have at least one entry");
}

void read_root(Table& root, Study& s, const fs::path& folder) {
  if (root.read(study_key("study"), s.name) && !is_plain(s.name))
    root.fail("study", "names a folder: use letters, digits, - and _ only");
  root.read(study_key("kind"), s.kind);
  std::string scene;
  root.read(study_key("scene"), scene);
  root.read(study_key("threads"), s.threads);
  read_settings(root, study_key("set"), s.set);
  read_vary(root, s.vary);
  read_cases(root, s, folder);
  s.scene_where = where(root.diagnostics(), root.place("scene"));
  if (!scene.empty()) s.scene = (folder / scene).lexically_normal();
  const auto has_own = [](const StudyCase& c) { return !c.scene.empty(); };
  const bool all_own = !s.cases.empty() && std::all_of(s.cases.begin(), s.cases.end(), has_own);
  if (!root.has("scene") && !all_own) root.missing({"scene"}, "scene: is missing, or every [[case]] needs its own");
  if (s.vary.empty() && s.cases.empty() && !root.has("vary") && !root.has("case"))
    root.missing({"vary", "case"}, "a study needs [vary] or [[case]]: what its runs differ in");
  double runs = s.cases.empty() ? 1 : static_cast<double>(s.cases.size());
  for (const StudyAxis& axis : s.vary) runs *= static_cast<double>(axis.values.size());
  if (runs > most_runs)
    root.fail(s.vary.empty() ? "case" : "vary", fmt::format("makes {:.6g} runs, allowed are {}", runs, most_runs));
  set_report_defaults(s);
  root.section(study_key("report"), [&](Table& t) { read_study_report(t, s, folder); });
  if (!root.has("report") && root.sound("kind") && s.kind != StudyKind::stability)
    root.missing({"report"}, "report.y: is missing: what the plots show");
}

}  // namespace

std::string toml_text(const toml::node& value) {
  if (const auto* number = value.as_floating_point()) {
    std::string text = fmt::format("{}", number->get());
    const bool whole = std::isfinite(number->get()) && text.find_first_of(".e") == std::string::npos;
    return whole ? text + ".0" : text;
  }
  std::vector<std::string> parts;
  if (const auto* list = value.as_array()) {
    for (const toml::node& entry : *list) parts.push_back(toml_text(entry));
    return fmt::format("[{}]", join_words(parts, ", "));
  }
  if (const auto* table = value.as_table()) {
    for (const auto& [key, entry] : entries_of(*table))
      parts.push_back(fmt::format("{} = {}", shown_key(key), toml_text(*entry)));
    return fmt::format("{{ {} }}", join_words(parts, ", "));
  }
  std::ostringstream out;
  out << toml::toml_formatter{value, toml::format_flags::allow_unicode_strings};
  return out.str();
}

StudyResult read_study(const fs::path& file) {
  StudyResult r;
  r.study.file = file;
  Diagnostics d;
  d.file = file.string();
  std::string why;
  const std::optional<std::string> text = read_text_file(file, why);
  if (!text) {
    r.errors = {d.file + ": " + why};
    return r;
  }
  try {
    const toml::table tree = parse_toml(*text);
    Table root(tree, "", d);
    read_root(root, r.study, file.parent_path());
    root.finish();
  } catch (const toml::parse_error& e) {
    report(d, place_of(e.source()), std::string(e.description()));
  }
  r.asked = d.asked;
  r.errors = listed(std::move(d));
  return r;
}

}  // namespace nanson
