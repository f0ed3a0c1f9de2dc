// What a part's nodes and tets show at a glance, eight at a time: det F, J and their quotient, speed, and the volume of the tet that is nearest to turning inside out.
#pragma once
#include "kernels/part.hpp"
#include "kernels/tensor.hpp"
#include "kernels/tets.hpp"

namespace nanson {

/// What is not a number is passed over.
struct Range {
  double least = 1e300, most = -1e300;
};

struct NodeExtrema {
  Range detF, J, detF_over_J;  // [-]
  double speed2 = 0;           // [m^2/s^2]
};

NANSON_INLINE double smallest(Vec8 v) {
  double m = v[0];
  for (int i = 1; i < 8; ++i) m = smaller(v[i], m);
  return m;
}

/// Over the nodes of a part, padding (node_of < 0) left out. Without an evolved J it is det F.
template <bool evolves_J>
NodeExtrema node_extrema_part(const Part& part, const double* rows, const std::int32_t* node_of) {
  constexpr std::int32_t none[8] = {-1, -1, -1, -1, -1, -1, -1, -1};
  const Vec8 above = broadcast8(1e300), below = broadcast8(-1e300);
  Vec8 low_d = above, high_d = below, low_J = above, high_J = below, low_q = above, high_q = below, fastest{};
  for (std::ptrdiff_t n = part.node_begin; n < part.node_end; n += 8) {
    const double* U = rows + row::U * n;
    Vec8 v[3], J, x;
    Tensor<Vec8> F;
    load_transposed(U, row::U, v[0], v[1], v[2], J);
    for (int I = 0; I < 3; ++I) load_transposed(U + 4 * (I + 1), row::U, F[0][I], F[1][I], F[2][I], x);
    const Mask8 real = less8(none, node_of + n);
    const Vec8 d = determinant(F, cofactor(F)), speed2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    low_d = smaller(choose(real, d, above), low_d);
    high_d = larger(choose(real, d, below), high_d);
    fastest = larger(choose(real, speed2, Vec8{}), fastest);
    if constexpr (evolves_J) {
      const Vec8 q = d / J;
      low_J = smaller(choose(real, J, above), low_J);
      high_J = larger(choose(real, J, below), high_J);
      low_q = smaller(choose(real, q, above), low_q);
      high_q = larger(choose(real, q, below), high_q);
    }
  }
  NodeExtrema e;
  e.detF = {smallest(low_d), largest(high_d)};
  e.J = evolves_J ? Range{smallest(low_J), largest(high_J)} : e.detF;
  e.detF_over_J = evolves_J ? Range{smallest(low_q), largest(high_q)} : Range{1, 1};
  e.speed2 = largest(fastest);
  return e;
}

/// Least deformed over undeformed volume of the tets [begin, end), a multiple of eight.
inline double least_tet_ratio(const TetArrays& tets, std::ptrdiff_t begin, std::ptrdiff_t end, const double* U) {
  Vec8 low = broadcast8(1e300);
  for (std::ptrdiff_t t = begin; t < end; t += 8)
    low = smaller(volumes6(tets, t, U, row::U, 7, 4) / load8(tets.volume6 + t), low);
  return smallest(low);
}

}  // namespace nanson
