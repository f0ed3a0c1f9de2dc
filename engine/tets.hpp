// The tets in the order of the rows, by part: what is watched or pushed tet by tet.
#pragma once
#include <vector>

#include "engine/aligned.hpp"
#include "engine/mesh/mesh.hpp"
#include "engine/order.hpp"

namespace nanson {

struct TetArrays;

/// A tet belongs to the part of its lowest row; every part's tets are padded to eights with its last one.
struct Tets {
  Aligned<std::int32_t> corner[4];  // rows
  Aligned<double> volume6;          // [m^3] six times the undeformed volume
  std::vector<int> first;           // of each part, and the end
  TetArrays arrays() const;
};

/// X: {X, 1/Omega} of the rows.
Tets make_tets(const Mesh& mesh, const Order& order, const Aligned<double>& X);

}  // namespace nanson
