// The tets in the order of the rows, by part: what is watched or pushed tet by tet.
#pragma once
#include <vector>

#include "engine/aligned.hpp"
#include "engine/mesh/mesh.hpp"
#include "engine/order.hpp"
#include "kernels/tets.hpp"

namespace nanson {

/// A tet belongs to the part of its lowest row; every part's tets are padded to eights with its last one.
struct Tets {
  Aligned<std::int32_t> corner[4];  // rows
  Aligned<double> volume6;          // [m^3] six times the undeformed volume
  std::vector<int> first;           // of each part, and the end
  std::vector<int> last;            // of each part: the end without padding
  std::vector<int> foreign;         // tets of other parts that have a node in this one ...
  std::vector<int> first_foreign;   // ... of each part, and the end; physics.tet_barrier only
  TetArrays arrays() const;
};

/// X: {X, 1/Omega} of the rows.
Tets make_tets(const Mesh& mesh, const Order& order, const Aligned<double>& X);

void find_foreign(Tets& tets, const Order& order);

}  // namespace nanson
