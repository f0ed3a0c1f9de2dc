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

/// Stabilisation of an edge and the jump it acts on.
struct EdgeStabilisation {
  Stabiliser s;
  Vec4 d;                         // reconstructed jump of {v, Sigma_J}, lane 3 replaced by c . (jump of P) C for the tensor pressure jump
};
template <Reconstruction reconstruction, bool evolves_J, PressureJump jump, UpwindMetric metric, EntropyFix fix>
NANSON_INLINE EdgeStabilisation edge_stabilisation(const Rows& rows, int a, int b, const double (&C)[3], double size, Vec4 plain, Vec4 D, Vec4 c, const Coefficients& k) {
  const double cc = dot3(c, c)[0];
  EdgeCoefficients s = edge_coefficients<metric>(cc, size, k.rho_cp, k.rho_cs);
  Vec4 d = reconstructed_jump<reconstruction>(rows, a, b, plain, D);
  if constexpr (!evolves_J) s.volume = 0;
  if constexpr (evolves_J && jump == PressureJump::tensor) {
    d[3] = dot3(c, traction_jump<reconstruction>(rows, a, b, C, D))[0];
    s.volume = s.volume / cc;
  }
  return {stabiliser<fix>(s, plain, d, c, cc), d};
}

/// Flux of every edge of the part: {P_ave C + D^p, D^J} (paper, eq. 40a, 43c), and q = (theta/4)(G_a - G_b) . D with a flux correction (method, section 14).
/// Only sums and differences of the two sides enter, in one order: seen from b the flux is bitwise the opposite.
template <Reconstruction reconstruction, FluxCorrection correction, bool evolves_J, PressureJump jump, UpwindMetric metric, EntropyFix fix>
NANSON_INLINE void edge_fluxes(const Part& part, const EdgeArrays& edges, const NodeLists& lists, const Rows& rows, const Coefficients& k, double* __restrict buffer) {
  constexpr bool corrected = correction != FluxCorrection::none;
  constexpr int width = corrected ? 8 : 4;
  constexpr int ahead = 32;  // edges whose neighbour rows are asked for in advance
  for (int a = part.node_begin; a < part.node_end; ++a) {
    const Vec4 Wa = load4(rows.W + row::W * a), Xa = load4(rows.X + row::X * a);
    const double* PHa = rows.PH + row::PH * a;
    const Vec8 PH_a[3] = {load8(PHa), load8(PHa + 8), load8(PHa + 16)};
    for (std::int32_t e = lists.out[a]; e < lists.out[a + 1]; ++e) {
      const std::int32_t b = edges.b[e], next = edges.b[e + ahead];  // the array is padded
      for (int line = 0; line < 3; ++line) __builtin_prefetch(rows.PH + row::PH * next + 8 * line);
      __builtin_prefetch(rows.W + row::W * next), __builtin_prefetch(rows.X + row::X * next);
      if constexpr (reconstruction != Reconstruction::constant) __builtin_prefetch(rows.G + row::G * next), __builtin_prefetch(rows.G + row::G * next + 8);
      const double C[3] = {edges.C[0][e], edges.C[1][e], edges.C[2][e]};
      const Vec8 tc = average_traction_and_area(PH_a, rows.PH + row::PH * b, C);
      const Vec4 c = high(tc), D = load4(rows.X + row::X * b) - Xa, plain = load4(rows.W + row::W * b) - Wa;
      Vec4 t = low(tc);
      if constexpr (correction == FluxCorrection::full) t = average_traction(rows.Q + row::Q * a, rows.Q + row::Q * b, C);
      const EdgeStabilisation u = edge_stabilisation<reconstruction, evolves_J, jump, metric, fix>(rows, a, b, C, edges.size[e], plain, D, c, k);
      Vec4 along = broadcast4(u.s.along), q{};
      if constexpr (corrected) q = difference_along(rows.G + row::G * a, rows.G + row::G * b, D) * broadcast4(0.25 * k.theta);
      if constexpr (correction == FluxCorrection::pressure) along = along + spread<3>(q);
      double* out = buffer + width * (e - part.edge_begin);
      store4(out, fma(u.s.k, u.d, fma(along, c, t)));
      if constexpr (corrected) store4(out + 4, q);
    }
  }
}

/// Power of the stabilisation alone, (v_b - v_a) . D^p + (Sigma_b - Sigma_a) D^J with the plain nodal differences (paper, eq. 71; method, section 11).
template <Reconstruction reconstruction, bool evolves_J, PressureJump jump, UpwindMetric metric, EntropyFix fix>
double dissipation_part(const Part& part, const EdgeArrays& edges, const NodeLists& lists, const Rows& rows, const Coefficients& k) {
  double power = 0;
  for (int a = part.node_begin; a < part.node_end; ++a)
    for (std::int32_t e = lists.out[a]; e < lists.out[a + 1]; ++e) {
      const std::int32_t b = edges.b[e];
      if (b < a) continue;  // the other part's copy counts; inside a part a < b always
      const double C[3] = {edges.C[0][e], edges.C[1][e], edges.C[2][e]};
      const double* PHa = rows.PH + row::PH * a;
      const Vec8 PH_a[3] = {load8(PHa), load8(PHa + 8), load8(PHa + 16)};
      const Vec4 c = high(average_traction_and_area(PH_a, rows.PH + row::PH * b, C));
      const Vec4 plain = load4(rows.W + row::W * b) - load4(rows.W + row::W * a), D = load4(rows.X + row::X * b) - load4(rows.X + row::X * a);
      const EdgeStabilisation u = edge_stabilisation<reconstruction, evolves_J, jump, metric, fix>(rows, a, b, C, edges.size[e], plain, D, c, k);
      const Vec4 p = plain * fma(u.s.k, u.d, broadcast4(u.s.along) * c);
      power += ((p[0] + p[1]) + p[2]) + p[3];
    }
  return power;
}

/// Corners: adjoint boundary flux (2 P_a - P_b - P_c)/8 C_gamma (method, section 3) and the load on the face.
template <FluxCorrection correction>
NANSON_INLINE void corner_forces(const Part& part, const CornerArrays& corners, const NodeLists& lists, const Rows& rows, const Coefficients& k, double* buffer) {
  constexpr bool full = correction == FluxCorrection::full;
  constexpr int width = correction != FluxCorrection::none ? 8 : 4, stride = full ? row::Q : row::PH, column = full ? 4 : 8;
  const double* stress = full ? rows.Q : rows.PH;
  if (part.corner_begin == part.corner_end) return;
  for (int a = part.node_begin; a < part.node_end; ++a)
    for (std::int32_t g = lists.corner[a]; g < lists.corner[a + 1]; ++g) {
      Vec4 f = corners.load[g] >= 0 ? load4(rows.loads + 4 * corners.load[g]) : Vec4{};
      if (k.adjoint)
        for (int I = 0; I < 3; ++I) {
          const Vec4 Pa = load4(stress + stride * a + column * I);
          const Vec4 d = (Pa - load4(stress + stride * corners.b[g] + column * I)) + (Pa - load4(stress + stride * corners.c[g] + column * I));
          f = fma(d, broadcast4(0.125 * corners.C[I][g]), f);
        }
      double* out = buffer + width * ((part.edge_end - part.edge_begin) + (g - part.corner_begin));
      store4(out, f);
      if constexpr (width == 8) store4(out + 4, Vec4{});
    }
}

template <Reconstruction reconstruction, FluxCorrection correction, bool evolves_J, PressureJump jump, UpwindMetric metric, EntropyFix fix>
void edge_flux_part(const Part& part, const EdgeArrays& edges, const CornerArrays& corners, const NodeLists& lists, const Rows& rows, const Coefficients& k,
                    const Scratch& scratch) {
  edge_fluxes<reconstruction, correction, evolves_J, jump, metric, fix>(part, edges, lists, rows, k, scratch.edge);
  corner_forces<correction>(part, corners, lists, rows, k, scratch.edge);
}

}  // namespace nanson
