// What a node's row says of the undeformed mesh: its place and volume, the length that bounds its step, its weights.
#pragma once
#include "engine/aligned.hpp"
#include "engine/order.hpp"
#include "engine/scene.hpp"

namespace nanson {

/// {X, 1/Omega} of every row; padding has unit volume.
Aligned<double> place_nodes(const Mesh& mesh, const Dual& dual, const Order& order);

/// l [m] of dt = cfl min l/c: 6 Omega / sum |C| (dual), the node's shortest edge (edge), the mesh's shortest edge (paper, eq. 51); infinite for padding.
Aligned<double> step_lengths(StepRule rule, const Mesh& mesh, const Dual& dual, const Order& order);

/// lambda = -M^-1 R, R = sum D, M = sum D (x) D over a node's edges: sum (1 + lambda . D) D = 0 (method, section 9).
Aligned<double> laplacian_weights(const Mesh& mesh, const Dual& dual, const Order& order);

}  // namespace nanson
