// A tet is evaluated by every part that it has a node in, as edges are: no list of a part depends on another's, and what a tet does to two parts is the same to the bit.
#include "engine/tet_barrier.hpp"

#include <algorithm>
#include <cmath>

#include "engine/parts.hpp"
#include "kernels/tet_barrier.hpp"

namespace nanson {
namespace {

/// visit(index in the list, lane, share, mean det F, eight tets) for the crushed ones of a list.
template <class Visit>
void visit_crushed(const TetArrays& tets, const std::vector<int>& list, std::size_t count, const double* U,
                   const double* detF, Visit visit) {
  for (std::size_t at = 0; at < count; at += 8) {
    const std::ptrdiff_t left = static_cast<std::ptrdiff_t>(count - at);
    const EightTets eight = pick(tets, list.data() + at, left);
    const Shares s = shares(eight.arrays(), 0, U, detF);
    const Mask8 crushed = (s.share < crushed_share) & first_lanes(left);
    if (!any(crushed)) continue;
    for (int i = 0; i < 8; ++i)
      if (crushed[i]) visit(i, s.share[i], s.mean_detF[i], eight);
  }
}

double modulus_at(const Domain& d, const EightTets& tets, int lane) {
  if (d.mixture.empty()) return d.coefficients.material.tet_barrier;
  double sum = 0;
  for (const auto& corner : tets.corner) sum += mean_at(d.mixture, corner[lane], &MaterialConstants::tet_barrier);
  return 0.25 * sum;
}

double least_density(const Domain& d, const EightTets& tets, int lane) {
  double least = density(d, tets.corner[0][lane]);
  for (const auto& corner : tets.corner) least = std::min(least, density(d, corner[lane]));
  return least;
}

/// The weight of cof F of a row goes into its stress: sigma += (det F/J) I with current areas.
void add_to_stress(const Domain& d, const double* U, const double* X, double weight, double* PH) {
  Tensor<double> F;
  for (int m = 0; m < 9; ++m) F[m % 3][m / 3] = U[4 * (m / 3 + 1) + m % 3];
  const Tensor<double> cof = cofactor(F);
  const double of_cell = weight * X[3];
  for (int m = 0; m < 9; ++m) PH[8 * (m / 3) + m % 3] += of_cell * cof[m % 3][m / 3];
  if (!d.coefficients.current_areas) return;
  const double sigma = evolves_J(d.scene->physics.formulation) ? of_cell * determinant(F, cof) / U[3] : of_cell;
  for (int i = 0; i < 3; ++i) PH[8 * i + 4 + i] += sigma;
}

void resist_in_part(Simulation& s, std::size_t p, const Rows& rows) {
  const Domain& d = s.domain;
  const Part& part = d.order.parts[p];
  TetBarrier& barrier = s.state.barrier;
  WatchedTets& watched = barrier.parts[p];
  double* force = barrier.force.data();
  for (const int n : watched.touched) std::fill_n(force + 4 * static_cast<std::ptrdiff_t>(n), 4, 0.0);
  watched.touched.clear();
  watched.rate2 = 0;
  const TetArrays tets = d.tets.arrays();
  const auto add = [&](int lane, double share, double mean_detF, const EightTets& eight) {
    double x[4][3];
    for (int a = 0; a < 4; ++a)
      for (int i = 0; i < 3; ++i)
        x[a][i] = rows.U_stage[row::U * static_cast<std::ptrdiff_t>(eight.corner[a][lane]) + 4 * (i + 1) + 3];
    const CrushedTet t = crushed_tet(x, eight.volume6[lane], mean_detF, share, modulus_at(d, eight, lane),
                                     least_density(d, eight, lane));
    watched.rate2 = std::max(watched.rate2, t.rate2);
    for (int a = 0; a < 4; ++a) {
      const int n = eight.corner[a][lane];
      if (n < part.node_begin || n >= part.node_end) continue;
      double* f = force + 4 * static_cast<std::ptrdiff_t>(n);
      for (int i = 0; i < 3; ++i) f[i] += t.force[a][i];
      f[3] += t.weight[a];
      watched.touched.push_back(n);
    }
  };
  visit_crushed(tets, watched.tets, watched.tets.size(), rows.U_stage, barrier.detF.data(), add);
  double* PH = s.state.PH[s.state.now].data();  // the stage's own, read by nobody yet
  for (const int n : watched.touched) {
    double& weight = force[4 * static_cast<std::ptrdiff_t>(n) + 3];
    if (weight == 0) continue;
    add_to_stress(d, rows.U_stage + row::U * static_cast<std::ptrdiff_t>(n),
                  rows.X + row::X * static_cast<std::ptrdiff_t>(n), weight,
                  PH + row::PH * static_cast<std::ptrdiff_t>(n));
    weight = 0;  // lane 3 of a force is the source of J
  }
}

}  // namespace

void watch_tets(Simulation& s) {
  const TetArrays tets = s.domain.tets.arrays();
  const double *U = s.state.U[0].data(), *detF = s.state.barrier.detF.data();
  for_parts(s, [&](int part, Scratch) {
    const std::size_t p = static_cast<std::size_t>(part);
    const Tets& all = s.domain.tets;
    WatchedTets& watched = s.state.barrier.parts[p];
    watched.tets.clear();
    const auto list = [&](Vec8 share, std::ptrdiff_t left, auto tet) {
      const Mask8 near = (share < watched_share) & first_lanes(left);
      if (!any(near)) return;
      for (int i = 0; i < 8; ++i)
        if (near[i]) watched.tets.push_back(tet(i));
    };
    for (int t = all.first[p]; t < all.last[p]; t += 8)
      list(shares(tets, t, U, detF).share, all.last[p] - t, [&](int i) { return t + i; });
    watched.own = watched.tets.size();
    for (int at = all.first_foreign[p]; at < all.first_foreign[p + 1]; at += 8) {
      const int *which = all.foreign.data() + at, left = all.first_foreign[p + 1] - at;
      list(shares(pick(tets, which, left).arrays(), 0, U, detF).share, left, [&](int i) { return which[i]; });
    }
  });
  s.state.barrier.is_watched = true;
}

const double* resist_crushing(Simulation& s, const Rows& rows) {
  TetBarrier& barrier = s.state.barrier;
  const auto is_idle = [](const WatchedTets& w) { return w.tets.empty() && w.touched.empty(); };
  barrier.fastest = 0;
  if (std::ranges::all_of(barrier.parts, is_idle)) return nullptr;
  for_parts(s, [&](int p, Scratch) { resist_in_part(s, static_cast<std::size_t>(p), rows); });
  double rate2 = 0;
  for (const WatchedTets& w : barrier.parts) rate2 = std::max(rate2, w.rate2);
  barrier.fastest = crushing_margin * std::sqrt(rate2);
  return rate2 > 0 ? barrier.force.data() : nullptr;
}

double crushing_energy(const Simulation& s) {
  const TetArrays tets = s.domain.tets.arrays();
  return sum_over_parts(s, [&](int p) {
    const WatchedTets& watched = s.state.barrier.parts[static_cast<std::size_t>(p)];
    double sum = 0;
    visit_crushed(tets, watched.tets, watched.own, s.state.U[0].data(), s.state.barrier.detF.data(),
                  [&](int lane, double share, double, const EightTets& eight) {
                    sum += eight.volume6[lane] / 6 * modulus_at(s.domain, eight, lane) * crushing(share).phi;
                  });
    return sum;
  });
}

}  // namespace nanson
