// Logarithm and exponential of a symmetric tensor: near a multiple of the identity by series of products, elsewhere by the spectrum. No branch between eight nodes
// as lanes but for whether any is far.
#pragma once
#include "kernels/symmetric_eigen.hpp"

namespace nanson {

/// A B of two tensors that commute: symmetric too.
template <class Real>
NANSON_INLINE Symmetric<Real> commuting_product(const Symmetric<Real>& A, const Symmetric<Real>& B) {
  Symmetric<Real> C;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) C(i, j) = fma(A(i, 0), B(0, j), fma(A(i, 1), B(1, j), A(i, 2) * B(2, j)));
  return C;
}

/// A : A.
template <class Real>
NANSON_INLINE Real square_norm(const Symmetric<Real>& A) {
  const auto sum = [](const Real* a) { return fma(a[2], a[2], fma(a[1], a[1], a[0] * a[0])); };
  return sum(A.a) + 2.0 * sum(A.a + 3);
}

template <class Real>
NANSON_INLINE Symmetric<Real> cofactor(const Symmetric<Real>& A) {
  const auto minor = [&](int i, int j, int k, int l) { return A(i, k) * A(j, l) - A(i, l) * A(j, k); };
  return {{minor(1, 2, 1, 2), minor(0, 2, 0, 2), minor(0, 1, 0, 1), minor(1, 2, 2, 0), minor(2, 0, 0, 1),
           minor(0, 1, 1, 2)}};
}

/// Determinant from a tensor and its cofactor.
template <class Real>
NANSON_INLINE Real determinant(const Symmetric<Real>& A, const Symmetric<Real>& cof) {
  return fma(A(0, 0), cof(0, 0), fma(A(0, 1), cof(0, 1), A(0, 2) * cof(0, 2)));
}

template <class Real>
NANSON_INLINE Symmetric<Real> inverse(const Symmetric<Real>& A) {
  Symmetric<Real> C = cofactor(A);
  const Real inverse_det = 1.0 / determinant(A, C);
  for (Real& c : C.a) c = c * inverse_det;
  return C;
}

/// c[0] I + c[1] A + c[2] A^2 + ...
template <class Real, std::size_t count>
NANSON_INLINE Symmetric<Real> polynomial(const Symmetric<Real>& A, const double (&c)[count]) {
  Symmetric<Real> sum{};
  for (int k = 0; k < 3; ++k) sum.a[k] = constant<Real>(c[count - 1]);
  for (std::size_t i = count - 1; i-- > 0;) {
    sum = commuting_product(sum, A);
    for (int k = 0; k < 3; ++k) sum.a[k] = sum.a[k] + c[i];
  }
  return sum;
}

/// Without a third of its trace.
template <class Real>
NANSON_INLINE Symmetric<Real> deviator(Symmetric<Real> A) {
  const Real mean = (A.a[0] + A.a[1] + A.a[2]) * (1.0 / 3.0);
  for (int k = 0; k < 3; ++k) A.a[k] = A.a[k] - mean;
  return A;
}

/// f(A) of the eigenvalues. Not inline: rare, and long.
template <class Real, class F>
[[gnu::noinline]] Symmetric<Real> by_spectrum(const Symmetric<Real>& A, F f) {
  Spectrum<Real> S = symmetric_eigen(A);
  for (Real& value : S.value) value = f(value);
  return composed(S.value, S.axis);
}

template <class Real>
NANSON_INLINE Symmetric<Real> choose(Comparison<Real> condition, const Symmetric<Real>& A, const Symmetric<Real>& B) {
  Symmetric<Real> C;
  for (int k = 0; k < 6; ++k) C.a[k] = choose(condition, A.a[k], B.a[k]);
  return C;
}

/// Deviator of ln A, of the same bits whatever the other lanes hold; NaN where A is not positive definite. With A = m (I + X), m = tr A/3, and Y = X (2 I + X)^-1:
/// ln A - ln m I = 2 (Y + Y^3/3 + ... + Y^17/17), the rest at round-off for |Y| <= 0.15, stretches within 15 % of each other.
template <class Real>
NANSON_INLINE Symmetric<Real> deviatoric_logarithm(const Symmetric<Real>& A) {
  const Real m = (A.a[0] + A.a[1] + A.a[2]) * (1.0 / 3.0), inverse_m = 1.0 / m;
  Symmetric<Real> X, M;
  for (int k = 0; k < 6; ++k) {
    X.a[k] = (k < 3 ? A.a[k] - m : A.a[k]) * inverse_m;
    M.a[k] = k < 3 ? X.a[k] + 2.0 : X.a[k];
  }
  const Symmetric<Real> Y = commuting_product(X, inverse(M));
  Symmetric<Real> ln = commuting_product(
      Y, polynomial(commuting_product(Y, Y),
                    {2.0, 2.0 / 3, 2.0 / 5, 2.0 / 7, 2.0 / 9, 2.0 / 11, 2.0 / 13, 2.0 / 15, 2.0 / 17}));
  const Comparison<Real> near = (square_norm(Y) <= 0.15 * 0.15) & (m > 0.0);
  if (!all(near)) ln = choose(near, ln, by_spectrum(A, [](Real x) { return logarithm(x); }));
  return deviator(ln);
}

/// e^A, of the same bits whatever the other lanes hold: I + A + A^2/2 + ... + A^11/11!, the rest at round-off for |A| <= 0.25.
template <class Real>
NANSON_INLINE Symmetric<Real> exponential(const Symmetric<Real>& A) {
  const Symmetric<Real> e = polynomial(A, {1.0, 1.0, 1.0 / 2, 1.0 / 6, 1.0 / 24, 1.0 / 120, 1.0 / 720, 1.0 / 5040,
                                           1.0 / 40320, 1.0 / 362880, 1.0 / 3628800, 1.0 / 39916800});
  const Comparison<Real> near = square_norm(A) <= 0.25 * 0.25;
  if (all(near)) return e;
  return choose(near, e, by_spectrum(A, [](Real x) { return exponential(x); }));
}

}  // namespace nanson
