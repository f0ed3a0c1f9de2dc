// Which choices cannot stand together, once: what no rule here forbids is built, and for nothing else is a combination refused. The scene check, the reference pages and
// the generators of tests walk this list.
#pragma once
#include <span>
#include <string_view>

#include "engine/scene.hpp"

namespace nanson {

struct PhysicsRule {
  std::string_view key;  // whose value cannot stand, as a scene spells it; keys of material are asked of every material
  std::string_view beside;  // the key that it cannot stand beside; while that is wrong itself, nothing is said
  bool (*broken)(const Scene&, const MaterialSpec&);
  std::string_view
      why;  // a sentence after "key = value: "; what nothing forbids but the work to be done "is not built yet"
};

std::span<const PhysicsRule> physics_rules();

/// The first rule that a scene breaks, or none.
const PhysicsRule* broken_rule(const Scene& scene);

}  // namespace nanson
