// Meshes from where the scene says: a built-in one, a .msh file, a .geo file that the gmsh program meshes, or an .inp deck.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh/used_names.hpp"

namespace nanson {

/// Reads a Gmsh .msh file (4.1 or 2.2, text or binary; first-order tets and triangles). Physical volumes become regions, physical
/// surfaces patches; tets of no physical volume are in region "unnamed". Nodes keep the order of the file, without construction points.
/// A .geo file is meshed first, in a folder that is removed. Every error starts with the path, in .msh text files with the line too.
RawMesh read_mesh(const std::filesystem::path& path, std::vector<std::string>& errors);

/// The same from bytes in memory; errors start with `name`.
RawMesh read_msh(std::string_view bytes, const std::string& name, std::vector<std::string>& errors);

/// Makes or reads the mesh of a scene and checks it; valid when no error was appended. Notes tell what a file holds besides.
Mesh load_mesh(const MeshSpec& spec, const UsedNames& used, std::vector<std::string>& errors,
               std::vector<std::string>& notes);

/// The same where no name is used yet.
Mesh load_mesh(const MeshSpec& spec, std::vector<std::string>& errors);

}  // namespace nanson
