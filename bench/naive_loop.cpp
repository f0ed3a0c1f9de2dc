// Four passes a stage over whole arrays: gradient, flux, update, material.
#include "bench/naive_loop.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bench/naive_gradients.hpp"
#include "engine/time_function.hpp"

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
  return c.linear() && !c.limited() && !c.fixed() && !c.jst() && !c.tensor() && !c.current() && c.deformed()
         && c.correction() == FluxCorrection::none;
}

/// dP_a = theta/(4 Omega_a) sum_b [(P_a - P_b + D . grad P_a) C_ab] (x) D (method, section 14).
void find_correction(NaiveLoop& n) {
  std::fill(n.dP.begin(), n.dP.end(), Table<3, 3>{});
  const auto add = [&](int a, int b, const double(&C)[3]) {
    double D[3];
    for (int I = 0; I < 3; ++I) D[I] = n.X[b][I] - n.X[a][I];
    for (int i = 0; i < 3; ++i) {
      double y = 0;
      for (int I = 0; I < 3; ++I)
        y += (n.stress[a].P[i][I] - n.stress[b].P[i][I] + dot(D, n.GP[a][3 * i + I].data())) * C[I];
      for (int I = 0; I < 3; ++I) n.dP[a][i][I] += y * D[I];
    }
  };
  for (const NaiveEdge& e : n.edges) {
    add(e.a, e.b, e.C);
    add(e.b, e.a, {-e.C[0], -e.C[1], -e.C[2]});
  }
  for (std::size_t a = 0; a < n.dP.size(); ++a)
    for (auto& column : n.dP[a])
      for (double& dP : column) dP *= theta / (4 * n.volume[a]);
}
void add_correction(NaiveLoop& n) {
  for (std::size_t a = 0; a < n.dP.size(); ++a)
    for (int m = 0; m < 9; ++m) n.stress[a].P[m / 3][m % 3] += n.dP[a][m / 3][m % 3];
}

/// Barth-Jespersen: the largest phi in [0, 1] for which W + phi G . D/2 stays between the values around at the midpoint of every edge (method, section 4).
void limit(NaiveLoop& n) {
  std::vector<std::array<double, 4>> most = n.W, least = n.W;
  for (const NaiveEdge& e : n.edges)
    for (int k = 0; k < 4; ++k) {
      most[e.a][k] = std::max(most[e.a][k], n.W[e.b][k]);
      least[e.a][k] = std::min(least[e.a][k], n.W[e.b][k]);
      most[e.b][k] = std::max(most[e.b][k], n.W[e.a][k]);
      least[e.b][k] = std::min(least[e.b][k], n.W[e.a][k]);
    }
  std::fill(n.L.begin(), n.L.end(), std::array<double, 4>{1, 1, 1, 1});
  const auto visit = [&](int a, const double(&D)[3]) {
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
  add_gradients<4>(
      n, [&](int a) { return n.W[a].data(); }, n.G);
  if (!n.lambda.empty()) pseudo_laplacian(n);
  else if (!n.L.empty()) limit(n);
  if (!n.GP.empty())
    add_gradients<9>(
        n, [&](int a) { return &n.stress[a].P[0][0]; }, n.GP);
  if (!n.dP.empty() && !n.takes_lagged) find_correction(n);
}

/// Average of a tensor of both ends times C: traction from P, deformed area vector c from H (eq. 35, 38).
NANSON_INLINE void average_times_C(const double (&A)[3][3], const double (&B)[3][3], const double (&C)[3],
                                   double (&out)[3]) {
  for (int i = 0; i < 3; ++i) {
    out[i] = 0;
    for (int I = 0; I < 3; ++I) out[i] += 0.5 * (A[i][I] + B[i][I]) * C[I];
  }
}

/// Jump of {v, Sigma_J} across the edge's midpoint, W+ - W-.
template <class Choice>
NANSON_INLINE void reconstruct(const NaiveLoop& n, const NaiveEdge& e, Choice choice, const double (&D)[3],
                               double (&jump)[4]) {
  const int count = choice.evolves_J() ? 4 : 3;
  if (choice.limited())
    for (int k = 0; k < count; ++k)
      jump[k] -= 0.5 * (n.L[e.a][k] * dot(n.G[e.a][k].data(), D) + n.L[e.b][k] * dot(n.G[e.b][k].data(), D));
  else if (choice.linear())
    for (int k = 0; k < count; ++k) jump[k] -= 0.5 * (dot(n.G[e.a][k].data(), D) + dot(n.G[e.b][k].data(), D));
}

/// c . (P+ - P-) C (eq. 36b), with the limiter of Sigma_J.
template <class Choice>
double traction_jump_along(const NaiveLoop& n, const NaiveEdge& e, Choice choice, const double (&c)[3],
                           const double (&D)[3]) {
  double across = 0;
  for (int i = 0; i < 3; ++i)
    for (int I = 0; I < 3; ++I) {
      double dP = n.stress[e.b].P[i][I] - n.stress[e.a].P[i][I];
      const double phi_a = choice.limited() ? n.L[e.a][3] : 1, phi_b = choice.limited() ? n.L[e.b][3] : 1;
      if (choice.linear())
        dP -= 0.5 * (phi_a * dot(n.GP[e.a][3 * i + I].data(), D) + phi_b * dot(n.GP[e.b][3 * i + I].data(), D));
      across += c[i] * dP * e.C[I];
    }
  return across;
}

/// {D^p, D^J} of an edge: D^p = |C|/2 rho [c_p n (x) n + c_s (I - n (x) n)] (v+ - v-) (eq. 36a, 37, 41), D^J = |c|^2 (Sigma+ - Sigma-)/(2 rho c_p |C|)
/// (Remark 4, eq. 42; with an energy of the parting c_J in place of c_p) or c . (P+ - P-) C/(2 rho c_p |C|) (eq. 36b), n = c/|c|, c = H_ave C, c_p times max(1, |H_ave N|) in the deformed metric.
/// Entropy fix: without the normal or the tangential part of D^p, or D^J, where it opposes the plain jump (method, section 3).
template <class Choice>
NANSON_INLINE std::array<double, 4> stabilisation(const NaiveLoop& n, const NaiveEdge& e, Choice choice,
                                                  const double (&c)[3], const double (&D)[3]) {
  const double rho_cp = 0.5 * (n.rho_cp[e.a] + n.rho_cp[e.b]), rho_cs = 0.5 * (n.rho_cs[e.a] + n.rho_cs[e.b]);
  double plain[4], jump[4];
  for (int k = 0; k < 4; ++k) jump[k] = plain[k] = n.W[e.b][k] - n.W[e.a][k];
  reconstruct(n, e, choice, D, jump);
  const double cc = dot(c, c), stretch = choice.deformed() ? std::max(1.0, std::sqrt(cc) / e.size) : 1.0,
               normal = dot(c, jump) / cc;
  double by_p = rho_cp * stretch, by_s = rho_cs;
  if (choice.fixed()) {
    double tangential = 0;
    for (int i = 0; i < 3; ++i) tangential += (jump[i] - normal * c[i]) * plain[i];
    if (normal * dot(c, plain) < 0) by_p = 0;
    if (tangential < 0) by_s = 0;
  }
  std::array<double, 4> out{};
  for (int i = 0; i < 3; ++i) out[i] = 0.5 * e.size * (by_s * jump[i] + (by_p - by_s) * normal * c[i]);
  if (!choice.evolves_J()) return out;
  const double across = choice.tensor() ? traction_jump_along(n, e, choice, c, D) : cc * jump[3];
  const double rho_cJ = 0.5 * (n.rho_cJ[e.a] + n.rho_cJ[e.b]);
  if (!choice.fixed() || across * plain[3] >= 0) out[3] = across / (2 * rho_cJ * stretch * e.size);
  return out;
}

/// {D^p, D^J} of the Jameson-Schmidt-Turkel scheme (method, section 9).
std::array<double, 4> jst_dissipation(const NaiveLoop& n, const NaiveEdge& e, bool evolves_J) {
  std::array<double, 4> out{};
  for (int i = 0; i < 3; ++i) out[i] = -1.0 / 256 * n.rho_cp[e.a] * e.size * (n.L[e.b][i] - n.L[e.a][i]);
  if (evolves_J) out[3] = -1.0 / 8192 * n.laws[0].constants.cp * e.size * (n.L[e.b][3] - n.L[e.a][3]);
  return out;
}

/// P_ave C + D^p and D^J of every edge, with the flux correction (method, section 14).
template <class Choice>
void flux_pass(NaiveLoop& n, Choice choice) {
  std::fill(n.force.begin(), n.force.end(), std::array<double, 4>{});
  if (!n.takes_lagged) std::fill(n.dG.begin(), n.dG.end(), Table<3, 3>{});
  const auto& edges = choice.current() ? n.current_edges : n.edges;
  for (const NaiveEdge& e : edges) {
    const NaiveStress &s_a = n.stress[e.a], &s_b = n.stress[e.b];
    const double D[3] = {n.X[e.b][0] - n.X[e.a][0], n.X[e.b][1] - n.X[e.a][1], n.X[e.b][2] - n.X[e.a][2]};
    double t[3], c[3];
    average_times_C(s_a.P, s_b.P, e.C, t);
    average_times_C(s_a.H, s_b.H, e.C, c);
    if (choice.current())
      for (int i = 0; i < 3; ++i) {  // sigma stands in place of H
        t[i] = c[i];
        c[i] = e.C[i];
      }
    std::array<double, 4> f = choice.jst() ? jst_dissipation(n, e, choice.evolves_J())
                                           : stabilisation(n, e, choice, c, D);
    for (int i = 0; i < 3; ++i) f[i] += t[i];
    if (choice.correction() != FluxCorrection::none) {
      double q[4];
      for (int k = 0; k < 4; ++k) q[k] = theta / 4 * (dot(n.G[e.a][k].data(), D) - dot(n.G[e.b][k].data(), D));
      const bool pressure = choice.correction() == FluxCorrection::pressure;
      double& q_lagged = n.q[static_cast<std::size_t>(&e - edges.data())];
      if (!n.takes_lagged) q_lagged = q[3];
      for (int i = 0; i < 3; ++i) {
        if (pressure) f[i] += q_lagged * c[i];
        if (n.takes_lagged) continue;
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
  const auto P = [&](int a, int i, int I) { return n.stress[a].P[i][I]; };
  const bool adjoint = n.scene->physics.boundary_flux == BoundaryFlux::adjoint;
  if (adjoint && has_current_areas(n.scene->physics.description)) current_boundary_flux(n);
  else if (adjoint)
    for (const NaiveCorner& c : n.corners)
      for (int i = 0; i < 3; ++i)
        for (int I = 0; I < 3; ++I)
          n.force[c.a][i] += (P(c.a, i, I) - (6 * P(c.a, i, I) + P(c.b, i, I) + P(c.c, i, I)) / 8) * c.C[I];
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
    for (int i = 0; i < 3; ++i) n.force[a][i] += n.rho[a] * n.volume[a] * n.scene->body_force[i];
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
      const double change = n.rho[h.node] * n.volume[h.node] * wanted - dot(n.force[h.node].data(), h.d[m]);
      for (int i = 0; i < 3; ++i) n.force[h.node][i] += change * h.d[m][i];
    }
}

struct Weights {
  double old, stage, dt;  // U_new = old U^n + stage (U + dt dU/dt)
  double operator()(double U_old, double U, double rate) const { return old * U_old + stage * (U + dt * rate); }
};

/// dv/dt = f/(rho Omega), dF/dt = G, dH/dt = F x G, dJ/dt = H : G + D^J/Omega, dx/dt = v (eq. 40a, 43, 31).
void update_pass(NaiveLoop& n, const std::vector<NaiveNode>& from, std::vector<NaiveNode>& to,
                 const std::vector<Table<3, 3>>& H_from, std::vector<Table<3, 3>>& H_to, const Weights& w) {
  const bool evolves_J = n.scene->physics.formulation != Formulation::pF;
  for (std::size_t a = 0; a < from.size(); ++a) {
    const NaiveNode U_old = n.now[a], U = from[a];
    const double inverse_volume = 1 / n.volume[a], inverse_mass = inverse_volume / n.rho[a];
    double G[3][3], dJ = n.force[a][3] * inverse_volume;
    for (int i = 0; i < 3; ++i)
      for (int I = 0; I < 3; ++I) {
        G[i][I] = n.G[a][i][I];
        if (!n.dG.empty()) G[i][I] += n.dG[a][i][I] * inverse_volume;
        if (evolves_J && n.dJ.empty()) dJ += n.stress[a].H[i][I] * G[i][I];
      }
    if (evolves_J && !n.dJ.empty()) dJ += n.dJ[a] * inverse_volume;
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

}  // namespace

void naive_stage(NaiveLoop& n, int number, double dt) {
  constexpr Weights rk2[] = {{0, 1, 0}, {0.5, 0.5, 0}}, rk3[] = {{0, 1, 0}, {0.75, 0.25, 0}, {1.0 / 3, 2.0 / 3, 0}};
  constexpr double at[] = {0, 1, 0.5};  // of the step: the time of each stage's rates
  const bool second = n.scene->time.integrator == Integrator::tvd_rk2, last = number == (second ? 1 : 2);
  Weights w = second ? rk2[number] : rk3[number];
  w.dt = dt;
  n.takes_lagged = number == 0 && n.has_lagged;
  auto &from = number == 0 ? n.now : n.stage, &to = last ? n.now : n.stage;
  auto &H_from = number == 0 ? n.H_now : n.H_stage, &H_to = last ? n.H_now : n.H_stage;
  if (!n.crushing.empty()) crushing_pass(n, from);
  gradient_pass(n);
  if (!n.takes_lagged) add_correction(n);
  const AnyChoice choice{n.scene->physics};
  if (choice.current()) current_geometry_pass(n, from);
  if (!is_baseline(choice)) flux_pass(n, choice);
  else if (choice.evolves_J()) flux_pass(n, Baseline<true>{});
  else flux_pass(n, Baseline<false>{});
  if (!n.springs.empty()) spring_pass(n, from);
  for (std::size_t a = 0; a < n.crushing.size(); ++a)
    for (int i = 0; i < 3; ++i) n.force[a][i] += n.crushing[a][i];
  boundary_pass(n, from, n.t + at[number] * dt);
  hold(n, dt);
  update_pass(n, from, to, H_from, H_to, w);
  naive_material(n, to, H_to, last);
  n.has_lagged = second && last && !n.dG.empty();
  if (n.has_lagged) add_correction(n);
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

}  // namespace nanson
