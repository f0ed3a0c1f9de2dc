// The springs between the nodes, which stand for the tets' own deformation (method, section 17): force and energy.
#pragma once
#include "kernels/part.hpp"

namespace nanson {

/// k (u_b - u_a) of an edge [N], lane 3 zero; the displacements stand in the rows of P and H. With current areas k (x_b - x_a) (tet_stiffness.hpp).
template <Areas areas>
NANSON_INLINE Vec4 spring_force(const EdgeArrays& edges, std::ptrdiff_t e, const Rows& rows) {
  const std::ptrdiff_t a = edges.a[e], b = edges.b[e];
  const double *ua = rows.PH + row::PH * a + 7, *ub = rows.PH + row::PH * b + 7;
  Vec4 stretch{ub[0] - ua[0], ub[8] - ua[8], ub[16] - ua[16], 0.0};
  if constexpr (areas == Areas::current) {
    const double *Xa = rows.X + row::X * a, *Xb = rows.X + row::X * b;
    stretch = stretch + Vec4{Xb[0] - Xa[0], Xb[1] - Xa[1], Xb[2] - Xa[2], 0.0};
  }
  return stretch * broadcast4(edges.stiffness[e]);
}

/// Sum of k |u_b - u_a|^2/2 over the edges that the part counts (of an edge between two parts one copy; inside a part a < b always) [J].
inline double spring_energy_part(const Part& part, const EdgeArrays& edges, const Rows& rows) {
  Vec4 twice{};
  for (std::int32_t e = part.edge_begin; e < part.edge_end; ++e) {
    if (edges.b[e] < edges.a[e]) continue;
    const double *ua = rows.PH + row::PH * edges.a[e] + 7, *ub = rows.PH + row::PH * edges.b[e] + 7;
    const Vec4 stretch{ub[0] - ua[0], ub[8] - ua[8], ub[16] - ua[16], 0.0};
    twice = fma(stretch * stretch, broadcast4(edges.stiffness[e]), twice);
  }
  return 0.5 * dot3(twice, Vec4{1, 1, 1, 1})[0];
}

}  // namespace nanson
