// 3x3 tensors over a number type (double, or 8 nodes as lanes), with the operations of the tensor cross product (paper, section 2.1.1).
#pragma once
#include "kernels/column.hpp"

namespace nanson {

template <class Real>
struct Tensor {
  Real a[3][3];  // a[i][I]: spatial row, material column
  NANSON_INLINE Real* operator[](int i) { return a[i]; }
  NANSON_INLINE const Real* operator[](int i) const { return a[i]; }
};

/// Cofactor, 1/2 F x F.
template <class Real>
NANSON_INLINE Tensor<Real> cofactor(const Tensor<Real>& F) {
  Tensor<Real> H;
  for (int i = 0; i < 3; ++i)
    for (int I = 0; I < 3; ++I) {
      const int j = (i + 1) % 3, k = (i + 2) % 3, J = (I + 1) % 3, K = (I + 2) % 3;
      H[i][I] = F[j][J] * F[k][K] - F[j][K] * F[k][J];
    }
  return H;
}

/// Determinant from a tensor and its cofactor.
template <class Real>
NANSON_INLINE Real determinant(const Tensor<Real>& F, const Tensor<Real>& cof) {
  return F[0][0] * cof[0][0] + F[0][1] * cof[0][1] + F[0][2] * cof[0][2];
}

/// A : B.
template <class Real>
NANSON_INLINE Real contract(const Tensor<Real>& A, const Tensor<Real>& B) {
  Real s = A[0][0] * B[0][0];
  for (int m = 1; m < 9; ++m) s = fma(A.a[m / 3][m % 3], B.a[m / 3][m % 3], s);
  return s;
}

/// Tensor cross product, [A x B]_iI = e_ijk e_IJK A_jJ B_kK.
template <class Real>
NANSON_INLINE Tensor<Real> cross(const Tensor<Real>& A, const Tensor<Real>& B) {
  Tensor<Real> R;
  for (int i = 0; i < 3; ++i)
    for (int I = 0; I < 3; ++I) {
      const int j = (i + 1) % 3, k = (i + 2) % 3, J = (I + 1) % 3, K = (I + 2) % 3;
      R[i][I] = (A[j][J] * B[k][K] - A[j][K] * B[k][J]) + (A[k][K] * B[j][J] - A[k][J] * B[j][K]);
    }
  return R;
}

template <class Real>
NANSON_INLINE Tensor<Real> identity() {
  const Real one = Real{} + 1.0, zero = Real{};
  return {{{one, zero, zero}, {zero, one, zero}, {zero, zero, one}}};
}

}  // namespace nanson
