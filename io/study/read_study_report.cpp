// What a study shows: the [report] section, whose keys depend on the kind of the study.
#include "io/study/read_study_report.hpp"

#include <algorithm>
#include <array>

#include "io/read_csv.hpp"
#include "io/results/write_summary.hpp"
#include "io/study/study_keys.hpp"

namespace nanson {
namespace {

namespace fs = std::filesystem;

/// The keys of [report]: those that only some kinds of study have, and all that this kind has.
struct ReportKeys {
  std::vector<std::string_view> of_kinds, own;
  explicit ReportKeys(StudyKind kind) {
    for (const Key& k : study_keys) {
      if (k.section() != "report") continue;
      if (!k.rules.of.empty()) of_kinds.push_back(k.name());
      if (k.is_of(word(kind))) own.push_back(k.name());
    }
  }
};

/// What report.x and report.y may name besides varied keys: the numbers of summary.json and those that the study makes of them.
std::vector<std::string> known_quantities() {
  std::vector<std::string> names = summary_numbers();
  for (const StudyQuantity& own : study_quantities) names.emplace_back(own.name);
  return names;
}

bool has_curves(StudyKind kind) { return kind == StudyKind::convergence || kind == StudyKind::sweep; }

/// A reference point: a label, and numbers under the names of x and y.
void read_point(Table& t, const ReportSpec& r, std::vector<ReferencePoint>& points) {
  ReferencePoint p;
  t.read(study_key("report.reference.label"), p.label);
  const auto take = [&](const std::string& name) {
    const toml::node* node = t.find(name);
    double value = 0;
    if (node && read_value(t.diagnostics(), *node, t.path(name), value)) p.values[name] = value;
    return node != nullptr;
  };
  if (!r.x.empty() && !take(r.x)) t.missing({r.x}, t.path(r.x) + ": is missing");
  bool any = false;
  for (const std::string& y : r.y) any = take(y) || any;
  if (!any) t.missing(r.y, fmt::format("a reference point needs one of {}", join_words(r.y)));
  points.push_back(std::move(p));
}

void read_reference_file(Table& t, const fs::path& file, ReportSpec& r) {
  std::string why;
  const std::optional<CsvTable> table = read_csv(file, why);
  if (!table) return t.fail("reference", fmt::format("{}: {}", file.string(), why));
  const auto label = table->column("label"), x = table->column(r.x);
  if (!label || !x) return t.fail("reference", fmt::format("{}: needs the columns label and {}", file.string(), r.x));
  for (const auto& row : table->rows) {
    ReferencePoint p{row[*label], {}};
    const auto take = [&](const std::string& key) {
      if (const auto c = table->column(key); c && number_in(row[*c])) p.values[key] = *number_in(row[*c]);
    };
    take(r.x);
    for (const std::string& y : r.y) take(y);
    r.reference.push_back(std::move(p));
  }
}

/// One name or a list of them; each place is kept in `places`.
void read_names(Table& t, const Key& key, std::vector<std::string>& names, const std::vector<std::string>& allowed,
                std::string_view what, std::map<std::string, std::string>* places = nullptr) {
  const toml::node* node = t.find(key);
  if (!node) return;
  std::vector<Word> read;
  if (const auto* one = node->as_string()) read.push_back({one->get(), t.place(key.name()), t.path(key.name())});
  else if (!t.read(key, read)) return;
  names.clear();
  for (const Word& w : read) {
    if (what == "quantity"
        && (w.text.starts_with("probes.") || w.text.starts_with("sweeps.") || w.text.starts_with("setup."))) {
    }  // known to the runs only
    else if (std::find(allowed.begin(), allowed.end(), w.text) == allowed.end())
      report(t.diagnostics(), w, unknown_word(what, w.text, allowed));
    if (places) places->emplace(w.text, fmt::format("{}: {}", where(t.diagnostics(), w.place), w.path));
    names.push_back(w.text);
  }
}

/// One name; what stands in `name` stays when the key is not there.
void read_one_name(Table& t, const Key& key, std::string& name, const std::vector<std::string>& allowed,
                   std::string_view what, std::map<std::string, std::string>* places = nullptr) {
  if (!t.find(key)) return;
  std::vector<std::string> names;
  read_names(t, key, names, allowed, what, places);
  if (names.size() == 1) name = names[0];
  else if (t.sound(key.name())) t.fail(key.name(), "must be one name");
}

void read_quantities(Table& t, Study& s, const std::vector<std::string>& keys) {
  ReportSpec& r = s.report;
  std::vector<std::string> quantities = known_quantities();
  quantities.insert(quantities.end(), keys.begin(), keys.end());
  const auto varied = [&](const std::string& name) { return std::find(keys.begin(), keys.end(), name) != keys.end(); };
  if (s.kind != StudyKind::compare) read_one_name(t, study_key("report.x"), r.x, quantities, "quantity", &r.where);
  if (s.kind == StudyKind::stability && t.has("x") && !varied(r.x))
    t.fail("x", "must be a varied key: it is the horizontal side of the map");
  read_names(t, study_key("report.y"), r.y, quantities, "quantity", &r.where);
  for (const std::string& y : r.y)
    if (varied(y)) t.fail("y", fmt::format("{} is varied, not a result", y));
  if (s.kind == StudyKind::stability || !t.sound("y")) return;
  if (!t.has("y")) t.missing({"y"}, "report.y: is missing: what the plots show");
  else if (r.y.empty()) t.fail("y", "must name at least one quantity: what the plots show");
}

void read_reference(Table& t, ReportSpec& r, const fs::path& folder) {
  t.read(study_key("report.reference_note"), r.reference_note);
  if (t.has("reference_note") && !t.has("reference"))
    t.fail("reference_note", "is about report.reference, which is missing");
  const toml::node* reference = t.find(study_key("report.reference"));
  if (!reference) return;
  std::string file;
  if (!reference->is_string()) t.list(study_key("report.reference"), [&](Table& p) { read_point(p, r, r.reference); });
  else if (t.read(study_key("report.reference"), file)) read_reference_file(t, folder / file, r);
}

void read_curves(Table& t, ReportSpec& r, const std::vector<std::string>& keys, const fs::path& folder) {
  read_names(t, study_key("report.lines"), r.lines, keys, "varied key");
  read_one_name(t, study_key("report.panels"), r.panels, keys, "varied key");
  if (!r.panels.empty() && r.panels == r.x) t.fail("panels", "is report.x");
  t.read(study_key("report.x_scale"), r.x_scale);
  t.read(study_key("report.y_scale"), r.y_scale);
  read_reference(t, r, folder);
}

void read_baseline(Table& t, Study& s) {
  std::vector<std::string> names;
  for (const StudyCase& c : s.cases) names.push_back(c.name);
  std::string& baseline = s.report.baseline;
  if (t.read(study_key("report.baseline"), baseline) && t.has("baseline")
      && std::find(names.begin(), names.end(), baseline) == names.end())
    t.fail("baseline", unknown_word("case", baseline, names));
}

}  // namespace

void set_report_defaults(Study& s) {
  ReportSpec& r = s.report;
  const std::vector<std::string> keys = varied_keys(s);
  if (s.kind == StudyKind::convergence) {
    r.x = std::string("h");
    r.x_scale = r.y_scale = AxisScale::log;
    r.rate_over = std::find(keys.begin(), keys.end(), "mesh.cells") != keys.end() ? "mesh.cells" : "";
  } else if (!keys.empty()) {
    r.x = keys.back();
  }
}

void read_study_report(Table& t, Study& s, const fs::path& folder) {
  ReportSpec& r = s.report;
  const std::vector<std::string> keys = varied_keys(s);
  const ReportKeys known(s.kind);
  if (t.diagnostics().wrong.contains("kind")) t.pass(known.of_kinds);
  else if (has_curves(s.kind)) t.only("a study with curves", known.own, known.of_kinds);
  else if (s.kind == StudyKind::stability) t.only("a stability map", known.own, known.of_kinds);
  else t.only("a comparison", known.own, known.of_kinds);
  t.read(study_key("report.title"), r.title);
  t.read(study_key("report.text"), r.text);
  read_quantities(t, s, keys);
  read_one_name(t, study_key("report.rate_over"), r.rate_over, keys, "varied key");
  if (has_curves(s.kind)) read_curves(t, r, keys, folder);
  if (s.kind == StudyKind::compare) read_baseline(t, s);
  t.read(study_key("report.max_wall_s"), r.max_wall_s);
  t.read(study_key("report.energy_tolerance"), r.energy_tolerance);
  t.read(study_key("report.checkerboard_max"), r.checkerboard_max);
}

}  // namespace nanson
