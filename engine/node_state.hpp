// A node's row of U, read and written by name.
#pragma once
#include "engine/vec3.hpp"
#include "kernels/part.hpp"

namespace nanson {

template <class Real>
struct NodeRow {
  Real* U;
  Real& v(int i) const { return U[i]; }                       // [m/s]
  Real& J() const { return U[3]; }                            // [-]; pFp: the pressure [Pa]
  Real& F(int i, int I) const { return U[4 * (I + 1) + i]; }  // [-]
  Real& x(int i) const { return U[4 * (i + 1) + 3]; }         // [m]

  Vec3 velocity() const { return {v(0), v(1), v(2)}; }
  Vec3 position() const { return {x(0), x(1), x(2)}; }
  Tensor<double> gradient() const {  // F
    Tensor<double> T;
    for (int m = 0; m < 9; ++m) T[m % 3][m / 3] = F(m % 3, m / 3);
    return T;
  }
  double detF() const {
    const Tensor<double> T = gradient();
    return determinant(T, cofactor(T));
  }
};
using NodeState = NodeRow<const double>;

/// Row n of the rows U.
inline NodeState state_of_row(const double* U, std::ptrdiff_t n) { return {U + row::U * n}; }
inline NodeRow<double> state_of_row(double* U, std::ptrdiff_t n) { return {U + row::U * n}; }

}  // namespace nanson
