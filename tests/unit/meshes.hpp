// Small meshes for tests: boxes, and boxes bent into other shapes.
#pragma once
#include <gtest/gtest.h>

#include <cmath>

#include "engine/mesh/mesh.hpp"

namespace nanson::test {

inline Mesh finished(RawMesh raw) {
  std::vector<std::string> errors;
  Mesh mesh = finish_mesh(std::move(raw), errors);
  if (!errors.empty()) ADD_FAILURE() << errors.front();
  return mesh;
}

/// Faces xmin xmax ymin ymax zmin zmax; sides 2, 3, 1.5 m from (-1, 0.5, 2).
inline RawMesh raw_box(std::array<int, 3> cells, Split split = Split::alternating, double perturb = 0) {
  MeshSpec spec;
  spec.origin = {-1, 0.5, 2};
  spec.size = {2, 3, 1.5};
  spec.cells = cells;
  spec.split = split;
  spec.perturb = perturb;
  return make_box(spec);
}

inline Mesh box(std::array<int, 3> cells, Split split = Split::alternating, double perturb = 0) {
  return finished(raw_box(cells, split, perturb));
}

/// The unit cube of a box, bent by X = map(cube point).
template <class Map>
RawMesh bent_box(std::array<int, 3> cells, Map map) {
  MeshSpec spec;
  spec.size = {1, 1, 1};
  spec.cells = cells;
  spec.split = Split::alternating;
  RawMesh raw = make_box(spec);
  for (Vec3& X : raw.X) X = map(X);
  return raw;
}

inline double volume(const Mesh& mesh, const std::array<int, 4>& t) {
  return tet_volume(mesh.X[t[0]], mesh.X[t[1]], mesh.X[t[2]], mesh.X[t[3]]);
}

}  // namespace nanson::test
