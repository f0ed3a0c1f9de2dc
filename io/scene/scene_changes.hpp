// What differs between the scene of a checkpoint and the one that is to go on from it, key by key.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace nanson {

struct KeyChange {
  std::string key;            // "material.density", "boundary.0.pressure"
  std::string before, after;  // values as TOML, of a key that is not written its default; empty where it has none
};

/// Of two scenes as read (Loaded::resolved), sorted by key.
std::vector<KeyChange> scene_changes(const std::string& before, const std::string& after);

/// Keys that end or show a run but do not make its problem another one; a restart may change them.
bool may_change_at_restart(std::string_view key);

/// "material.density: 1000.0 -> 1100.0".
std::string change_text(const KeyChange& change);

}  // namespace nanson
