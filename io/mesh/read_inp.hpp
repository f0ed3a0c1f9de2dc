// Meshes from input decks of Abaqus and CalculiX. Faces are surfaces, sets of triangles and sets of nodes; regions are the element sets of the solid
// sections, where there are none those that elements name themselves.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "io/mesh/used_names.hpp"

namespace nanson {

/// Errors say where they stand; notes what was left out.
RawMesh read_inp(const std::filesystem::path& file, const UsedNames& used, std::vector<std::string>& errors,
                 std::vector<std::string>& notes);

}  // namespace nanson
