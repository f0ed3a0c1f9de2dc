// The incompressible scheme {p, F, p} (paper, eq. 53-62; method, section 10): what a stage's projection reads and writes, its edge rows, and the constraint.
// Operators are integrated over the dual cell: D_H(v)_a = Omega_a H_a : grad v_a [m^3/s], and its adjoint f_H(q) [N]: sum q D_H(v) = -sum v . f_H(q).
#pragma once
#include "kernels/gradient_part.hpp"

namespace nanson {

namespace row {
inline constexpr std::ptrdiff_t E =
    8;  // an edge: {H_a C/2, -w | H_b C/2, w}, H of the stage's start, w [m^4 s/kg] of the stabilisation
inline constexpr std::ptrdiff_t B = 12;  // a corner: {H_a C/8, 0 | H_b C/8, 0 | H_c C/8, 0}
inline constexpr std::ptrdiff_t V = 4;   // {velocity that a pressure gives [m/s], its stabilisation S(d) [m^3/s]}
}  // namespace row

/// Rows of the pressure's projection; those of the stage's start are only read.
struct ProjectionRows {
  const double *X, *W, *PH, *G;  // as in Rows
  const double* length;          // [m] of the step rule
  const Constraint* constraints;
  const std::int32_t* held;  // per node: its constraint, -1 without
  double *E, *B;             // per edge, per corner
  double* U;                 // {v, pressure | F, x} that is projected
  double* H;                 // cof F of U, rows of row::H
  double *volume, *taken;    // [-] Q, volume that the stabilisation has taken; [m^3/s] its rate, of the stage's start
  double *new_volume, *new_taken;     // of U
  double* fixed;                      // [m^3/s] what the residual keeps through a stage
  double* lag;                        // [m^3/s] L_old
  double* inverse_diagonal;           // of K, 0 without one
  double* weight_sum;                 // sum of w over the node's edges
  double* R;                          // [m^3/s] residual
  double* d;                          // [Pa] search direction, or the pressure increment of the pseudo-time solver
  double* V;                          // rows of row::V
  double* Kd;                         // K d [m^3/s]
  double* removed;                    // [N] 3 a constraint: force of d along the held directions
  const double *rho, *inverse_kappa;  // [kg/m^3], [1/Pa] of nodes; several materials only
};

struct ProjectionCoefficients {
  double rho = 0, inverse_kappa = 0;  // [kg/m^3], [1/Pa]
  double beta = 0;                    // [-] stabilisation
  double beta_over_rho_cs = 0;        // [m^2 s/kg]
  double theta = 0, dt = 0;           // [-] drift control, [s]
  double still = 0;                   // [m/s] speeds below this times 1e-9 are rest
};

NANSON_INLINE double density(const ProjectionRows& rows, const ProjectionCoefficients& k, int n) {
  return rows.rho ? rows.rho[n] : k.rho;
}
NANSON_INLINE double compliance(const ProjectionRows& rows, const ProjectionCoefficients& k, int n) {
  return rows.inverse_kappa ? rows.inverse_kappa[n] : k.inverse_kappa;
}

/// Sums that a part gives to a reduction.
struct Three {
  double s[3] = {};
};

NANSON_INLINE Tensor<double> tensor_of(const double* columns, int stride) {
  Tensor<double> T;
  for (int m = 0; m < 9; ++m) T[m % 3][m / 3] = columns[stride * (m / 3) + m % 3];
  return T;
}

NANSON_INLINE Vec4 area(const double* PH, double C0, double C1, double C2) {
  const Vec4 c = fma(load4(PH + 20), broadcast4(C2),
                     fma(load4(PH + 12), broadcast4(C1), load4(PH + 4) * broadcast4(C0)));
  return Vec4{c[0], c[1], c[2], 0.0};  // u stands in lane 3
}

/// The edge and corner rows: w = beta |c|^2/(|C| rho c_s), c = H_ave C. Seen from either end w is bitwise the same.
inline void projection_edges_part(const Part& part, const EdgeArrays& edges, const CornerArrays& corners,
                                  const NodeLists& lists, const ProjectionRows& rows, const ProjectionCoefficients& k) {
  for (int a = part.node_begin; a < part.node_end; ++a) {
    const double* PHa = rows.PH + row::PH * a;
    prefetch_edges(a, edges, lists);
    for (std::int32_t e = lists.out[a]; e < lists.out[a + 1]; ++e) {
      prefetch_row<row::PH, ahead::wide_rows, 3>(Outward(), rows.PH, edges, e);
      const double C0 = 0.5 * edges.C[0][e], C1 = 0.5 * edges.C[1][e], C2 = 0.5 * edges.C[2][e];
      Vec4 ha = area(PHa, C0, C1, C2), hb = area(rows.PH + row::PH * edges.b[e], C0, C1, C2);
      const Vec4 c = ha + hb;
      const double per_impedance = edges.rho_cs ? k.beta / edges.rho_cs[e] : k.beta_over_rho_cs;
      const double w = per_impedance * dot3(c, c)[0] / edge_size(edges, e);
      ha[3] = -w;
      hb[3] = w;
      store8(rows.E + row::E * e, concat(ha, hb));
    }
    for (std::int32_t g = lists.corner[a]; g < lists.corner[a + 1]; ++g) {
      const double C0 = 0.125 * corners.C[0][g], C1 = 0.125 * corners.C[1][g], C2 = 0.125 * corners.C[2][g];
      double* B = rows.B + row::B * g;
      store4(B, area(PHa, C0, C1, C2));
      store4(B + 4, area(rows.PH + row::PH * corners.b[g], C0, C1, C2));
      store4(B + 8, area(rows.PH + row::PH * corners.c[g], C0, C1, C2));
    }
  }
}

/// |Pi h|^2 on the free directions of node n.
NANSON_INLINE double free_square(const ProjectionRows& rows, int n, const double* h) {
  double sum = h[0] * h[0] + h[1] * h[1] + h[2] * h[2];
  if (rows.held[n] < 0) return sum;
  const Constraint& c = rows.constraints[rows.held[n]];
  for (int m = 0; m < c.count; ++m) {
    const double along = h[0] * c.d[m][0] + h[1] * c.d[m][1] + h[2] * c.d[m][2];
    sum -= along * along;
  }
  return sum;
}

/// Before the iteration, with U at the end of the stage but for its velocity and pressure: H = cof F, Q += dt S/Omega; then what stays fixed in the residual,
/// L_old - theta-term: L_old_a = -sum_b w (g_a + g_b)/2 . D, g = grad p_old (lagged Rhie-Chow), theta Omega (det F + Q - 1 - p_old/kappa)/dt; and diag K.
inline void projection_start_part(const Part& part, const EdgeArrays& edges, const NodeLists& lists,
                                  const ProjectionRows& rows, const ProjectionCoefficients& k) {
  for (int n = part.node_begin; n < part.node_end; ++n) {
    const double inverse_volume = rows.X[row::X * n + 3], volume = 1.0 / inverse_volume,
                 old_pressure = rows.W[row::W * n + 3], inverse_kappa = compliance(rows, k, n);
    const Tensor<double> F = tensor_of(rows.U + row::U * n + 4, 4), H = cofactor(F);
    for (int m = 0; m < 9; ++m) rows.H[row::H * n + 4 * (m / 3) + m % 3] = H[m % 3][m / 3];
    rows.new_volume[n] = fma(k.dt * inverse_volume, rows.taken[n], rows.volume[n]);

    const Vec4 Xa = load4(rows.X + row::X * n);
    const double* Ga = rows.G + row::G * n;
    double lag = 0, diagonal = 0, weights = 0;
    const auto add = [&](int b, double w, const double* h) {
      const double* Gb = rows.G + row::G * b;
      const Vec4 D = load4(rows.X + row::X * b) - Xa;
      lag = fma(-0.5 * w, (Ga[3] + Gb[3]) * D[0] + (Ga[7] + Gb[7]) * D[1] + (Ga[11] + Gb[11]) * D[2], lag);
      diagonal = fma(k.dt / density(rows, k, b) * rows.X[row::X * b + 3], free_square(rows, b, h), diagonal);
      weights += w;
    };
    prefetch_lists(n, edges, lists);
    for (std::ptrdiff_t e = lists.out[n]; e < lists.out[n + 1]; ++e) {
      prefetch_row<row::X, ahead::rows>(Outward(), rows.X, edges, e);
      prefetch_row<row::G, ahead::rows, 2>(Outward(), rows.G, edges, e);
      const double* E = rows.E + row::E * e;
      __builtin_prefetch(E + row::E * ahead::blocks);
      add(edges.b[e], E[7], E);
    }
    for (std::int32_t i = lists.in[n]; i < lists.in[n + 1]; ++i) {
      const double* E = rows.E + row::E * lists.in_edges[i];
      add(lists.in_nodes[i], E[7], E + 4);
    }
    diagonal += weights + volume * inverse_kappa / k.dt;
    rows.lag[n] = lag;
    rows.weight_sum[n] = weights;
    rows.inverse_diagonal[n] = diagonal > 0 ? 1.0 / diagonal : 0.0;
    const double drift = determinant(F, H) + rows.new_volume[n] - 1.0 - old_pressure * inverse_kappa;
    rows.fixed[n] = fma(k.theta * volume / k.dt, drift, lag);
  }
}

/// Residual of the constraint, with the new H: R = D_H(v) + S(p) + L_old - Omega (p - p_old)/(kappa dt) + theta-term [m^3/s]; S(p)_a = sum_b w (p_b - p_a).
/// Returns the sums of R^2/Omega, of Omega (|grad v|^2 + what counts as rest), and of R.
inline Three constraint_residual_part(const Part& part, const EdgeArrays& edges, const CornerArrays& corners,
                                      const NodeLists& lists, const ProjectionRows& rows,
                                      const ProjectionCoefficients& k) {
  Three sum;
  for (int n = part.node_begin; n < part.node_end; ++n) {
    const Vec4 Ua = load4(rows.U + row::U * n);
    Vec4 g0{}, g1{}, g2{};
    double S = 0;
    const auto add = [&](Vec4 d, double C0, double C1, double C2) {
      g0 = fma(d, broadcast4(C0), g0);
      g1 = fma(d, broadcast4(C1), g1);
      g2 = fma(d, broadcast4(C2), g2);
    };
    prefetch_edges(n, edges, lists);
    for (std::ptrdiff_t e = lists.out[n]; e < lists.out[n + 1]; ++e) {
      prefetch_row<row::U, ahead::rows>(Outward(), rows.U, edges, e);
      __builtin_prefetch(rows.E + row::E * (e + ahead::blocks));
      const Vec4 d = load4(rows.U + row::U * edges.b[e]) - Ua;
      add(d, edges.C[0][e], edges.C[1][e], edges.C[2][e]);
      S = fma(rows.E[row::E * e + 7], d[3], S);
    }
    for (std::int32_t i = lists.in[n]; i < lists.in[n + 1]; ++i) {
      const std::int32_t e = lists.in_edges[i];
      const Vec4 d = load4(rows.U + row::U * lists.in_nodes[i]) - Ua;
      add(d, -edges.C[0][e], -edges.C[1][e], -edges.C[2][e]);
      S = fma(rows.E[row::E * e + 7], d[3], S);
    }
    for (std::int32_t g = lists.corner[n]; g < lists.corner[n + 1]; ++g) {
      const Vec4 d = ((load4(rows.U + row::U * corners.b[g]) - Ua) + (load4(rows.U + row::U * corners.c[g]) - Ua))
                     * 0.25;
      add(d, corners.C[0][g], corners.C[1][g], corners.C[2][g]);
    }
    const double* H = rows.H + row::H * n;
    const double D = 0.5
                     * (dot3(load4(H), g0) + dot3(load4(H + 4), g1) + dot3(load4(H + 8), g2))[0];  // 2 Omega grad v = g
    const double inverse_volume = rows.X[row::X * n + 3], volume = 1.0 / inverse_volume;
    const double R = (D + S)
                     + (rows.fixed[n] - volume * compliance(rows, k, n) / k.dt * (Ua[3] - rows.W[row::W * n + 3]));
    rows.R[n] = R;
    rows.new_taken[n] = S + rows.lag[n];
    const double rest = 1e-9 / rows.length[n], speed2 = dot3(Ua, Ua)[0] + k.still * k.still;
    sum.s[0] += R * R * inverse_volume;
    sum.s[2] += R;
    sum.s[1] += 0.25 * inverse_volume * (dot3(g0, g0) + dot3(g1, g1) + dot3(g2, g2))[0] + volume * rest * rest * speed2;
  }
  return sum;
}

/// R -= mean Omega: the part of the residual that a closed domain's pressure cannot reach. Returns the sum of R^2/Omega.
inline double subtract_mean_part(const Part& part, const ProjectionRows& rows, double mean) {
  double sum = 0;
  for (int n = part.node_begin; n < part.node_end; ++n) {
    const double inverse_volume = rows.X[row::X * n + 3];
    rows.R[n] -= mean / inverse_volume;
    sum += rows.R[n] * rows.R[n] * inverse_volume;
  }
  return sum;
}

}  // namespace nanson
