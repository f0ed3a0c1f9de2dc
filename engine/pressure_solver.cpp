// Jacobi-preconditioned conjugate gradients without a matrix, and the damped pseudo-time iteration. Sums over parts are trees: bitwise the same for any threads.
// In a closed domain the constant is in the kernel of K: K is used between P = I - 1 Omega^T/V and its transpose, so that increments have the mean zero
// and residuals the sum zero; what is left over is one uniform rate of dilatation.
#include "engine/pressure_solver.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/pressure_iteration.hpp"

namespace nanson {
namespace {

/// The sweeps of an iteration over all parts.
struct Sweeps {
  Simulation& s;
  const ProjectionRows& rows;
  const ProjectionCoefficients k = projection_coefficients(s);
  const EdgeArrays edges = s.domain.order.edges();
  const CornerArrays corners = s.domain.order.corners();
  const NodeLists lists = s.domain.order.lists();
  const bool closed = s.domain.projection.closed;
  const double total_volume = s.domain.projection.total_volume;

  double mean(double sum) const { return closed ? sum / total_volume : 0.0; }
  void force(double keep, double step) {
    for_parts(s, [&](int p, Scratch) {
      pressure_force_part(s.domain.projection.parts[p], edges, corners, lists, rows, k, keep, step);
    });
  }
  Three apply() {
    return sum_three(s, [&](const Part& part) { return pressure_operator_part(part, edges, corners, lists, rows, k); });
  }
  Three step(double alpha, double mean_of_Kd) {
    return sum_three(s, [&](const Part& part) {
      return pressure_step_part(part, rows, alpha, mean_of_Kd, s.state.reactions.data());
    });
  }
  void direction(double mean_of_z, double beta) {
    for_parts(s, [&](int p, Scratch) { pressure_direction_part(s.domain.projection.parts[p], rows, mean_of_z, beta); });
  }
};

PressureSolve conjugate_gradients(Sweeps& sweep, double norm, double goal, int most) {
  PressureSolve out{0, norm};
  Three z = sweep.step(0, 0);
  sweep.direction(sweep.mean(z.s[2]), 0);
  while (out.norm > goal && out.iterations < most && !asked_to_stop(sweep.s.state.projection, out.iterations)) {
    sweep.force(0, sweep.k.dt);
    const Three Kd = sweep.apply();
    ++out.iterations;
    if (!(Kd.s[0] > 0)) break;
    const Three next = sweep.step(z.s[1] / Kd.s[0], sweep.mean(Kd.s[1]));
    sweep.direction(sweep.mean(next.s[2]), next.s[1] / z.s[1]);
    z = next;
    out.norm = std::sqrt(z.s[0]);
  }
  return out;
}

PressureSolve pseudo_time(Sweeps& sweep, double length, double norm, double goal, int most) {
  Simulation& s = sweep.s;
  Projection& p = s.state.projection;
  const double dt = sweep.k.dt, speed = length / dt, gamma = sweep.k.rho * speed * speed;
  for_parts(s, [&](int i, Scratch) {
    s.team.part_sums[i] = pseudo_step_part(s.domain.projection.parts[i], sweep.edges, sweep.rows, 1 / speed);
  });
  const double dtau = *std::min_element(s.team.part_sums.begin(), s.team.part_sums.end()), keep = 1 / (1 + dtau / dt);
  std::fill(p.d.begin(), p.d.end(), 0.0);
  std::fill(p.Kd.begin(), p.Kd.end(), 0.0);
  std::fill(p.V.begin(), p.V.end(), 0.0);
  std::fill(p.removed.begin(), p.removed.end(), 0.0);
  PressureSolve out{0, norm};
  double mean = 0, sum = 0;
  while (out.norm > goal && out.iterations < most && !asked_to_stop(p, out.iterations)) {
    sum = sum_over_parts(s, [&](int i) {
      return pseudo_pressure_part(s.domain.projection.parts[i], sweep.rows, sweep.k, gamma * dtau, mean);
    });
    sweep.force(keep, keep * dtau);
    mean = sweep.mean(sweep.apply().s[1]);
    ++out.iterations;
    out.norm = std::sqrt(
        sum_over_parts(s, [&](int i) { return pseudo_residual_part(s.domain.projection.parts[i], sweep.rows, mean); }));
  }
  if (sweep.closed)
    for (double& d : p.d) d -= sum / sweep.total_volume;
  sweep.step(1, 0);
  return out;
}

}  // namespace

ProjectionCoefficients projection_coefficients(const Simulation& s) {
  ProjectionCoefficients k = s.domain.projection.coefficients;
  k.dt = s.state.dt;
  return k;
}

bool asked_to_stop(const Projection& p, long iterations) {
  constexpr long patience = 1000;  // a stage takes ten or so: what a signal finds at work ends as it would without
  return iterations >= patience && p.asked_to_stop && p.asked_to_stop();
}

ProjectionRows projection_rows(Simulation& s, int from, int to) {
  State& u = s.state;
  Projection& p = s.state.projection;
  return {s.domain.X.data(),
          u.W[u.now].data(),
          u.PH[u.now].data(),
          u.G.data(),
          s.domain.step_length.data(),
          s.domain.boundary.constraints.data(),
          s.domain.projection.held.data(),
          p.E.data(),
          p.B.data(),
          u.U[1].data(),
          p.H.data(),
          p.volume[from].data(),
          p.taken[from].data(),
          p.volume[to].data(),
          p.taken[to].data(),
          p.fixed.data(),
          p.lag.data(),
          p.inverse_diagonal.data(),
          p.weight_sum.data(),
          p.R.data(),
          p.d.data(),
          p.V.data(),
          p.Kd.data(),
          p.removed.data(),
          s.domain.mixture.empty() ? nullptr : s.domain.mixture.rho.data(),
          s.domain.mixture.empty() ? nullptr : s.domain.projection.inverse_kappa.data()};
}

PressureSolve solve_pressure(Simulation& s, const ProjectionRows& rows, double norm, double goal, int most) {
  Sweeps sweep{s, rows};
  const ProjectionSpec& spec = s.domain.scene->projection;
  return spec.solver == ProjectionSolver::cg ? conjugate_gradients(sweep, norm, goal, most)
                                             : pseudo_time(sweep, spec.length_scale, norm, goal, most);
}

}  // namespace nanson
