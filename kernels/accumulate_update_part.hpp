// Nodal gather of the part-local buffer (scatter-free), supports, and the Runge-Kutta update of {v, J, F, H, x} (paper, eq. 40a, 43, 50).
#pragma once
#include "kernels/part.hpp"

namespace nanson {

/// Undeformed density [kg/m^3]: of the material, or of every node.
struct OneDensity {
  double rho;
  double operator[](int) const { return rho; }
};
struct NodeDensity {
  const double* rho;
  double operator[](int n) const { return rho[n]; }
};

/// Force of every node [N] with the J source [m^3/s] in lane 3: what acts from outside, + out-edges, - in-edges, + corners. With a flux correction also
/// the correction of the velocity gradient, sum_b q (x) C / Omega (method, section 14).
template <GradientCorrection correction>
NANSON_INLINE void gather(const Part& part, const EdgeArrays& edges, const NodeLists& lists, const Rows& rows,
                          const Scratch& scratch) {
  constexpr bool corrected = correction == GradientCorrection::found;
  constexpr int width = corrected ? 8 : 4;
  const double* buffer = scratch.edge;
  for (int n = part.node_begin; n < part.node_end; ++n) {
    const double inverse_volume = rows.X[row::X * n + 3];
    Vec4 f = rows.force ? load4(rows.force + 4 * n) : Vec4{};
    if (rows.crushing) f = f + load4(rows.crushing + 4 * n);
    Vec8 g[3] = {concat(f, Vec4{})};  // {force | column 0 of dG}, {unused | column 1}, {unused | column 2}
    const auto add = [&](auto sense, std::ptrdiff_t e) {
      const double* r = buffer + width * (e - part.edge_begin);
      if constexpr (corrected) {
        const Vec8 flux_q = load8(r);
        g[0] = add_product(sense, flux_q, concat(broadcast4(1.0), broadcast4(edges.C[0][e])), g[0]);
        for (int I = 1; I < 3; ++I) g[I] = add_product(sense, flux_q, broadcast8(edges.C[I][e]), g[I]);
      } else {
        f = sense > 0 ? f + load4(r) : f - load4(r);
      }
    };
    for (std::int32_t e = lists.out[n]; e < lists.out[n + 1]; ++e) add(Outward(), e);
    for (std::int32_t i = lists.in[n]; i < lists.in[n + 1]; ++i) add(Inward(), lists.in_edges[i]);
    if constexpr (corrected) f = low(g[0]);
    for (std::int32_t i = lists.corner[n]; i < lists.corner[n + 1]; ++i)
      f = f + load4(scratch.corner + 4 * (i - part.corner_begin));
    store4(scratch.force + 4 * (n - part.node_begin), f);
    if constexpr (corrected) {
      double* dG = scratch.dG + 12 * (n - part.node_begin);
      for (int I = 0; I < 3; ++I) store4(dG + 4 * I, high(g[I]) * inverse_volume);
    }
  }
}

/// Along each held direction the force becomes mass x prescribed acceleration; what the support gave is booked [N].
template <class Density>
NANSON_INLINE void constrain(const Part& part, const Rows& rows, const Coefficients& k, Density rho,
                             const Constraint* constraints, double* reactions, const Scratch& scratch) {
  for (std::int32_t i = part.constraint_begin; i < part.constraint_end; ++i) {
    const Constraint& h = constraints[i];
    double* f = scratch.force + 4 * (h.node - part.node_begin);
    const double mass = rho[h.node] / rows.X[row::X * h.node + 3];
    const double* v = rows.W + row::W * h.node;
    double* booked = reactions + reaction_row * i;
    for (int m = 0; m < reaction_row; ++m) booked[m] = 0;
    for (int m = 0; m < h.count; ++m) {
      double wanted = 0;
      for (int s = 0; s < 3; ++s)
        if (h.weight[m][s] != 0) wanted += h.weight[m][s] * k.acceleration[h.source[m][s]];
      const double* d = h.d[m];
      const double reaction = mass * wanted - (f[0] * d[0] + f[1] * d[1] + f[2] * d[2]);
      for (int j = 0; j < 3; ++j) f[j] += reaction * d[j];
      booked[m] = reaction;
      booked[3] += reaction * (v[0] * d[0] + v[1] * d[1] + v[2] * d[2]);
    }
  }
}

/// dv/dt = f/(rho Omega), dF/dt = G, dH/dt = F x G, dJ/dt = H:G (current areas: row dJ) + source/Omega, dx/dt = v; then U_new = w0 U_old + w1 U_stage + dt dU/dt (eq. 50).
template <Formulation formulation, GradientCorrection correction, Areas areas, class Density>
NANSON_INLINE void update(const Part& part, const Rows& rows, const Coefficients& k, Density rho,
                          const Scratch& scratch) {
  const Vec4 w0 = broadcast4(k.old_weight), w1 = broadcast4(k.stage_weight), dt = broadcast4(k.dt);
  double inverse_rho = 1.0 / k.material.rho;
  auto advance = [&](const double* old_row, const double* stage_row, double* new_row, Vec4 rate) {
    store4(new_row, fma(dt, rate, fma(w0, load4(old_row), w1 * load4(stage_row))));
  };
  for (int n = part.node_begin; n < part.node_end; ++n) {
    const double *U_old = rows.U_old + row::U * n, *U_stage = rows.U_stage + row::U * n, *PH = rows.PH + row::PH * n,
                 *G = rows.G + row::G * n;
    double* U_new = rows.U_new + row::U * n;
    Vec4 g[3] = {load4(G), load4(G + 4), load4(G + 8)};
    if constexpr (correction != GradientCorrection::none) {
      const double* dG = correction == GradientCorrection::lagged ? rows.lagged_dG + row::U * n
                                                                  : scratch.dG + 12 * (n - part.node_begin);
      for (int I = 0; I < 3; ++I) g[I] = g[I] + load4(dG + 4 * I);
    }
    if constexpr (std::is_same_v<Density, NodeDensity>) inverse_rho = 1.0 / rho[n];
    const double inverse_volume = rows.X[row::X * n + 3], inverse_mass = inverse_rho * inverse_volume;
    Vec4 rate = load4(scratch.force + 4 * (n - part.node_begin))
                * Vec4{inverse_mass, inverse_mass, inverse_mass, inverse_volume};
    if constexpr (areas == Areas::current && evolves_J(formulation)) rate[3] += rows.dJ[n];
    else if constexpr (evolves_J(formulation)) {
      Vec4 p = load4(PH + 4) * g[0];
      p = fma(load4(PH + 12), g[1], p);
      p = fma(load4(PH + 20), g[2], p);
      rate[3] += (p[0] + p[1]) + p[2];
    }
    const Vec4 v = load4(U_stage);
    const Vec4 F[3] = {load4(U_stage + 4), load4(U_stage + 8), load4(U_stage + 12)};
    advance(U_old, U_stage, U_new, rate);
    for (int I = 0; I < 3; ++I)
      advance(U_old + 4 * (I + 1), U_stage + 4 * (I + 1), U_new + 4 * (I + 1), Vec4{g[I][0], g[I][1], g[I][2], v[I]});
    if constexpr (formulation == Formulation::pFHJ) {
      Tensor<double> Fa, Ga;
      for (int m = 0; m < 9; ++m) {
        Fa[m % 3][m / 3] = F[m / 3][m % 3];
        Ga[m % 3][m / 3] = g[m / 3][m % 3];
      }
      const Tensor<double> dH = cross(Fa, Ga);
      for (int I = 0; I < 3; ++I)
        advance(rows.H_old + row::H * n + 4 * I, rows.H_stage + row::H * n + 4 * I, rows.H_new + row::H * n + 4 * I,
                Vec4{dH[0][I], dH[1][I], dH[2][I], 0.0});
    }
    if constexpr (correction == GradientCorrection::found)
      if (k.leaves_lagged)
        for (int I = 0; I < 3; ++I)
          store4(rows.lagged_dG + row::U * n + 4 * I, load4(scratch.dG + 12 * (n - part.node_begin) + 4 * I));
  }
}

/// What is chosen once a sweep: area vectors, and densities.
template <Formulation formulation, GradientCorrection correction>
void accumulate_update_part(const Part& part, const EdgeArrays& edges, const NodeLists& lists, const Rows& rows,
                            const Coefficients& k, const Constraint* constraints, double* reactions,
                            const Scratch& scratch) {
  const auto with = [&](auto rho) {
    gather<correction>(part, edges, lists, rows, scratch);
    constrain(part, rows, k, rho, constraints, reactions, scratch);
    if (rows.dJ) update<formulation, correction, Areas::current>(part, rows, k, rho, scratch);
    else update<formulation, correction, Areas::undeformed>(part, rows, k, rho, scratch);
  };
  rows.rho ? with(NodeDensity{rows.rho}) : with(OneDensity{k.material.rho});
}

}  // namespace nanson
