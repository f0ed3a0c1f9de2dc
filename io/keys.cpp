// The keys of scenes and studies, what cannot stand together, then the output's fields, columns and numbers.
#include "io/keys.hpp"

#include <fmt/format.h>

#include "engine/history.hpp"
#include "engine/physics_rules.hpp"
#include "engine/summary.hpp"
#include "io/print.hpp"
#include "io/scene/key_pages.hpp"
#include "io/scene/key_schema.hpp"
#include "io/scene/scene_keys.hpp"
#include "io/scene/words.hpp"
#include "io/study/study_keys.hpp"

namespace nanson {
namespace {

/// A line of the output's tables.
struct Line {
  std::string name, unit, sentence;
};
struct OutputTable {
  std::string_view title;
  std::vector<Line> lines;
};

std::vector<OutputTable> output_tables() {
  OutputTable fields{"Nodal fields (output.fields and probes); values of a node together, float32", {}};
  for (const Field& f : output_fields())
    fields.lines.push_back({f.components == 1 ? std::string(f.name) : fmt::format("{} ({})", f.name, f.components),
                            std::string(f.unit), std::string(f.sentence)});
  OutputTable columns{"Columns of history.csv", {}};
  for (const ColumnKind& c : column_kinds())
    columns.lines.push_back({std::string(c.name), std::string(c.unit), std::string(c.sentence)});
  columns.lines.push_back(
      {"reaction_FACE_x | y | z", "N", "force of the support at FACE on the body, mean of the last step's stages"});
  columns.lines.push_back(
      {"PROBE_FIELD", "of the field", "a probe's fields; components end in _x _y _z, or _11 _12 ... _33 row by row"});
  OutputTable numbers{"Entries of summary.json; numbers among them are what a study may plot", {}};
  for (const SummaryEntry& e : summary_entries())
    numbers.lines.push_back({std::string(e.name), std::string(e.unit), std::string(e.sentence)});
  numbers.lines.push_back(
      {"probes.PROBE.FIELD", "of the field", "last values of a probe; a study asks for ....0, ....1"});
  numbers.lines.push_back(
      {"setup.NAME, sweeps.NAME", "s", "wall time of a part of the set-up, of a sweep of the loop"});
  OutputTable own{"What a study makes of a run besides", {}};
  for (const StudyQuantity& q : study_quantities)
    own.lines.push_back({std::string(q.name), std::string(q.unit), std::string(q.sentence)});
  return {fields, columns, numbers, own};
}

std::string output_text() {
  std::string text;
  for (const OutputTable& table : output_tables()) {
    text += fmt::format("\n{}\n", table.title);
    for (const Line& l : table.lines)
      text += fmt::format("  {}{}\n{}", l.name, l.unit.empty() ? "" : fmt::format(" [{}]", l.unit),
                          wrapped(l.sentence, 6));
  }
  return text;
}

std::string output_markdown() {
  std::string text;
  for (const OutputTable& table : output_tables()) {
    text += fmt::format("\n### {}\n| name | unit | meaning |\n|---|---|---|\n", table.title);
    for (const Line& l : table.lines)
      text += fmt::format("| {} | {} | {} |\n", table_cell("`" + l.name + "`"), l.unit, table_cell(l.sentence));
  }
  return text;
}

/// The rules of physics that a key takes part in.
std::string rules_text(std::string_view name) {
  std::string text;
  for (const PhysicsRule& rule : physics_rules()) {
    if (!is_meant(rule.key, name) && !is_meant(rule.beside, name)) continue;
    if (text.empty()) text = "\nWhat cannot stand together\n";
    const std::string beside = rule.beside.empty() ? "" : fmt::format(" beside {}", rule.beside);
    text += fmt::format("  {}{}\n{}", rule.key, beside, wrapped(std::string(rule.why), 6));
  }
  return text;
}

std::string rules_markdown() {
  std::string text =
      "\n### What cannot stand together\nAll else that these keys can say together is built.\n"
      "| key | beside | why not |\n|---|---|---|\n";
  for (const PhysicsRule& rule : physics_rules()) {
    const std::string beside = rule.beside.empty() ? "" : fmt::format("`{}`", rule.beside);
    text += fmt::format("| `{}` | {} | {} |\n", rule.key, beside, table_cell(std::string(rule.why)));
  }
  return text;
}

/// Of the first level.
std::vector<std::string_view> section_names(std::span<const Key> keys) {
  std::vector<std::string_view> names;
  for (const Key& k : keys)
    if (is_section(k) && k.section().empty()) names.push_back(k.path);
  return names;
}

int print_named(const KeysOptions& o, std::span<const Key> keys) {
  std::string text = keys_text(keys, o.name);
  if (o.name == "output" && !o.study) text += output_text();
  if (!text.empty() && !o.study) text += rules_text(o.name);
  if (text.empty()) {
    const std::string near = nearest_word(o.name, key_names(keys));
    print(stderr, "{}: unknown key{}, sections: {}\n", o.name,
          near.empty() ? "" : fmt::format(", did you mean \"{}\"?", near), join_words(section_names(keys)));
    return 2;
  }
  print_text(stdout, text);
  if (o.name.empty() && !o.study)
    print(stdout,
          "\nnanson keys SECTION | KEY: some of them; output: fields, columns and numbers too; --study: those of a "
          "study\n");
  return 0;
}

}  // namespace

std::string reference_markdown() {
  return "Written by `nanson keys --markdown`. A key in brackets belongs to that kind only.\n\n"
         + keys_markdown(scene_keys) + rules_markdown() + output_markdown() + "\n### Keys of a study\n"
         + keys_markdown(study_keys);
}

std::string scene_schema() { return json_schema(scene_keys, "nanson scene"); }
std::string study_schema() { return json_schema(study_keys, "nanson study", scene_keys); }
std::string completions() { return settings_text(scene_keys); }

int print_keys(const KeysOptions& o) {
  const std::span<const Key> keys = o.study ? std::span<const Key>(study_keys) : std::span<const Key>(scene_keys);
  if (o.markdown) print_text(stdout, reference_markdown());
  else if (o.json) print_text(stdout, o.study ? study_schema() : scene_schema());
  else if (o.settings) print_text(stdout, completions());
  else return print_named(o, keys);
  return 0;
}

}  // namespace nanson
