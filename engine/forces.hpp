// What acts on the body from outside. Each force of a scene adds itself to a row of forces; one visitor then shows them all, and the supports', to those who keep books.
#pragma once
#include "engine/parts.hpp"

namespace nanson {

/// The two rows that a force may write, [N] with a lane to spare: on each corner of a loaded face, 4 a face; on nodes, 4 a node.
/// What acts between the nodes themselves is no force from outside and would have a row of its own.
enum class ActsOn { corners, nodes };

struct Force {
  std::string_view name;
  ActsOn on;
  bool varies;                                                             // else its row is written once, at the start
  bool (*acts)(const Domain& d);                                           // whether the scene has it
  void (*add)(const Simulation& s, const double* U, double t, double* f);  // adds itself at t [s] and on the rows U
};

/// Writes the rows of a stage that takes its rates of the rows U at time t; `first`: also those that never change.
void find_forces(Simulation& s, const double* U, double t, bool first = false);

/// Shows use(row, force [N]) the loads that share p of the parts stands for.
template <class Use>
void each_load(const Simulation& s, int p, Use use) {
  const Domain& d = s.domain;
  const std::size_t parts = d.order.parts.size(), share = static_cast<std::size_t>(p),
                    faces = d.boundary.slot_nodes.size();
  for (std::size_t slot = faces * share / parts; slot < faces * (share + 1) / parts; ++slot) {
    const double* f = &s.state.loads[4 * slot];
    for (const int n : d.boundary.slot_nodes[slot]) use(n, Vec3{f[0], f[1], f[2]});
  }
  if (s.state.force.empty()) return;
  const Part& part = d.order.parts[share];
  for (int n = part.node_begin; n < part.node_begin + nodes_of(d, part); ++n) {
    const double* f = &s.state.force[static_cast<std::size_t>(4 * n)];
    if (!is_padding(d, n)) use(n, Vec3{f[0], f[1], f[2]});
  }
}

/// The same of the supports, in the present stage.
template <class Use>
void each_reaction(const Simulation& s, int p, Use use) {
  const Part& part = s.domain.order.parts[static_cast<std::size_t>(p)];
  for (int i = part.constraint_begin; i < part.constraint_end; ++i) {
    const Constraint& h = s.domain.boundary.constraints[static_cast<std::size_t>(i)];
    const double* R = &s.state.reactions[static_cast<std::size_t>(reaction_row * i)];
    Vec3 f{};
    for (int m = 0; m < h.count; ++m)
      for (int k = 0; k < 3; ++k) f[static_cast<std::size_t>(k)] += R[m] * h.d[m][k];
    use(h.node, f);
  }
}

/// Of all that acts from outside in the present stage, supports too; arms from a point to the places x of the rows `arms`.
struct Resultant {
  Vec3 force{}, torque{};  // [N], [N m]
};
Resultant resultant(const Simulation& s, const double* arms, const Vec3& about);

/// Power of the loads at the velocities of the rows W [W]; that of the supports stands in the reactions.
double power_of_loads(const Simulation& s, const double* W);

}  // namespace nanson
