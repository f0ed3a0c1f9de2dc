// Area vectors of the current configuration, part by part: of the median dual of x (paper, eq. 48), or the undeformed ones mapped by H_x = cof(grad x) (eq. 49).
#pragma once
#include "kernels/gradient_part.hpp"

namespace nanson {

/// Current area vectors, in the numbering of edges and corners [m^2], and the rows that they are made from.
struct CurrentAreas {
  double* x;                 // row::x a node [m]
  double* map;               // row::H a node, columns of H_x [-] (pseudo_updated)
  const std::int32_t* ring;  // where an edge's tets begin, one more entry than edges (updated)
  const std::int32_t* cd;    // rows (c, d) of each tet at the edge ab, (a, b, c, d) an even permutation of its nodes
  double* c[3];              // from a to b
  double* corner[3];         // outward, a third of the face
};

NANSON_INLINE Vec4 rotated(Vec4 p) { return __builtin_shufflevector(p, p, 1, 2, 0, 3); }  // y z x
NANSON_INLINE Vec4 cross(Vec4 p, Vec4 q) { return rotated(fma(p, rotated(q), -(rotated(p) * q))); }
NANSON_INLINE void store_area(double* const (&c)[3], std::ptrdiff_t at, Vec4 area) {
  c[0][at] = area[0], c[1][at] = area[1], c[2][at] = area[2];
}

inline void positions_part(const Part& part, const double* U, const CurrentAreas& areas) {
  for (std::ptrdiff_t n = part.node_begin; n < part.node_end; ++n)
    store4(areas.x + row::x * n, Vec4{U[row::U * n + 7], U[row::U * n + 11], U[row::U * n + 15], 0.0});
}

/// c = sum over the tets at ab of (c - m) x (d - m) / 12, m = (a + b)/2; seen from b every term is bitwise the opposite, so without fma. At a corner
/// (x_b - x_a) x (x_c - x_a) / 6.
inline void dual_areas_part(const Part& part, const EdgeArrays& edges, const CornerArrays& corners,
                            const NodeLists& lists, const CurrentAreas& areas) {
  const auto x = [&](std::int32_t n) { return load4(areas.x + row::x * n); };
  for (std::int32_t e = part.edge_begin; e < part.edge_end; ++e) {
    const Vec4 m = (x(edges.a[e]) + x(edges.b[e])) * 0.5;
    Vec4 sum{};
    for (int line = 0; line < 2; ++line) __builtin_prefetch(areas.cd + 2 * areas.ring[e] + ahead::rings + 16 * line);
    __builtin_prefetch(areas.x + row::x * edges.b[e + ahead::single_rows]);  // c and d are neighbours of a too
    for (std::int32_t i = areas.ring[e]; i < areas.ring[e + 1]; ++i) {
      const Vec4 p = x(areas.cd[2 * i]) - m, q = x(areas.cd[2 * i + 1]) - m;
      sum = sum + (p * rotated(q) - rotated(p) * q);
    }
    store_area(areas.c, e, rotated(sum) * (1.0 / 12));
  }
  for (int a = part.node_begin; a < part.node_end; ++a)
    for (std::int32_t g = lists.corner[a]; g < lists.corner[a + 1]; ++g)
      store_area(areas.corner, g, cross(x(corners.b[g]) - x(a), x(corners.c[g]) - x(a)) * (1.0 / 6));
}

/// H_x = cof(grad x), the gradient with the (6,1,1)/8 boundary rows that (49) omits (method, section 8).
inline void area_map_part(const Part& part, const EdgeArrays& edges, const CornerArrays& corners,
                          const NodeLists& lists, const Rows& rows, const CurrentAreas& areas) {
  Rows of_x = rows;
  of_x.W = areas.x;
  of_x.G = areas.map;
  static_assert(row::x == row::W && row::G == row::H);
  for (int n = part.node_begin; n < part.node_end; ++n) {
    gradient_of_W(n, edges, corners, lists, of_x);
    double* H = areas.map + row::H * n;
    const Vec4 f0 = load4(H), f1 = load4(H + 4), f2 = load4(H + 8);
    store4(H, cross(f1, f2));
    store4(H + 4, cross(f2, f0));
    store4(H + 8, cross(f0, f1));
  }
}

/// c = (H_x,a + H_x,b)/2 C on edges, H_x,a C at corners.
inline void mapped_areas_part(const Part& part, const EdgeArrays& edges, const CornerArrays& corners,
                              const NodeLists& lists, const CurrentAreas& areas) {
  const auto H = [&](std::int32_t n, int I) { return load4(areas.map + row::H * n + 4 * I); };
  for (std::int32_t e = part.edge_begin; e < part.edge_end; ++e) {
    const std::int32_t a = edges.a[e], b = edges.b[e], next = edges.b[e + ahead::rows];
    __builtin_prefetch(areas.map + row::H * next);
    __builtin_prefetch(areas.map + row::H * next + 8);
    Vec4 c{};
    for (int I = 0; I < 3; ++I) c = fma(H(a, I) + H(b, I), broadcast4(0.5 * edges.C[I][e]), c);
    store_area(areas.c, e, c);
  }
  for (int a = part.node_begin; a < part.node_end; ++a)
    for (std::int32_t g = lists.corner[a]; g < lists.corner[a + 1]; ++g) {
      Vec4 c{};
      for (int I = 0; I < 3; ++I) c = fma(H(a, I), broadcast4(corners.C[I][g]), c);
      store_area(areas.corner, g, c);
    }
}

}  // namespace nanson
