// One iteration on the pressure: K d = -D_H(V) - S(d) + Omega d/(kappa dt), V = dt/(rho Omega) Pi f_H(d), and the vector updates of its solvers (method, section 10).
#pragma once
#include "kernels/projection.hpp"

namespace nanson {

/// V = keep V + step/(rho Omega) Pi f_H(d), with S(d) in lane 3. After the closure of the dual cell f_H(d)_a = sum_b d_b H_b C/2 - sum_gamma (2 T_a + T_b + T_c)/8 C_gamma,
/// T = d H. What the supports remove is kept for their reactions.
inline void pressure_force_part(const Part& part, const EdgeArrays& edges, const CornerArrays& corners,
                                const NodeLists& lists, const ProjectionRows& rows, const ProjectionCoefficients& k,
                                double keep, double step) {
  for (int n = part.node_begin; n < part.node_end; ++n) {
    Vec4 f{}, in{};
    prefetch_lists(n, edges, lists);
    for (std::ptrdiff_t e = lists.out[n]; e < lists.out[n + 1]; ++e) {
      __builtin_prefetch(rows.E + row::E * (e + ahead::blocks));
      __builtin_prefetch(rows.d + edges.b[e + ahead::single_rows]);
      f = fma(load4(rows.E + row::E * e + 4), broadcast4(rows.d[edges.b[e]]), f);
    }
    for (std::int32_t i = lists.in[n]; i < lists.in[n + 1]; ++i) {
      const std::int32_t e = lists.in_edges[i];
      in = fma(load4(rows.E + row::E * e), broadcast4(rows.d[lists.in_nodes[i]]), in);
    }
    f = f - in;
    for (std::int32_t g = lists.corner[n]; g < lists.corner[n + 1]; ++g) {
      const double* B = rows.B + row::B * g;
      f = f
          - fma(load4(B), broadcast4(2.0 * rows.d[n]),
                fma(load4(B + 4), broadcast4(rows.d[corners.b[g]]), load4(B + 8) * broadcast4(rows.d[corners.c[g]])));
    }
    if (rows.held[n] >= 0) {
      const Constraint& c = rows.constraints[rows.held[n]];
      for (int m = 0; m < c.count; ++m) {
        const Vec4 along = Vec4{c.d[m][0], c.d[m][1], c.d[m][2], 0.0};
        const Vec4 size = dot3(along, f);
        f = f - size * along;
        double& removed = rows.removed[3 * rows.held[n] + m];
        removed = fma(keep, removed, step / k.dt * size[0]);
      }
    }
    double* V = rows.V + row::V * n;
    Vec4 v = fma(f, broadcast4(step / density(rows, k, n) * rows.X[row::X * n + 3]), load4(V) * broadcast4(keep));
    v[3] = fma(-rows.weight_sum[n], rows.d[n], f[3]);
    store4(V, v);
  }
}

/// K d from the rows V. Returns the sums of d K d and K d.
inline Three pressure_operator_part(const Part& part, const EdgeArrays& edges, const CornerArrays& corners,
                                    const NodeLists& lists, const ProjectionRows& rows,
                                    const ProjectionCoefficients& k) {
  Three sum;
  for (int n = part.node_begin; n < part.node_end; ++n) {
    Vec4 D{}, in{};
    prefetch_lists(n, edges, lists);
    for (std::ptrdiff_t e = lists.out[n]; e < lists.out[n + 1]; ++e) {
      __builtin_prefetch(rows.E + row::E * (e + ahead::blocks));
      __builtin_prefetch(rows.V + row::V * edges.b[e + ahead::single_rows]);
      D = fma(load4(rows.E + row::E * e), load4(rows.V + row::V * edges.b[e]), D);
    }
    for (std::int32_t i = lists.in[n]; i < lists.in[n + 1]; ++i) {
      const std::int32_t e = lists.in_edges[i];
      in = fma(load4(rows.E + row::E * e + 4), load4(rows.V + row::V * lists.in_nodes[i]), in);
    }
    D = D - in;
    const Vec4 Va = load4(rows.V + row::V * n);
    for (std::int32_t g = lists.corner[n]; g < lists.corner[n + 1]; ++g)
      D = fma(load4(rows.B + row::B * g),
              (Va + Va) + (load4(rows.V + row::V * corners.b[g]) + load4(rows.V + row::V * corners.c[g])), D);
    const double volume = 1.0 / rows.X[row::X * n + 3], d = rows.d[n];
    const double Kd = volume * compliance(rows, k, n) / k.dt * d - Va[3] - ((D[0] + D[1]) + D[2]);
    rows.Kd[n] = Kd;
    sum.s[0] += d * Kd;
    sum.s[1] += Kd;
  }
  return sum;
}

/// v += alpha V, p += alpha d, R -= alpha (K d - mean Omega); the supports take alpha times what they removed.
/// Returns the sums of R^2/Omega, R z and Omega z, z = R/diag.
inline Three pressure_step_part(const Part& part, const ProjectionRows& rows, double alpha, double mean,
                                double* reactions) {
  Three sum;
  for (int n = part.node_begin; n < part.node_end; ++n) {
    double* U = rows.U + row::U * n;
    const Vec4 V = load4(rows.V + row::V * n);
    store4(U, fma(Vec4{V[0], V[1], V[2], rows.d[n]}, broadcast4(alpha), load4(U)));
    const double inverse_volume = rows.X[row::X * n + 3], volume = 1.0 / inverse_volume;
    const double R = fma(-alpha, rows.Kd[n] - mean * volume, rows.R[n]), z = R * rows.inverse_diagonal[n];
    rows.R[n] = R;
    sum.s[0] += R * R * inverse_volume;
    sum.s[1] += R * z;
    sum.s[2] += volume * z;
  }
  for (std::int32_t i = part.constraint_begin; i < part.constraint_end; ++i) {
    const Constraint& h = rows.constraints[i];
    const double* v = rows.W + row::W * h.node;
    for (int m = 0; m < h.count; ++m) {
      const double reaction = -alpha * rows.removed[3 * i + m];
      reactions[reaction_row * i + m] += reaction;
      reactions[reaction_row * i + 3] += reaction * (v[0] * h.d[m][0] + v[1] * h.d[m][1] + v[2] * h.d[m][2]);
    }
  }
  return sum;
}

/// d = R/diag - mean + beta d.
inline void pressure_direction_part(const Part& part, const ProjectionRows& rows, double mean, double beta) {
  for (int n = part.node_begin; n < part.node_end; ++n)
    rows.d[n] = fma(rows.R[n], rows.inverse_diagonal[n], fma(beta, rows.d[n], -mean));
}

/// Pseudo-time step [s] of a part: min |D| |C|/max(|H_a C|, |H_b C|) over its edges, times `scale` [s/m] (paper's local rule, C_tau = 1).
inline double pseudo_step_part(const Part& part, const EdgeArrays& edges, const ProjectionRows& rows, double scale) {
  double least = 1e300;
  for (std::int32_t e = part.edge_begin; e < part.edge_end; ++e) {
    const double* E = rows.E + row::E * e;
    const Vec4 D = load4(rows.X + row::X * edges.b[e]) - load4(rows.X + row::X * edges.a[e]), ha = load4(E),
               hb = load4(E + 4);
    const double largest2 = 4 * larger(dot3(ha, ha)[0], dot3(hb, hb)[0]);
    least = smaller(root(dot3(D, D)[0]) * edge_size(edges, e) / root(largest2), least);
  }
  return scale * least;
}

/// d += gamma dtau r/Omega/(1 + gamma dtau (2 sum w/Omega + 1/(kappa dt))), r = R - (K d - mean Omega); `pace` = gamma dtau [kg/(m s)]. Returns the sum of Omega d.
inline double pseudo_pressure_part(const Part& part, const ProjectionRows& rows, const ProjectionCoefficients& k,
                                   double pace, double mean) {
  double sum = 0;
  for (int n = part.node_begin; n < part.node_end; ++n) {
    const double inverse_volume = rows.X[row::X * n + 3], r = (rows.R[n] - rows.Kd[n]) * inverse_volume + mean;
    rows.d[n] += pace * r / (1 + pace * (2 * rows.weight_sum[n] * inverse_volume + compliance(rows, k, n) / k.dt));
    sum += rows.d[n] / inverse_volume;
  }
  return sum;
}

/// Sum of r^2/Omega of the pseudo-time residual.
inline double pseudo_residual_part(const Part& part, const ProjectionRows& rows, double mean) {
  double sum = 0;
  for (int n = part.node_begin; n < part.node_end; ++n) {
    const double inverse_volume = rows.X[row::X * n + 3], r = rows.R[n] - rows.Kd[n] + mean / inverse_volume;
    sum += r * r * inverse_volume;
  }
  return sum;
}

}  // namespace nanson
