// Eight lanes where the processor's registers hold four: a pair of columns with the operators that the vector
// extension has, so that kernels are one text. As one vector of 64 bytes GCC would keep such lanes in memory.
#pragma once
#include <cstddef>
#include <type_traits>

namespace nanson {

typedef double Vec4 __attribute__((vector_size(32)));
typedef long long Mask4 __attribute__((vector_size(32)));
typedef unsigned long long Bits4 __attribute__((vector_size(32)));

/// Lanes 0 to 3 and 4 to 7; one number stands for eight equal ones.
template <class Column, class Number>
struct Pair {
  using Mask = Pair<Mask4, long long>;
  Column low, high;

  Pair() = default;
  [[gnu::always_inline]] Pair(Column l, Column h) : low(l), high(h) {}
  [[gnu::always_inline]] Pair(Number x) : low{x, x, x, x}, high{x, x, x, x} {}
  [[gnu::always_inline]] Pair(Number a, Number b, Number c, Number d, Number e, Number f, Number g, Number h)
      : low{a, b, c, d}, high{e, f, g, h} {}

  [[gnu::always_inline]] Number operator[](std::ptrdiff_t i) const { return i < 4 ? low[i] : high[i - 4]; }
  [[gnu::always_inline]] Number& operator[](std::ptrdiff_t i) { return reinterpret_cast<Number*>(this)[i]; }

  [[gnu::always_inline]] friend Pair operator+(Pair a, Pair b) { return {a.low + b.low, a.high + b.high}; }
  [[gnu::always_inline]] friend Pair operator-(Pair a, Pair b) { return {a.low - b.low, a.high - b.high}; }
  [[gnu::always_inline]] friend Pair operator*(Pair a, Pair b) { return {a.low * b.low, a.high * b.high}; }
  [[gnu::always_inline]] friend Pair operator/(Pair a, Pair b) { return {a.low / b.low, a.high / b.high}; }
  [[gnu::always_inline]] friend Pair operator&(Pair a, Pair b) { return {a.low & b.low, a.high & b.high}; }
  [[gnu::always_inline]] friend Pair operator|(Pair a, Pair b) { return {a.low | b.low, a.high | b.high}; }
  [[gnu::always_inline]] friend Pair operator<<(Pair a, int bits) { return {a.low << bits, a.high << bits}; }
  [[gnu::always_inline]] friend Pair operator>>(Pair a, int bits) { return {a.low >> bits, a.high >> bits}; }
  [[gnu::always_inline]] friend Pair operator-(Pair a) { return {-a.low, -a.high}; }
  [[gnu::always_inline]] friend Pair operator~(Pair a) { return {~a.low, ~a.high}; }

  [[gnu::always_inline]] friend Mask operator<(Pair a, Pair b) {
    return {(Mask4)(a.low < b.low), (Mask4)(a.high < b.high)};
  }
  [[gnu::always_inline]] friend Mask operator>(Pair a, Pair b) { return b < a; }
  [[gnu::always_inline]] friend Mask operator<=(Pair a, Pair b) {
    return {(Mask4)(a.low <= b.low), (Mask4)(a.high <= b.high)};
  }
  [[gnu::always_inline]] friend Mask operator>=(Pair a, Pair b) { return b <= a; }
  [[gnu::always_inline]] friend Mask operator==(Pair a, Pair b) {
    return {(Mask4)(a.low == b.low), (Mask4)(a.high == b.high)};
  }
};

}  // namespace nanson
