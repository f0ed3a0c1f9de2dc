// The barrier of crushed tets in a run: which tets are looked at, what they do in a stage, and their energy (physics.tet_barrier).
#pragma once
#include <vector>

#include "engine/aligned.hpp"

namespace nanson {

struct Simulation;
struct Rows;

/// From one look at all tets to the next [steps].
inline constexpr long watch_steps = 16;

/// Of a part: a tet is looked at in every part that it has a node in, for the nodes that are the part's own.
struct WatchedTets {
  std::vector<int> tets;     // with a small share; those that belong to the part first
  std::size_t own = 0;       // that belong to it
  std::vector<int> touched;  // rows with a force, some of them more than once
  double rate2 = 0;          // [1/s^2] largest (c/l)^2
};

struct TetBarrier {
  Aligned<double> detF;   // [-] a row
  Aligned<double> force;  // [N] {force, weight of cof F} a row; zero where no tet is crushed
  std::vector<WatchedTets> parts;
  bool is_watched = false;  // the lists are made
  double fastest = 0;       // [1/s] largest c/l of the crushed tets
};

/// Lists the tets that might be crushed soon.
void watch_tets(Simulation& s);

/// Forces of the stage's crushed tets on their nodes, {force, 0} a row, or none; their nodes' share is added to the nodal stress before anybody reads it.
const double* resist_crushing(Simulation& s, const Rows& rows);

/// Of the crushed tets at the present state [J].
double crushing_energy(const Simulation& s);

}  // namespace nanson
