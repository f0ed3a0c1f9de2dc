// The time loop: run, step, stage (paper, eq. 50), and the sweeps of a stage over parts.
#include "engine/solver.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "engine/angular_momentum.hpp"
#include "engine/book_stage.hpp"
#include "engine/current_areas.hpp"
#include "engine/forces.hpp"
#include "engine/incompressible.hpp"
#include "engine/monitor.hpp"
#include "engine/parts.hpp"
#include "engine/time_function.hpp"

namespace nanson {
namespace {

/// U_new = old U_old + stage (U_stage + dt dU/dt).
struct RungeKuttaStage {
  double old, stage;
  double mean;   // the stage's share in the step's mean rate
  double at;     // [dt] after t: the time of the state whose rates it takes
  int from, to;  // rows of U that it takes its rates of and writes
  bool last;
  bool at_the_next;  // its rates are of t + dt: the next step's first stage takes its flux correction
};
constexpr RungeKuttaStage tvd_rk2[] = {{0, 1, 0.5, 0, 0, 1, false, false}, {0.5, 0.5, 0.5, 1, 1, 0, true, true}};
constexpr RungeKuttaStage ssp_rk3[] = {{0, 1, 1.0 / 6, 0, 0, 1, false, false},
                                       {0.75, 0.25, 1.0 / 6, 1, 1, 1, false, false},
                                       {1.0 / 3, 2.0 / 3, 2.0 / 3, 0.5, 1, 0, true, false}};

std::span<const RungeKuttaStage> stages_of(const Scene& scene) {
  if (scene.time.integrator == Integrator::tvd_rk2) return tvd_rk2;
  return ssp_rk3;
}

bool broken(const Simulation& s) {
  return std::any_of(s.state.reports.begin(), s.state.reports.end(), [](const PartReport& r) { return r.broken; });
}

Coefficients coefficients_of(const Simulation& s, const RungeKuttaStage& rk) {
  Coefficients k = s.domain.coefficients;
  const bool projected = s.domain.scene->physics.formulation
                         == Formulation::pFp;  // an Euler step that the projection averages
  k.old_weight = projected ? 0 : rk.old;
  k.stage_weight = projected ? 1 : rk.stage;
  k.dt = k.stage_weight * s.state.dt;
  k.commits = rk.last;
  k.takes_lagged = rk.from == 0 && s.state.has_lagged_correction;
  k.leaves_lagged = rk.at_the_next && s.domain.scene->physics.flux_correction != FluxCorrection::none;
  k.acceleration = s.state.acceleration.data();
  return k;
}

/// Two sweeps over the parts: gradients; then fluxes, gather, update and the next stress while the part is in cache (one sweep with constant reconstruction).
/// The incompressible scheme projects before the stress. Returns why the run must not go on, or nothing.
std::string stage(Simulation& s, int number, const RungeKuttaStage& rk) {
  const Domain& d = s.domain;
  State& u = s.state;
  const PhysicsSpec& physics = d.scene->physics;
  const bool projected = physics.formulation == Formulation::pFp, keeps = physics.keep_angular_momentum;
  const bool neighbours = physics.reconstruction != Reconstruction::constant || projected;  // read their gradients
  const Coefficients k = coefficients_of(s, rk);
  const PartFunctions& functions = k.takes_lagged ? d.lagged_functions : d.functions;
  Rows rows = stage_rows(d, u, rk.from, projected ? 1 : rk.to);
  const auto edges = d.order.edges();
  const auto corners = d.order.corners();
  const auto lists = d.order.lists();
  const EdgeArrays edges_of_flux = flux_edges(s);
  const CornerArrays corners_of_flux = flux_corners(s);
  const double* arms = u.U[0].data();  // of angular momentum, TVD-RK2: x^n, then x^(n+1)

  s.team.clock.time("forces", [&] {
    find_forces(s, rows.U_stage, u.t + rk.at * u.dt);
    s.books.external_work += rk.mean * u.dt * power_of_loads(s, rows.W);
  });
  if (physics.tet_barrier > 0) s.team.clock.time("tet_barrier", [&] { rows.crushing = resist_crushing(s, rows); });
  if (has_current_areas(physics.description))
    s.team.clock.time("current_areas", [&] { find_current_areas(s, rows.U_stage); });
  if (neighbours)
    s.team.clock.time("gradient", [&] {
      for_parts(s, [&](int p, Scratch) { functions.gradient(d.order.parts[p], edges, corners, lists, rows, k); });
    });
  if (functions.corrects_stress) {  // what the edges read and what the stress overwrites change places
    std::swap(u.PH[0], u.PH[1]);
    rows.PH = u.PH[u.now].data();
    rows.PH_new = u.PH[1 - u.now].data();
  }
  s.team.clock.time("flux_update_stress", [&] {
    for_parts(s, [&](int p, Scratch scratch) {
      const Part& part = d.order.parts[p];
      Rows mine = rows;
      if (!neighbours) {  // gradients of this part only, as dF/dt
        mine.G = scratch.dG - row::G * static_cast<std::ptrdiff_t>(part.node_begin);
        functions.gradient(part, edges, corners, lists, mine, k);
      }
      s.team.part_sums[p] = functions.edge_flux(part, edges_of_flux, corners_of_flux, lists, mine, k, scratch);
      functions.accumulate_update(part, edges, lists, mine, k, d.boundary.constraints.data(), u.reactions.data(),
                                  scratch);
      if (keeps) sum_moments(s, rows, arms, p, scratch);
      if (!projected) u.reports[p] = stress_of_part(d, p, mine, k, scratch);
    });
  });
  if (d.scene->monitor.energy) s.team.clock.time("monitor.energy", [&] { book_dissipation(s, rows, rk.mean * u.dt); });
  if (keeps && !broken(s))
    s.team.clock.time("keep_angular_momentum", [&] {
      s.books.angular_momentum_work += rk.mean * u.dt * keep_angular_momentum(s, rows, k, arms);
    });
  const std::string failure = projected ? project_stage(s, {number, rk.old, rk.stage, rk.from, rk.to}) : std::string();
  if (projected && d.scene->monitor.energy) book_drift_control(s, rk.mean * u.dt);
  book_stage(s, arms, rk.mean, rk.from == 0);
  if (!projected) u.now = 1 - u.now;
  u.has_lagged_correction = k.leaves_lagged;
  return failure;
}

/// Rate of each condition's time factor over the step: prescribed velocities are then exact at t + dt, in every Runge-Kutta stage.
void prescribe(const Boundary& boundary, State& u) {
  for (std::size_t i = 0; i < u.acceleration.size(); ++i) {
    const BoundarySpec& c = boundary.conditions[i];
    u.acceleration[i] = c.kind == BoundaryKind::velocity ? (value_at(c.time, u.t + u.dt) - value_at(c.time, u.t)) / u.dt
                                                         : 0.0;
  }
}

/// The step for the rest of the way: at most 5 % larger than the last, and `end` is hit by sharing the last two steps.
double next_step(const Simulation& s) {
  const TimeSpec& time = s.domain.scene->time;
  double dt = allowed_step(s);
  if (s.state.step > 0) dt = std::min(dt, 1.05 * s.state.dt);
  if (time.dt_max > 0) dt = std::min(dt, time.dt_max);
  const double left = time.end - s.state.t;
  return left <= dt ? left : left < 2 * dt ? 0.5 * left : dt;
}

/// The first multiple of `every` after t; t itself where multiples are too close for t's digits: then every step has a frame.
double next_multiple(double every, double t) {
  const double next = every * (std::floor(t / every) + 1);
  return next > t && next <= t + every ? next : t;
}

/// Whether to go on after a step: done (so far) | breakdown | stopped, with the reason.
std::string judge_step(Simulation& s, const std::function<std::string()>& asked_to_stop, std::string& reason) {
  const TimeSpec& time = s.domain.scene->time;
  const double allowed = allowed_step(s);
  if (!(allowed >= time.dt_collapse * s.state.first_dt)) {
    s.breakdown = collapse(s, allowed);
    reason = s.breakdown->text;
    return "breakdown";
  }
  if (s.state.step % s.domain.scene->output.history_every == 0 || s.state.t >= time.end) {
    s.team.clock.time("watch", [&] {
      look(s);
      s.breakdown = ruin(s);
    });
    if (s.breakdown) {
      reason = s.breakdown->text;
      return "breakdown";
    }
  }
  if (s.state.t >= time.end) return "done";
  if (time.max_steps > 0 && s.state.step >= time.max_steps) {
    reason = "time.max_steps reached";
    s.stopped_by = "max_steps";
  } else if (time.max_wall_s > 0 && s.team.wall_s - s.team.earlier_wall_s >= time.max_wall_s) {
    reason = "time.max_wall_s reached";
    s.stopped_by = "max_wall_s";
  } else if (asked_to_stop) {
    reason = asked_to_stop();
    s.stopped_by = reason.empty() ? "" : "signal";
  }
  return reason.empty() ? "done" : "stopped";
}

}  // namespace

void advance(Simulation& s) {
  State& u = s.state;
  prescribe(s.domain.boundary, u);
  if (s.domain.scene->physics.tet_barrier > 0 && (!u.barrier.is_watched || u.step % watch_steps == 0))
    s.team.clock.time("tet_barrier", [&] { watch_tets(s); });
  int number = 0;
  for (const RungeKuttaStage& rk : stages_of(*s.domain.scene)) {
    const std::string failure = stage(s, number, rk);
    ++number;
    const bool stop = !failure.empty() && s.domain.scene->projection.on_limit == OnLimit::stop;
    if (!failure.empty() && !stop) warn(s, "iteration_limit", failure);
    if (!broken(s) && !stop) continue;
    if (!rk.last) {
      u.U[0] = u.U[1];
      u.H[0] = u.H[1];
    }
    s.breakdown = broken(s) ? locate_breakdown(s, number) : Breakdown{-1, failure, "iteration_limit"};
    break;
  }
  if (s.domain.scene->monitor.energy) book_plastic_work(s);
  u.t += u.dt;
  ++u.step;
}

namespace {

/// The row and the frame that the state is due. What a run tells is a matter of its state alone: one that goes on from a checkpoint tells the same.
void tell_what_is_due(Simulation& s, const Observer& observer) {
  const OutputSpec& output = s.domain.scene->output;
  State& u = s.state;
  if (u.step % output.history_every == 0 && observer.on_history) observer.on_history(s);
  if (u.step % output.history_every == 0) u.last_history = u.step;
  const bool first = u.step == 0, due = first || (output.every > 0 && u.t >= u.next_frame);
  if (due && observer.on_frame) observer.on_frame(s);
  if (due) u.last_frame = u.step;
  if (due && !first) u.next_frame = next_multiple(output.every, u.t);
}

/// Asked to stop, the last step's projection did not end as it would have: nobody should go on from there.
bool was_cut_short(const Simulation& s) {
  return std::ranges::any_of(s.watch.warnings, [](const Warning& w) { return w.cause == "given_up"; });
}

/// What has not been told of the last state.
void tell_the_rest(Simulation& s, const Observer& observer) {
  const State& u = s.state;
  if (u.last_history < u.step && s.watch.step != u.step) look(s);
  if (u.last_history < u.step && observer.on_history) observer.on_history(s);
  if (u.last_frame < u.step && observer.on_frame) observer.on_frame(s);
}

}  // namespace

std::string run(Simulation& s, const Observer& observer, std::string& reason) {
  const TimeSpec& time = s.domain.scene->time;
  State& u = s.state;
  s.team.earlier_wall_s = s.team.wall_s;
  const double wall = wall_seconds() - s.team.wall_s, cpu = cpu_seconds() - s.team.cpu_s;
  const auto read_clocks = [&] {
    s.team.wall_s = wall_seconds() - wall;
    s.team.cpu_s = cpu_seconds() - cpu;
  };
  std::string status = "done";
  if (s.watch.step < 0) look(s);
  for (;;) {
    const bool ends = status != "done" || u.t >= time.end;
    if (status != "breakdown" && !was_cut_short(s) && observer.on_checkpoint) observer.on_checkpoint(s, ends);
    if (status == "done") tell_what_is_due(s, observer);
    if (ends) break;
    u.dt = next_step(s);
    const bool last = u.dt == time.end - u.t;
    if (u.step == 0) u.first_dt = u.dt_min = u.dt_max = u.dt;
    advance(s);
    if (last) u.t = time.end;
    u.dt_min = std::min(u.dt_min, u.dt);
    u.dt_max = std::max(u.dt_max, u.dt);
    read_clocks();
    if (s.breakdown) {
      status = "breakdown";
      reason = s.breakdown->text;
    } else status = judge_step(s, observer.stop, reason);
    if (observer.on_step) observer.on_step(s);
  }
  read_clocks();
  tell_the_rest(s, observer);
  return status;
}

}  // namespace nanson
