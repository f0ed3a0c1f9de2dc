// Columns of 4 and lanes of 8 doubles on the GCC/clang vector extension, with one explicit fma so that every compiler rounds alike.
#pragma once
#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>
#if defined(__AVX__)
#include <immintrin.h>
#endif

#include "kernels/pair.hpp"

#define NANSON_INLINE [[gnu::always_inline]] inline

namespace nanson {

#if defined(__AVX512F__)
typedef double Vec8 __attribute__((vector_size(64)));
typedef long long Mask8 __attribute__((vector_size(64)));
typedef unsigned long long Bits8 __attribute__((vector_size(64)));
#else
using Vec8 = Pair<Vec4, double>;
using Mask8 = Pair<Mask4, long long>;
using Bits8 = Pair<Bits4, unsigned long long>;
#endif

NANSON_INLINE Vec4 broadcast4(double x) { return Vec4{x, x, x, x}; }
NANSON_INLINE Vec8 broadcast8(double x) { return Vec8{x, x, x, x, x, x, x, x}; }

#if defined(__AVX512F__)
NANSON_INLINE Vec4 low(Vec8 v) { return __builtin_shufflevector(v, v, 0, 1, 2, 3); }
NANSON_INLINE Vec4 high(Vec8 v) { return __builtin_shufflevector(v, v, 4, 5, 6, 7); }
#else
NANSON_INLINE Vec4 low(Vec8 v) { return v.low; }
NANSON_INLINE Vec4 high(Vec8 v) { return v.high; }
#endif
NANSON_INLINE Vec8 concat(Vec4 a, Vec4 b) {
#if defined(__AVX512F__)
  return _mm512_maskz_insertf64x4(0xff, _mm512_castpd256_pd512(a), b,
                                  1);  // the shuffle below takes two moves more with GCC 12
#else
  return Vec8(a, b);
#endif
}

/// Per half of eight lanes, four lanes chosen from those of a's half (0 to 3) and of b's (4 to 7).
template <int i, int j, int k, int l>
NANSON_INLINE Vec8 shuffle_halves(Vec8 a, Vec8 b) {
#if defined(__AVX512F__)
  constexpr auto at = [](int m, int half) { return (m < 4 ? m : m + 4) + 4 * half; };
  return __builtin_shufflevector(a, b, at(i, 0), at(j, 0), at(k, 0), at(l, 0), at(i, 1), at(j, 1), at(k, 1), at(l, 1));
#else
  return Vec8(__builtin_shufflevector(a.low, b.low, i, j, k, l), __builtin_shufflevector(a.high, b.high, i, j, k, l));
#endif
}

/// Eight lanes chosen from four.
template <int... from>
NANSON_INLINE Vec8 lanes_of(Vec4 v) {
  static_assert(sizeof...(from) == 8);
#if defined(__AVX512F__)
  return __builtin_shufflevector(v, v, from...);
#else
  constexpr int at[] = {from...};
  return Vec8(__builtin_shufflevector(v, v, at[0], at[1], at[2], at[3]),
              __builtin_shufflevector(v, v, at[4], at[5], at[6], at[7]));
#endif
}

template <int i>
NANSON_INLINE Vec4 spread(Vec4 v) {  // lane i in all lanes
  return __builtin_shufflevector(v, v, i, i, i, i);
}

NANSON_INLINE Vec4 load4(const double* p) { return *reinterpret_cast<const Vec4*>(p); }  // p 32-byte aligned
NANSON_INLINE Vec8 load8(const double* p) { return *reinterpret_cast<const Vec8*>(p); }  // p 64-byte aligned
#if defined(__AVX512F__)
NANSON_INLINE Vec8 load8_anywhere(const double* p) {
  typedef double Loose8 __attribute__((vector_size(64), aligned(8)));
  return *reinterpret_cast<const Loose8*>(p);
}
NANSON_INLINE void store8_anywhere(double* p, Vec8 v) {
  typedef double Loose8 __attribute__((vector_size(64), aligned(8)));
  *reinterpret_cast<Loose8*>(p) = v;
}
#else
typedef double Loose4 __attribute__((vector_size(32), aligned(8)));
NANSON_INLINE Vec8 load8_anywhere(const double* p) {
  return Vec8(*reinterpret_cast<const Loose4*>(p), *reinterpret_cast<const Loose4*>(p + 4));
}
NANSON_INLINE void store8_anywhere(double* p, Vec8 v) {
  *reinterpret_cast<Loose4*>(p) = v.low;
  *reinterpret_cast<Loose4*>(p + 4) = v.high;
}
#endif
NANSON_INLINE void store4(double* p, Vec4 v) { *reinterpret_cast<Vec4*>(p) = v; }
NANSON_INLINE void store8(double* p, Vec8 v) { *reinterpret_cast<Vec8*>(p) = v; }

/// a b + c in one rounding where the target has it, in two everywhere else: never a mixture inside one build.
NANSON_INLINE double fma(double a, double b, double c) {
#if defined(__FMA__)
  return __builtin_fma(a, b, c);
#else
  return a * b + c;
#endif
}
NANSON_INLINE Vec4 fma(Vec4 a, Vec4 b, Vec4 c) {
#if defined(__FMA__)
  return _mm256_fmadd_pd(a, b, c);
#else
  return a * b + c;
#endif
}
NANSON_INLINE Vec8 fma(Vec8 a, Vec8 b, Vec8 c) {
#if defined(__AVX512F__)
  return _mm512_fmadd_pd(a, b, c);
#else
  return concat(fma(low(a), low(b), low(c)), fma(high(a), high(b), high(c)));
#endif
}
/// c - a b, rounded like fma(-a, b, c).
NANSON_INLINE double fnma(double a, double b, double c) { return fma(-a, b, c); }
NANSON_INLINE Vec4 fnma(Vec4 a, Vec4 b, Vec4 c) {
#if defined(__FMA__)
  return _mm256_fnmadd_pd(a, b, c);
#else
  return c - a * b;
#endif
}
NANSON_INLINE Vec8 fnma(Vec8 a, Vec8 b, Vec8 c) {
#if defined(__AVX512F__)
  return _mm512_fnmadd_pd(a, b, c);
#else
  return concat(fnma(low(a), low(b), low(c)), fnma(high(a), high(b), high(c)));
#endif
}

NANSON_INLINE double root(double x) { return __builtin_sqrt(x); }
NANSON_INLINE Vec4 root(Vec4 x) {
#if defined(__AVX__)
  return _mm256_sqrt_pd(x);
#else
  return Vec4{root(x[0]), root(x[1]), root(x[2]), root(x[3])};
#endif
}
NANSON_INLINE Vec8 root(Vec8 x) {
#if defined(__AVX512F__)
  return _mm512_maskz_sqrt_pd(0xff, x);  // the unmasked one trips -Wmaybe-uninitialized in GCC 12
#else
  return concat(root(low(x)), root(high(x)));
#endif
}

/// Lanes where a < b, of eight numbers each.
NANSON_INLINE Mask8 less8(const std::int32_t* a, const std::int32_t* b) {
#if defined(__AVX512F__)
  typedef std::int32_t Int8 __attribute__((vector_size(32), aligned(4)));
  return __builtin_convertvector(*reinterpret_cast<const Int8*>(a) < *reinterpret_cast<const Int8*>(b), Mask8);
#else
  typedef std::int32_t Int4 __attribute__((vector_size(16), aligned(4)));
  const auto of = [](const std::int32_t* p) { return *reinterpret_cast<const Int4*>(p); };
  return Mask8(__builtin_convertvector(of(a) < of(b), Mask4), __builtin_convertvector(of(a + 4) < of(b + 4), Mask4));
#endif
}

/// The first lanes of eight.
NANSON_INLINE Mask8 first_lanes(std::ptrdiff_t count) {
  return Vec8{0, 1, 2, 3, 4, 5, 6, 7} < static_cast<double>(count);
}

/// Sum of the lanes, pair by pair.
NANSON_INLINE double sum(Vec8 x) {
  const Vec4 s = low(x) + high(x);
  return (s[0] + s[1]) + (s[2] + s[3]);
}

/// a where the condition holds, else b. A comparison with NaN does not hold.
NANSON_INLINE double choose(bool condition, double a, double b) { return condition ? a : b; }
NANSON_INLINE Vec4 choose(Mask4 condition, Vec4 a, Vec4 b) { return condition ? a : b; }
#if defined(__AVX512F__)
NANSON_INLINE Vec8 choose(Mask8 condition, Vec8 a, Vec8 b) { return condition ? a : b; }
#else
NANSON_INLINE Vec8 choose(Mask8 condition, Vec8 a, Vec8 b) {
  return Vec8(choose(condition.low, a.low, b.low), choose(condition.high, a.high, b.high));
}
#endif

template <class Real>
NANSON_INLINE Real larger(Real a, Real b) {
  return choose(a > b, a, b);
}

template <class Real>
NANSON_INLINE Real smaller(Real a, Real b) {
  return choose(a < b, a, b);
}

/// What a comparison of numbers gives.
template <class Real>
using Comparison = std::conditional_t<std::is_same_v<Real, Vec8>, Mask8, bool>;

/// A number of the type, without an operation.
template <class Real>
NANSON_INLINE Real constant(double x) {
  if constexpr (std::is_same_v<Real, Vec8>) return broadcast8(x);
  else return Real(x);
}

/// c[0] + c[1] x + c[2] x^2 + ...
template <class Real, std::size_t count>
NANSON_INLINE Real polynomial(Real x, const double (&c)[count]) {
  Real sum = constant<Real>(c[count - 1]);
  for (std::size_t i = count - 1; i-- > 0;) sum = fma(sum, x, constant<Real>(c[i]));
  return sum;
}

inline constexpr std::int32_t inverse_cbrt_word = 0x553ef0c0;  // the best one

/// First guess of x^(-1/3) for normal x > 0, within 3.5 %: minus a third of the exponent, by the high word.
NANSON_INLINE double inverse_cbrt_guess(double x) {
  const auto high_word = static_cast<std::int32_t>(std::bit_cast<std::uint64_t>(x) >> 32);
  const auto third = static_cast<std::int32_t>(static_cast<double>(high_word) * (1.0 / 3.0));
  return std::bit_cast<double>(static_cast<std::uint64_t>(static_cast<std::uint32_t>(inverse_cbrt_word - third)) << 32);
}
#if defined(__AVX512F__)
NANSON_INLINE Vec8 inverse_cbrt_guess(Vec8 x) {
  typedef std::int32_t Int8 __attribute__((vector_size(32)));
  const Mask8 bits = std::bit_cast<Mask8>(x);
  const Int8 high_word = __builtin_convertvector(bits >> 32, Int8);
  const Int8 third = __builtin_convertvector(__builtin_convertvector(high_word, Vec8) * (1.0 / 3.0), Int8);
  return std::bit_cast<Vec8>(__builtin_convertvector(inverse_cbrt_word - third, Mask8) << 32);
}
#else
NANSON_INLINE Vec4 inverse_cbrt_guess(Vec4 x) {
  typedef std::int32_t Int4 __attribute__((vector_size(16)));
  const Mask4 bits = std::bit_cast<Mask4>(x);
  const Int4 high_word = __builtin_convertvector(bits >> 32, Int4);
  const Int4 third = __builtin_convertvector(__builtin_convertvector(high_word, Vec4) * (1.0 / 3.0), Int4);
  return std::bit_cast<Vec4>(__builtin_convertvector(inverse_cbrt_word - third, Mask4) << 32);
}
NANSON_INLINE Vec8 inverse_cbrt_guess(Vec8 x) { return Vec8(inverse_cbrt_guess(x.low), inverse_cbrt_guess(x.high)); }
#endif

/// x^(-1/3) for x > 0, about 1 ulp, without a quotient; NaN where x is not > 0, which callers report as a breakdown. Two steps with e = 1 - x y^3 of
/// y (1 - e)^(-1/3) = y (1 + e/3 + 2 e^2/9 + 14 e^3/81 + ...): the error goes as its fourth power.
template <class Real>
NANSON_INLINE Real inverse_cube_root(Real x) {
  Real y = inverse_cbrt_guess(x);
  for (int k = 0; k < 2; ++k) {
    const Real e = fnma(x * y, y * y, constant<Real>(1.0));
    y = fma(y * e, polynomial(e, {1.0 / 3, 2.0 / 9, 14.0 / 81}), y);
  }
  return choose(x > 0.0, y, x - x + __builtin_nan(""));
}

NANSON_INLINE std::uint64_t bits_of(double x) { return std::bit_cast<std::uint64_t>(x); }
NANSON_INLINE Bits8 bits_of(Vec8 x) { return std::bit_cast<Bits8>(x); }
NANSON_INLINE double real_of(std::uint64_t bits) { return std::bit_cast<double>(bits); }
NANSON_INLINE Vec8 real_of(Bits8 bits) { return std::bit_cast<Vec8>(bits); }

inline constexpr double ln2_high = 0x1.62e42feep-1,
                        ln2_low = 0x1.a39ef35793c76p-33;  // k ln2_high is exact for the exponents of a double

/// ln x = k ln 2 + ln m, m in [sqrt(1/2), sqrt(2)): with f = m - 1, s = f/(2 + f), ln m = f - (f^2/2 - s (f^2/2 + R)), R = 2/3 s^2 + 2/5 s^4 + ... About 1 ulp;
/// NaN where x is not a normal number above 0, which callers report as a breakdown.
template <class Real>
NANSON_INLINE Real logarithm(Real x) {
  constexpr std::uint64_t bias = 1024ull << 52, root_half = 0x3fe6a09e667f3bcd;
  const auto bits = bits_of(x);
  const auto k = (bits - root_half + bias) >> 52;  // + 1024
  const Real exponent = real_of(k | 0x4330000000000000ull) - (0x1p52 + 1024),
             f = real_of(bits + bias - (k << 52)) - 1.0;
  const Real s = f / (f + 2.0), half = 0.5 * (f * f), z = s * s;
  const Real R = z
                 * polynomial(z,
                              {2.0 / 3, 2.0 / 5, 2.0 / 7, 2.0 / 9, 2.0 / 11, 2.0 / 13, 2.0 / 15, 2.0 / 17, 2.0 / 19});
  const Real ln = exponent * ln2_high - ((half - (s * (half + R) + exponent * ln2_low)) - f);
  return choose(x >= 0x1p-1022, choose(x < __builtin_inf(), ln, x), x - x + __builtin_nan(""));
}

/// e^x = 2^k e^r, |r| <= ln 2/2, by the series of e^r. About 1 ulp for |x| < 708, beyond that 0 or infinite; NaN stays NaN.
template <class Real>
NANSON_INLINE Real exponential(Real x) {
  constexpr double round = 0x1.8p52;  // x + round holds the nearest whole number in its low bits
  const Real t = x * 0x1.71547652b82fep0 + round, k = t - round;
  const Real r = (x - k * ln2_high) - k * ln2_low;
  const Real P = polynomial(r, {1.0 / 2, 1.0 / 6, 1.0 / 24, 1.0 / 120, 1.0 / 720, 1.0 / 5040, 1.0 / 40320, 1.0 / 362880,
                                1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800});
  const Real e = real_of(bits_of(1.0 + (r + r * r * P)) + (bits_of(t) << 52));
  const Real beyond = choose(x > 0.0, Real{} + __builtin_inf(), choose(x < 0.0, Real{}, x));
  return choose(x < 708.0, choose(x > -708.0, e, beyond), beyond);
}

/// Eight rows of four doubles, `stride` doubles apart, as four lanes of eight.
NANSON_INLINE void load_transposed(const double* p, std::ptrdiff_t stride, Vec8& c0, Vec8& c1, Vec8& c2, Vec8& c3) {
  const Vec8 z0 = concat(load4(p), load4(p + 4 * stride)), z1 = concat(load4(p + stride), load4(p + 5 * stride));
  const Vec8 z2 = concat(load4(p + 2 * stride), load4(p + 6 * stride)),
             z3 = concat(load4(p + 3 * stride), load4(p + 7 * stride));
  const Vec8 t0 = shuffle_halves<0, 4, 2, 6>(z0, z1), t1 = shuffle_halves<1, 5, 3, 7>(z0, z1);
  const Vec8 t2 = shuffle_halves<0, 4, 2, 6>(z2, z3), t3 = shuffle_halves<1, 5, 3, 7>(z2, z3);
  c0 = shuffle_halves<0, 1, 4, 5>(t0, t2);
  c1 = shuffle_halves<0, 1, 4, 5>(t1, t3);
  c2 = shuffle_halves<2, 3, 6, 7>(t0, t2);
  c3 = shuffle_halves<2, 3, 6, 7>(t1, t3);
}

/// Eight rows {c0, c1, c2, c3} from lanes.
NANSON_INLINE void rows_of(Vec8 c0, Vec8 c1, Vec8 c2, Vec8 c3, Vec4 (&row)[8]) {
  const Vec8 t0 = shuffle_halves<0, 4, 2, 6>(c0, c1), t1 = shuffle_halves<1, 5, 3, 7>(c0, c1);
  const Vec8 t2 = shuffle_halves<0, 4, 2, 6>(c2, c3), t3 = shuffle_halves<1, 5, 3, 7>(c2, c3);
  const Vec8 z0 = shuffle_halves<0, 1, 4, 5>(t0, t2), z1 = shuffle_halves<0, 1, 4, 5>(t1, t3);
  const Vec8 z2 = shuffle_halves<2, 3, 6, 7>(t0, t2), z3 = shuffle_halves<2, 3, 6, 7>(t1, t3);
  row[0] = low(z0);
  row[1] = low(z1);
  row[2] = low(z2);
  row[3] = low(z3);
  row[4] = high(z0);
  row[5] = high(z1);
  row[6] = high(z2);
  row[7] = high(z3);
}

/// The inverse of load_transposed.
NANSON_INLINE void store_transposed(double* p, std::ptrdiff_t stride, Vec8 c0, Vec8 c1, Vec8 c2, Vec8 c3) {
  Vec4 row[8];
  rows_of(c0, c1, c2, c3, row);
  for (int i = 0; i < 8; ++i) store4(p + i * stride, row[i]);
}

/// Stores a cache line past the caches: it is not read first, and nothing else is thrown out for it. `finish_streams` before another thread reads.
NANSON_INLINE void stream8(double* p, Vec8 x) {
#if defined(__AVX512F__)
  _mm512_stream_pd(p, x);
#elif defined(__AVX__)
  _mm256_stream_pd(p, low(x));
  _mm256_stream_pd(p + 4, high(x));
#else
  store8(p, x);
#endif
}
NANSON_INLINE void finish_streams() {
#if defined(__AVX__)
  _mm_sfence();
#endif
}

NANSON_INLINE bool any(const Mask8 m) { return (m[0] | m[1] | m[2] | m[3] | m[4] | m[5] | m[6] | m[7]) != 0; }
NANSON_INLINE bool all(bool b) { return b; }
NANSON_INLINE bool all(const Mask8 m) { return (m[0] & m[1] & m[2] & m[3] & m[4] & m[5] & m[6] & m[7]) != 0; }
NANSON_INLINE double largest(const Vec8 v) {
  double m = v[0];
  for (int i = 1; i < 8; ++i) m = v[i] > m ? v[i] : m;
  return m;
}

/// Sum of the first three lanes in one order, in all lanes.
NANSON_INLINE Vec4 dot3(Vec4 a, Vec4 b) {
  const Vec4 p = a * b;
  return (spread<0>(p) + spread<1>(p)) + spread<2>(p);
}

}  // namespace nanson
