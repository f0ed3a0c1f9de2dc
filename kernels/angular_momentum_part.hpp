// Sums over a part's nodes for the angular momentum projection, and the correction that it adds (method, section 7).
#pragma once
#include "kernels/part.hpp"

namespace nanson {

/// About the point o: sum Omega, sum Omega r (3), sum Omega r (x) r (6: 11 22 33 12 13 23), sum r x f (3); r = y - o, f [N] all forces of the stage.
inline constexpr int moment_count = 13;

/// Rows with a step length beyond this are padding [m].
inline constexpr double padding_length = 1e299;

/// `nodes` leaves out the padding at the part's end, an infinite step length (that of several materials) the padding between. y stands in the rows U `arms`, f in scratch.force (after the supports). Eight nodes at a time.
inline void moments_part(const Part& part, int nodes, const double* X, const double* step_length, const double* arms,
                         const double (&o)[3], const Scratch& scratch, double* sums) {
  const Vec8 zero{};
  Vec8 sum_of[moment_count] = {};
  const auto add = [&](int i, Vec8 term) { sum_of[i] = sum_of[i] + term; };
  for (int at = 0; at < nodes; at += 8) {
    const std::ptrdiff_t n = part.node_begin + at;
    const Mask8 real = first_lanes(nodes - at) & (load8(step_length + n) < padding_length);
    Vec8 r[3], f[3], inverse_volume, a, b, c;
    load_transposed(X + row::X * n, row::X, a, b, c, inverse_volume);
    load_transposed(scratch.force + 4 * at, 4, f[0], f[1], f[2], a);
    for (int k = 0; k < 3; ++k) load_transposed(arms + row::U * n + 4 * (k + 1), row::U, a, b, c, r[k]);
    const Vec8 volume = choose(real, 1.0 / inverse_volume, zero);
    for (int k = 0; k < 3; ++k) {
      r[k] = r[k] - o[k];
      f[k] = choose(real, f[k], zero);
    }
    add(0, volume);
    for (int k = 0; k < 3; ++k) {
      add(1 + k, volume * r[k]);
      add(4 + k, volume * (r[k] * r[k]));
      add(10 + k, r[(k + 1) % 3] * f[(k + 2) % 3] - r[(k + 2) % 3] * f[(k + 1) % 3]);
    }
    add(7, volume * (r[0] * r[1]));
    add(8, volume * (r[0] * r[2]));
    add(9, volume * (r[1] * r[2]));
  }
  for (int i = 0; i < moment_count; ++i) sums[i] = sum(sum_of[i]);
}

/// f += Omega lambda x (y - c) on the stage's new rows: dt lambda x (y - c)/rho0 is added to v, but for the held directions, whose supports react.
/// Returns the power of the correction at the stage's velocity [W].
inline double correct_part(const Part& part, int nodes, const Rows& rows, const Coefficients& k,
                           const double* step_length, const double* arms, const double (&lambda)[3],
                           const double (&c)[3], const Constraint* constraints, double* reactions) {
  double power = 0;
  std::int32_t held = part.constraint_begin;
  for (int n = part.node_begin; n < part.node_begin + nodes; ++n) {
    if (!(step_length[n] < padding_length)) continue;
    const double volume = 1 / rows.X[row::X * n + 3], per_mass = k.dt / (rows.rho ? rows.rho[n] : k.material.rho),
                 *y = arms + row::U * n, *v = rows.W + row::W * n;
    const double r[3] = {y[7] - c[0], y[11] - c[1], y[15] - c[2]};
    double f[3];  // [N/m^3]
    for (int i = 0; i < 3; ++i) f[i] = lambda[(i + 1) % 3] * r[(i + 2) % 3] - lambda[(i + 2) % 3] * r[(i + 1) % 3];
    power += volume * (f[0] * v[0] + f[1] * v[1] + f[2] * v[2]);
    if (held < part.constraint_end && constraints[held].node == n) {
      const Constraint& h = constraints[held];
      double* booked = reactions + reaction_row * held++;
      for (int m = 0; m < h.count; ++m) {
        const double* d = h.d[m];
        const double along = f[0] * d[0] + f[1] * d[1] + f[2] * d[2];
        for (int i = 0; i < 3; ++i) f[i] -= along * d[i];
        booked[m] -= volume * along;
        booked[3] -= volume * along * (v[0] * d[0] + v[1] * d[1] + v[2] * d[2]);
      }
    }
    double *U = rows.U_new + row::U * n, *W = rows.W_new + row::W * n;
    for (int i = 0; i < 3; ++i) {
      U[i] += per_mass * f[i];
      W[i] = U[i];
    }
  }
  return power;
}

}  // namespace nanson
