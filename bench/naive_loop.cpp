// Four passes a stage over whole arrays: gradient, flux, update, material.
#include "bench/naive_loop.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/time_function.hpp"
#include "kernels/materials/linear_elastic.hpp"
#include "kernels/materials/mooney_rivlin.hpp"
#include "kernels/materials/neo_hookean.hpp"

namespace nanson {
namespace {

constexpr double theta = 2.0 / 3;  // [-] flux correction

/// What the edge loop branches on: read at run time, or known to the compiler for the loops that benches compare with.
struct AnyChoice {
  PhysicsSpec p;
  bool linear() const { return p.reconstruction != Reconstruction::constant; }
  bool limited() const { return p.reconstruction == Reconstruction::limited; }
  bool fixed() const { return p.entropy_fix == EntropyFix::edge; }
  bool jst() const { return p.stabilisation == Stabilisation::jst; }
  bool evolves_J() const { return p.formulation != Formulation::pF; }
  bool tensor() const { return p.pressure_jump == PressureJump::tensor; }
  bool deformed() const { return p.upwind_metric == UpwindMetric::deformed; }
  bool current() const { return has_current_areas(p.description); }
  FluxCorrection correction() const { return p.flux_correction; }
};
template <bool with_J>
struct Baseline {
  static constexpr bool linear() { return true; }
  static constexpr bool limited() { return false; }
  static constexpr bool fixed() { return false; }
  static constexpr bool jst() { return false; }
  static constexpr bool evolves_J() { return with_J; }
  static constexpr bool tensor() { return false; }
  static constexpr bool deformed() { return true; }
  static constexpr bool current() { return false; }
  static constexpr FluxCorrection correction() { return FluxCorrection::none; }
};
bool is_baseline(const AnyChoice& c) {
  return c.linear() && !c.limited() && !c.fixed() && !c.jst() && !c.tensor() && !c.current() && c.deformed() && c.correction() == FluxCorrection::none;
}

double dot(const double* p, const double* q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }

/// Green-Gauss gradient of `count` numbers a node, value(node)[k] and gradient(node)[k][I], with the (6,1,1)/8 rule at the boundary (eq. 29, 43a).
template <int count, class Value>
void add_gradients(const NaiveLoop& n, Value value, std::vector<Table<count, 3>>& gradient) {
  std::fill(gradient.begin(), gradient.end(), Table<count, 3>{});
  for (const NaiveEdge& e : n.edges) {
    const double *U_a = value(e.a), *U_b = value(e.b);
    auto &G_a = gradient[e.a], &G_b = gradient[e.b];
    for (int k = 0; k < count; ++k)
      for (int I = 0; I < 3; ++I) {
        const double average = 0.5 * (U_a[k] + U_b[k]) * e.C[I];
        G_a[k][I] += average;
        G_b[k][I] -= average;
      }
  }
  for (const NaiveCorner& c : n.corners) {
    const double *U_a = value(c.a), *U_b = value(c.b), *U_c = value(c.c);
    for (int k = 0; k < count; ++k)
      for (int I = 0; I < 3; ++I) gradient[c.a][k][I] += (6 * U_a[k] + U_b[k] + U_c[k]) / 8 * c.C[I];
  }
  for (std::size_t a = 0; a < gradient.size(); ++a) {
    const double inverse = 1 / n.volume[a];
    for (auto& row : gradient[a])
      for (double& g : row) g *= inverse;
  }
}

/// Q_a = P_a + theta/(4 Omega_a) sum_b [(P_a - P_b + D . grad P_a) C_ab] (x) D (method, section 14).
void correct_stress(NaiveLoop& n) {
  std::fill(n.Q.begin(), n.Q.end(), Table<3, 3>{});
  const auto add = [&](int a, int b, const double (&C)[3]) {
    double D[3];
    for (int I = 0; I < 3; ++I) D[I] = n.X[b][I] - n.X[a][I];
    for (int i = 0; i < 3; ++i) {
      double y = 0;
      for (int I = 0; I < 3; ++I) y += (n.stress[a].P[i][I] - n.stress[b].P[i][I] + dot(D, n.GP[a][3 * i + I].data())) * C[I];
      for (int I = 0; I < 3; ++I) n.Q[a][i][I] += y * D[I];
    }
  };
  for (const NaiveEdge& e : n.edges) {
    add(e.a, e.b, e.C);
    add(e.b, e.a, {-e.C[0], -e.C[1], -e.C[2]});
  }
  for (std::size_t a = 0; a < n.Q.size(); ++a)
    for (int m = 0; m < 9; ++m) n.Q[a][m / 3][m % 3] = n.stress[a].P[m / 3][m % 3] + theta / (4 * n.volume[a]) * n.Q[a][m / 3][m % 3];
}

/// Barth-Jespersen: the largest phi in [0, 1] for which W + phi G . D/2 stays between the values around at the midpoint of every edge (method, section 4).
void limit(NaiveLoop& n) {
  std::vector<std::array<double, 4>> most = n.W, least = n.W;
  for (const NaiveEdge& e : n.edges)
    for (int k = 0; k < 4; ++k) {
      most[e.a][k] = std::max(most[e.a][k], n.W[e.b][k]), least[e.a][k] = std::min(least[e.a][k], n.W[e.b][k]);
      most[e.b][k] = std::max(most[e.b][k], n.W[e.a][k]), least[e.b][k] = std::min(least[e.b][k], n.W[e.a][k]);
    }
  std::fill(n.L.begin(), n.L.end(), std::array<double, 4>{1, 1, 1, 1});
  const auto visit = [&](int a, const double (&D)[3]) {
    for (int k = 0; k < 4; ++k) {
      const double q = 0.5 * dot(n.G[a][k].data(), D);
      if (q > 0) n.L[a][k] = std::min(n.L[a][k], (most[a][k] - n.W[a][k]) / q);
      if (q < 0) n.L[a][k] = std::min(n.L[a][k], (least[a][k] - n.W[a][k]) / q);
    }
  };
  for (const NaiveEdge& e : n.edges) {
    const Vec3 &A = n.X[e.a], &B = n.X[e.b];
    visit(e.a, {B[0] - A[0], B[1] - A[1], B[2] - A[2]});
    visit(e.b, {A[0] - B[0], A[1] - B[1], A[2] - B[2]});
  }
}

/// L_a = sum_b (1 + lambda_a . D)(W_b - W_a) (method, section 9).
void pseudo_laplacian(NaiveLoop& n) {
  std::fill(n.L.begin(), n.L.end(), std::array<double, 4>{});
  for (const NaiveEdge& e : n.edges) {
    const double D[3] = {n.X[e.b][0] - n.X[e.a][0], n.X[e.b][1] - n.X[e.a][1], n.X[e.b][2] - n.X[e.a][2]};
    const double weight_a = 1 + dot(n.lambda[e.a].data(), D), weight_b = 1 - dot(n.lambda[e.b].data(), D);
    for (int k = 0; k < 4; ++k) {
      n.L[e.a][k] += weight_a * (n.W[e.b][k] - n.W[e.a][k]);
      n.L[e.b][k] += weight_b * (n.W[e.a][k] - n.W[e.b][k]);
    }
  }
}

void gradient_pass(NaiveLoop& n) {
  add_gradients<4>(n, [&](int a) { return n.W[a].data(); }, n.G);
  if (!n.lambda.empty()) pseudo_laplacian(n);
  else if (!n.L.empty()) limit(n);
  if (!n.GP.empty()) add_gradients<9>(n, [&](int a) { return &n.stress[a].P[0][0]; }, n.GP);
  if (!n.Q.empty()) correct_stress(n);
}

/// Average of a tensor of both ends times C: traction from P, deformed area vector c from H (eq. 35, 38).
NANSON_INLINE void average_times_C(const double (&A)[3][3], const double (&B)[3][3], const double (&C)[3], double (&out)[3]) {
  for (int i = 0; i < 3; ++i) {
    out[i] = 0;
    for (int I = 0; I < 3; ++I) out[i] += 0.5 * (A[i][I] + B[i][I]) * C[I];
  }
}

/// Jump of {v, Sigma_J} across the edge's midpoint, W+ - W-.
template <class Choice>
NANSON_INLINE void reconstruct(const NaiveLoop& n, const NaiveEdge& e, Choice choice, const double (&D)[3], double (&jump)[4]) {
  const int count = choice.evolves_J() ? 4 : 3;
  if (choice.limited())
    for (int k = 0; k < count; ++k) jump[k] -= 0.5 * (n.L[e.a][k] * dot(n.G[e.a][k].data(), D) + n.L[e.b][k] * dot(n.G[e.b][k].data(), D));
  else if (choice.linear())
    for (int k = 0; k < count; ++k) jump[k] -= 0.5 * (dot(n.G[e.a][k].data(), D) + dot(n.G[e.b][k].data(), D));
}

/// c . (P+ - P-) C (eq. 36b).
template <class Choice>
double traction_jump_along(const NaiveLoop& n, const NaiveEdge& e, Choice choice, const double (&c)[3], const double (&D)[3]) {
  double across = 0;
  for (int i = 0; i < 3; ++i)
    for (int I = 0; I < 3; ++I) {
      double dP = n.stress[e.b].P[i][I] - n.stress[e.a].P[i][I];
      if (choice.linear()) dP -= 0.5 * (dot(n.GP[e.a][3 * i + I].data(), D) + dot(n.GP[e.b][3 * i + I].data(), D));
      across += c[i] * dP * e.C[I];
    }
  return across;
}

/// {D^p, D^J} of an edge: D^p = |C|/2 rho [c_p n (x) n + c_s (I - n (x) n)] (v+ - v-) (eq. 36a, 37, 41), D^J = |c|^2 (Sigma+ - Sigma-)/(2 rho c_p |C|)
/// (Remark 4, eq. 42) or c . (P+ - P-) C/(2 rho c_p |C|) (eq. 36b), n = c/|c|, c = H_ave C, c_p times max(1, |H_ave N|) in the deformed metric.
/// Entropy fix: without the normal or the tangential part of D^p, or D^J, where it opposes the plain jump (method, section 3).
template <class Choice>
NANSON_INLINE std::array<double, 4> stabilisation(const NaiveLoop& n, const NaiveEdge& e, Choice choice, const double (&c)[3], const double (&D)[3]) {
  const double rho = n.material.rho, cp = n.material.cp, cs = n.material.cs;
  double plain[4], jump[4];
  for (int k = 0; k < 4; ++k) jump[k] = plain[k] = n.W[e.b][k] - n.W[e.a][k];
  reconstruct(n, e, choice, D, jump);
  const double cc = dot(c, c), stretch = choice.deformed() ? std::max(1.0, std::sqrt(cc) / e.size) : 1.0, normal = dot(c, jump) / cc;
  double by_p = cp * stretch, by_s = cs;
  if (choice.fixed()) {
    double tangential = 0;
    for (int i = 0; i < 3; ++i) tangential += (jump[i] - normal * c[i]) * plain[i];
    if (normal * dot(c, plain) < 0) by_p = 0;
    if (tangential < 0) by_s = 0;
  }
  std::array<double, 4> out{};
  for (int i = 0; i < 3; ++i) out[i] = 0.5 * e.size * rho * (by_s * jump[i] + (by_p - by_s) * normal * c[i]);
  if (!choice.evolves_J()) return out;
  const double across = choice.tensor() ? traction_jump_along(n, e, choice, c, D) : cc * jump[3];
  if (!choice.fixed() || across * plain[3] >= 0) out[3] = across / (2 * rho * cp * stretch * e.size);
  return out;
}

/// {D^p, D^J} of the Jameson-Schmidt-Turkel scheme (method, section 9).
std::array<double, 4> jst_dissipation(const NaiveLoop& n, const NaiveEdge& e, bool evolves_J) {
  std::array<double, 4> out{};
  for (int i = 0; i < 3; ++i) out[i] = -1.0 / 256 * n.material.rho * n.material.cp * e.size * (n.L[e.b][i] - n.L[e.a][i]);
  if (evolves_J) out[3] = -1.0 / 8192 * n.material.cp * e.size * (n.L[e.b][3] - n.L[e.a][3]);
  return out;
}

/// Adds C to the current edge between a and b, turned when that runs from b to a.
void add_area(NaiveLoop& n, int a, int b, const Eigen::Vector3d& C) {
  const auto at = std::lower_bound(n.current_edges.begin(), n.current_edges.end(), std::pair(std::min(a, b), std::max(a, b)),
                                   [](const NaiveEdge& e, const std::pair<int, int>& k) { return std::pair(e.a, e.b) < k; });
  for (int i = 0; i < 3; ++i) at->C[i] += a < b ? C[i] : -C[i];
}

/// Median dual of the current positions: in every tet, per edge, the two triangles (edge midpoint, face centroid, tet centroid), turned from a to b.
void dual_of_x(NaiveLoop& n, const std::vector<NaiveNode>& U) {
  for (NaiveEdge& e : n.current_edges) e.C[0] = e.C[1] = e.C[2] = 0;
  for (const auto& t : n.tets) {
    Eigen::Vector3d x[4];
    for (int v = 0; v < 4; ++v) x[v] = Eigen::Vector3d(U[t[v]].x);
    const Eigen::Vector3d middle = (x[0] + x[1] + x[2] + x[3]) / 4;
    for (const auto& e : tet_edges) {
      const Eigen::Vector3d m = (x[e[0]] + x[e[1]]) / 2, f = (x[e[0]] + x[e[1]] + x[e[2]]) / 3, g = (x[e[0]] + x[e[1]] + x[e[3]]) / 3;
      add_area(n, t[e[0]], t[e[1]], 0.5 * (f - m).cross(middle - m) + 0.5 * (middle - m).cross(g - m));
    }
  }
  for (std::size_t k = 0; k < n.corners.size(); ++k) {
    const NaiveCorner& c = n.corners[k];
    const Eigen::Vector3d a(U[c.a].x), A = (Eigen::Vector3d(U[c.b].x) - a).cross(Eigen::Vector3d(U[c.c].x) - a) / 6;
    n.current_corners[k] = {A[0], A[1], A[2]};
  }
}

/// H_x = cof(grad x), edges its mean times C (paper, eq. 49).
void areas_by_map(NaiveLoop& n, const std::vector<NaiveNode>& U) {
  add_gradients<3>(n, [&](int a) { return U[a].x; }, n.grad_x);
  for (std::size_t a = 0; a < n.H_x.size(); ++a)
    for (int i = 0; i < 3; ++i)
      for (int I = 0; I < 3; ++I) {
        const int j = (i + 1) % 3, k = (i + 2) % 3, J = (I + 1) % 3, K = (I + 2) % 3;
        n.H_x[a][i][I] = n.grad_x[a][j][J] * n.grad_x[a][k][K] - n.grad_x[a][j][K] * n.grad_x[a][k][J];
      }
  for (std::size_t k = 0; k < n.edges.size(); ++k)
    for (int i = 0; i < 3; ++i) {
      const NaiveEdge& e = n.edges[k];
      n.current_edges[k].C[i] = 0.5 * (dot(n.H_x[e.a][i].data(), e.C) + dot(n.H_x[e.b][i].data(), e.C));
    }
}

/// Area vector of a face's third at its node m, of which the corner is c: the face's own, or that of the node's map.
Vec3 corner_area(const NaiveLoop& n, std::size_t corner, int m) {
  if (n.H_x.empty()) return n.current_corners[corner];
  Vec3 out;
  for (int i = 0; i < 3; ++i) out[i] = dot(n.H_x[m][i].data(), n.corners[corner].C);
  return out;
}

/// Current areas and what moves J: (48d) as the paper writes it; with relative velocities where the areas do not close (method, section 8).
void current_geometry_pass(NaiveLoop& n, const std::vector<NaiveNode>& U) {
  const bool mapped = n.scene->physics.description == Description::pseudo_updated;
  if (mapped) areas_by_map(n, U);
  else dual_of_x(n, U);
  std::fill(n.dJ.begin(), n.dJ.end(), 0.0);
  for (const NaiveEdge& e : n.current_edges)
    for (int i = 0; i < 3; ++i) {
      const double v_a = n.W[e.a][i], v_b = n.W[e.b][i];
      n.dJ[e.a] += (mapped ? v_b - v_a : v_a + v_b) / 2 * e.C[i];
      n.dJ[e.b] -= (mapped ? v_a - v_b : v_a + v_b) / 2 * e.C[i];
    }
  for (std::size_t k = 0; k < n.corners.size(); ++k) {
    const NaiveCorner& c = n.corners[k];
    const Vec3 area = corner_area(n, k, c.a);
    for (int i = 0; i < 3; ++i) n.dJ[c.a] += ((6 * n.W[c.a][i] + n.W[c.b][i] + n.W[c.c][i]) / 8 - (mapped ? n.W[c.a][i] : 0.0)) * area[i];
  }
}

/// Adjoint boundary flux t_a - (6 t_a + t_b + t_c)/8, t = sigma c_gamma at each of the face's nodes.
void current_boundary_flux(NaiveLoop& n) {
  for (std::size_t k = 0; k < n.corners.size(); ++k) {
    const NaiveCorner& c = n.corners[k];
    const int node[3] = {c.a, c.b, c.c};
    const double weight[3] = {1 - 6.0 / 8, -1.0 / 8, -1.0 / 8};
    for (int m = 0; m < 3; ++m) {
      const Vec3 area = corner_area(n, k, node[m]);
      for (int i = 0; i < 3; ++i) n.force[c.a][i] += weight[m] * dot(n.stress[node[m]].H[i], area.data());
    }
  }
}

/// P_ave C + D^p and D^J of every edge, with the flux correction (method, section 14).
template <class Choice>
void flux_pass(NaiveLoop& n, Choice choice) {
  std::fill(n.force.begin(), n.force.end(), std::array<double, 4>{});
  std::fill(n.dG.begin(), n.dG.end(), Table<3, 3>{});
  for (const NaiveEdge& e : choice.current() ? n.current_edges : n.edges) {
    const NaiveStress &s_a = n.stress[e.a], &s_b = n.stress[e.b];
    const double D[3] = {n.X[e.b][0] - n.X[e.a][0], n.X[e.b][1] - n.X[e.a][1], n.X[e.b][2] - n.X[e.a][2]};
    double t[3], c[3];
    average_times_C(s_a.P, s_b.P, e.C, t);
    average_times_C(s_a.H, s_b.H, e.C, c);
    if (choice.current())
      for (int i = 0; i < 3; ++i) t[i] = c[i], c[i] = e.C[i];  // sigma stands in place of H
    std::array<double, 4> f = choice.jst() ? jst_dissipation(n, e, choice.evolves_J()) : stabilisation(n, e, choice, c, D);
    for (int i = 0; i < 3; ++i) f[i] += t[i];
    if (choice.correction() != FluxCorrection::none) {
      double q[4];
      for (int k = 0; k < 4; ++k) q[k] = theta / 4 * (dot(n.G[e.a][k].data(), D) - dot(n.G[e.b][k].data(), D));
      for (int i = 0; i < 3; ++i) {
        if (choice.correction() == FluxCorrection::pressure) f[i] += q[3] * c[i];
        else
          for (int I = 0; I < 3; ++I) f[i] += 0.5 * (n.Q[e.a][i][I] - s_a.P[i][I] + n.Q[e.b][i][I] - s_b.P[i][I]) * e.C[I];
        for (int I = 0; I < 3; ++I) {
          n.dG[e.a][i][I] += q[i] * e.C[I];
          n.dG[e.b][i][I] -= q[i] * e.C[I];
        }
      }
    }
    for (int k = 0; k < 4; ++k) {
      n.force[e.a][k] += f[k];
      n.force[e.b][k] -= f[k];
    }
  }
}

/// Adjoint boundary flux (P_a - (6 P_a + P_b + P_c)/8) C_gamma (method, section 3), tractions, following pressures, body force.
void boundary_pass(NaiveLoop& n, const std::vector<NaiveNode>& U, double t) {
  const auto P = [&](int a, int i, int I) { return n.Q.empty() ? n.stress[a].P[i][I] : n.Q[a][i][I]; };
  if (has_current_areas(n.scene->physics.description)) current_boundary_flux(n);
  else if (n.scene->physics.boundary_flux == BoundaryFlux::adjoint)
    for (const NaiveCorner& c : n.corners)
      for (int i = 0; i < 3; ++i)
        for (int I = 0; I < 3; ++I) n.force[c.a][i] += (P(c.a, i, I) - (6 * P(c.a, i, I) + P(c.b, i, I) + P(c.c, i, I)) / 8) * c.C[I];
  for (const LoadedFace& f : n.loaded) {
    const double factor = value_at(n.scene->boundary[static_cast<std::size_t>(f.condition)].time, t);
    Vec3 force = f.corner_force;
    if (f.kind == BoundaryKind::pressure) {
      const double *a = U[f.node[0]].x, *b = U[f.node[1]].x, *c = U[f.node[2]].x;
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        force[i] = -f.pressure / 3 * 0.5 * ((b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]));
      }
    }
    for (int node : f.node)
      for (int i = 0; i < 3; ++i) n.force[node][i] += factor * force[i];
  }
  for (std::size_t a = 0; a < n.volume.size(); ++a)
    for (int i = 0; i < 3; ++i) n.force[a][i] += n.material.rho * n.volume[a] * n.scene->body_force[i];
}

/// Along a held direction dp/dt is rho (v(t + dt) - v(t))/dt of what is prescribed there.
void hold(NaiveLoop& n, double dt) {
  std::vector<double> rate(n.scene->boundary.size());
  for (std::size_t i = 0; i < rate.size(); ++i) {
    const BoundarySpec& c = n.scene->boundary[i];
    rate[i] = c.kind == BoundaryKind::velocity ? (value_at(c.time, n.t + dt) - value_at(c.time, n.t)) / dt : 0.0;
  }
  for (const Constraint& h : n.constraints)
    for (int m = 0; m < h.count; ++m) {
      double wanted = 0;
      for (int s = 0; s < 3; ++s) wanted += h.weight[m][s] * rate[static_cast<std::size_t>(h.source[m][s])];
      const double change = n.material.rho * n.volume[h.node] * wanted - dot(n.force[h.node].data(), h.d[m]);
      for (int i = 0; i < 3; ++i) n.force[h.node][i] += change * h.d[m][i];
    }
}

struct Weights {
  double old, stage, dt;  // U_new = old U^n + stage (U + dt dU/dt)
  double operator()(double U_old, double U, double rate) const { return old * U_old + stage * (U + dt * rate); }
};

/// dv/dt = f/(rho Omega), dF/dt = G, dH/dt = F x G, dJ/dt = H : G + D^J/Omega, dx/dt = v (eq. 40a, 43, 31).
void update_pass(NaiveLoop& n, const std::vector<NaiveNode>& from, std::vector<NaiveNode>& to, const std::vector<Table<3, 3>>& H_from,
                 std::vector<Table<3, 3>>& H_to, const Weights& w) {
  const bool evolves_J = n.scene->physics.formulation != Formulation::pF;
  for (std::size_t a = 0; a < from.size(); ++a) {
    const NaiveNode U_old = n.now[a], U = from[a];
    const double inverse_volume = 1 / n.volume[a], inverse_mass = inverse_volume / n.material.rho;
    double G[3][3], dJ = n.force[a][3] * inverse_volume;
    for (int i = 0; i < 3; ++i)
      for (int I = 0; I < 3; ++I) {
        G[i][I] = n.G[a][i][I];
        if (!n.dG.empty()) G[i][I] += n.dG[a][i][I] * inverse_volume;
        if (evolves_J && n.dJ.empty()) dJ += n.stress[a].H[i][I] * G[i][I];
      }
    if (!n.dJ.empty()) dJ += n.dJ[a] * inverse_volume;
    NaiveNode& out = to[a];
    for (int i = 0; i < 3; ++i) {
      out.v[i] = w(U_old.v[i], U.v[i], n.force[a][i] * inverse_mass);
      out.x[i] = w(U_old.x[i], U.x[i], U.v[i]);
      for (int I = 0; I < 3; ++I) out.F[i][I] = w(U_old.F[i][I], U.F[i][I], G[i][I]);
    }
    out.J = w(U_old.J, U.J, dJ);
    if (H_from.empty()) continue;
    const Table<3, 3> H_old = n.H_now[a], H = H_from[a];
    for (int i = 0; i < 3; ++i)
      for (int I = 0; I < 3; ++I) {
        const int j = (i + 1) % 3, k = (i + 2) % 3, J = (I + 1) % 3, K = (I + 2) % 3;
        const double dH = U.F[j][J] * G[k][K] + U.F[k][K] * G[j][J] - U.F[j][K] * G[k][J] - U.F[k][J] * G[j][K];
        H_to[a][i][I] = w(H_old[i][I], H[i][I], dH);
      }
  }
}

template <Law law, Volumetric volumetric, Isochoric isochoric, Formulation formulation>
void material_pass(NaiveLoop& n, const std::vector<NaiveNode>& nodes, const std::vector<Table<3, 3>>& H_of) {
  const MaterialConstants& m = n.material;
  const bool deformed = n.scene->physics.upwind_metric == UpwindMetric::deformed, jst = n.scene->physics.stabilisation == Stabilisation::jst;
  n.report = {};
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    const NaiveNode& U = nodes[a];
    Tensor<double> F, H{};
    for (int k = 0; k < 9; ++k) F[k / 3][k % 3] = U.F[k / 3][k % 3];
    if (formulation == Formulation::pFHJ)
      for (int k = 0; k < 9; ++k) H[k / 3][k % 3] = H_of[a][k / 3][k % 3];
    const Stress<double> s = Material<law, volumetric, isochoric, formulation>::stress(F, H, U.J, m);
    for (int k = 0; k < 9; ++k) n.stress[a].P[k / 3][k % 3] = s.P[k / 3][k % 3], n.stress[a].H[k / 3][k % 3] = s.H[k / 3][k % 3];
    for (int k = 0; k < 9 && !n.dJ.empty(); ++k) n.stress[a].H[k / 3][k % 3] = dot(n.stress[a].P[k / 3], U.F[k % 3]) / U.J;
    n.W[a] = {U.v[0], U.v[1], U.v[2], !jst ? s.Sigma_J : formulation == Formulation::pF ? s.det_F : U.J};
    double c = std::sqrt(s.rho_c2 / m.rho);
    if (formulation != Formulation::pF && law != Law::linear_elastic) c = std::max(c, s.d2U / (m.rho * m.cp) * (deformed ? std::sqrt(s.H2) : s.H2));
    n.report.fastest = std::max(n.report.fastest, c / n.step_length[a]);
    if (!(s.det_F > 0) || !std::isfinite(dot(U.v, U.v)) || (formulation != Formulation::pF && !(U.J > 0))) n.report.broken = true;
  }
}

template <Law law, Volumetric volumetric, Isochoric isochoric>
void material_of_formulation(NaiveLoop& n, const std::vector<NaiveNode>& nodes, const std::vector<Table<3, 3>>& H) {
  switch (n.scene->physics.formulation) {
    case Formulation::pF: return material_pass<law, volumetric, Isochoric::F, Formulation::pF>(n, nodes, H);
    case Formulation::pFJ: return material_pass<law, volumetric, isochoric, Formulation::pFJ>(n, nodes, H);
    case Formulation::pFHJ: return material_pass<law, volumetric, isochoric, Formulation::pFHJ>(n, nodes, H);
    case Formulation::pFp: throw std::invalid_argument("the plain loop has no projection");
  }
}

template <Law law>
void material_of_law(NaiveLoop& n, const std::vector<NaiveNode>& nodes, const std::vector<Table<3, 3>>& H) {
  const MaterialSpec& m = n.scene->material;
  if (m.volumetric == Volumetric::quadratic && m.isochoric == Isochoric::F) material_of_formulation<law, Volumetric::quadratic, Isochoric::F>(n, nodes, H);
  else if (m.volumetric == Volumetric::quadratic) material_of_formulation<law, Volumetric::quadratic, Isochoric::J>(n, nodes, H);
  else if (m.isochoric == Isochoric::F) material_of_formulation<law, Volumetric::barrier, Isochoric::F>(n, nodes, H);
  else material_of_formulation<law, Volumetric::barrier, Isochoric::J>(n, nodes, H);
}

void material(NaiveLoop& n, const std::vector<NaiveNode>& nodes, const std::vector<Table<3, 3>>& H) {
  switch (n.scene->material.law) {
    case Law::linear_elastic: return material_of_formulation<Law::linear_elastic, Volumetric::quadratic, Isochoric::F>(n, nodes, H);
    case Law::neo_hookean: return material_of_law<Law::neo_hookean>(n, nodes, H);
    case Law::mooney_rivlin: return material_of_law<Law::mooney_rivlin>(n, nodes, H);
    case Law::hencky_j2: throw std::invalid_argument("the plain loop has no plasticity");
  }
}

void copy_state(NaiveLoop& n, const Simulation& s) {
  for (std::size_t a = 0; a < n.row.size(); ++a) {
    const double* U = &s.state.U[0][static_cast<std::size_t>(row::U * n.row[a])];
    NaiveNode& node = n.now[a];
    node.J = U[3];
    for (int i = 0; i < 3; ++i) {
      node.v[i] = U[i], node.x[i] = U[4 * (i + 1) + 3];
      for (int I = 0; I < 3; ++I) node.F[i][I] = U[4 * (I + 1) + i];
    }
    if (n.H_now.empty()) continue;
    for (int m = 0; m < 9; ++m) n.H_now[a][m % 3][m / 3] = s.state.H[0][static_cast<std::size_t>(row::H * n.row[a] + 4 * (m / 3) + m % 3)];
  }
}

void allocate(NaiveLoop& n) {
  const std::size_t nodes = n.row.size();
  const PhysicsSpec& p = n.scene->physics;
  const bool full = p.flux_correction == FluxCorrection::full;
  n.now.resize(nodes), n.stage.resize(nodes), n.W.resize(nodes), n.stress.resize(nodes), n.G.resize(nodes), n.force.resize(nodes);
  if (p.formulation == Formulation::pFHJ) n.H_now.resize(nodes), n.H_stage.resize(nodes);
  if (full || (p.pressure_jump == PressureJump::tensor && p.reconstruction != Reconstruction::constant)) n.GP.resize(nodes);
  if (full) n.Q.resize(nodes);
  if (p.flux_correction != FluxCorrection::none) n.dG.resize(nodes);
  if (p.reconstruction == Reconstruction::limited || p.stabilisation == Stabilisation::jst) n.L.resize(nodes);
}

/// lambda_a = -M^-1 R, R = sum_b D, M = sum_b D (x) D: the pseudo-Laplacian of a linear field is zero (method, section 9).
void find_lambda(NaiveLoop& n) {
  std::vector<Eigen::Vector3d> R(n.row.size(), Eigen::Vector3d::Zero());
  std::vector<Eigen::Matrix3d> M(n.row.size(), Eigen::Matrix3d::Zero());
  for (const NaiveEdge& e : n.edges) {
    const Eigen::Vector3d D = Eigen::Vector3d(n.X[e.b].data()) - Eigen::Vector3d(n.X[e.a].data());
    R[e.a] += D, M[e.a] += D * D.transpose();
    R[e.b] -= D, M[e.b] += D * D.transpose();
  }
  for (std::size_t a = 0; a < n.row.size(); ++a) {
    const Eigen::Vector3d lambda = -M[a].inverse() * R[a];
    n.lambda.push_back({lambda[0], lambda[1], lambda[2]});
  }
}

void place_edges(NaiveLoop& n, const Order& o, const std::vector<int>& node_of_row) {
  for (int r = 0; r < o.rows; ++r) {
    for (std::int32_t e = o.out[r]; e < o.out[r + 1]; ++e)
      if (o.b[e] > r) n.edges.push_back({node_of_row[r], node_of_row[o.b[e]], {o.C[0][e], o.C[1][e], o.C[2][e]}, std::hypot(o.C[0][e], o.C[1][e], o.C[2][e])});
    for (std::int32_t g = o.corner[r]; g < o.corner[r + 1]; ++g)
      n.corners.push_back({node_of_row[r], node_of_row[o.corner_b[g]], node_of_row[o.corner_c[g]], {o.corner_C[0][g], o.corner_C[1][g], o.corner_C[2][g]}});
  }
}

}  // namespace

NaiveLoop make_naive_loop(const Simulation& s) {
  NaiveLoop n;
  n.scene = s.scene, n.material = s.coefficients.material, n.t = s.t;
  std::vector<int> node_of_row(static_cast<std::size_t>(s.order.rows), -1);
  for (int r = 0; r < s.order.rows; ++r) {
    const int node = s.order.node_of[r];
    if (node < 0) continue;
    node_of_row[r] = static_cast<int>(n.row.size());
    n.row.push_back(r), n.X.push_back(s.mesh->X[node]), n.volume.push_back(s.volume[node]), n.step_length.push_back(s.state.step_length[r]);
  }
  place_edges(n, s.order, node_of_row);
  n.constraints = s.boundary.constraints, n.loaded = s.boundary.loaded;
  for (Constraint& h : n.constraints) h.node = node_of_row[h.node];
  for (LoadedFace& f : n.loaded)
    for (int& node : f.node) node = node_of_row[node];
  allocate(n);
  if (n.scene->physics.stabilisation == Stabilisation::jst) find_lambda(n);
  if (has_current_areas(n.scene->physics.description)) {
    for (auto t : s.mesh->tets) {
      for (int& node : t) node = node_of_row[s.order.row_of[node]];
      n.tets.push_back(t);
    }
    n.current_edges = n.edges, n.current_corners.resize(n.corners.size()), n.dJ.resize(n.row.size());
    if (n.scene->physics.description == Description::pseudo_updated) n.grad_x.resize(n.row.size()), n.H_x.resize(n.row.size());
  }
  copy_state(n, s);
  material(n, n.now, n.H_now);
  return n;
}

void naive_stage(NaiveLoop& n, int number, double dt) {
  constexpr Weights rk2[] = {{0, 1, 0}, {0.5, 0.5, 0}}, rk3[] = {{0, 1, 0}, {0.75, 0.25, 0}, {1.0 / 3, 2.0 / 3, 0}};
  constexpr double at[] = {0, 1, 0.5};  // of the step: the time of each stage's rates
  const bool second = n.scene->time.integrator == Integrator::tvd_rk2, last = number == (second ? 1 : 2);
  Weights w = second ? rk2[number] : rk3[number];
  w.dt = dt;
  auto &from = number == 0 ? n.now : n.stage, &to = last ? n.now : n.stage;
  auto &H_from = number == 0 ? n.H_now : n.H_stage, &H_to = last ? n.H_now : n.H_stage;
  gradient_pass(n);
  const AnyChoice choice{n.scene->physics};
  if (choice.current()) current_geometry_pass(n, from);
  if (!is_baseline(choice)) flux_pass(n, choice);
  else if (choice.evolves_J()) flux_pass(n, Baseline<true>{});
  else flux_pass(n, Baseline<false>{});
  boundary_pass(n, from, n.t + at[number] * dt);
  hold(n, dt);
  update_pass(n, from, to, H_from, H_to, w);
  material(n, to, H_to);
}

void naive_advance(NaiveLoop& n, double dt) {
  const int stages = n.scene->time.integrator == Integrator::tvd_rk2 ? 2 : 3;
  for (int number = 0; number < stages; ++number) naive_stage(n, number, dt);
  n.t += dt;
}

double naive_dissipation(NaiveLoop& n) {
  const AnyChoice choice{n.scene->physics};
  gradient_pass(n);
  if (choice.current()) current_geometry_pass(n, n.now);
  double power = 0;
  for (const NaiveEdge& e : choice.current() ? n.current_edges : n.edges) {
    const double D[3] = {n.X[e.b][0] - n.X[e.a][0], n.X[e.b][1] - n.X[e.a][1], n.X[e.b][2] - n.X[e.a][2]};
    double c[3];
    average_times_C(n.stress[e.a].H, n.stress[e.b].H, e.C, c);
    for (int i = 0; i < 3 && choice.current(); ++i) c[i] = e.C[i];
    const std::array<double, 4> d = stabilisation(n, e, choice, c, D);
    for (int k = 0; k < 4; ++k) power += (n.W[e.b][k] - n.W[e.a][k]) * d[k];
  }
  return power;
}

double largest_difference(const NaiveLoop& n, const std::vector<NaiveNode>& nodes, const double* U_of, const double* W_of, const double* PH_of) {
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
    J.add(node.J, U[3]), swept.add(n.W[a][3], W_of[row::W * r + 3]);
    for (int i = 0; i < 3; ++i) {
      v.add(node.v[i], U[i]), x.add(node.x[i], U[4 * (i + 1) + 3]);
      for (int I = 0; I < 3; ++I) {
        F.add(node.F[i][I], U[4 * (I + 1) + i]);
        P.add(n.stress[a].P[i][I], PH[8 * I + i]), H.add(n.stress[a].H[i][I], PH[8 * I + 4 + i]);
      }
    }
  }
  P.size = std::max(P.size, 0.1 * n.material.kappa);
  if (!n.dJ.empty()) H.size = std::max(H.size, 0.1 * n.material.kappa);  // the Cauchy stress
  if (n.lambda.empty()) swept.size = std::max(swept.size, 0.1 * n.material.kappa);
  double worst = 0;
  for (const Field& f : {v, J, F, x, H, swept, P})
    if (f.difference > 0) worst = std::max(worst, f.difference / f.size);
  return worst;
}

double largest_difference(const NaiveLoop& n, const Simulation& s) {
  return largest_difference(n, n.now, s.state.U[0].data(), s.state.W[s.state.now].data(), s.state.PH[s.state.now].data());
}

}  // namespace nanson
