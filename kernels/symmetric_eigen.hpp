// Eigenvalues and axes of a symmetric 3x3 tensor by a fixed number of Jacobi sweeps: no branch, so that eight nodes run as lanes.
#pragma once
#include "kernels/tensor.hpp"

namespace nanson {

/// Symmetric tensor, {11, 22, 33, 12, 23, 31}.
template <class Real>
struct Symmetric {
  Real a[6];
  NANSON_INLINE Real& operator()(int i, int j) { return a[at(i, j)]; }
  NANSON_INLINE const Real& operator()(int i, int j) const { return a[at(i, j)]; }
  static constexpr int at(int i, int j) { return i == j ? i : i + j == 1 ? 3 : i + j == 3 ? 4 : 5; }
};

/// A = sum value[k] axis[k] (x) axis[k].
template <class Real>
struct Spectrum {
  Real value[3];
  Real axis[3][3];
};

/// Turns the axes p, q so that a_pq becomes 0, with the smaller of the two angles: tan t = 2 a_pq sgn(d)/(|d| + sqrt(d^2 + 4 a_pq^2)), d = a_qq - a_pp.
template <class Real>
NANSON_INLINE void jacobi_rotation(Real& pp, Real& qq, Real& pq, Real& pr, Real& qr, Real (&p)[3], Real (&q)[3]) {
  const Real d = qq - pp, a = pq + pq;
  const Real t = choose(d < 0.0, -a, a)
                 / (choose(d < 0.0, -d, d) + root(d * d + a * a) + 1e-300);  // 0/0 of equal values becomes 0
  const Real c = 1.0 / root(t * t + 1.0), s = t * c;
  const auto turn = [&](Real& x, Real& y) {
    const Real x0 = x;
    x = c * x0 - s * y;
    y = c * y + s * x0;
  };
  pp = pp - t * pq;
  qq = qq + t * pq;
  pq = Real{};
  turn(pr, qr);
  for (int k = 0; k < 3; ++k) turn(p[k], q[k]);
}

/// Sum of value[k] axis[k] (x) axis[k].
template <class Real>
NANSON_INLINE Symmetric<Real> composed(const Real (&value)[3], const Real (&axis)[3][3]) {
  Symmetric<Real> A;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      Real sum = value[0] * axis[0][i] * axis[0][j];
      for (int k = 1; k < 3; ++k) sum = fma(value[k] * axis[k][i], axis[k][j], sum);
      A(i, j) = sum;
    }
  return A;
}

inline constexpr int jacobi_sweeps =
    4;  // convergence is quadratic: the off-diagonal rest is at round-off after the fourth (tested)

template <class Real>
NANSON_INLINE Spectrum<Real> symmetric_eigen(Symmetric<Real> A) {
  const Real one = Real{} + 1.0, zero = Real{};
  Spectrum<Real> S{{}, {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}}};
  for (int sweep = 0; sweep < jacobi_sweeps; ++sweep) {
    jacobi_rotation(A(0, 0), A(1, 1), A(0, 1), A(0, 2), A(1, 2), S.axis[0], S.axis[1]);
    jacobi_rotation(A(1, 1), A(2, 2), A(1, 2), A(0, 1), A(0, 2), S.axis[1], S.axis[2]);
    jacobi_rotation(A(0, 0), A(2, 2), A(0, 2), A(0, 1), A(1, 2), S.axis[0], S.axis[2]);
  }
  for (int k = 0; k < 3; ++k) S.value[k] = A(k, k);
  return S;
}

}  // namespace nanson
