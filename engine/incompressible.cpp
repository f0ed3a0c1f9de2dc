// The projection of a stage: residual of the volume constraint with the new cofactor, linear solves with the old one until it is small, averaging, stress.
#include "engine/incompressible.hpp"

#include <fmt/format.h>

#include <cmath>

#include "engine/monitor.hpp"
#include "engine/pressure_solver.hpp"

namespace nanson {
namespace {

/// The constraint's residual and the size that it is compared with; in a closed domain without the uniform rate of dilatation that no pressure can reach.
struct Residual {
  double norm = 0, scale = 0;
};

Residual constraint_residual(Simulation& s, const ProjectionRows& rows) {
  const ProjectionSetup& p = s.domain.projection;
  const Three sum = sum_three(s, [&](const Part& part) {
    return constraint_residual_part(part, s.domain.order.edges(), s.domain.order.corners(), s.domain.order.lists(),
                                    rows, projection_coefficients(s));
  });
  Residual r{std::sqrt(sum.s[0]), std::sqrt(sum.s[1])};
  if (!p.closed) return r;
  const double mean = sum.s[2] / p.total_volume;
  r.norm = std::sqrt(sum_over_parts(s, [&](int i) { return subtract_mean_part(p.parts[i], rows, mean); }));
  return r;
}

std::string limit_met(const Simulation& s, int number, const Residual& r) {
  const ProjectionSpec& spec = s.domain.scene->projection;
  return fmt::format(
      "the projection met projection.max_iterations = {} in stage {} of step {}, t = {:.6e} s: its residual is {:.3g} "
      "of the velocity gradient, projection.tolerance = {:g}; "
      "a smaller time.cfl or better shaped tets may help",
      spec.max_iterations, number + 1, s.state.step + 1, s.state.t + s.state.dt, r.norm / r.scale, spec.tolerance);
}

std::string given_up(const Simulation& s, int number, const Residual& r) {
  return fmt::format(
      "asked to stop within the projection of stage {} of step {}: its residual is {:.3g} of the velocity gradient, "
      "projection.tolerance = {:g}",
      number + 1, s.state.step + 1, r.norm / r.scale, s.domain.scene->projection.tolerance);
}

/// Velocity and pressure of U[1] until the constraint holds. A state that is not finite is left to the stress sweep, which reports it.
std::string solve_constraint(Simulation& s, const ProjectionRows& rows, int number) {
  const ProjectionSpec& spec = s.domain.scene->projection;
  Projection& p = s.state.projection;
  long spent = 0;
  ++p.stages;
  for (;;) {
    const Residual r = constraint_residual(s, rows);
    const double goal = spec.tolerance * r.scale;
    p.residual = r.scale > 0 ? r.norm / r.scale : 0;
    if (!std::isfinite(r.norm) || r.norm <= goal) return {};
    if (spent >= spec.max_iterations) return limit_met(s, number, r);
    const int iterations =
        solve_pressure(s, rows, r.norm, goal, static_cast<int>(spec.max_iterations - spent)).iterations;
    if (asked_to_stop(p, spent + iterations)) {
      warn(s, "given_up", given_up(s, number, r));
      return {};
    }
    spent += iterations;
    p.iterations += iterations;
    p.step_iterations += iterations;
    ++p.rounds;
  }
}

double inverse_kappa(const Domain& d, int n) {
  return d.mixture.empty() ? d.projection.coefficients.inverse_kappa : d.projection.inverse_kappa[n];
}

/// U = old U^n + stage U**, U** the stage's Euler step (paper, eq. 50); at nu = 0.5 the pressure is the last stage's.
void average_part(const Part& part, const Domain& d, State& u, const ProjectedStage& rk) {
  Projection& p = u.projection;
  const auto mean = [&](double old, double stage) { return rk.old * old + rk.stage * stage; };
  for (int n = part.node_begin; n < part.node_end; ++n) {
    const double *old = &u.U[0][row::U * static_cast<std::size_t>(n)],
                 *stage = &u.U[1][row::U * static_cast<std::size_t>(n)];
    double* U = &u.U[rk.to][row::U * static_cast<std::size_t>(n)];
    const bool keeps_pressure = rk.to == 0 && inverse_kappa(d, n) == 0;
    for (int k = 0; k < row::U; ++k) U[k] = k == 3 && keeps_pressure ? stage[k] : mean(old[k], stage[k]);
    p.volume[rk.to][n] = mean(p.volume[0][n], p.volume[1][n]);
    p.taken[rk.to][n] = mean(p.taken[0][n], p.taken[1][n]);
  }
}

}  // namespace

std::string project_stage(Simulation& s, const ProjectedStage& rk) {
  const Domain& d = s.domain;
  State& u = s.state;
  Projection& p = s.state.projection;
  if (rk.number == 0) p.step_iterations = 0;
  const ProjectionCoefficients k = projection_coefficients(s);
  const std::vector<Part>& parts = d.projection.parts;
  const ProjectionRows rows = projection_rows(s, rk.from, 1);
  std::string failure;
  s.team.clock.time("projection_start", [&] {
    for_parts(s, [&](int i, Scratch) {
      projection_edges_part(parts[i], d.order.edges(), d.order.corners(), d.order.lists(), rows, k);
    });
    for_parts(s, [&](int i, Scratch) { projection_start_part(parts[i], d.order.edges(), d.order.lists(), rows, k); });
  });
  s.team.clock.time("projection", [&] { failure = solve_constraint(s, rows, rk.number); });
  s.team.clock.time("stress", [&] {
    Rows next{};
    next.X = d.X.data();
    next.U_new = u.U[rk.to].data();
    next.W_new = u.W[0].data();
    next.PH_new = u.PH[0].data();
    next.detF = u.barrier.detF.data();
    for_parts(s, [&](int i, Scratch scratch) {
      const Part& part = d.order.parts[i];
      if (rk.old != 0) average_part(part, d, u, rk);
      s.state.reports[i] = stress_of_part(d, i, next, d.coefficients, scratch);
    });
  });
  return failure;
}

}  // namespace nanson
