// The edge loop of a part: fluxes and stabilisation into a part-local buffer that stays in L2, then the boundary corners. Knows no material.
#pragma once
#include "kernels/flux.hpp"
#include "kernels/part.hpp"

namespace nanson {

/// Jump of the tensor rows: (P+ - P-) C reconstructed to the edge's midpoint (paper, eq. 36b).
template <Reconstruction reconstruction>
NANSON_INLINE Vec4 traction_jump(const Rows& rows, int a, int b, const double (&C)[3], Vec4 D) {
  const Vec4 D_half[3] = {spread<0>(D) * 0.5, spread<1>(D) * 0.5, spread<2>(D) * 0.5};
  Vec4 y{};
  for (int I = 0; I < 3; ++I) {
    Vec4 r = load4(rows.PH + row::PH * b + 8 * I) - load4(rows.PH + row::PH * a + 8 * I);
    if constexpr (reconstruction == Reconstruction::linear)
      for (int K = 0; K < 3; ++K) {
        const int at = 4 * (3 * K + I);
        r = r - (load4(rows.GP + row::GP * a + at) + load4(rows.GP + row::GP * b + at)) * D_half[K];
      }
    y = fma(r, broadcast4(C[I]), y);
  }
  return y;
}

/// Flux of every edge of the part: {P_ave C + D^p, D^J} (paper, eq. 40a, 43c), and q = (theta/4)(G_a - G_b) . D with a flux correction (method, section 14).
/// Only sums and differences of the two sides enter, in one order: seen from b the flux is bitwise the opposite.
template <Reconstruction reconstruction, FluxCorrection correction, bool evolves_J, PressureJump jump, UpwindMetric metric>
NANSON_INLINE void edge_fluxes(const Part& part, const EdgeArrays& edges, const NodeLists& lists, const Rows& rows, const Coefficients& k, double* buffer) {
  constexpr bool corrected = correction != FluxCorrection::none;
  constexpr int width = corrected ? 8 : 4;
  constexpr int ahead = 16;  // edges whose neighbour rows are asked for in advance
  for (int a = part.node_begin; a < part.node_end; ++a) {
    const Vec4 Wa = load4(rows.W + row::W * a), Xa = load4(rows.X + row::X * a);
    const double* PHa = rows.PH + row::PH * a;
    const Vec8 PH_a[3] = {load8(PHa), load8(PHa + 8), load8(PHa + 16)};
    const double* Ga = rows.G + row::G * a;
    for (std::int32_t e = lists.out[a]; e < lists.out[a + 1]; ++e) {
      const std::int32_t b = edges.b[e];
      const std::int32_t next = edges.b[e + ahead];  // the array is padded
      for (int line = 0; line < 3; ++line) __builtin_prefetch(rows.PH + row::PH * next + 8 * line);
      const double C[3] = {edges.C[0][e], edges.C[1][e], edges.C[2][e]};
      const Vec8 tc = average_traction_and_area(PH_a, rows.PH + row::PH * b, C);
      Vec4 t = low(tc);
      const Vec4 c = high(tc);
      Vec4 d = load4(rows.W + row::W * b) - Wa, q{}, D{};
      if constexpr (reconstruction == Reconstruction::linear) {
        const double* Gb = rows.G + row::G * b;
        __builtin_prefetch(rows.G + row::G * next), __builtin_prefetch(rows.G + row::G * next + 8);
        D = load4(rows.X + row::X * b) - Xa;
        const Vec4 D0 = spread<0>(D), D1 = spread<1>(D), D2 = spread<2>(D);
        Vec4 s = (load4(Ga) + load4(Gb)) * D0;
        s = fma(load4(Ga + 4) + load4(Gb + 4), D1, s), s = fma(load4(Ga + 8) + load4(Gb + 8), D2, s);
        d = fma(s, broadcast4(-0.5), d);
        if constexpr (corrected) {
          q = (load4(Ga) - load4(Gb)) * D0;
          q = fma(load4(Ga + 4) - load4(Gb + 4), D1, q), q = fma(load4(Ga + 8) - load4(Gb + 8), D2, q);
          q = q * broadcast4(0.25 * k.theta);
        }
      }
      if constexpr (correction == FluxCorrection::full) {
        const double *Qa = rows.Q + row::Q * a, *Qb = rows.Q + row::Q * b;
        t = (load4(Qa) + load4(Qb)) * broadcast4(0.5 * C[0]);
        t = fma(load4(Qa + 4) + load4(Qb + 4), broadcast4(0.5 * C[1]), t), t = fma(load4(Qa + 8) + load4(Qb + 8), broadcast4(0.5 * C[2]), t);
      }
      const double cc = dot3(c, c)[0];
      const EdgeCoefficients s = edge_coefficients<metric>(cc, edges.size[e], k.rho_cp, k.rho_cs);
      Vec4 along = broadcast4(s.normal) * dot3(c, d);
      if constexpr (correction == FluxCorrection::pressure) along = along + spread<3>(q);
      double volume = evolves_J ? s.volume : 0.0;
      if constexpr (jump == PressureJump::tensor && evolves_J) {
        d[3] = (dot3(c, traction_jump<reconstruction>(rows, a, b, C, D)))[0];
        volume = s.volume / cc;
      }
      const Vec4 flux = fma(Vec4{s.shear, s.shear, s.shear, volume}, d, fma(along, c, t));
      double* out = buffer + width * (e - part.edge_begin);
      store4(out, flux);
      if constexpr (corrected) store4(out + 4, q);
    }
  }
}

/// Power of the same stabilisation alone, (v_b - v_a) . D^p + (Sigma_b - Sigma_a) D^J with the plain nodal differences (paper, eq. 71; method, section 11).
template <Reconstruction reconstruction, bool evolves_J, PressureJump jump, UpwindMetric metric>
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
      Vec4 d = plain;
      if constexpr (reconstruction == Reconstruction::linear) {
        const double *Ga = rows.G + row::G * a, *Gb = rows.G + row::G * b;
        for (int I = 0; I < 3; ++I) d = d - (load4(Ga + 4 * I) + load4(Gb + 4 * I)) * broadcast4(0.5 * D[I]);
      }
      const double cc = dot3(c, c)[0];
      const EdgeCoefficients s = edge_coefficients<metric>(cc, edges.size[e], k.rho_cp, k.rho_cs);
      double volume = evolves_J ? s.volume : 0.0;
      const double along = s.normal * dot3(c, d)[0];
      if constexpr (jump == PressureJump::tensor && evolves_J) {
        d[3] = (dot3(c, traction_jump<reconstruction>(rows, a, b, C, D)))[0];
        volume = s.volume / cc;
      }
      for (int i = 0; i < 3; ++i) power += plain[i] * (s.shear * d[i] + along * c[i]);
      power += plain[3] * volume * d[3];
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

template <Reconstruction reconstruction, FluxCorrection correction, bool evolves_J, PressureJump jump, UpwindMetric metric>
void edge_flux_part(const Part& part, const EdgeArrays& edges, const CornerArrays& corners, const NodeLists& lists, const Rows& rows, const Coefficients& k,
                    const Scratch& scratch) {
  edge_fluxes<reconstruction, correction, evolves_J, jump, metric>(part, edges, lists, rows, k, scratch.edge);
  corner_forces<correction>(part, corners, lists, rows, k, scratch.edge);
}

}  // namespace nanson
