// mesh.regions: layers of the built-in box along an axis.
#include <cmath>

#include "io/scene/scene_sections.hpp"

namespace nanson {

namespace {

constexpr double off_plane = 1e-6;  // share of a cell by which a plane may miss the cells' own

bool read_planes(Table& t, std::vector<double>& at) {
  const toml::node* node = t.find(key("mesh.regions.at"));
  if (!node) return false;
  const auto* list = node->as_array();
  if (!list || list->empty()) {
    t.fail("at", "must be a list of the planes between the layers [m]");
    return false;
  }
  bool ok = true;
  for (std::size_t i = 0; i < list->size(); ++i) {
    double plane = 0;
    ok = read_value(t.diagnostics(), (*list)[i], fmt::format("{}.{}", t.path("at"), i), plane) && ok;
    at.push_back(plane);
  }
  return ok;
}

/// Why plane i cannot part the cells; empty when it can.
std::string plane_problem(const MeshSpec& m, std::size_t i) {
  const std::size_t k = static_cast<std::size_t>(m.regions.axis);
  const double plane = m.regions.at[i], cell = m.size[k] / m.cells[k], cells = (plane - m.origin[k]) / cell,
               whole = std::round(cells);
  if (i > 0 && !(plane > m.regions.at[i - 1])) return "must lie above the plane before it";
  if (!(whole >= 1 && whole <= m.cells[k] - 1))
    return fmt::format("must lie inside the box, between {:g} and {:g}, with a row of cells on each side", m.origin[k],
                       m.origin[k] + m.size[k]);
  if (std::abs(cells - whole) > off_plane)
    return fmt::format("cuts through cells: the nearest plane between two of the {} is at {:g}", m.cells[k],
                       m.origin[k] + whole * cell);
  return "";
}

}  // namespace

void read_regions(Table& t, MeshSpec& m) {
  const bool box = t.sound("box") && t.sound("box.size") && t.sound("box.origin") && t.sound("cells");
  t.section(key("mesh.regions"), [&](Table& r) {
    MeshRegions regions;
    std::vector<Word> names;
    const bool axis = r.read(key("mesh.regions.axis"), regions.axis), planes = read_planes(r, regions.at);
    if (r.read(key("mesh.regions.names"), names)) {
      for (std::size_t i = 0; i < names.size(); ++i) {
        regions.names.push_back(names[i].text);
        for (std::size_t k = 0; k < i; ++k)
          if (names[k].text == names[i].text) report(r.diagnostics(), names[i], "is named twice");
      }
      if (planes && names.size() != regions.at.size() + 1)
        r.fail("names", fmt::format("must be {} names, one more than planes in \"at\"", regions.at.size() + 1));
    }
    if (!box || !axis || !planes) return;
    m.regions = regions;
    const auto* list = r.find("at")->as_array();
    for (std::size_t i = 0; i < regions.at.size(); ++i)
      if (const std::string why = plane_problem(m, i); !why.empty())
        report(r.diagnostics(), (*list)[i], fmt::format("{}.{}", r.path("at"), i), why);
  });
}

}  // namespace nanson
