// The material: from {v, J, F, H} to the rows that neighbours read, {v, Sigma_J} and {P|H}, eight nodes as lanes; with the step bound, the breakdown test and the
// plastic state: each stage returns from the state at the start of the step, only the last one, whose F is that of the new state, keeps what flowed.
#pragma once
#include "kernels/materials/hencky_j2.hpp"
#include "kernels/materials/linear_elastic.hpp"
#include "kernels/materials/mooney_rivlin.hpp"
#include "kernels/materials/neo_hookean.hpp"
#include "kernels/part.hpp"
#include "kernels/parting.hpp"
#include "kernels/stress_rows.hpp"
#include "kernels/tet_stiffness.hpp"

namespace nanson {

NANSON_INLINE void load_state(const double* p, PlasticState<Vec8>& z) {
  Vec8 unused;
  Vec8* C = z.C_p_inv.a;
  load_transposed(p, row::plastic, C[0], C[1], C[2], z.eps_p);
  load_transposed(p + 4, row::plastic, C[3], C[4], C[5], unused);
}
NANSON_INLINE void store_state(double* p, const PlasticState<Vec8>& z) {
  const Vec8* C = z.C_p_inv.a;
  store_transposed(p, row::plastic, C[0], C[1], C[2], z.eps_p);
  store_transposed(p + 4, row::plastic, C[3], C[4], C[5], Vec8{});
}

/// sigma = P F^T / J: what fluxes with current areas take in place of H (method, section 8). [Pa]
NANSON_INLINE Tensor<Vec8> cauchy_stress(const Tensor<Vec8>& P, const Tensor<Vec8>& F, Vec8 J) {
  const Vec8 inverse_J = 1.0 / J;
  Tensor<Vec8> sigma;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      sigma[i][j] = fma(P[i][2], F[j][2], fma(P[i][1], F[j][1], P[i][0] * F[j][0])) * inverse_J;
  return sigma;
}

/// P + dP of the last stage: what the first stage of the next step averages (full flux correction).
NANSON_INLINE void add_lagged(Tensor<Vec8>& P, const double* dP) {
  Vec8 d[3], unused;
  for (int I = 0; I < 3; ++I) {
    load_transposed(dP + 4 * I, row::dP, d[0], d[1], d[2], unused);
    for (int i = 0; i < 3; ++i) P[i][I] = P[i][I] + d[i];
  }
}

/// Fastest reference-frame speed of a node: the acoustic one, and that of the J stabilisation where J is evolved, U''|H N|/(rho0 c_J), or with the paper's
/// upwinding U''|H N|^2/(rho0 c_J), with |H N| <= |H| (method, section 6). [m/s]
/// The three choices are of the sweep; each is a constant, for a body without the branch, or a bool.
template <class Own, Formulation formulation, class Current, class Parted, class Commits>
PartReport stress_sweep(const Part& part, const Rows& rows, const Coefficients& k, const double* step_length,
                        Current current_areas, Parted parted, Commits commits) {
  const double inverse_rho = 1.0 / k.material.rho, inverse_rho_cJ = 1.0 / k.rho_cJ, c_tets = k.material.tet_stiffness;
  Vec8 fastest{}, plastic_work{};
  Mask8 broken{};
  for (int n = part.node_begin; n < part.node_end; n += 8) {
    const double* U = rows.U_new + row::U * n;
    Vec8 v[3], x[3], u[3], J, unused;
    Tensor<Vec8> F, H;
    load_transposed(U, row::U, v[0], v[1], v[2], J);
    for (int I = 0; I < 3; ++I) load_transposed(U + 4 * (I + 1), row::U, F[0][I], F[1][I], F[2][I], x[I]);
    if constexpr (formulation == Formulation::pFHJ)
      for (int I = 0; I < 3; ++I)
        load_transposed(rows.H_new + row::H * n + 4 * I, row::H, H[0][I], H[1][I], H[2][I], unused);
    Stress<Vec8> s;
    Mask8 sound = Vec8{} == 0.0;
    if constexpr (Own::traits.has_state) {
      typename Own::template State<Vec8> z;
      load_state(rows.plastic + row::plastic * n, z);
      const auto r = Own::return_mapping(F, z, k.material);
      s = Own::stress(F, H, J, r, k.material);
      sound = r.q - r.q == 0.0;
      if (commits) {
        Vec8 X[3], inverse_volume;
        load_transposed(rows.X + row::X * n, row::X, X[0], X[1], X[2], inverse_volume);
        plastic_work = plastic_work + r.plastic_work / inverse_volume;
        if (any(r.d_gamma > 0.0)) store_state(rows.plastic_new + row::plastic * n, Own::flowed(F, z, r));
      }
    } else {
      s = Own::stress(F, H, J, k.material);
    }
    if constexpr (evolves_J(formulation))
      if (parted) add_parting(s, F, J, k.material.parting);
    if (c_tets > 0) add_tet_stiffness(s.P, F, c_tets, current_areas);
    find_displacement(rows, n, x, c_tets > 0, u);
    if (rows.detF) store8(rows.detF + n, s.detF);
    if (k.leaves_lagged && rows.dP) add_lagged(s.P, rows.dP + row::dP * n);

    const Vec8 swept = !k.sweeps_J ? s.Sigma_J : evolves_J(formulation) ? J : s.detF;
    if (current_areas)
      store_rows(rows, n, v, swept, s.P, cauchy_stress(s.P, F, evolves_J(formulation) ? J : s.detF), u, k.streams);
    else store_rows(rows, n, v, swept, s.P, s.H, u, k.streams);
    Vec8 c = root(s.rho_c2 * inverse_rho);
    if constexpr (evolves_J(formulation) && !Own::traits.is_linear)
      c = larger(c, s.d2U * inverse_rho_cJ * (k.edge.deformed_metric ? root(s.H2) : s.H2));
    const Vec8 rate = c / load8(step_length + n);
    fastest = larger(rate, fastest);
    const Vec8 size = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    sound = sound & (s.detF > 0.0) & (size - size == 0.0);
    if constexpr (evolves_J(formulation)) sound = sound & (J > 0.0);
    broken = broken | ~sound;
  }
  if (k.streams) finish_streams();
  double work = 0;
  for (int i = 0; i < 8; ++i) work += plastic_work[i];
  return {largest(fastest), any(broken), work};
}

/// A body for every choice; but a law with a state, whose return outweighs any branch, decides eight nodes at a time.
template <Law law, Volumetric volumetric, Isochoric isochoric, Formulation formulation>
PartReport stress_part(const Part& part, const Rows& rows, const Coefficients& k, const double* step_length) {
  using Own = Material<law, volumetric, isochoric, formulation>;
  const auto sweep = [&](auto current_areas, auto parted, auto commits) {
    return stress_sweep<Own, formulation>(part, rows, k, step_length, current_areas, parted, commits);
  };
  constexpr std::true_type yes;
  constexpr std::false_type no;
  const bool parted = k.material.parting > 0;
  if constexpr (Own::traits.has_state) {
    return sweep(k.current_areas, parted, k.commits);
  } else if constexpr (Own::traits.is_linear) {
    return sweep(no, no, no);
  } else {
    if constexpr (evolves_J(formulation))
      if (parted) return k.current_areas ? sweep(yes, yes, no) : sweep(no, yes, no);
    return k.current_areas ? sweep(yes, no, no) : sweep(no, no, no);
  }
}

/// Eight nodes at a time, those past the part's end without weight.
template <Law law, Volumetric volumetric, Isochoric isochoric, Formulation formulation>
double strain_energy_part(const Part& part, const Rows& rows, const Coefficients& k) {
  using Own = Material<law, volumetric, isochoric, formulation>;
  Vec8 total{};
  for (std::ptrdiff_t n = part.node_begin; n < part.node_end; n += 8) {
    const double* U = rows.U_stage + row::U * n;
    Vec8 v[3], X[3], J, x, inverse_volume, density;
    Tensor<Vec8> F, H{};
    load_transposed(U, row::U, v[0], v[1], v[2], J);
    for (int I = 0; I < 3; ++I) load_transposed(U + 4 * (I + 1), row::U, F[0][I], F[1][I], F[2][I], x);
    if constexpr (formulation == Formulation::pFHJ)
      for (int I = 0; I < 3; ++I)
        load_transposed(rows.H_stage + row::H * n + 4 * I, row::H, H[0][I], H[1][I], H[2][I], x);
    if constexpr (Own::traits.has_state) {
      typename Own::template State<Vec8> z;
      load_state(rows.plastic + row::plastic * n, z);
      density = Own::energy(F, J, z, k.material);
    } else {
      density = Own::energy(F, H, J, k.material);
    }
    if constexpr (evolves_J(formulation))
      if (k.material.parting > 0) density = density + parting_energy(F, J, k.material.parting);
    if (k.material.tet_stiffness > 0) density = density + tet_stiffness_energy(F, k.material.tet_stiffness);
    load_transposed(rows.X + row::X * n, row::X, X[0], X[1], X[2], inverse_volume);
    total = total + choose(first_lanes(part.node_end - n), density / inverse_volume, Vec8{});
  }
  return sum(total);
}

}  // namespace nanson
