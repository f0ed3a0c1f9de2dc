// The separate bodies of a mesh: pieces that share no node, which is nearly always a slip of the mesh (bodies that touch without one).
#pragma once
#include <string>
#include <vector>

#include "engine/solver.hpp"

namespace nanson {

struct Piece {
  int nodes = 0;
  double mass = 0;  // [kg]
  Vec3 centre{};    // [m] mean of its nodes
  double gap = 0;   // [m] between its nodes and those of any other piece; 0: there is no other
  bool held = false, moves = false, pushed = false;  // some node has a support, an initial velocity, a load or gravity
};

/// Largest mass first, at the start of a run.
std::vector<Piece> pieces(const Simulation& s);

/// Lines that name the pieces, none when there is one.
std::vector<std::string> piece_lines(const std::vector<Piece>& pieces, double shortest_edge);

/// A sentence when one of several pieces is neither held nor moving and something pushes it; else empty.
std::string loose_piece(const std::vector<Piece>& pieces);

}  // namespace nanson
