// All that a run changes: where it stands, the unknowns, and the rows that its stages work in.
#pragma once
#include <string>
#include <vector>

#include "engine/domain.hpp"
#include "engine/node_state.hpp"
#include "engine/tet_barrier.hpp"

namespace nanson {

struct State {
  double t = 0, dt = 0;  // [s]
  long step = 0;
  double first_dt = 0, dt_min = 0, dt_max = 0;  // [s]
  double next_frame = 0;                        // [s]
  long last_history = 0, last_frame = 0;        // steps

  Aligned<double> U[2];                // state at the start of the step (and after it), state of a stage
  Aligned<double> H[2];                // pFHJ
  Aligned<double> W[2], PH[2];         // of the stage, and being written for the next
  Aligned<double> G;                   // linear reconstruction
  Aligned<double> dP;                  // full flux correction
  Aligned<double> q;                   // pressure correction, one an edge
  Aligned<double> GP;                  // tensor pressure jump
  Aligned<double> L;                   // limiter (limited) or pseudo-Laplacian (jst)
  Aligned<double> plastic;             // hencky_j2
  Aligned<double> loads;               // [N] 4 a loaded face
  Aligned<double> force;               // [N] 4 a node: gravity, a manufactured motion's body force
  Aligned<double> reactions;           // reaction_row a constraint, of the last stage
  Aligned<double> mean_reactions;      // mean of the last step's stages
  Aligned<double> initial_mismatch;    // [-] monitor.involutions: F - grad x at the start, 9 a row
  CurrentGeometry current;             // current areas only
  TetBarrier barrier;                  // physics.tet_barrier only
  Projection projection;               // pFp only
  std::vector<PartReport> reports;     // one a part
  std::vector<double> acceleration;    // [1/s] per boundary condition: rate of the time factor over the step
  Vec3 arm_origin{};                   // [m] keep_angular_momentum: what its arms are counted from
  bool has_lagged_correction = false;  // of the last stage, for the next step's first: dG in U[1], dP within PH[now]
  int now = 0;                         // which of W, PH belongs to the present state
};

/// Whether a run that stops between two steps needs an array to go on: `unknown` are the unknowns themselves (they are what a state's hash is of), `carried` is found from them
/// but not to the last bit, or belongs to a report; `work` is written before it is read.
enum class Keep { unknown, carried, work };

/// What an array has rows of.
enum class Per { node, edge, corner, face, constraint };

struct ArrayRole {
  std::string_view name;
  std::size_t size;   // doubles; 0 where the scene does not carry it
  std::size_t width;  // of a row
  Per of;
  Keep keep;
};

/// The one list of a state's arrays, by what the physics of the scene needs: visit(role, array).
template <class SomeState, class Visit>
void each_array(const Domain& d, SomeState& u, Visit visit) {
  const PhysicsSpec& p = d.scene->physics;
  using enum Per;
  const std::size_t rows[] = {static_cast<std::size_t>(d.order.rows), d.order.C[0].size(), d.order.corner_b.size(),
                              d.boundary.slot_nodes.size(), d.boundary.constraints.size()};
  const bool projected = p.formulation == Formulation::pFp, linear = p.reconstruction != Reconstruction::constant,
             corrected = p.flux_correction != FluxCorrection::none, current = has_current_areas(p.description);
  const auto say = [&](std::string_view name, Keep keep, Per of, std::ptrdiff_t doubles, bool carried, auto& array) {
    const std::size_t width = static_cast<std::size_t>(doubles);
    visit(ArrayRole{name, carried ? width * rows[static_cast<int>(of)] : 0, width, of, keep}, array);
  };
  say("U", Keep::unknown, node, row::U, true, u.U[0]);
  say("U_stage", corrected ? Keep::carried : Keep::work, node, row::U, true, u.U[1]);
  say("H", Keep::unknown, node, row::H, p.formulation == Formulation::pFHJ, u.H[0]);
  say("H_stage", Keep::work, node, row::H, p.formulation == Formulation::pFHJ, u.H[1]);
  for (int k = 0; k < 2; ++k) {
    say("W", k == u.now ? Keep::carried : Keep::work, node, row::W, k == 0 || !projected, u.W[k]);
    say("PH", k == u.now ? Keep::carried : Keep::work, node, row::PH, k == 0 || !projected, u.PH[k]);
  }
  say("G", Keep::work, node, row::G, linear || projected, u.G);
  say("dP", Keep::carried, node, row::dP, p.flux_correction == FluxCorrection::full, u.dP);
  say("q", Keep::carried, edge, 1, p.flux_correction == FluxCorrection::pressure, u.q);
  say("GP", Keep::work, node, row::GP, p.pressure_jump == PressureJump::tensor && linear, u.GP);
  say("L", Keep::work, node, row::L,
      p.reconstruction == Reconstruction::limited || p.stabilisation == Stabilisation::jst, u.L);
  say("plastic", Keep::unknown, node, row::plastic * d.mixture.state_sets, has_plasticity(*d.scene), u.plastic);
  say("loads", Keep::work, face, 4, true, u.loads);
  say("force", Keep::carried, node, 4, has_forces_on_nodes(d), u.force);
  say("reactions", Keep::work, constraint, reaction_row, true, u.reactions);
  say("mean_reactions", Keep::carried, constraint, reaction_row, true, u.mean_reactions);
  say("initial_mismatch", Keep::carried, node, 9, d.scene->monitor.involutions, u.initial_mismatch);
  say("x", Keep::work, node, row::x, current, u.current.x);
  say("area_map", Keep::work, node, row::H, p.description == Description::pseudo_updated, u.current.map);
  for (int k = 0; k < 3; ++k) {
    say("c", Keep::work, edge, 1, current, u.current.c[k]);
    say("c_corner", Keep::work, corner, 1, current, u.current.corner[k]);
  }
  say("dJ", Keep::work, node, 1, current, u.current.dJ);
  say("detF", Keep::carried, node, 1, p.tet_barrier > 0, u.barrier.detF);
  say("crushing", Keep::work, node, 4, p.tet_barrier > 0, u.barrier.force);
  auto& q = u.projection;
  say("projection_E", Keep::work, edge, row::E, projected, q.E);
  say("projection_B", Keep::work, corner, row::B, projected, q.B);
  say("projection_H", Keep::work, node, row::H, projected, q.H);
  say("projection_V", Keep::work, node, row::V, projected, q.V);
  say("volume", Keep::carried, node, 1, projected, q.volume[0]);
  say("volume_stage", Keep::work, node, 1, projected, q.volume[1]);
  say("taken", Keep::carried, node, 1, projected, q.taken[0]);
  say("taken_stage", Keep::work, node, 1, projected, q.taken[1]);
  say("fixed", Keep::carried, node, 1, projected, q.fixed);
  say("lag", Keep::carried, node, 1, projected, q.lag);
  for (auto* v : {&q.inverse_diagonal, &q.weight_sum, &q.R, &q.d, &q.Kd})
    say("projection_solve", Keep::work, node, 1, projected, *v);
  say("removed", Keep::work, constraint, 3, projected, q.removed);
}

/// Zero or undeformed everywhere; padding rows are undeformed nodes of unit volume with an infinite step length.
State make_state(const Domain& domain);

/// The rows of a stage that takes the rates of U[from] and writes U[to], and the next W and PH.
Rows stage_rows(const Domain& domain, State& state, int from, int to);
/// Those of the present state that energies are sums over.
Rows present_rows(const Domain& domain, const State& state);

std::size_t bytes_of(const Domain& domain, const State& state);

/// In words what the scene does not pay for.
std::vector<std::string> fields_left_out(const Scene& scene);

}  // namespace nanson
