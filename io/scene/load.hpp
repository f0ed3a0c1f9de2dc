// A scene and its mesh, or every error of both at once.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/mesh/mesh.hpp"
#include "engine/scene.hpp"

namespace nanson {

struct Loaded {
  Scene scene;
  Mesh mesh;
  double mesh_s = 0;               // [s] to read or make it and to check it
  std::vector<std::string> notes;  // what its file holds besides
  std::string resolved;            // the scene as read, with --set, as sorted TOML
};

/// Nothing when something is wrong: all of it then stands in `errors`.
std::optional<Loaded> load(const std::filesystem::path& file, const std::vector<std::string>& settings,
                           std::vector<std::string>& errors);

}  // namespace nanson
