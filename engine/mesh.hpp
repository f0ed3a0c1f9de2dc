// Tetrahedral mesh with named boundary patches and regions, in the file's own numbering.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "engine/scene.hpp"

namespace nanson {

/// What a generator or a reader delivers, unchecked.
struct RawMesh {
  std::vector<Vec3> X;                             // [m]
  std::vector<std::array<int, 4>> tets;            // node indices from 0
  std::vector<int> tet_region;                     // index into region_names, one per tet
  std::vector<std::string> region_names;
  std::vector<std::array<int, 3>> triangles;       // named boundary triangles, any orientation
  std::vector<int> triangle_patch;                 // index into patch_names, one per triangle
  std::vector<std::string> patch_names;
};

/// A boundary triangle, seen from outside counter-clockwise, and the tet it belongs to.
struct Face {
  std::array<int, 3> nodes;
  int tet;
  int patch;                                       // index into patch_names, -1 where the mesh names none
};

/// A checked mesh: all tets positively oriented, every node used, the boundary closed and manifold.
struct Mesh {
  std::vector<Vec3> X;                             // [m]
  std::vector<std::array<int, 4>> tets;
  std::vector<int> tet_region;
  std::vector<std::string> region_names;
  std::vector<Face> faces;
  std::vector<std::string> patch_names;
  int reoriented = 0;                              // tets whose nodes were swapped to make their volume positive
  int unnamed_faces = 0;                           // boundary triangles of no patch: traction free
};

/// Six tets a cell; faces xmin xmax ymin ymax zmin zmax, one region "box".
RawMesh make_box(const MeshSpec& spec);

/// Orients, finds the boundary and checks. Errors (named by index, each at most a few times) are appended; the mesh is valid when none was.
Mesh finish_mesh(RawMesh raw, std::vector<std::string>& errors);

/// Volume of a tet, positive when right-handed. [m^3]
double tet_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace nanson
