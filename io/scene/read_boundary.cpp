// The [[boundary]] entries: kinds, functions of time, and which kinds may meet on one face.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include "io/read_csv.hpp"
#include "io/scene/scene_sections.hpp"
#include "io/text_file.hpp"

namespace nanson {

namespace {

struct Entry {
  std::vector<Word> faces;
  BoundarySpec spec;
};

/// Three numbers, where the word "free" leaves a component to the body.
void read_velocity(Table& t, BoundarySpec& b) {
  Diagnostics& d = t.diagnostics();
  const toml::node* v = t.find(key("boundary.v"));
  if (!v) return;
  const auto* list = v->as_array();
  if (!list || list->size() != 3) return t.fail("v", "must be three numbers, or \"free\" in place of some");
  for (std::size_t i = 0; i < 3; ++i) {
    const toml::node& component = (*list)[i];
    const std::string path = fmt::format("{}.{}", t.path("v"), i);
    const auto* word = component.as_string();
    b.held[i] = !word;
    if (word && word->get() == "free") continue;
    if (word) report(d, component, path, "must be a number or \"free\"");
    if (word || !read_value(d, component, path, b.velocity[i])) d.wrong.insert(t.path("v"));
  }
  if (t.sound("v") && !b.held[0] && !b.held[1] && !b.held[2]) t.fail("v", "holds no component, use kind = \"free\"");
}

void read_points(Table& t, std::vector<std::pair<double, double>>& points) {
  Diagnostics& d = t.diagnostics();
  const toml::node* node = t.find(key("boundary.time.points"));
  if (!node) return;
  const auto* list = node->as_array();
  if (!list || list->size() < 2) return t.fail("points", "must be a list of at least two points [t, factor]");
  for (std::size_t i = 0; i < list->size(); ++i) {
    const toml::node& point = (*list)[i];
    const std::string path = fmt::format("{}.{}", t.path("points"), i);
    const auto* pair = point.as_array();
    std::pair<double, double> p;
    if (!pair || pair->size() != 2) {
      report(d, point, path, "must be two numbers [t, factor]");
    } else if (read_value(d, (*pair)[0], path + ".0", p.first) && read_value(d, (*pair)[1], path + ".1", p.second)) {
      const double last = points.empty() ? -std::numeric_limits<double>::infinity() : points.back().first;
      if (!(p.first > last)) report(d, point, path, fmt::format("must come after the point at t = {}", last));
      points.push_back(p);
    }
  }
}

/// Two columns of a file, counted from 1.
std::array<std::size_t, 2> read_columns(Table& t) {
  std::array<std::size_t, 2> columns{1, 2};
  const toml::node* node = t.find(key("boundary.time.columns"));
  if (!node) return columns;
  const auto* list = node->as_array();
  bool sound = list && list->size() == 2;
  for (std::size_t i = 0; sound && i < 2; ++i) {
    const auto* number = (*list)[i].as_integer();
    sound = number && number->get() >= 1;
    if (sound) columns[i] = static_cast<std::size_t>(number->get());
  }
  if (!sound) t.fail("columns", "must be two column numbers from 1 on, that of t and that of the factor");
  return columns;
}

/// A first line that is not all numbers is a heading.
std::string points_of(const CsvTable& table, const std::array<std::size_t, 2>& columns,
                      std::vector<std::pair<double, double>>& points) {
  std::vector<std::vector<std::string>> rows{table.names};
  rows.insert(rows.end(), table.rows.begin(), table.rows.end());
  const std::size_t width = table.names.size(), most = std::max(columns[0], columns[1]);
  if (most > width) return fmt::format("has {} columns, no column {}", width, most);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::array<double, 2> v{};
    bool sound = true;
    for (std::size_t k = 0; k < 2; ++k) {
      const std::string& text = rows[i][columns[k] - 1];
      char* end = nullptr;
      v[k] = std::strtod(text.c_str(), &end);
      while (end && (*end == ' ' || *end == '\t')) ++end;
      sound = sound && end != text.c_str() && *end == '\0' && std::isfinite(v[k]);
    }
    if (!sound && i == 0) continue;
    if (!sound)
      return fmt::format("row {}: \"{}\", \"{}\" are not two numbers", i + 1, rows[i][columns[0] - 1],
                         rows[i][columns[1] - 1]);
    if (!points.empty() && !(v[0] > points.back().first))
      return fmt::format("row {}: t = {} must come after {}", i + 1, v[0], points.back().first);
    points.push_back({v[0], v[1]});
  }
  return points.size() < 2 ? "must hold at least two points" : "";
}

/// The file stands beside the scene, or at its path from there.
void read_points_file(Table& t, std::vector<std::pair<double, double>>& points) {
  const std::array<std::size_t, 2> columns = read_columns(t);
  std::string name;
  if (!t.read(key("boundary.time.file"), name) || name.empty() || !t.sound("columns")) return;
  std::string why;
  auto text = read_text_file(std::filesystem::path(t.diagnostics().file).parent_path() / name, why);
  if (!text) return t.fail("file", why);
  if (!text->ends_with('\n')) *text += '\n';
  const auto table = parse_csv(*text, why);
  if (table) why = points_of(*table, columns, points);
  if (!why.empty()) t.fail("file", why);
}

void read_table(Table& t, std::vector<std::pair<double, double>>& points) {
  if (!t.has("points") && !t.has("file"))
    t.missing({"points", "file"}, fmt::format("{}: is missing, or file", t.path("points")));
  if (t.has("points") && t.has("file")) t.fail("file", "cannot stand beside points");
  read_points(t, points);
  std::vector<std::pair<double, double>> of_file;
  read_points_file(t, of_file);
  if (!t.has("points")) points = std::move(of_file);
}

void read_entry(Table& t, Entry& e) {
  using enum BoundaryKind;
  BoundarySpec& b = e.spec;
  read_names(t, key("boundary.face"), e.faces);
  for (const Word& f : e.faces) b.faces.push_back({f.text, where(t.diagnostics(), f.place)});
  const bool known = read_kind(t, key("boundary.kind"), b.kind);
  if (known && b.kind == traction) t.read(key("boundary.t"), b.traction);
  if (known && b.kind == pressure) t.read(key("boundary.p"), b.pressure);
  if (known && b.kind == velocity) read_velocity(t, b);
  t.section(key("boundary.time"), [&](Table& f) { read_time_function(f, b.time); });
  const bool has_value = b.kind == traction || b.kind == pressure || b.kind == velocity;
  if (known && !has_value && b.time.kind != TimeKind::constant)
    t.fail("time", fmt::format("kind {} has no value that could change in time", word(b.kind)));
}

bool is_load(const BoundarySpec& b) { return b.kind == BoundaryKind::traction || b.kind == BoundaryKind::pressure; }

bool holds_all(const BoundarySpec& b) {
  return b.kind == BoundaryKind::fixed || (b.kind == BoundaryKind::velocity && b.held[0] && b.held[1] && b.held[2]);
}

/// Why two entries cannot share a face; empty when they can: loads with each other and with what leaves them a direction to act in.
std::string_view conflict(const BoundarySpec& a, const BoundarySpec& b) {
  if (a.kind == b.kind) return "the same kind twice";
  if (a.kind == BoundaryKind::free || b.kind == BoundaryKind::free) return "a free face takes nothing else";
  if (!is_load(a) && !is_load(b)) return "the face would be held twice";
  if (holds_all(a) || holds_all(b)) return "a load does nothing on a face that is held in all directions";
  return {};
}

void check_shared_faces(const std::vector<Entry>& entries, Diagnostics& d) {
  struct Use {
    const Word* face;
    const BoundarySpec* spec;
  };
  std::vector<Use> uses;
  for (const Entry& e : entries) {
    for (const Word& face : e.faces) {
      for (const Use& before : uses) {
        if (before.face->text != face.text) continue;
        const std::string_view why = before.spec == &e.spec ? "the list names it twice"
                                                            : conflict(*before.spec, e.spec);
        if (why.empty()) continue;
        const std::string place = where(d, before.face->place);
        report(d, face,
               fmt::format("kind {} cannot join kind {} of {}: {}", word(e.spec.kind), word(before.spec->kind), place,
                           why));
        break;
      }
      uses.push_back({&face, &e.spec});
    }
  }
}

}  // namespace

void read_names(Table& t, const Key& key, std::vector<Word>& names) {
  const std::string_view name = key.name();
  const toml::node* node = t.find(key);
  if (!node) return;
  if (node->is_string()) names.push_back({node->as_string()->get(), t.place(name), t.path(name)});
  else if (!node->is_array()) t.fail(name, "must be a name or a list of names");
  else if (t.read(key, names) && names.empty()) t.fail(name, fmt::format("must name at least one {}", name));
}

void read_boundaries(Table& root, std::vector<BoundarySpec>& boundary) {
  std::vector<Entry> sound;
  root.list(key("boundary"), [&](Table& t) {
    Entry e;
    read_entry(t, e);
    if (t.sound("kind") && t.sound("v")) sound.push_back(e);
    boundary.push_back(std::move(e.spec));
  });
  check_shared_faces(sound, root.diagnostics());
}

void read_time_function(Table& t, TimeFunction& f) {
  using enum TimeKind;
  read_kind(t, key("boundary.time.kind"), f.kind);
  if (f.kind == ramp) t.read(key("boundary.time.until", "ramp"), f.until);
  if (f.kind == sine) {
    t.read(key("boundary.time.frequency"), f.frequency);
    t.read(key("boundary.time.phase"), f.phase);
  }
  if (f.kind == pulse) {
    const bool from = t.read(key("boundary.time.from"), f.from);
    const bool until = t.read(key("boundary.time.until", "pulse"), f.until);
    if (from && until && !(f.from < f.until)) t.fail("until", fmt::format("must be above from = {}", f.from));
  }
  if (f.kind == logistic) {
    t.read(key("boundary.time.rate"), f.rate);
    t.read(key("boundary.time.centre"), f.centre);
    t.read(key("boundary.time.until", "logistic"), f.until);
  }
  if (f.kind == table) read_table(t, f.points);
}

}  // namespace nanson
