// The edge loop of a part: fluxes and stabilisation into a part-local buffer that stays in L2, then the boundary corners. Knows no material.
#pragma once
#include "kernels/corner_forces.hpp"
#include "kernels/flux.hpp"
#include "kernels/part.hpp"
#include "kernels/reconstruction.hpp"
#include "kernels/springs.hpp"

namespace nanson {

/// Jump of the tensor rows: (P+ - P-) C reconstructed to the edge's midpoint (paper, eq. 36b); with a limiter, that of Sigma_J.
template <Reconstruction reconstruction>
NANSON_INLINE Vec4 traction_jump(const Rows& rows, int a, int b, const double (&C)[3], Vec4 D) {
  const Vec4 D_half[3] = {spread<0>(D) * 0.5, spread<1>(D) * 0.5, spread<2>(D) * 0.5};
  const auto gradient = [&](int n, int at) {
    const Vec4 g = load4(rows.GP + row::GP * n + at);
    if constexpr (reconstruction == Reconstruction::limited) return g * broadcast4(rows.L[row::L * n + 3]);
    else return g;
  };
  Vec4 y{};
  for (int I = 0; I < 3; ++I) {
    Vec4 r = load4(rows.PH + row::PH * b + 8 * I) - load4(rows.PH + row::PH * a + 8 * I);
    if constexpr (reconstruction != Reconstruction::constant)
      for (int K = 0; K < 3; ++K) r = r - (gradient(a, 4 * (3 * K + I)) + gradient(b, 4 * (3 * K + I))) * D_half[K];
    y = fma(r, broadcast4(C[I]), y);
  }
  return y;
}

/// Edges in two passes: gathered one by one as columns, then finished eight at a time as lanes, so that roots and quotients are not waited for edge by edge.
inline constexpr int edge_block = 64;
struct EdgeBlock {
  alignas(64) double tc[8 * edge_block];     // {P_ave C, 0 | H_ave C, 0} [N], [m^2]
  alignas(64) double d[4 * edge_block];      // reconstructed jump of {v, Sigma_J}
  alignas(64) double plain[4 * edge_block];  // nodal jump, where it is wanted: entropy fix, audit, current areas
  alignas(64) double y[4 * edge_block];      // (P+ - P-) C, tensor pressure jump only
};

/// First pass over edges [begin, end): central traction and area, jumps; q = (theta/4)(G_a - G_b) . D into the second half of the flux rows.
template <Reconstruction reconstruction, FluxCorrection found, PressureJump jump, bool plain_jumps, Areas areas>
NANSON_INLINE void gather_edges(int begin, int end, const EdgeArrays& edges, const Rows& rows, double theta,
                                EdgeBlock& block, double* flux) {
  for (int e = begin; e < end; ++e) {
    const std::int32_t a = edges.a[e], b = edges.b[e], next = edges.b[e + ahead::rows];
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
    if (edges.stiffness) tc = tc + concat(spring_force<areas>(edges, e, rows), Vec4{});
    const Vec4 D = load4(rows.X + row::X * b) - load4(rows.X + row::X * a),
               plain = load4(rows.W + row::W * b) - load4(rows.W + row::W * a);
    const int at = e - begin;
    store8(block.tc + 8 * at, tc);
    store4(block.d + 4 * at, reconstructed_jump<reconstruction>(rows, a, b, plain, D));
    if constexpr (plain_jumps) store4(block.plain + 4 * at, plain);
    if constexpr (jump == PressureJump::tensor)
      store4(block.y + 4 * at, traction_jump<reconstruction>(rows, a, b, C, D));
    if constexpr (found != FluxCorrection::none) {
      const Vec4 q = difference_along(rows.G + row::G * a, rows.G + row::G * b, D) * broadcast4(0.25 * theta);
      store4(flux + 8 * at + 4, q);
      if constexpr (found == FluxCorrection::pressure) rows.lagged_q[e] = q[3];
    }
  }
}

/// Asks for the rows of a node, some nodes ahead, that the update reads after the edge loop: states, or the state and a lagged correction; H where it is carried.
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

/// Second pass over eight edges, from the block's `at` and the part's edge e: {P_ave C + spring + D^p, D^J} into rows of `width`. Returns the power of the stabilisation alone,
/// (v_b - v_a) . D^p + (Sigma_b - Sigma_a) D^J with the plain nodal differences (paper, eq. 71; method, section 11), where the scene audits [W].
template <int width, PressureJump jump, bool plain_jumps, Areas areas>
NANSON_INLINE Vec8 finish_edges(const EdgeBlock& block, int at, const EdgeArrays& edges, std::ptrdiff_t e,
                                const Rows& rows, const Coefficients& k, double* flux, double* motion) {
  const auto dot = [](const Vec8(&p)[4], const Vec8(&q)[4]) { return fma(p[2], q[2], fma(p[1], q[1], p[0] * q[0])); };
  const EdgeChoices& choices = k.edge;
  Vec8 t[4], c[4], d[4], plain[4]{}, y[4];
  load_transposed(block.tc + 8 * at, 8, t[0], t[1], t[2], t[3]);
  load_transposed(block.tc + 8 * at + 4, 8, c[0], c[1], c[2], c[3]);
  load_transposed(block.d + 4 * at, 4, d[0], d[1], d[2], d[3]);
  if constexpr (plain_jumps) load_transposed(block.plain + 4 * at, 4, plain[0], plain[1], plain[2], plain[3]);
  const Vec8 cc = dot(c, c), size = edge_sizes(edges, e);
  EdgeCoefficientsOf<Vec8> s = edges.rho_cp
                                   ? edge_coefficients(cc, size, load8_anywhere(edges.rho_cp + e),
                                                       load8_anywhere(edges.rho_cs + e),
                                                       load8_anywhere(edges.rho_cJ + e), choices.deformed_metric)
                                   : edge_coefficients(cc, size, k.rho_cp, k.rho_cs, k.rho_cJ, choices.deformed_metric);
  if (!choices.evolves_J) s.volume = Vec8{};
  if constexpr (jump == PressureJump::tensor) {
    load_transposed(block.y + 4 * at, 4, y[0], y[1], y[2], y[3]);
    d[3] = dot(c, y);
    s.volume = s.volume / cc;
  }
  StabiliserOf<Vec8> u = stabiliser(s, dot(c, d));
  Vec8 power{};
  if constexpr (plain_jumps) {
    if (choices.entropy_fix) u = fixed_stabiliser(s, cc, dot(c, d), dot(c, plain), dot(d, plain), d[3] * plain[3]);
    if (choices.audits) power = fma(u.shear, dot(d, plain), fma(u.along, dot(c, plain), u.volume * d[3] * plain[3]));
  }
  if constexpr (areas == Areas::current) store8_anywhere(motion, dot(c, plain));
  if (choices.adds_pressure) u.along = u.along + load8_anywhere(rows.lagged_q + e);
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
template <Reconstruction reconstruction, FluxCorrection found, PressureJump jump, bool plain_jumps, Areas areas>
NANSON_INLINE double edge_fluxes(const Part& part, const EdgeArrays edges, const Rows rows, const Coefficients k,
                                 double* buffer, double* motion) {
  constexpr int width = found != FluxCorrection::none ? 8 : 4;
  EdgeBlock block{};
  Vec8 power{};
  for (int begin = part.edge_begin; begin < part.edge_end; begin += edge_block) {
    const int count = part.edge_end - begin < edge_block ? part.edge_end - begin : edge_block;
    double* flux = buffer + width * static_cast<std::ptrdiff_t>(begin - part.edge_begin);
    gather_edges<reconstruction, found, jump, plain_jumps, areas>(begin, begin + count, edges, rows, k.theta, block,
                                                                  flux);
    for (int at = 0; at < count; at += 8) {
      const std::ptrdiff_t e = begin + at, n = edges.a[e] + ahead::nodes;
      prefetch_U(n, rows, k.takes_lagged);
      if constexpr (found == FluxCorrection::full) {
        __builtin_prefetch(rows.dP + row::dP * n);
        __builtin_prefetch(rows.dP + row::dP * n + 8);
      }
      if (k.edge.adds_pressure) __builtin_prefetch(rows.lagged_q + e + ahead::arrays);
      if constexpr (areas == Areas::current)  // twice as many arrays: the processor's own prefetch loses their sequence
        for (int i = 0; i < 3; ++i) {
          __builtin_prefetch(edges.c[i] + e + ahead::arrays);
          __builtin_prefetch(edges.C[i] + e + ahead::arrays);
        }
      const Vec8 of_edges = finish_edges<width, jump, plain_jumps, areas>(
          block, at, edges, e, rows, k, flux + width * at,
          areas == Areas::current ? motion + (e - part.edge_begin) : nullptr);
      if constexpr (plain_jumps)
        if (k.edge.audits) power = power + choose(counted(edges, e, count - at), of_edges, Vec8{});
    }
  }
  return sum(power);
}

template <Reconstruction reconstruction, FluxCorrection found, PressureJump jump, bool plain_jumps, Areas areas>
double edge_flux_part(const Part& part, const EdgeArrays& edges, const CornerArrays& corners, const NodeLists& lists,
                      const Rows& rows, const Coefficients& k, const Scratch& scratch) {
  const double power = edge_fluxes<reconstruction, found, jump, plain_jumps, areas>(part, edges, rows, k, scratch.edge,
                                                                                    scratch.motion);
  if constexpr (areas == Areas::current) {
    current_corner_forces(part, corners, lists, rows, k, scratch.corner);
    if (k.edge.evolves_J) cell_motion(part, corners, lists, rows, scratch.motion);
  } else {
    corner_forces(part, corners, lists, rows, k, scratch.corner);
  }
  return power;
}

}  // namespace nanson
