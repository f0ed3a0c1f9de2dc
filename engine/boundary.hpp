// Supports and loads of a scene on the rows of an order: held directions per node and patch, loaded faces.
#pragma once
#include <string>
#include <vector>

#include "engine/order.hpp"
#include "kernels/part.hpp"

namespace nanson {

/// One load on one face: a dead traction or a following pressure.
struct LoadedFace {
  int slot;                 // row of the loads that it adds to: one a face
  std::array<int, 3> node;  // rows, counter-clockwise from outside
  BoundaryKind kind;        // traction | pressure
  Vec3 corner_force;        // [N] traction: force on each corner at factor 1
  double pressure;          // [Pa] pressure
  int condition;            // index into Boundary::conditions
};

struct Boundary {
  std::vector<BoundarySpec> conditions;
  std::vector<Constraint> constraints;  // by row, hence by part
  std::vector<std::string> held_faces;  // named faces that hold some direction, in the scene's order
  std::vector<LoadedFace> loaded;
  std::vector<std::array<int, 3>> slot_nodes;  // rows of the corners of each loaded face
  std::vector<std::string> free_faces;         // named faces that no condition mentions
};

/// Also sets the corners' load numbers and the parts' constraint ranges in `order`.
Boundary make_boundary(const Scene& scene, const Mesh& mesh, Order& order);

}  // namespace nanson
