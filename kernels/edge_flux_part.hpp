// The edge loop of a part: fluxes and stabilisation into a part-local buffer that stays in L2, then the boundary corners. Knows no material.
#pragma once
#include "kernels/flux.hpp"
#include "kernels/part.hpp"
#include "kernels/reconstruction.hpp"

namespace nanson {

/// Jump of the tensor rows: (P+ - P-) C reconstructed to the edge's midpoint (paper, eq. 36b).
template <Reconstruction reconstruction>
NANSON_INLINE Vec4 traction_jump(const Rows& rows, int a, int b, const double (&C)[3], Vec4 D) {
  const Vec4 D_half[3] = {spread<0>(D) * 0.5, spread<1>(D) * 0.5, spread<2>(D) * 0.5};
  Vec4 y{};
  for (int I = 0; I < 3; ++I) {
    Vec4 r = load4(rows.PH + row::PH * b + 8 * I) - load4(rows.PH + row::PH * a + 8 * I);
    if constexpr (reconstruction != Reconstruction::constant)
      for (int K = 0; K < 3; ++K) {
        const int at = 4 * (3 * K + I);
        r = r - (load4(rows.GP + row::GP * a + at) + load4(rows.GP + row::GP * b + at)) * D_half[K];
      }
    y = fma(r, broadcast4(C[I]), y);
  }
  return y;
}

constexpr bool finds(EdgeCorrection c) {
  return c == EdgeCorrection::finds_pressure || c == EdgeCorrection::finds_full;
}
constexpr bool adds_pressure(EdgeCorrection c) {
  return c == EdgeCorrection::finds_pressure || c == EdgeCorrection::takes_pressure;
}

/// Edges in two passes: gathered one by one as columns, then finished eight at a time as lanes, so that roots and quotients are not waited for edge by edge.
inline constexpr int edge_block = 64;
struct EdgeBlock {
  alignas(64) double tc[8 * edge_block];     // {P_ave C, 0 | H_ave C, 0} [N], [m^2]
  alignas(64) double d[4 * edge_block];      // reconstructed jump of {v, Sigma_J}
  alignas(64) double plain[4 * edge_block];  // nodal jump; entropy fix, audit, current areas
  alignas(64) double y[4 * edge_block];      // (P+ - P-) C, tensor pressure jump only
};

/// First pass over edges [begin, end): central traction and area, jumps; q = (theta/4)(G_a - G_b) . D into the second half of the flux rows.
template <Reconstruction reconstruction, EdgeCorrection correction, bool audits, PressureJump jump, EntropyFix fix,
          Areas areas>
NANSON_INLINE void gather_edges(int begin, int end, const EdgeArrays& edges, const Rows& rows, double theta,
                                EdgeBlock& block, double* flux) {
  constexpr int ahead = 60;  // edges whose neighbour rows are asked for in advance; the array is padded
  for (int e = begin; e < end; ++e) {
    const std::int32_t a = edges.a[e], b = edges.b[e], next = edges.b[e + ahead];
    for (int line = 0; line < 3; ++line) __builtin_prefetch(rows.PH + row::PH * next + 8 * line);
    __builtin_prefetch(rows.W + row::W * next);
    __builtin_prefetch(rows.X + row::X * next);
    if constexpr (reconstruction != Reconstruction::constant) {
      __builtin_prefetch(rows.G + row::G * next);
      __builtin_prefetch(rows.G + row::G * next + 8);
    }
    if constexpr (reconstruction == Reconstruction::limited) __builtin_prefetch(rows.L + row::L * next);
    if constexpr (jump == PressureJump::tensor && reconstruction != Reconstruction::constant)
      for (int line = 0; line < 5; ++line) __builtin_prefetch(rows.GP + row::GP * next + 8 * line);
    const double* const(&area)[3] = areas == Areas::current ? edges.c : edges.C;
    const double C[3] = {area[0][e], area[1][e], area[2][e]};
    const double* PHa = rows.PH + row::PH * a;
    const Vec8 PH_a[3] = {load8(PHa), load8(PHa + 8), load8(PHa + 16)};
    Vec8 tc = average_traction_and_area(PH_a, rows.PH + row::PH * b, C);
    if constexpr (areas == Areas::current)
      tc = concat(high(tc), Vec4{C[0], C[1], C[2], 0.0});  // {sigma_ave c, 0 | c, 0}
    const Vec4 D = load4(rows.X + row::X * b) - load4(rows.X + row::X * a),
               plain = load4(rows.W + row::W * b) - load4(rows.W + row::W * a);
    const int at = e - begin;
    store8(block.tc + 8 * at, tc);
    store4(block.d + 4 * at, reconstructed_jump<reconstruction>(rows, a, b, plain, D));
    if constexpr (fix != EntropyFix::none || audits || areas == Areas::current) store4(block.plain + 4 * at, plain);
    if constexpr (jump == PressureJump::tensor)
      store4(block.y + 4 * at, traction_jump<reconstruction>(rows, a, b, C, D));
    if constexpr (finds(correction)) {
      const Vec4 q = difference_along(rows.G + row::G * a, rows.G + row::G * b, D) * broadcast4(0.25 * theta);
      store4(flux + 8 * at + 4, q);
      if constexpr (correction == EdgeCorrection::finds_pressure) rows.lagged_q[e] = q[3];
    }
  }
}

/// Asks for the rows of a node, some nodes ahead, that the update reads after the edge loop: states, or the state and a lagged correction; H where it is carried.
inline constexpr int nodes_ahead = 40;
NANSON_INLINE void prefetch_U(std::ptrdiff_t n, const Rows& rows, bool takes_lagged) {
  for (const double* U : {rows.U_old, takes_lagged ? rows.lagged_dG : rows.U_stage}) {
    __builtin_prefetch(U + row::U * n);
    __builtin_prefetch(U + row::U * n + 8);
  }
  if (rows.H_old)
    for (const double* H : {rows.H_old, rows.H_stage}) {
      __builtin_prefetch(H + row::H * n);
      __builtin_prefetch(H + row::H * n + 8);
    }
}

/// Second pass over eight edges: {P_ave C + D^p, D^J} into rows of `width`. Returns the power of the stabilisation alone, (v_b - v_a) . D^p + (Sigma_b - Sigma_a) D^J
/// with the plain nodal differences (paper, eq. 71; method, section 11), where the scene audits [W].
template <EdgeCorrection correction, bool audits, bool evolves_J, PressureJump jump, UpwindMetric metric,
          EntropyFix fix, Areas areas, class Z>
NANSON_INLINE Vec8 finish_edges(const EdgeBlock& block, int at, Vec8 size, Z rho_cp, Z rho_cs, const double* q,
                                double* motion, double* flux) {
  constexpr int width = finds(correction) ? 8 : 4;
  const auto dot = [](const Vec8(&p)[4], const Vec8(&q)[4]) { return fma(p[2], q[2], fma(p[1], q[1], p[0] * q[0])); };
  Vec8 t[4], c[4], d[4], plain[4]{}, y[4];
  load_transposed(block.tc + 8 * at, 8, t[0], t[1], t[2], t[3]);
  load_transposed(block.tc + 8 * at + 4, 8, c[0], c[1], c[2], c[3]);
  load_transposed(block.d + 4 * at, 4, d[0], d[1], d[2], d[3]);
  if constexpr (fix != EntropyFix::none || audits || areas == Areas::current)
    load_transposed(block.plain + 4 * at, 4, plain[0], plain[1], plain[2], plain[3]);
  const Vec8 cc = dot(c, c);
  EdgeCoefficientsOf<Vec8> s = edge_coefficients<metric>(cc, size, rho_cp, rho_cs);
  if constexpr (!evolves_J) s.volume = Vec8{};
  if constexpr (evolves_J && jump == PressureJump::tensor) {
    load_transposed(block.y + 4 * at, 4, y[0], y[1], y[2], y[3]);
    d[3] = dot(c, y);
    s.volume = s.volume / cc;
  }
  StabiliserOf<Vec8> u = stabiliser<fix, Vec8>(s, cc, dot(c, d), dot(c, plain), dot(d, plain), d[3] * plain[3]);
  if constexpr (areas == Areas::current) store8_anywhere(motion, dot(c, plain));
  Vec8 power{};
  if constexpr (audits) power = fma(u.shear, dot(d, plain), fma(u.along, dot(c, plain), u.volume * d[3] * plain[3]));
  if constexpr (adds_pressure(correction)) u.along = u.along + load8_anywhere(q);
  Vec8 f[3];
  for (int i = 0; i < 3; ++i) f[i] = fma(u.shear, d[i], fma(u.along, c[i], t[i]));
  store_transposed(flux, width, f[0], f[1], f[2], u.volume * d[3]);
  return power;
}

/// Of eight edges, those that are the part's to count: not past its end, and of an edge between two parts one copy (inside a part a < b always).
NANSON_INLINE Mask8 counted(const EdgeArrays& edges, std::ptrdiff_t e, int left) {
  return less8(edges.a + e, edges.b + e) & first_lanes(left);
}

/// Flux of every edge of the part: {P_ave C + D^p, D^J} (paper, eq. 40a, 43c), and q = (theta/4)(G_a - G_b) . D with a flux correction (method, section 14).
/// Only sums, differences and products of the two sides enter, in one order: seen from b the flux is bitwise the opposite.
/// Arrays and coefficients by value: the compiler then knows that the stores to the buffer leave them alone. Returns the power of the stabilisation [W].
template <Reconstruction reconstruction, EdgeCorrection correction, bool audits, bool evolves_J, PressureJump jump,
          UpwindMetric metric, EntropyFix fix, Areas areas = Areas::undeformed, Materials materials = Materials::one>
NANSON_INLINE double edge_fluxes(const Part& part, const EdgeArrays edges, const Rows rows, const Coefficients k,
                                 double* buffer, double* motion = nullptr) {
  constexpr int width = finds(correction) ? 8 : 4;
  EdgeBlock block{};
  Vec8 power{};
  for (int begin = part.edge_begin; begin < part.edge_end; begin += edge_block) {
    const int count = part.edge_end - begin < edge_block ? part.edge_end - begin : edge_block;
    double* flux = buffer + width * static_cast<std::ptrdiff_t>(begin - part.edge_begin);
    gather_edges<reconstruction, correction, audits, jump, fix, areas>(begin, begin + count, edges, rows, k.theta,
                                                                       block, flux);
    for (int at = 0; at < count; at += 8) {
      const std::ptrdiff_t n = edges.a[begin + at] + nodes_ahead;
      prefetch_U(n, rows, k.takes_lagged);
      if constexpr (correction == EdgeCorrection::finds_full) {
        __builtin_prefetch(rows.dP + row::dP * n);
        __builtin_prefetch(rows.dP + row::dP * n + 8);
      }
      const double* q = nullptr;
      if constexpr (adds_pressure(correction)) {
        q = rows.lagged_q + begin + at;
        __builtin_prefetch(q + 256);
      }
      const Vec8 size = edge_sizes(edges, begin + at);
      double* of_motion = nullptr;
      if constexpr (areas
                    == Areas::current) {  // twice as many arrays: the processor's own prefetch loses their sequence
        for (int i = 0; i < 3; ++i) {
          __builtin_prefetch(edges.c[i] + begin + at + 256);
          __builtin_prefetch(edges.C[i] + begin + at + 256);
        }
        of_motion = motion + (begin + at - part.edge_begin);
      }
      Vec8 of_edges;
      if constexpr (materials == Materials::several)
        of_edges = finish_edges<correction, audits, evolves_J, jump, metric, fix, areas>(
            block, at, size, load8_anywhere(edges.rho_cp + begin + at), load8_anywhere(edges.rho_cs + begin + at), q,
            of_motion, flux + width * at);
      else
        of_edges = finish_edges<correction, audits, evolves_J, jump, metric, fix, areas>(
            block, at, size, k.rho_cp, k.rho_cs, q, of_motion, flux + width * at);
      if constexpr (audits) power = power + choose(counted(edges, begin + at, count - at), of_edges, Vec8{});
    }
  }
  return sum(power);
}

/// Corners: adjoint boundary flux (2 P_a - P_b - P_c)/8 C_gamma (method, section 3) and the load on the face.
NANSON_INLINE void corner_forces(const Part& part, const CornerArrays& corners, const NodeLists& lists,
                                 const Rows& rows, const Coefficients& k, double* buffer) {
  const auto stress = [&](std::ptrdiff_t n, int I) { return load4(rows.PH + row::PH * n + 8 * I); };
  if (part.corner_begin == part.corner_end) return;
  for (int a = part.node_begin; a < part.node_end; ++a)
    for (std::int32_t g = lists.corner[a]; g < lists.corner[a + 1]; ++g) {
      Vec4 f = corners.load[g] >= 0 ? load4(rows.loads + 4 * corners.load[g]) : Vec4{};
      if (k.adjoint)
        for (int I = 0; I < 3; ++I) {
          const Vec4 Pa = stress(a, I), d = (Pa - stress(corners.b[g], I)) + (Pa - stress(corners.c[g], I));
          f = fma(d, broadcast4(0.125 * corners.C[I][g]), f);
        }
      store4(buffer + 4 * (g - part.corner_begin), f);
    }
}

template <Reconstruction reconstruction, EdgeCorrection correction, bool evolves_J, PressureJump jump,
          UpwindMetric metric, EntropyFix fix, bool audits, Materials materials>
double edge_flux_part(const Part& part, const EdgeArrays& edges, const CornerArrays& corners, const NodeLists& lists,
                      const Rows& rows, const Coefficients& k, const Scratch& scratch) {
  const double power =
      edge_fluxes<reconstruction, correction, audits, evolves_J, jump, metric, fix, Areas::undeformed, materials>(
          part, edges, rows, k, scratch.edge);
  corner_forces(part, corners, lists, rows, k, scratch.corner);
  return power;
}

}  // namespace nanson
