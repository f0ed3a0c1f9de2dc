// From a scene file to a Scene: the text, the settings, the sections in order, then the rules between sections.
#include "io/scene/read_scene.hpp"

#include <algorithm>
#include <optional>
#include <sstream>

#include "io/scene/parse_toml.hpp"
#include "io/scene/scene_sections.hpp"
#include "io/scene/settings.hpp"
#include "io/text_file.hpp"

namespace nanson {

namespace {

namespace fs = std::filesystem;

std::optional<toml::table> parse_text(const std::string& text, Diagnostics& d) {
  try {
    return parse_toml(text);
  } catch (const toml::parse_error& e) {
    report(d, place_of(e.source()), std::string(e.description()));
    return std::nullopt;
  }
}

void read_root(Table& root, SceneResult& r, const fs::path& folder) {
  Scene& s = r.scene;
  if (root.read(key("scene"), s.name) && !is_plain(s.name))
    root.fail("scene", "names a folder: use letters, digits, - and _ only");
  root.section(key("mesh"), [&](Table& t) { read_mesh_section(t, s.mesh, folder); });
  read_materials(root, s);
  root.section(key("physics"), [&](Table& t) { read_physics(t, s.physics); });
  root.section(key("projection"), [&](Table& t) { read_projection(t, s.projection); });
  root.section(key("initial"), [&](Table& t) { read_initial(t, s.initial); });
  read_boundaries(root, s.boundary);
  root.section(key("body_force"), [&](Table& t) { t.read(key("body_force.g"), s.body_force); });
  root.section(key("time"), [&](Table& t) { read_time(t, s.physics, s.time); });
  root.section(key("output"), [&](Table& t) { read_output(t, s.output); });
  root.section(key("monitor"), [&](Table& t) { read_monitor(t, s.monitor); });
  check_together(root, s);
}

bool concerns_mesh(const std::string& key) { return key == "mesh" || key.starts_with("mesh."); }

}  // namespace

SceneResult read_scene(const fs::path& file, const std::vector<std::string>& settings) {
  SceneResult r;
  r.scene.file = file;
  Diagnostics d;
  d.file = file.string();

  std::string why;
  std::vector<Setting> parsed = parse_settings(settings, d);
  std::optional<std::string> text = read_text_file(file, why);
  if (!text) {
    r.errors = listed(d);
    r.errors.insert(r.errors.begin(), d.file + ": " + why);  // it has no line
    return r;
  }
  r.scene.text = *text;
  if (!settings.empty() && !text->ends_with('\n')) r.scene.text += '\n';
  for (const std::string& setting : settings) r.scene.text += "# --set " + setting + "\n";

  if (std::optional<toml::table> tree = parse_text(*text, d)) {
    for (Setting& s : parsed) apply(*tree, std::move(s), d);
    std::ostringstream resolved;
    resolved << toml::toml_formatter{*tree};  // keys sorted, comments gone
    r.resolved = resolved.str();
    Table root(*tree, "", d);
    read_root(root, r, file.parent_path());
    root.finish();
    r.asked = std::move(d.asked);
    r.mesh_valid = std::none_of(d.wrong.begin(), d.wrong.end(), concerns_mesh);
  }
  r.errors = listed(std::move(d));
  return r;
}

}  // namespace nanson
