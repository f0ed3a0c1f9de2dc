// The [output] section: field names and probes.
#include <algorithm>

#include "engine/output_field.hpp"
#include "io/scene/scene_sections.hpp"

namespace nanson {

namespace {

void read_fields(Table& t, const std::vector<Word>& words, std::vector<std::string>& fields) {
  const std::vector<std::string_view> known = output_field_names();
  fields.clear();
  for (const Word& w : words) {
    if (std::find(known.begin(), known.end(), w.text) == known.end())
      report(t.diagnostics(), w, unknown_word("field", w.text, known));
    else if (std::find(fields.begin(), fields.end(), w.text) != fields.end())
      report(t.diagnostics(), w, "is named twice");
    else fields.push_back(w.text);
  }
}

void read_probe(const std::string& name, Table& t, std::vector<ProbeSpec>& probes) {
  ProbeSpec p;
  p.name = name;
  if (t.read(key("output.probes.NAME.at"), p.at)) p.where = where(t.diagnostics(), t.place("at"));
  std::vector<Word> words;
  if (t.read(key("output.probes.NAME.fields"), words)) {
    if (words.empty()) t.fail("fields", "must name at least one field");
    read_fields(t, words, p.fields);
  }
  probes.push_back(std::move(p));
}

}  // namespace

void read_output(Table& t, OutputSpec& o) {
  t.read(key("output.every"), o.every);
  t.read(key("output.history_every"), o.history_every);
  std::vector<Word> words;
  if (t.read(key("output.fields"), words) && t.has("fields")) read_fields(t, words, o.fields);
  t.read(key("output.compress"), o.compress);
  t.read(key("output.checkpoint_every"), o.checkpoint_every);
  t.section(key("output.probes"), [&](Table& probes) {
    probes.each(key("output.probes.NAME"), [&](const std::string& name, Table& p) {
      if (!is_plain(name)) probes.fail(name, "names a column: use letters, digits, - and _ only");
      read_probe(name, p, o.probes);
    });
  });
}

}  // namespace nanson
