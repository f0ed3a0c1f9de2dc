// Tetrahedral mesh with named boundary patches and regions, in the file's own numbering.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "engine/scene.hpp"

namespace nanson {

/// What a generator or a reader delivers, unchecked.
struct RawMesh {
  std::vector<Vec3> X;                   // [m]
  std::vector<std::array<int, 4>> tets;  // node indices from 0
  std::vector<int> tet_region;           // index into region_names, one per tet
  std::vector<std::string> region_names;
  std::vector<std::array<int, 3>> triangles;  // named boundary triangles, any orientation
  std::vector<int> triangle_patch;            // index into patch_names, one per triangle
  std::vector<std::string> patch_names;
};

/// A boundary triangle, seen from outside counter-clockwise, and the tet it belongs to.
struct Face {
  std::array<int, 3> nodes;
  int tet;
  int patch;  // index into patch_names, -1 where the mesh names none
};

/// A checked mesh: all tets positively oriented, every node used, the boundary closed and manifold.
struct Mesh {
  std::vector<Vec3> X;  // [m]
  std::vector<std::array<int, 4>> tets;
  std::vector<int> tet_region;
  std::vector<std::string> region_names;
  std::vector<Face> faces;               // sorted by their nodes
  std::vector<std::string> patch_names;  // those that have a boundary face, in the order of the raw mesh
  int reoriented = 0;                    // tets whose nodes were swapped to make their volume positive
  int unnamed_faces = 0;                 // boundary triangles of no patch: traction free
};

/// Corners of the face opposite each node of a right-handed tet, counter-clockwise from outside.
inline constexpr std::array<std::array<int, 3>, 4> tet_faces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// Six tets a cell; faces xmin xmax ymin ymax zmin zmax, one region "box" or layers along an axis.
RawMesh make_box(const MeshSpec& spec);

/// A quarter of a circular cylinder, its axis from the origin along Z: a core of m x m cells, m half the tangential ones, in a ring of radial - m layers. The split
/// is the box's alternating one. Faces x0 y0 zmin zmax side, one region "cylinder". cells: tangential even, radial above m.
RawMesh make_cylinder(const MeshSpec& spec);

/// A needle of square cross-section along X between two spheres about the origin, in the box's alternating split: opposite sides are planes through the origin that
/// meet at `angle`. Faces inner outer sides, one region "needle".
RawMesh make_needle(const MeshSpec& spec);

/// Orients, finds the boundary and checks. Errors (named by index from 0, each kind at most five times) are appended; the mesh is
/// valid when none was. Named triangles between two tets are dropped: gmsh names interfaces of regions too.
Mesh finish_mesh(RawMesh raw, std::vector<std::string>& errors);

/// Volume of a tet, positive when right-handed. [m^3]
double tet_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace nanson
