// Allocation by role, step lengths, and the account of memory.
#include "engine/state.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace nanson {
namespace {

double distance(const Vec3& p, const Vec3& q) { return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]); }

/// l of dt = cfl min l/c: 6 Omega / sum |C| (dual), the node's shortest edge (edge), the mesh's shortest edge (paper, eq. 51).
std::vector<double> step_lengths(StepRule rule, const Mesh& mesh, const Dual& dual) {
  std::vector<double> length(mesh.X.size(), 1e300), areas(mesh.X.size(), 0.0);
  for (const auto& e : dual.edges) {
    const double h = distance(mesh.X[e.a], mesh.X[e.b]), A = std::hypot(e.C[0], e.C[1], e.C[2]);
    length[e.a] = std::min(length[e.a], h);
    length[e.b] = std::min(length[e.b], h);
    areas[e.a] += A;
    areas[e.b] += A;
  }
  if (rule == StepRule::dual)
    for (std::size_t n = 0; n < length.size(); ++n) length[n] = 6 * dual.volume[n] / areas[n];
  if (rule == StepRule::paper) std::fill(length.begin(), length.end(), *std::min_element(length.begin(), length.end()));
  return length;
}

/// lambda = -M^-1 R, R = sum D, M = sum D (x) D over a node's edges: sum (1 + lambda . D) D = 0 (method, section 9).
Aligned<double> laplacian_weights(const Mesh& mesh, const Dual& dual, const Order& order) {
  std::vector<Eigen::Vector3d> R(mesh.X.size(), Eigen::Vector3d::Zero());
  std::vector<Eigen::Matrix3d> M(mesh.X.size(), Eigen::Matrix3d::Zero());
  for (const auto& e : dual.edges) {
    const Eigen::Vector3d D = Eigen::Map<const Eigen::Vector3d>(mesh.X[e.b].data())
                              - Eigen::Map<const Eigen::Vector3d>(mesh.X[e.a].data());
    R[e.a] += D;
    R[e.b] -= D;
    M[e.a] += D * D.transpose();
    M[e.b] += D * D.transpose();
  }
  Aligned<double> lambda(row::lambda * static_cast<std::size_t>(order.rows), 0.0);
  for (std::size_t n = 0; n < mesh.X.size(); ++n) {
    const Eigen::Vector3d l = -M[n].ldlt().solve(R[n]);
    for (int k = 0; k < 3; ++k) lambda[static_cast<std::size_t>(row::lambda * order.row_of[n] + k)] = l[k];
  }
  return lambda;
}

}  // namespace

State make_state(const Scene& scene, const Mesh& mesh, Dual dual, const Order& order, const Boundary& boundary) {
  State s;
  const std::size_t rows = static_cast<std::size_t>(order.rows);
  const PhysicsSpec& p = scene.physics;
  s.X.assign(row::X * rows, 0.0);
  s.step_length.assign(rows, 1e300);
  const std::vector<double> length = step_lengths(scene.time.step, mesh, dual);
  if (p.stabilisation == Stabilisation::jst) s.lambda = laplacian_weights(mesh, dual, order);
  dual.edges = std::vector<DualEdge>();  // the rows take their place
  for (std::size_t r = 0; r < rows; ++r) {
    const int n = order.node_of[r];
    for (int k = 0; k < 3 && n >= 0; ++k) s.X[row::X * r + k] = mesh.X[n][k];
    s.X[row::X * r + 3] = n < 0 ? 1.0 : 1.0 / dual.volume[n];
    if (n >= 0) s.step_length[r] = length[n];
  }
  for (int k = 0; k < 2; ++k) {
    s.U[k].assign(row::U * rows, 0.0);
    if (k == 0 || p.formulation != Formulation::pFp) {
      s.W[k].assign(row::W * rows, 0.0);
      s.PH[k].assign(row::PH * rows, 0.0);
    }
    if (p.formulation == Formulation::pFHJ) s.H[k].assign(row::H * rows, 0.0);
    for (std::size_t r = 0; r < rows; ++r) {
      double* U = &s.U[k][row::U * r];
      U[3] = p.formulation == Formulation::pFp ? 0 : 1;
      for (int I = 0; I < 3; ++I) {
        U[4 * (I + 1) + I] = 1;
        U[4 * (I + 1) + 3] = s.X[row::X * r + I];
        if (!s.H[k].empty()) s.H[k][row::H * r + 4 * I + I] = 1;
      }
    }
  }
  if (p.reconstruction != Reconstruction::constant || p.formulation == Formulation::pFp) s.G.assign(row::G * rows, 0.0);
  if (p.flux_correction == FluxCorrection::pressure) s.q.assign(order.C[0].size(), 0.0);
  if (p.flux_correction == FluxCorrection::full) s.dP.assign(row::dP * rows, 0.0);
  if (p.pressure_jump == PressureJump::tensor && p.reconstruction == Reconstruction::linear)
    s.GP.assign(row::GP * rows, 0.0);
  if (p.reconstruction == Reconstruction::limited || p.stabilisation == Stabilisation::jst)
    s.L.assign(row::L * rows, 0.0);
  if (has_plasticity(scene)) {
    s.plastic.assign(row::plastic * rows, 0.0);
    for (std::size_t r = 0; r < rows; ++r)
      for (std::size_t k = 0; k < 3; ++k) s.plastic[row::plastic * r + k] = 1;
  }
  s.loads.assign(4 * boundary.slot_nodes.size(), 0.0);
  s.reactions.assign(reaction_row * boundary.constraints.size(), 0.0);
  s.mean_reactions = s.reactions;
  return s;
}

Rows stage_rows(State& u, int from, int to) {
  const int next = 1 - u.now;
  Rows r{};
  r.X = u.X.data();
  r.lambda = u.lambda.data();
  r.loads = u.loads.data();
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
  return r;
}

double bytes_per_node(const State& s, const Order& o) {
  std::size_t doubles = s.X.size() + s.G.size() + s.dP.size() + s.q.size() + s.GP.size() + s.L.size() + s.lambda.size()
                        + s.plastic.size() + s.step_length.size() + s.loads.size() + 2 * s.reactions.size();
  for (int k = 0; k < 2; ++k) doubles += s.U[k].size() + s.H[k].size() + s.W[k].size() + s.PH[k].size();
  for (int k = 0; k < 3; ++k) doubles += o.C[k].size() + o.corner_C[k].size();
  const std::size_t ints = o.a.size() + o.b.size() + o.out.size() + o.in.size() + o.in_edges.size() + o.in_nodes.size()
                           + o.corner.size() + o.corner_b.size() + o.corner_c.size() + o.corner_load.size()
                           + o.corner_face.size() + o.row_of.size() + o.node_of.size();
  return static_cast<double>(8 * doubles + 4 * ints) / o.nodes;
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
  if (scene.materials.empty())
    out.push_back("densities and material shares of nodes, impedances of edges (one material): about 150 bytes");
  if (!scene.monitor.energy)
    out.push_back("energy audit (monitor.energy = false): the power of the stabilisation in the edge loop");
  return out;
}

}  // namespace nanson
