// A simulation: a domain, the state on it, the books of what has come in and gone out, and the team that computes.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "engine/books.hpp"
#include "engine/state.hpp"
#include "engine/team.hpp"
#include "engine/watch.hpp"

namespace nanson {

struct Breakdown {
  int node = -1;           // of the mesh
  std::string text;        // where, when and why
  std::string_view cause;  // detF | J | inverted_tet | not_finite | dt_collapse | energy_growth | iteration_limit
};

struct Simulation {
  const Domain domain;
  State state;
  Books books;
  mutable Team team;  // what sums over parts need: who only looks takes it too
  std::optional<Breakdown> breakdown;
  std::string_view stopped_by;  // max_steps | max_wall_s | signal
  Watch watch;
};

/// Bytes a node of everything that a step reads or writes.
double bytes_per_node(const Simulation& s);

/// FNV-1a of the unknowns {v, J, F, x}, H, plastic state in mesh order: equal if and only if two states are bitwise equal, but for collisions.
std::string state_hash(const Simulation& s);

/// A mesh node's state.
inline NodeState state_of(const Simulation& s, int node) {
  return state_of_row(s.state.U[0].data(), s.domain.order.row_of[static_cast<std::size_t>(node)]);
}

}  // namespace nanson
