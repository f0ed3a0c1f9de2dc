// The plain loop beside the engine: made from a simulation, and compared with one.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "bench/naive_loop.hpp"
#include "engine/material.hpp"

namespace nanson {
namespace {

void copy_state(NaiveLoop& n, const Simulation& s) {
  for (std::size_t a = 0; a < n.row.size(); ++a) {
    const double* U = &s.state.U[0][static_cast<std::size_t>(row::U * n.row[a])];
    NaiveNode& node = n.now[a];
    node.J = U[3];
    for (int i = 0; i < 3; ++i) {
      node.v[i] = U[i];
      node.x[i] = U[4 * (i + 1) + 3];
      for (int I = 0; I < 3; ++I) node.F[i][I] = U[4 * (I + 1) + i];
    }
    if (n.H_now.empty()) continue;
    for (int m = 0; m < 9; ++m)
      n.H_now[a][m % 3][m / 3] = s.state.H[0][static_cast<std::size_t>(row::H * n.row[a] + 4 * (m / 3) + m % 3)];
  }
}

void allocate(NaiveLoop& n) {
  const std::size_t nodes = n.row.size();
  const PhysicsSpec& p = n.scene->physics;
  const bool full = p.flux_correction == FluxCorrection::full;
  n.now.resize(nodes);
  n.stage.resize(nodes);
  n.W.resize(nodes);
  n.stress.resize(nodes);
  n.G.resize(nodes);
  n.force.resize(nodes);
  if (p.formulation == Formulation::pFHJ) {
    n.H_now.resize(nodes);
    n.H_stage.resize(nodes);
  }
  if (full || (p.pressure_jump == PressureJump::tensor && p.reconstruction != Reconstruction::constant))
    n.GP.resize(nodes);
  if (full) n.dP.resize(nodes);
  if (p.flux_correction != FluxCorrection::none) {
    n.dG.resize(nodes);
    n.q.resize(n.edges.size());
  }
  if (p.reconstruction == Reconstruction::limited || p.stabilisation == Stabilisation::jst) n.L.resize(nodes);
}

/// lambda_a = -M^-1 R, R = sum_b D, M = sum_b D (x) D: the pseudo-Laplacian of a linear field is zero (method, section 9).
void find_lambda(NaiveLoop& n) {
  std::vector<Eigen::Vector3d> R(n.row.size(), Eigen::Vector3d::Zero());
  std::vector<Eigen::Matrix3d> M(n.row.size(), Eigen::Matrix3d::Zero());
  for (const NaiveEdge& e : n.edges) {
    const Eigen::Vector3d D = Eigen::Vector3d(n.X[e.b].data()) - Eigen::Vector3d(n.X[e.a].data());
    R[e.a] += D;
    M[e.a] += D * D.transpose();
    R[e.b] -= D;
    M[e.b] += D * D.transpose();
  }
  for (std::size_t a = 0; a < n.row.size(); ++a) {
    const Eigen::Vector3d lambda = -M[a].inverse() * R[a];
    n.lambda.push_back({lambda[0], lambda[1], lambda[2]});
  }
}

/// Quarters of the tets around a node by region, and the means that follow.
void place_materials(NaiveLoop& n, const Simulation& s) {
  const Mesh& mesh = *s.domain.mesh;
  const std::size_t nodes = n.row.size();
  std::vector<std::size_t> place(mesh.X.size());
  for (std::size_t a = 0; a < nodes; ++a) place[static_cast<std::size_t>(s.domain.order.node_of[n.row[a]])] = a;
  std::vector<int> law_of(mesh.region_names.size(), 0);
  for (const MaterialSpec& m : materials_of(*s.domain.scene)) {
    for (const Named& region : m.regions)
      for (std::size_t r = 0; r < law_of.size(); ++r)
        if (mesh.region_names[r] == region.name) law_of[r] = static_cast<int>(n.laws.size());
    n.laws.push_back({m, constants_of(m, s.domain.scene->physics), std::vector<double>(nodes, 0.0), {}});
    if (m.law == Law::hencky_j2) n.laws.back().plastic.assign(nodes, PlasticState<double>{{{1, 1, 1, 0, 0, 0}}, 0});
  }
  const bool one = n.laws.size() == 1;
  for (std::size_t t = 0; t < mesh.tets.size() && !one; ++t) {
    const auto& v = mesh.tets[t];
    const double quarter = 0.25 * tet_volume(mesh.X[v[0]], mesh.X[v[1]], mesh.X[v[2]], mesh.X[v[3]]);
    for (const int node : v) n.laws[law_of[mesh.tet_region[t]]].share[place[node]] += quarter;
  }
  n.rho.assign(nodes, 0.0);
  n.rho_cp = n.rho_cs = n.rho_cJ = n.rho;
  for (std::size_t a = 0; a < nodes; ++a) {
    double total = 0;
    for (const NaiveLaw& law : n.laws) total += law.share[a];
    for (NaiveLaw& law : n.laws) {
      law.share[a] = one ? 1.0 : law.share[a] / total;
      n.rho[a] += law.share[a] * law.constants.rho;
      n.rho_cp[a] += law.share[a] * law.constants.rho * law.constants.cp;
      n.rho_cs[a] += law.share[a] * law.constants.rho * law.constants.cs;
      n.rho_cJ[a] += law.share[a] * law.constants.rho * law.constants.cJ;
    }
  }
}

void place_edges(NaiveLoop& n, const Order& o, const std::vector<int>& node_of_row) {
  for (int r = 0; r < o.rows; ++r) {
    for (std::int32_t e = o.out[r]; e < o.out[r + 1]; ++e)
      if (o.b[e] > r)
        n.edges.push_back({node_of_row[r],
                           node_of_row[o.b[e]],
                           {o.C[0][e], o.C[1][e], o.C[2][e]},
                           std::hypot(o.C[0][e], o.C[1][e], o.C[2][e])});
    for (std::int32_t g = o.corner[r]; g < o.corner[r + 1]; ++g)
      n.corners.push_back({node_of_row[r],
                           node_of_row[o.corner_b[g]],
                           node_of_row[o.corner_c[g]],
                           {o.corner_C[0][g], o.corner_C[1][g], o.corner_C[2][g]}});
  }
}

}  // namespace

NaiveLoop make_naive_loop(const Simulation& s) {
  NaiveLoop n;
  n.scene = s.domain.scene;
  n.t = s.state.t;
  std::vector<int> node_of_row(static_cast<std::size_t>(s.domain.order.rows), -1);
  for (int r = 0; r < s.domain.order.rows; ++r) {
    const int node = s.domain.order.node_of[r];
    if (node < 0) continue;
    node_of_row[r] = static_cast<int>(n.row.size());
    n.row.push_back(r);
    n.X.push_back(s.domain.mesh->X[node]);
    n.volume.push_back(s.domain.volume[node]);
    n.step_length.push_back(s.domain.step_length[r]);
  }
  place_edges(n, s.domain.order, node_of_row);
  n.constraints = s.domain.boundary.constraints;
  n.loaded = s.domain.boundary.loaded;
  for (Constraint& h : n.constraints) h.node = node_of_row[h.node];
  for (LoadedFace& f : n.loaded)
    for (int& node : f.node) node = node_of_row[node];
  allocate(n);
  if (n.scene->physics.stabilisation == Stabilisation::jst) find_lambda(n);
  for (auto t : s.domain.mesh->tets) {
    for (int& node : t) node = node_of_row[s.domain.order.row_of[node]];
    n.tets.push_back(t);
  }
  if (has_current_areas(n.scene->physics.description)) {
    n.current_edges = n.edges;
    n.current_corners.resize(n.corners.size());
    n.dJ.resize(n.row.size());
    if (n.scene->physics.description == Description::pseudo_updated) {
      n.grad_x.resize(n.row.size());
      n.H_x.resize(n.row.size());
    }
  }
  place_materials(n, s);
  if (n.scene->physics.tet_stiffness > 0) find_springs(n);
  if (n.scene->physics.tet_barrier > 0) n.crushing.resize(n.row.size());
  copy_state(n, s);
  naive_material(n, n.now, n.H_now, false);
  return n;
}

double largest_difference(const NaiveLoop& n, const std::vector<NaiveNode>& nodes, const double* U_of,
                          const double* W_of, const double* PH_of) {
  struct Field {
    double size = 0, difference = 0;
    void add(double ours, double theirs) {
      size = std::max(size, std::abs(ours));
      const double d = std::abs(ours - theirs);
      if (!(d <= difference)) difference = std::isnan(d) ? HUGE_VAL : d;
    }
  } v, J, F, x, H, swept, P;
  for (std::size_t a = 0; a < n.row.size(); ++a) {
    const NaiveNode& node = nodes[a];
    const std::size_t r = static_cast<std::size_t>(n.row[a]);
    const double *U = U_of + row::U * r, *PH = PH_of + row::PH * r;
    J.add(node.J, U[3]);
    swept.add(n.W[a][3], W_of[row::W * r + 3]);
    for (int i = 0; i < 3; ++i) {
      v.add(node.v[i], U[i]);
      x.add(node.x[i], U[4 * (i + 1) + 3]);
      for (int I = 0; I < 3; ++I) {
        F.add(node.F[i][I], U[4 * (I + 1) + i]);
        P.add(n.stress[a].P[i][I], PH[8 * I + i]);
        H.add(n.stress[a].H[i][I], PH[8 * I + 4 + i]);
      }
    }
  }
  double kappa = 0;
  for (const NaiveLaw& law : n.laws) kappa = std::max(kappa, law.constants.kappa);
  P.size = std::max(P.size, 0.1 * kappa);
  if (!n.dJ.empty()) H.size = std::max(H.size, 0.1 * kappa);  // the Cauchy stress
  if (n.lambda.empty()) swept.size = std::max(swept.size, 0.1 * kappa);
  double worst = 0;
  for (const Field& f : {v, J, F, x, H, swept, P})
    if (f.difference > 0) worst = std::max(worst, f.difference / f.size);
  return worst;
}

double largest_difference(const NaiveLoop& n, const Simulation& s) {
  return largest_difference(n, n.now, s.state.U[0].data(), s.state.W[s.state.now].data(),
                            s.state.PH[s.state.now].data());
}

}  // namespace nanson
