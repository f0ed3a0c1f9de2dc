// Size and shape of a mesh in a few numbers, for `nanson check`.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "engine/mesh/mesh.hpp"

namespace nanson {

struct PatchSize {
  std::string name;
  std::size_t faces = 0;
  double area = 0;  // [m^2]
};

struct MeshQuality {
  std::size_t nodes = 0, tets = 0, boundary_faces = 0;
  double volume = 0;                      // [m^3]
  double min_edge = 0, max_edge = 0;      // [m]
  double min_volume = 0, max_volume = 0;  // [m^3] of a tet
  double worst = 1;                       // smallest mean ratio, see mean_ratio
  int worst_tet = 0;
  Vec3 worst_centre{};                      // [m]
  std::array<std::size_t, 10> histogram{};  // tets with mean ratio in [0, 0.1), [0.1, 0.2), ... [0.9, 1]
  std::vector<PatchSize> patches;           // one per patch name
  PatchSize unnamed{"(unnamed)"};           // boundary faces of no patch
};

/// 12 (3 V)^(2/3) / (sum of the squared edge lengths): 1 for a regular tet, 0 for a flat one. [-]
double mean_ratio(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// The mesh must have passed finish_mesh.
MeshQuality mesh_quality(const Mesh& mesh);

/// As lines of text.
std::string to_text(const MeshQuality& quality);

}  // namespace nanson
