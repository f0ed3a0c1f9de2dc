// Groups of a mesh may overlap: the names that a scene uses decide what a triangle or a tet counts for.
#pragma once
#include <string>
#include <vector>

#include "engine/mesh/mesh.hpp"

namespace nanson {

/// Names of faces and regions in a scene's [[boundary]] and [[material]].
struct UsedNames {
  std::vector<std::string> faces, regions;
};

UsedNames used_names(const Scene& scene);

/// Of the patches that a triangle is in keeps those that are used, or the smallest where none is, of equal ones the last; two used ones are left for finish_mesh to refuse.
void keep_used_patches(RawMesh& raw, const UsedNames& used);

}  // namespace nanson
