// Names and places of a scene that only the mesh can confirm.
#include <algorithm>
#include <limits>

#include "io/scene/read_scene.hpp"
#include "io/scene/words.hpp"

namespace nanson {

namespace {

struct Box {
  Vec3 low, high;
};

Box bounding_box(const Mesh& mesh) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Box box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  for (const Vec3& X : mesh.X) {
    for (std::size_t i = 0; i < 3; ++i) {
      box.low[i] = std::min(box.low[i], X[i]);
      box.high[i] = std::max(box.high[i], X[i]);
    }
  }
  return box;
}

/// Up to the rounding of coordinates that were computed or written as text.
bool inside(const Box& box, const Vec3& at) {
  double extent = 0;
  for (std::size_t i = 0; i < 3; ++i) extent = std::max(extent, box.high[i] - box.low[i]);
  const double slack = 1e-9 * extent;
  for (std::size_t i = 0; i < 3; ++i)
    if (!(at[i] >= box.low[i] - slack && at[i] <= box.high[i] + slack)) return false;
  return true;
}

std::string shown(const Vec3& v) { return fmt::format("[{}, {}, {}]", v[0], v[1], v[2]); }

/// Regions that the mesh does not have, and regions of the mesh that no [[material]] is for.
void check_regions(const Scene& scene, const Mesh& mesh, std::vector<std::string>& errors) {
  const auto materials = materials_of(scene);
  if (materials[0].regions.empty()) return;  // one [material]
  std::vector<std::string> named;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    for (const Named& region : materials[i].regions) {
      named.push_back(region.name);
      if (std::find(mesh.region_names.begin(), mesh.region_names.end(), region.name) != mesh.region_names.end())
        continue;
      errors.push_back(fmt::format("{}: material.{}.region = \"{}\": {}", region.where, i, region.name,
                                   unknown_word("region", region.name, mesh.region_names)));
    }
  }
  for (std::size_t r = 0; r < mesh.region_names.size(); ++r) {
    const long tets = std::count(mesh.tet_region.begin(), mesh.tet_region.end(), static_cast<int>(r));
    if (tets == 0 || std::find(named.begin(), named.end(), mesh.region_names[r]) != named.end()) continue;
    errors.push_back(fmt::format("{}: material: no [[material]] is for region \"{}\" of the mesh, which has {} tets",
                                 materials[0].regions[0].where, mesh.region_names[r], tets));
  }
}

}  // namespace

std::vector<std::string> check_names(const Scene& scene, const Mesh& mesh) {
  std::vector<std::string> errors;
  for (std::size_t i = 0; i < scene.boundary.size(); ++i) {
    for (const Named& face : scene.boundary[i].faces) {
      if (std::find(mesh.patch_names.begin(), mesh.patch_names.end(), face.name) != mesh.patch_names.end()) continue;
      errors.push_back(fmt::format("{}: boundary.{}.face = \"{}\": {}", face.where, i, face.name,
                                   unknown_word("face", face.name, mesh.patch_names)));
    }
  }
  check_regions(scene, mesh, errors);
  const Box box = bounding_box(mesh);
  for (const ProbeSpec& p : scene.output.probes) {
    if (inside(box, p.at)) continue;
    const std::string why = fmt::format("lies outside the mesh, which spans {} to {}", shown(box.low), shown(box.high));
    errors.push_back(fmt::format("{}: output.probes.{}.at = {}: {}", p.where, p.name, shown(p.at), why));
  }
  return errors;
}

}  // namespace nanson
