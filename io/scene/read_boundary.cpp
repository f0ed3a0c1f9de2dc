// The [[boundary]] entries: kinds, functions of time, and which kinds may meet on one face.
#include <limits>

#include "io/scene/scene_sections.hpp"

namespace nanson {

namespace {

struct Entry {
  std::vector<Word> faces;
  BoundarySpec spec;
};

/// Three numbers, where the word "free" leaves a component to the body.
void read_velocity(Table& t, BoundarySpec& b) {
  Diagnostics& d = t.diagnostics();
  const toml::node* v = t.require_node("v");
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
  const toml::node* node = t.require_node("points");
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

void read_entry(Table& t, Entry& e) {
  using enum BoundaryKind;
  BoundarySpec& b = e.spec;
  read_names(t, "face", e.faces);
  for (const Word& f : e.faces) b.faces.push_back({f.text, where(t.diagnostics(), f.place)});
  const bool known = read_kind<BoundaryKind>(t, "kind", b.kind, true,
                                             {{traction, {"t"}}, {pressure, {"p"}}, {velocity, {"v"}}});
  if (known && b.kind == traction) t.require("t", b.traction);
  if (known && b.kind == pressure) t.require("p", b.pressure);
  if (known && b.kind == velocity) read_velocity(t, b);
  t.section("time", [&](Table& f) { read_time_function(f, b.time); });
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

void read_names(Table& t, std::string_view key, std::vector<Word>& names) {
  const toml::node* node = t.find(key);
  if (node && node->is_string()) {
    names.push_back({node->as_string()->get(), t.place(key), t.path(key)});
  } else if (node && !node->is_array()) {
    t.fail(key, "must be a name or a list of names");
  } else if (t.require(key, names) && names.empty()) {
    t.fail(key, fmt::format("must name at least one {}", key));
  }
}

void read_boundaries(Table& root, std::vector<BoundarySpec>& boundary) {
  std::vector<Entry> sound;
  root.list("boundary", [&](Table& t) {
    Entry e;
    read_entry(t, e);
    if (t.sound("kind") && t.sound("v")) sound.push_back(e);
    boundary.push_back(std::move(e.spec));
  });
  check_shared_faces(sound, root.diagnostics());
}

void read_time_function(Table& t, TimeFunction& f) {
  using enum TimeKind;
  read_kind<TimeKind>(t, "kind", f.kind, true,
                      {{ramp, {"until"}},
                       {sine, {"frequency", "phase"}},
                       {pulse, {"from", "until"}},
                       {logistic, {"rate", "centre", "until"}},
                       {table, {"points"}}});
  if (f.kind == ramp) t.require("until", f.until, {.above = 0});
  if (f.kind == sine) {
    t.require("frequency", f.frequency, {.above = 0});
    t.read("phase", f.phase);
  }
  if (f.kind == pulse) {
    const bool from = t.require("from", f.from), until = t.require("until", f.until);
    if (from && until && !(f.from < f.until)) t.fail("until", fmt::format("must be above from = {}", f.from));
  }
  if (f.kind == logistic) {
    t.require("rate", f.rate, {.above = 0});
    t.require("centre", f.centre);
    t.require("until", f.until, {.above = 0});
  }
  if (f.kind == table) read_points(t, f.points);
}

}  // namespace nanson
