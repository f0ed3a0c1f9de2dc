// What a study shows: the [report] section, whose keys depend on the kind of the study.
#include "io/study/read_study_report.hpp"

#include <algorithm>
#include <array>

#include "io/read_csv.hpp"
#include "io/results/write_summary.hpp"

namespace nanson {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 8> of_kinds{"x",       "lines",     "panels",         "x_scale",
                                                   "y_scale", "reference", "reference_note", "baseline"};
constexpr std::array<std::string_view, 14> of_curves{"title",
                                                     "text",
                                                     "x",
                                                     "y",
                                                     "lines",
                                                     "panels",
                                                     "rate_over",
                                                     "x_scale",
                                                     "y_scale",
                                                     "reference",
                                                     "reference_note",
                                                     "max_wall_s",
                                                     "energy_tolerance",
                                                     "checkerboard_max"};
constexpr std::array<std::string_view, 8> of_a_map{
    "title", "text", "x", "y", "rate_over", "max_wall_s", "energy_tolerance", "checkerboard_max"};
constexpr std::array<std::string_view, 8> of_bars{
    "title", "text", "y", "rate_over", "baseline", "max_wall_s", "energy_tolerance", "checkerboard_max"};

/// What report.x and report.y may name besides varied keys: the numbers of summary.json and those that the study makes of them.
std::vector<std::string> known_quantities() {
  std::vector<std::string> names = summary_number_keys();
  for (const char* own : study_quantities) names.emplace_back(own);
  return names;
}

bool has_curves(StudyKind kind) { return kind == StudyKind::convergence || kind == StudyKind::sweep; }

/// A reference point: a label, and numbers under the names of x and y.
void read_point(Table& t, const ReportSpec& r, std::vector<ReferencePoint>& points) {
  ReferencePoint p;
  t.require("label", p.label);
  double x = 0;
  if (!r.x.empty() && t.require(r.x, x)) p.values[r.x] = x;
  bool any = false;
  for (const std::string& y : r.y) {
    double value = 0;
    if (t.has(y) && t.read(y, value)) p.values[y] = value;
    any = t.find(y) || any;
  }
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
void read_names(Table& t, std::string_view key, std::vector<std::string>& names,
                const std::vector<std::string>& allowed, std::string_view what,
                std::map<std::string, std::string>* places = nullptr) {
  const toml::node* node = t.find(key);
  if (!node) return;
  std::vector<Word> read;
  if (const auto* one = node->as_string()) read.push_back({one->get(), t.place(key), t.path(key)});
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
void read_one_name(Table& t, std::string_view key, std::string& name, const std::vector<std::string>& allowed,
                   std::string_view what, std::map<std::string, std::string>* places = nullptr) {
  if (!t.has(key)) return;
  std::vector<std::string> names;
  read_names(t, key, names, allowed, what, places);
  if (names.size() == 1) name = names[0];
  else if (t.sound(key)) t.fail(key, "must be one name");
}

void read_quantities(Table& t, Study& s, const std::vector<std::string>& keys) {
  ReportSpec& r = s.report;
  std::vector<std::string> quantities = known_quantities();
  quantities.insert(quantities.end(), keys.begin(), keys.end());
  const auto varied = [&](const std::string& name) { return std::find(keys.begin(), keys.end(), name) != keys.end(); };
  if (s.kind != StudyKind::compare) read_one_name(t, "x", r.x, quantities, "quantity", &r.where);
  if (s.kind == StudyKind::stability && t.has("x") && !varied(r.x))
    t.fail("x", "must be a varied key: it is the horizontal side of the map");
  read_names(t, "y", r.y, quantities, "quantity", &r.where);
  for (const std::string& y : r.y)
    if (varied(y)) t.fail("y", fmt::format("{} is varied, not a result", y));
  if (s.kind == StudyKind::stability || !t.sound("y")) return;
  if (!t.has("y")) t.missing({"y"}, "report.y: is missing: what the plots show");
  else if (r.y.empty()) t.fail("y", "must name at least one quantity: what the plots show");
}

void read_reference(Table& t, ReportSpec& r, const fs::path& folder) {
  t.read("reference_note", r.reference_note);
  if (t.has("reference_note") && !t.has("reference"))
    t.fail("reference_note", "is about report.reference, which is missing");
  const toml::node* reference = t.find("reference");
  if (!reference) return;
  std::string file;
  if (!reference->is_string()) t.list("reference", [&](Table& p) { read_point(p, r, r.reference); });
  else if (t.read("reference", file)) read_reference_file(t, folder / file, r);
}

void read_curves(Table& t, ReportSpec& r, const std::vector<std::string>& keys, const fs::path& folder) {
  read_names(t, "lines", r.lines, keys, "varied key");
  read_one_name(t, "panels", r.panels, keys, "varied key");
  if (!r.panels.empty() && r.panels == r.x) t.fail("panels", "is report.x");
  t.read("x_scale", r.x_scale);
  t.read("y_scale", r.y_scale);
  read_reference(t, r, folder);
}

void read_baseline(Table& t, Study& s) {
  std::vector<std::string> names;
  for (const StudyCase& c : s.cases) names.push_back(c.name);
  std::string& baseline = s.report.baseline;
  if (t.read("baseline", baseline) && t.has("baseline")
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
  if (t.diagnostics().wrong.contains("kind")) t.pass(of_bars);
  else if (has_curves(s.kind)) t.only("a study with curves", of_curves, of_kinds);
  else if (s.kind == StudyKind::stability) t.only("a stability map", of_a_map, of_kinds);
  else t.only("a comparison", of_bars, of_kinds);
  t.read("title", r.title);
  t.read("text", r.text);
  read_quantities(t, s, keys);
  read_one_name(t, "rate_over", r.rate_over, keys, "varied key");
  if (has_curves(s.kind)) read_curves(t, r, keys, folder);
  if (s.kind == StudyKind::compare) read_baseline(t, s);
  t.read("max_wall_s", r.max_wall_s, {.above = 0});
  t.read("energy_tolerance", r.energy_tolerance, {.from = 0});
  t.read("checkerboard_max", r.checkerboard_max, {.above = 0});
}

}  // namespace nanson
