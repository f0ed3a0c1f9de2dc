// Scene, then mesh, then the names that only the mesh can check.
#include "io/scene/load.hpp"

#include "engine/clock.hpp"
#include "io/mesh/read_mesh.hpp"
#include "io/scene/read_scene.hpp"

namespace nanson {

std::optional<Loaded> load(const std::filesystem::path& file, const std::vector<std::string>& settings,
                           std::vector<std::string>& errors) {
  SceneResult read = read_scene(file, settings);
  errors = std::move(read.errors);
  Loaded out{std::move(read.scene), {}, 0, {}, std::move(read.resolved)};
  if (read.mesh_valid) {
    std::vector<std::string> mesh_errors;
    const double start = wall_seconds();
    out.mesh = load_mesh(out.scene.mesh, used_names(out.scene), mesh_errors, out.notes);
    out.mesh_s = wall_seconds() - start;
    if (mesh_errors.empty()) mesh_errors = check_names(out.scene, out.mesh);
    errors.insert(errors.end(), mesh_errors.begin(), mesh_errors.end());
  }
  if (!errors.empty()) return std::nullopt;
  return out;
}

}  // namespace nanson
