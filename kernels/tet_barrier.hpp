// The barrier of tets that are crushed beyond what their nodes are (method, section 17): energy, forces, nodal stress, and the step that it allows.
#pragma once
#include <cmath>

#include "kernels/part.hpp"
#include "kernels/tensor.hpp"
#include "kernels/tets.hpp"

namespace nanson {

/// A tet's share r = J_T / Jm, Jm the mean of its nodes' det F: below `crushed_share` a tet stores V_T m phi(r), m its modulus [Pa], phi = ln^2(r/crushed_share)/2; from
/// `watched_share` on nobody looks at it before the next look at all tets.
inline constexpr double crushed_share = 0.3, watched_share = 0.65;

/// The step is found for the shares of a stage: the next may be smaller.
inline constexpr double crushing_margin = 1.2;

/// phi and its derivatives; goes on straight below a thousandth of `crushed_share`.
struct Crushing {
  double phi, d, dd;
};
inline Crushing crushing(double share) {
  constexpr double least = 1e-3 * crushed_share;
  const double r = share > least ? share : least, ln = std::log(r / crushed_share), d = ln / r;
  return {0.5 * ln * ln + d * (share - r), d, (1 - ln) / (r * r)};
}

/// Eight tets picked from a list; the last one stands for those past its end.
struct EightTets {
  alignas(64) std::int32_t corner[4][8];
  alignas(64) double volume6[8];
  TetArrays arrays() const { return {{corner[0], corner[1], corner[2], corner[3]}, volume6}; }
};
inline EightTets pick(const TetArrays& tets, const std::int32_t* which, std::ptrdiff_t left) {
  EightTets out;
  for (int i = 0; i < 8; ++i) {
    const std::int32_t t = which[i < left ? i : left - 1];
    for (int k = 0; k < 4; ++k) out.corner[k][i] = tets.corner[k][t];
    out.volume6[i] = tets.volume6[t];
  }
  return out;
}

/// Jm of eight tets from t on, and their shares.
struct Shares {
  Vec8 mean_detF, share;
};
NANSON_INLINE Shares shares(const TetArrays& tets, std::ptrdiff_t t, const double* U, const double* detF) {
  const auto at = [&](int k) { return gather8(detF, 1, 0, tets.corner[k] + t); };
  const Vec8 mean = 0.25 * ((at(0) + at(1)) + (at(2) + at(3)));
  return {mean, volumes6(tets, t, U, row::U, 7, 4) / (load8(tets.volume6 + t) * mean)};
}

/// What a crushed tet does to its four nodes: f = -V m phi' dJ_T/dx / Jm [N], and the weight of cof F_a in the nodal stress, whose power is that of Jm, -(V/4) m phi' r/(Jm Omega_a).
struct CrushedTet {
  double force[4][3];
  double weight[4];  // [Pa], without 1/Omega_a: [Pa m^3]
  double rate2;      // [1/s^2] (c/l)^2 of the tet, c^2 = m phi'' |dJ_T/dF|^2/(rho0 Jm^2)
};
inline CrushedTet crushed_tet(const double (&x)[4][3], double volume6, double mean_detF, double share, double modulus,
                              double rho) {
  constexpr int face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};  // counter-clockwise seen from the corner
  const Crushing c = crushing(share);
  CrushedTet out;
  double most = 0;
  for (int i = 0; i < 3; ++i) out.force[3][i] = 0;
  for (int a = 0; a < 4; ++a) {
    const double *p = x[face[a][0]], *q = x[face[a][1]], *r = x[face[a][2]];
    double e[3], f[3], area2 = 0;
    for (int i = 0; i < 3; ++i) {
      e[i] = q[i] - p[i];
      f[i] = r[i] - p[i];
    }
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const double d = e[k] * f[j] - e[j] * f[k];  // [m^2] six times the derivative of the volume
      area2 += d * d;
      if (a == 3) continue;  // the four have no resultant, to the bit
      out.force[a][i] = -modulus * c.d / (6 * mean_detF) * d;
      out.force[3][i] -= out.force[a][i];
    }
    most = area2 > most ? area2 : most;
    out.weight[a] = -0.25 * (volume6 / 6) * modulus * c.d * share / mean_detF;
  }
  out.rate2 = modulus * c.dd / (mean_detF * mean_detF) * most / (volume6 * volume6) / rho;
  return out;
}

}  // namespace nanson
