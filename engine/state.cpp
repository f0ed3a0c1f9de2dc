// Allocation by role, the undeformed state, and the account of memory.
#include "engine/state.hpp"

namespace nanson {
namespace {

/// F = H = I, J = 1 (pFp: p = 0), x = X.
void set_undeformed(const Domain& d, State& s) {
  const bool pFp = d.scene->physics.formulation == Formulation::pFp;
  for (int k = 0; k < 2; ++k)
    for (int n = 0; n < d.order.rows; ++n) {
      const auto u = state_of_row(s.U[k].data(), n);
      u.J() = pFp ? 0 : 1;
      for (int I = 0; I < 3; ++I) {
        u.F(I, I) = 1;
        u.x(I) = d.X[static_cast<std::size_t>(row::X * n + I)];
        if (!s.H[k].empty()) s.H[k][static_cast<std::size_t>(row::H * n + 4 * I + I)] = 1;
      }
    }
  for (std::size_t at = 0; at < s.plastic.size(); at += row::plastic)
    for (std::size_t k = 0; k < 3; ++k) s.plastic[at + k] = 1;
}

}  // namespace

State make_state(const Domain& d) {
  State s;
  each_array(d, s, [](const ArrayRole& role, Aligned<double>& array) { array.assign(role.size, 0.0); });
  set_undeformed(d, s);
  s.reports.resize(d.order.parts.size());
  if (d.scene->physics.tet_barrier > 0) s.barrier.parts.resize(d.order.parts.size());
  s.acceleration.assign(d.scene->boundary.size(), 0.0);
  s.next_frame = d.scene->output.every;
  return s;
}

Rows stage_rows(const Domain& d, State& u, int from, int to) {
  const int next = 1 - u.now;
  Rows r{};
  r.X = d.X.data();
  r.lambda = d.lambda.data();
  r.rho = d.mixture.rho.data();
  r.dJ = u.current.dJ.data();
  r.loads = u.loads.data();
  r.force = u.force.empty() ? nullptr : u.force.data();
  r.U_old = u.U[0].data();
  r.U_stage = u.U[from].data();
  r.H_old = u.H[0].data();
  r.H_stage = u.H[from].data();
  r.W = u.W[u.now].data();
  r.PH = u.PH[u.now].data();
  r.G = u.G.data();
  r.dP = u.dP.data();
  r.lagged_dG = u.U[1].data();
  r.lagged_q = u.q.data();
  r.GP = u.GP.data();
  r.L = u.L.data();
  r.U_new = u.U[to].data();
  r.H_new = u.H[to].data();
  r.W_new = u.W[next].data();
  r.PH_new = u.PH[next].data();
  r.plastic = u.plastic.data();
  r.plastic_new = u.plastic.data();
  r.detF = u.barrier.detF.data();
  return r;
}

Rows present_rows(const Domain& d, const State& u) {
  Rows r{};
  r.X = d.X.data();
  r.rho = d.mixture.rho.data();
  r.U_stage = u.U[0].data();
  r.H_stage = u.H[0].data();
  r.PH = u.PH[u.now].data();
  r.plastic = u.plastic.data();
  return r;
}

std::size_t bytes_of(const Domain& d, const State& u) {
  std::size_t doubles = 0;
  each_array(d, u, [&](const ArrayRole&, const Aligned<double>& array) { doubles += array.size(); });
  return 8 * doubles;
}

std::vector<std::string> fields_left_out(const Scene& scene) {
  const PhysicsSpec& p = scene.physics;
  std::vector<std::string> out;
  if (p.formulation != Formulation::pFHJ) out.push_back("H (evolved only in pFHJ): 192 bytes");
  if (!evolves_J(p.formulation))
    out.push_back("evolution and stabilisation of J (pF, pFp): arithmetic only, its lanes would be padding");
  if (p.formulation != Formulation::pFp) out.push_back("projection (pFp): rows of edges and of its iteration");
  if (!has_current_areas(p.description))
    out.push_back("current dual geometry (description = total): areas of edges and faces, a sweep a stage");
  if (p.reconstruction == Reconstruction::constant && p.formulation != Formulation::pFp)
    out.push_back("gradients and their sweep (constant reconstruction): 96 bytes");
  if (p.flux_correction != FluxCorrection::full)
    out.push_back("dP and its sums in the gradient sweep (flux_correction is not full): 96 bytes");
  if (p.pressure_jump == PressureJump::scalar) out.push_back("gradient of P (scalar pressure jump): 288 bytes");
  if (p.reconstruction != Reconstruction::limited) out.push_back("limiter (reconstruction is not limited): 32 bytes");
  if (!p.keep_angular_momentum)
    out.push_back("angular momentum projection (keep_angular_momentum = false): two passes over the nodes a stage");
  if (p.tet_stiffness == 0)
    out.push_back("springs between nodes (tet_stiffness = 0): their stiffness, 8 bytes an edge");
  if (p.tet_barrier == 0) out.push_back("barrier of crushed tets (tet_barrier = 0): 40 bytes and their lists");
  if (scene.materials.empty())
    out.push_back("densities and material shares of nodes, impedances of edges (one material): about 150 bytes");
  if (!scene.monitor.energy)
    out.push_back("energy audit (monitor.energy = false): the power of the stabilisation in the edge loop");
  return out;
}

}  // namespace nanson
