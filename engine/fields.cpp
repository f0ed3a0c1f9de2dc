// Fields from rows; errors against exact solutions.
#include "engine/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "engine/compensated_sum.hpp"
#include "engine/initial.hpp"
#include "engine/manufactured.hpp"

namespace nanson {
namespace {

const double* U_row(const Simulation& s, int node) {
  return &s.state.U[0][static_cast<std::size_t>(row::U * s.domain.order.row_of[static_cast<std::size_t>(node)])];
}
const double* PH_row(const Simulation& s, int node) {
  return &s.state.PH[s.state.now]
                    [static_cast<std::size_t>(row::PH * s.domain.order.row_of[static_cast<std::size_t>(node)])];
}

/// P_iI of the material [Pa]: without the tets' share, and without the flux correction that the next step's first stage takes.
double P_at(const Simulation& s, int node, int i, int I) {
  const Domain& d = s.domain;
  const double rest = i == I && !d.coefficients.current_areas ? 1 : 0,
               c = d.scene->physics.tet_stiffness > 0
                       ? tet_stiffness_at(d, d.order.row_of[static_cast<std::size_t>(node)])
                       : 0,
               P = PH_row(s, node)[8 * I + i] + c * (U_row(s, node)[4 * (I + 1) + i] - rest);
  if (!s.state.has_lagged_correction || s.state.dP.empty()) return P;
  return P
         - s.state.dP[static_cast<std::size_t>(row::dP * s.domain.order.row_of[static_cast<std::size_t>(node)] + 4 * I
                                               + i)];
}

double plastic_strain(const Simulation& s, int node) {
  return nanson::plastic_strain(s.domain.mixture, s.state.plastic,
                                s.domain.order.row_of[static_cast<std::size_t>(node)]);
}

Tensor<double> F_of(const double* U) {
  Tensor<double> F;
  for (int m = 0; m < 9; ++m) F[m % 3][m / 3] = U[4 * (m / 3 + 1) + m % 3];
  return F;
}

/// J as it is carried, det F where none is.
double carried_J(const Simulation& s, int node) {
  const double* U = U_row(s, node);
  return evolves_J(s.domain.scene->physics.formulation) ? U[3] : determinant(F_of(U), cofactor(F_of(U)));
}

/// Cauchy stress P F^T / J with the J that the scheme carries [Pa].
Tensor<double> cauchy(const Simulation& s, int node) {
  const Tensor<double> F = F_of(U_row(s, node));
  const double J = carried_J(s, node);
  Tensor<double> sigma{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      for (int I = 0; I < 3; ++I) sigma[i][j] += P_at(s, node, i, I) * F[j][I];
      sigma[i][j] /= J;
    }
  return sigma;
}

double von_mises(const Tensor<double>& a) {
  const double m = (a[0][0] + a[1][1] + a[2][2]) / 3;
  double dev2 = 0;
  for (int k = 0; k < 9; ++k) {
    const double d = 0.5 * (a[k / 3][k % 3] + a[k % 3][k / 3]) - (k % 4 == 0 ? m : 0.0);
    dev2 += d * d;
  }
  return std::sqrt(1.5 * dev2);
}

void put(const Tensor<double>& a, double* out) {
  for (int k = 0; k < 9; ++k) out[k] = a[k / 3][k % 3];
}

constexpr Field table[] = {
    {"x", 3, "m", "current position",
     [](const Simulation& s, int node, double* out) {
       for (int k = 0; k < 3; ++k) out[k] = U_row(s, node)[4 * (k + 1) + 3];
     }},
    {"displacement", 3, "m", "x - X, from the undeformed position",
     [](const Simulation& s, int node, double* out) {
       const Vec3& X = s.domain.mesh->X[static_cast<std::size_t>(node)];
       for (int k = 0; k < 3; ++k) out[k] = U_row(s, node)[4 * (k + 1) + 3] - X[static_cast<std::size_t>(k)];
     }},
    {"velocity", 3, "m/s", "linear momentum over the undeformed density",
     [](const Simulation& s, int node, double* out) {
       for (int k = 0; k < 3; ++k) out[k] = U_row(s, node)[k];
     }},
    {"pressure", 1, "Pa", "-tr(sigma)/3, positive in compression",
     [](const Simulation& s, int node, double* out) {
       const auto sigma = cauchy(s, node);
       out[0] = -(sigma[0][0] + sigma[1][1] + sigma[2][2]) / 3;
     }},
    {"P", 9, "Pa",
     "first Piola-Kirchhoff stress P_iI, force per undeformed area; row-major: P_11 P_12 P_13 P_21 ...; "
     "the Cauchy stress is sigma = P F^T / J with the carried J",
     [](const Simulation& s, int node, double* out) {
       for (int k = 0; k < 9; ++k) out[k] = P_at(s, node, k / 3, k % 3);
     }},
    {"F", 9, "-", "deformation gradient F_iI = dx_i/dX_I as it is carried, row-major",
     [](const Simulation& s, int node, double* out) { put(F_of(U_row(s, node)), out); }},
    {"H", 9, "-", "area map H_iI (the cofactor of F; carried by pFHJ only), row-major",
     [](const Simulation& s, int node, double* out) {
       if (has_current_areas(s.domain.scene->physics.description))  // sigma stands in its place
         return put(cofactor(F_of(U_row(s, node))), out);
       for (int k = 0; k < 9; ++k) out[k] = PH_row(s, node)[8 * (k % 3) + 4 + k / 3];
     }},
    {"J", 1, "-", "volume map as it is carried, det F where it is not (pF, pFp)",
     [](const Simulation& s, int node, double* out) { out[0] = carried_J(s, node); }},
    {"detF", 1, "-", "determinant of F; below or at 0: turned inside out",
     [](const Simulation& s, int node, double* out) {
       const auto F = F_of(U_row(s, node));
       out[0] = determinant(F, cofactor(F));
     }},
    {"von_mises", 1, "Pa", "sqrt(3/2 s:s) of the deviator s of the Cauchy stress",
     [](const Simulation& s, int node, double* out) { out[0] = von_mises(cauchy(s, node)); }},
    {"plastic_strain", 1, "-", "equivalent plastic strain (law hencky_j2 only)",
     [](const Simulation& s, int node, double* out) { out[0] = plastic_strain(s, node); }},
};

}  // namespace

std::span<const Field> output_fields() { return table; }

const Field* find_field(std::string_view name) {
  const auto at = std::ranges::find(table, name, &Field::name);
  return at == std::end(table) ? nullptr : at;
}

const Field& field_named(std::string_view name) {
  if (const Field* f = find_field(name)) return *f;
  throw std::invalid_argument(fmt::format("no field is called {}", name));
}

std::vector<std::string_view> output_field_names() {
  std::vector<std::string_view> names;
  for (const Field& f : table) names.push_back(f.name);
  return names;
}

std::string component_ending(const Field& f, int c) {
  if (f.components == 1) return "";
  if (f.components == 3) return fmt::format("_{}", "xyz"[c]);
  return fmt::format("_{}{}", c / 3 + 1, c % 3 + 1);
}

std::vector<float> field(const Simulation& s, const Field& f) {
  std::vector<float> values(static_cast<std::size_t>(s.domain.order.nodes * f.components));
#pragma omp parallel for schedule(static) num_threads(s.team.threads)
  for (int n = 0; n < s.domain.order.nodes; ++n) {
    double v[9];
    f.at(s, n, v);
    for (int k = 0; k < f.components; ++k)
      values[static_cast<std::size_t>(n * f.components + k)] = static_cast<float>(v[k]);
  }
  return values;
}

ProbePlace place_probe(const Mesh& mesh, const Vec3& at) {
  ProbePlace best;
  double best_least = -1e-9;  // barycentric slack for points on a face
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& n = mesh.tets[t];
    Vec3 p[4];
    for (int k = 0; k < 4; ++k) p[k] = mesh.X[static_cast<std::size_t>(n[k])];
    const double V = tet_volume(p[0], p[1], p[2], p[3]);
    const std::array<double, 4> w{tet_volume(at, p[1], p[2], p[3]) / V, tet_volume(p[0], at, p[2], p[3]) / V,
                                  tet_volume(p[0], p[1], at, p[3]) / V, tet_volume(p[0], p[1], p[2], at) / V};
    const double least = std::min(std::min(w[0], w[1]), std::min(w[2], w[3]));
    if (least > best_least) {
      best = {static_cast<int>(t), n, w, at};
      best_least = least;
    }
  }
  if (best.tet >= 0) return best;
  double nearest = std::numeric_limits<double>::max();
  for (std::size_t n = 0; n < mesh.X.size(); ++n) {
    const double d = std::hypot(mesh.X[n][0] - at[0], mesh.X[n][1] - at[1], mesh.X[n][2] - at[2]);
    const int node = static_cast<int>(n);
    if (d < nearest) {
      nearest = d;
      best = {-1, {node, node, node, node}, {1, 0, 0, 0}, mesh.X[n]};
    }
  }
  return best;
}

void probe(const Simulation& s, const ProbePlace& place, const Field& f, double* out) {
  for (int c = 0; c < f.components; ++c) out[c] = 0;
  for (int k = 0; k < 4; ++k) {
    double v[9];
    f.at(s, place.nodes[static_cast<std::size_t>(k)], v);
    for (int c = 0; c < f.components; ++c) out[c] += place.weight[static_cast<std::size_t>(k)] * v[c];
  }
}

std::map<std::string, double> exact_errors(const Simulation& s) {
  std::map<std::string, double> errors;
  if (!has_exact_solution(*s.domain.scene)) return errors;
  const MaterialConstants& m = s.domain.coefficients.material;
  const auto P11 = [&](const PointState& p) { return exact_stress(s.domain.scene->material, m, p)[0][0]; };
  const Extent box = extent_of(*s.domain.mesh);
  CompensatedSum e1[2], e2[2], x1[3], x2[3];  // p1, P11; sizes of p1, P11 at t and P11 at t = 0
  for (int n = 0; n < s.domain.order.nodes; ++n) {
    const Vec3& X = s.domain.mesh->X[static_cast<std::size_t>(n)];
    const double V = s.domain.volume[static_cast<std::size_t>(n)];
    const PointState now = exact_solution(*s.domain.scene, box, X, s.state.t),
                     start = exact_solution(*s.domain.scene, box, X, 0);
    const double exact[3] = {m.rho * now.v[0], P11(now), P11(start)},
                 ours[2] = {m.rho * U_row(s, n)[0], P_at(s, n, 0, 0)};
    for (int k = 0; k < 3; ++k) {
      x1[k] += V * std::abs(exact[k]);
      x2[k] += V * exact[k] * exact[k];
    }
    for (int k = 0; k < 2; ++k) {
      e1[k] += V * std::abs(ours[k] - exact[k]);
      e2[k] += V * (ours[k] - exact[k]) * (ours[k] - exact[k]);
    }
  }
  errors["p1_L1"] = e1[0] / x1[0];
  errors["p1_L2"] = std::sqrt(e2[0] / x2[0]);
  errors["P11_L1"] = e1[1] / x1[1];
  errors["P11_L2"] = std::sqrt(e2[1] / x2[1]);
  errors["P11_L1_t0"] = e1[1] / x1[2];
  errors["P11_L2_t0"] = std::sqrt(e2[1] / x2[2]);
  return errors;
}

}  // namespace nanson
