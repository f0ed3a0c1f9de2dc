// Tets in lanes of eight: corners and volumes.
#pragma once
#include <cstddef>
#include <cstdint>

#include "kernels/column.hpp"

namespace nanson {

/// Corners of the tets as structure of arrays of rows, in an order that visits the rows nearly one after another.
struct TetArrays {
  const std::int32_t* corner[4];
  const double* volume6;  // [m^3] six times the undeformed volume
};

/// Entry `at` of the rows of eight corners.
NANSON_INLINE Vec8 gather8(const double* rows, std::ptrdiff_t width, int at, const std::int32_t* corner) {
  const double* p = rows + at;
  return Vec8{p[width * corner[0]], p[width * corner[1]], p[width * corner[2]], p[width * corner[3]],
              p[width * corner[4]], p[width * corner[5]], p[width * corner[6]], p[width * corner[7]]};
}

/// Six times the signed volumes of eight tets from t on; the place's component i is entry first + i step of a row. [m^3]
NANSON_INLINE Vec8 volumes6(const TetArrays& tets, std::ptrdiff_t t, const double* rows, std::ptrdiff_t width,
                            int first, int step) {
  Vec8 e[3][3];
  for (int i = 0; i < 3; ++i) {
    const Vec8 x = gather8(rows, width, first + i * step, tets.corner[0] + t);
    for (int k = 0; k < 3; ++k) e[k][i] = gather8(rows, width, first + i * step, tets.corner[k + 1] + t) - x;
  }
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) + e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2])
         + e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

}  // namespace nanson
