// A scene file and the --set values, read into a Scene; every error with its place.
#pragma once
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "engine/mesh/mesh.hpp"
#include "engine/scene.hpp"

namespace nanson {

struct Key;

struct SceneResult {
  Scene scene;
  std::vector<std::string>
      errors;                  // "file:line:column: key = found: why", sorted; the scene is valid when there are none
  std::string resolved;        // the TOML with all settings in it: what makes one run differ from another
  std::set<const Key*> asked;  // keys of the table that the reader asked for
  bool mesh_valid = false;     // the mesh can be made, and names checked against it, although other sections are wrong
};

/// `settings` are "a.b=VALUE"; they override the file and are checked like it.
SceneResult read_scene(const std::filesystem::path& file, const std::vector<std::string>& settings = {});

/// What only the mesh knows: faces and regions that it does not name, regions without a material, plastic regions that touch, probes outside its bounding box.
std::vector<std::string> check_names(const Scene& scene, const Mesh& mesh);

}  // namespace nanson
