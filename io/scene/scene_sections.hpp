// The readers of a scene's sections, one function each; they share the rule for keys that belong to one kind of thing only.
#pragma once
#include <filesystem>
#include <vector>

#include "engine/scene.hpp"
#include "io/scene/config_table.hpp"

namespace nanson {

void read_regions(Table& t, MeshSpec& m);
void read_mesh_section(Table& t, MeshSpec& m, const std::filesystem::path& folder);
/// [material], or [[material]] for several regions.
void read_materials(Table& root, Scene& s);
void read_physics(Table& t, PhysicsSpec& p);
void read_projection(Table& t, ProjectionSpec& p);
void read_initial(Table& t, InitialSpec& s);
/// A name or a list of names, required.
void read_names(Table& t, std::string_view key, std::vector<Word>& names);
void read_boundaries(Table& root, std::vector<BoundarySpec>& boundary);
void read_time_function(Table& t, TimeFunction& f);
void read_time(Table& t, TimeSpec& s);
void read_output(Table& t, OutputSpec& o);
void read_monitor(Table& t, MonitorSpec& m);

/// Rules between sections, for what was read without an error.
void check_together(Table& root, const Scene& s);

/// A kind and the keys that belong to it.
template <class Kind>
struct KindKeys {
  Kind kind;
  std::vector<std::string_view> keys;
};

/// Reads the kind and refuses keys that belong to other kinds only. False when the kind is wrong or missing: then nothing is said about any of
/// these keys, and `kind` keeps its default, which has none.
template <class Kind>
bool read_kind(Table& t, std::string_view key, Kind& kind, bool required, const std::vector<KindKeys<Kind>>& table) {
  std::vector<std::string_view> all, own;
  for (const auto& entry : table) all.insert(all.end(), entry.keys.begin(), entry.keys.end());
  if (!(required ? t.require(key, kind) : t.read(key, kind))) {
    t.pass(all);
    return false;
  }
  for (const auto& entry : table)
    if (entry.kind == kind) own = entry.keys;
  t.only(word(kind), own, all);
  return true;
}

}  // namespace nanson
