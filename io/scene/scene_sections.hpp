// The readers of a scene's sections, one function each; they share the rule for keys that belong to one kind of thing only.
#pragma once
#include <filesystem>
#include <vector>

#include "engine/scene.hpp"
#include "io/scene/config_table.hpp"
#include "io/scene/scene_keys.hpp"

namespace nanson {

void read_regions(Table& t, MeshSpec& m);
void read_mesh_section(Table& t, MeshSpec& m, const std::filesystem::path& folder);
/// [material], or [[material]] for several regions.
void read_materials(Table& root, Scene& s);
void read_physics(Table& t, PhysicsSpec& p);
void read_projection(Table& t, ProjectionSpec& p);
void read_initial(Table& t, InitialSpec& s);
/// A name or a list of names, at least one.
void read_names(Table& t, const Key& key, std::vector<Word>& names);
void read_boundaries(Table& root, std::vector<BoundarySpec>& boundary);
void read_time_function(Table& t, TimeFunction& f);
void read_time(Table& t, const PhysicsSpec& physics, TimeSpec& s);
void read_output(Table& t, OutputSpec& o);
void read_monitor(Table& t, MonitorSpec& m);

/// Rules between sections, for what was read without an error.
void check_together(Table& root, const Scene& s);

/// The keys of a section that belong to one kind of thing or another, each once, and of these the ones that belong to `word`.
struct KindKeys {
  std::vector<std::string_view> all, own;
};
KindKeys kind_keys(std::span<const Key> table, std::string_view section, std::string_view word);

/// Reads the kind and refuses keys that belong to other kinds only. False when the kind is wrong or missing: then nothing is said about any of
/// these keys, and `kind` keeps its default, which has none.
template <class Kind>
bool read_kind(Table& t, const Key& key, Kind& kind) {
  const bool known = t.read(key, kind);
  const KindKeys keys = kind_keys(scene_keys, key.section(), word(kind));
  if (known) t.only(word(kind), keys.own, keys.all);
  else t.pass(keys.all);
  return known;
}

}  // namespace nanson
