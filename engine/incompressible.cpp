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

/// U^(n+1) = (U^n + U**)/2 (paper, eq. 50); at nu = 0.5 the pressure is the last stage's.
void average_part(const Part& part, State& u, bool keeps_pressure) {
  Projection& p = u.projection;
  for (int n = part.node_begin; n < part.node_end; ++n) {
    double *U = &u.U[0][row::U * static_cast<std::size_t>(n)], *last = &u.U[1][row::U * static_cast<std::size_t>(n)];
    for (int k = 0; k < row::U; ++k) U[k] = k == 3 && keeps_pressure ? last[k] : 0.5 * (U[k] + last[k]);
    p.volume[0][n] = 0.5 * (p.volume[0][n] + p.volume[1][n]);
    p.taken[0][n] = 0.5 * (p.taken[0][n] + p.taken[1][n]);
  }
}

}  // namespace

std::string project_stage(Simulation& s, int number) {
  const Domain& d = s.domain;
  State& u = s.state;
  Projection& p = s.state.projection;
  if (number == 0) p.step_iterations = 0;
  const ProjectionCoefficients k = projection_coefficients(s);
  const std::vector<Part>& parts = d.projection.parts;
  const ProjectionRows rows = projection_rows(s, number, 1);
  std::string failure;
  s.team.clock.time("projection_start", [&] {
    for_parts(s, [&](int i, Scratch) {
      projection_edges_part(parts[i], d.order.edges(), d.order.corners(), d.order.lists(), rows, k);
    });
    for_parts(s, [&](int i, Scratch) { projection_start_part(parts[i], d.order.edges(), d.order.lists(), rows, k); });
  });
  s.team.clock.time("projection", [&] { failure = solve_constraint(s, rows, number); });
  s.team.clock.time("stress", [&] {
    Rows next{};
    next.X = d.X.data();
    next.U_new = u.U[number == 0 ? 1 : 0].data();
    next.W_new = u.W[0].data();
    next.PH_new = u.PH[0].data();
    for_parts(s, [&](int i, Scratch) {
      const Part& part = d.order.parts[i];
      if (number == 1) average_part(part, u, k.inverse_kappa == 0);
      s.state.reports[i] = d.functions.stress(part, next, d.coefficients, d.step_length.data());
    });
  });
  return failure;
}

}  // namespace nanson
