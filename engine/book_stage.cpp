// Dissipation, work and impulses of a stage.
#include "engine/book_stage.hpp"

#include <algorithm>
#include <cmath>

namespace nanson {
namespace {

/// -sum over rows of p times what(row) [m^3/s]: power [W] that the pressures of the rows W lose to a volume's rate that is not the motion's.
template <class What>
double power_lost(const Simulation& s, const double* W, What what) {
  return -sum_over_parts(s, [&](int p) {
    const Part& part = s.domain.projection.parts[static_cast<std::size_t>(p)];
    double sum = 0;
    for (int n = part.node_begin; n < part.node_end; ++n) sum += W[row::W * n + 3] * what(static_cast<std::size_t>(n));
    return sum;
  });
}

}  // namespace

void book_dissipation(Simulation& s, const Rows& rows, double weighted_dt) {
  s.books.dissipated += weighted_dt * tree_sum(s.team.part_sums);
  const Aligned<double>& taken = s.state.projection.taken[rows.U_stage == s.state.U[0].data() ? 0 : 1];
  if (s.domain.scene->physics.formulation == Formulation::pFp)
    s.books.dissipated += weighted_dt * power_lost(s, rows.W, [&](std::size_t n) { return taken[n]; });
}

void book_drift_control(Simulation& s, double weighted_dt) {
  const Projection& p = s.state.projection;
  s.books.dissipated += weighted_dt * power_lost(s, s.state.W[s.state.now].data(), [&](std::size_t n) {
                          return p.fixed[n] - p.lag[n];
                        });
}

void book_stage(Simulation& s, const double* arms, double mean, bool first) {
  State& u = s.state;
  Books& b = s.books;
  const double dt = mean * u.dt;
  for (std::size_t i = 0; i < u.reactions.size(); ++i)
    u.mean_reactions[i] = (first ? 0 : u.mean_reactions[i]) + mean * u.reactions[i];
  const Resultant outside = resultant(s, arms, {});
  for (std::size_t k = 0; k < 3; ++k) {
    b.impulse[k] += dt * outside.force[k];
    b.angular_impulse[k] += dt * outside.torque[k];
  }
  b.external_work += dt * sum_over_parts(s, [&](int p) {
                       const Part& part = s.domain.order.parts[static_cast<std::size_t>(p)];
                       double power = 0;
                       for (int i = part.constraint_begin; i < part.constraint_end; ++i)
                         power += u.reactions[static_cast<std::size_t>(reaction_row * i + 3)];
                       return power;
                     });
  b.largest_work = std::max(b.largest_work, std::abs(b.external_work));
}

void book_plastic_work(Simulation& s) {
  for (std::size_t p = 0; p < s.state.reports.size(); ++p) s.team.part_sums[p] = s.state.reports[p].plastic_work;
  s.books.dissipated += tree_sum(s.team.part_sums);
}

Vec3 reaction(const Simulation& s, int face) {
  Vec3 sum{};
  for (std::size_t i = 0; i < s.domain.boundary.constraints.size(); ++i) {
    const Constraint& h = s.domain.boundary.constraints[i];
    for (int m = 0; m < h.count; ++m)
      for (int k = 0; k < 3 && h.face[m] == face; ++k)
        sum[k] += s.state.mean_reactions[reaction_row * i + static_cast<std::size_t>(m)] * h.d[m][k];
  }
  return sum;
}

}  // namespace nanson
