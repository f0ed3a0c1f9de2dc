// What the sections of a scene say together: the rules of physics, each complained of at the key that it concerns, and options that nothing would read.
#include <fmt/format.h>

#include <span>
#include <string>

#include "engine/physics_rules.hpp"
#include "io/scene/scene_sections.hpp"

namespace nanson {
namespace {

/// Complaints at keys of the scene, each where the key stands.
class Keys {
 public:
  Keys(Table& root, const Scene& scene)
      : root_(root),
        materials_(materials_of(scene)),
        many_(root.find("material") && root.find("material")->as_array()) {}

  /// Names of a key: one, but for a key of `material` one for every material.
  std::string name(std::string_view key, std::size_t i) const {
    if (!many_ || !key.starts_with("material.")) return std::string(key);
    return fmt::format("material.{}{}", i, key.substr(key.find('.')));
  }
  bool is_sound(std::string_view key) const {
    const std::size_t count = key.starts_with("material.") ? materials_.size() : 1;
    for (std::size_t i = 0; i < count; ++i)
      if (root_.diagnostics().wrong.contains(name(key, i))) return false;
    return true;
  }
  /// At the key, or at its section where the key is not written.
  void fail(const std::string& key, std::string_view why) {
    const std::size_t dot = key.rfind('.');
    const std::string section = key.substr(0, dot);
    if (const auto* t = table_of(section)) Table(*t, section, root_.diagnostics()).fail(key.substr(dot + 1), why);
  }
  void check(const PhysicsRule& rule, const Scene& s) {
    if (!rule.beside.empty() && !is_sound(rule.beside)) return;
    const std::size_t count = rule.key.starts_with("material.") ? materials_.size() : 1;
    for (std::size_t i = 0; i < count; ++i) {
      const std::string key = name(rule.key, i);
      if (!root_.diagnostics().wrong.contains(key) && rule.broken(s, materials_[i])) fail(key, rule.why);
    }
  }

 private:
  const toml::table* table_of(std::string_view section) const {
    const std::size_t dot = section.find('.');
    const toml::node* node = root_.find(section.substr(0, dot));
    if (const auto* list = node ? node->as_array() : nullptr)
      node = list->get(dot == section.npos ? 0 : std::stoul(std::string(section.substr(dot + 1))));
    return node ? node->as_table() : nullptr;
  }

  Table& root_;
  std::span<const MaterialSpec> materials_;
  bool many_;
};

/// The section [projection] is read by {p, F, p} alone.
void check_projection_keys(Table& root, Keys& keys, const Scene& s) {
  const toml::node* section = root.find("projection");
  if (s.physics.formulation == Formulation::pFp || !keys.is_sound("physics.formulation") || !section) return;
  for (const char* key :
       {"solver", "stabilisation", "drift_control", "length_scale", "tolerance", "max_iterations", "on_limit"}) {
    const std::string name = fmt::format("projection.{}", key);
    if (section->as_table() && section->as_table()->contains(key) && keys.is_sound(name))
      keys.fail(name, "is a key of physics.formulation = \"pFp\" only");
  }
}

}  // namespace

void check_together(Table& root, const Scene& s) {
  Keys keys(root, s);
  for (const PhysicsRule& rule : physics_rules()) keys.check(rule, s);
  check_projection_keys(root, keys, s);
}

}  // namespace nanson
