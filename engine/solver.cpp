// The time loop: run, step, stage (paper, eq. 50), and the sweeps of a stage over parts.
#include "engine/solver.hpp"

#include <algorithm>
#include <cmath>

#include "engine/angular_momentum.hpp"
#include "engine/incompressible.hpp"
#include "engine/monitor.hpp"
#include "engine/parts.hpp"
#include "engine/time_function.hpp"

namespace nanson {
namespace {

/// U_new = old U_old + stage (U_stage + dt dU/dt); `mean` is the stage's share in the step's mean rate.
struct RungeKuttaStage {
  double old, stage, mean;
};
constexpr RungeKuttaStage tvd_rk2[] = {{0, 1, 0.5}, {0.5, 0.5, 0.5}};
constexpr RungeKuttaStage projected_rk2[] = {{0, 1, 0.5}, {0, 1, 0.5}};  // the projection averages itself
constexpr RungeKuttaStage ssp_rk3[] = {{0, 1, 1.0 / 6}, {0.75, 0.25, 1.0 / 6}, {1.0 / 3, 2.0 / 3, 2.0 / 3}};

/// Force on each corner of the loaded faces at time t, on the stage's geometry; returns their sum [N].
Vec3 compute_loads(Simulation& s, const double* U, double t) {
  Vec3 sum{};
  std::fill(s.state.loads.begin(), s.state.loads.end(), 0.0);
  for (const LoadedFace& f : s.boundary.loaded) {
    const double factor = value_at(s.boundary.conditions[static_cast<std::size_t>(f.condition)].time, t);
    Vec3 force = f.corner_force;
    if (f.kind
        == BoundaryKind::
            pressure) {  // -p a/3, a = (x_b - x_a) x (x_c - x_a)/2: the resultant of a closed surface is exactly zero
      double e[2][3];
      for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 2; ++j)
          e[j][k] = U[row::U * f.node[j + 1] + 4 * (k + 1) + 3] - U[row::U * f.node[0] + 4 * (k + 1) + 3];
      for (int k = 0; k < 3; ++k)
        force[k] = -f.pressure / 6 * (e[0][(k + 1) % 3] * e[1][(k + 2) % 3] - e[0][(k + 2) % 3] * e[1][(k + 1) % 3]);
    }
    for (int k = 0; k < 3; ++k) {
      s.state.loads[static_cast<std::size_t>(4 * f.slot + k)] += factor * force[k];
      sum[k] += 3 * factor * force[k];
    }
  }
  return sum;
}

bool broken(const Simulation& s) {
  return std::any_of(s.reports.begin(), s.reports.end(), [](const PartReport& r) { return r.broken; });
}

/// Two sweeps over the parts: gradients; then fluxes, gather, update and the next stress while the part is in cache (one sweep with constant reconstruction).
/// The incompressible scheme projects before the stress. Returns why the run must not go on, or nothing.
std::string stage(Simulation& s, const RungeKuttaStage& rk, int number, int stages) {
  State& u = s.state;
  const bool projected = s.scene->physics.formulation == Formulation::pFp;
  const int from = number == 0 ? 0 : 1, to = number == stages - 1 && !projected ? 0 : 1;
  Coefficients k = s.coefficients;
  k.old_weight = rk.old;
  k.stage_weight = rk.stage;
  k.dt = rk.stage * s.dt;
  k.commits = number == stages - 1;
  k.takes_lagged = number == 0 && u.has_lagged_correction;
  k.leaves_lagged = s.scene->physics.flux_correction != FluxCorrection::none && stages == 2
                    && number == 1;  // at t + dt, as the next step's first stage
  const PartFunctions& functions = k.takes_lagged ? s.lagged_functions : s.functions;
  Rows rows = stage_rows(u, from, to);
  rows.dJ = s.current.dJ.data();
  rows.rho = s.mixture.rho.data();
  const auto edges = s.order.edges();
  const auto corners = s.order.corners();
  const auto lists = s.order.lists();
  const EdgeArrays flux_edges = nanson::flux_edges(s);
  const CornerArrays flux_corners = nanson::flux_corners(s);
  const bool linear = s.scene->physics.reconstruction != Reconstruction::constant
                      || projected;  // the projection needs neighbours' pressure gradients
  const bool keeps = s.scene->physics.keep_angular_momentum;
  const double t = s.t + (number == 0 ? 0 : number == 1 ? s.dt : 0.5 * s.dt);
  const double* arms = u.U[0].data();  // of angular momentum, TVD-RK2: x^n, then x^(n+1)

  if (!s.boundary.loaded.empty()) {
    const Vec3 sum = compute_loads(s, rows.U_stage, t);
    for (int i = 0; i < 3; ++i) s.ledger.impulse[i] += rk.mean * s.dt * sum[i];
  }
  if (has_current_areas(s.scene->physics.description))
    s.clock.time("current_areas", [&] { find_current_areas(s, rows.U_stage); });
  if (linear)
    s.clock.time("gradient", [&] {
      for_parts(s, [&](int p, Scratch) { functions.gradient(s.order.parts[p], edges, corners, lists, rows, k); });
    });
  if (functions.corrects_stress) {  // what the edges read and what the stress overwrites change places
    std::swap(u.PH[0], u.PH[1]);
    rows.PH = u.PH[u.now].data();
    rows.PH_new = u.PH[1 - u.now].data();
  }
  s.clock.time("flux_update_stress", [&] {
    for_parts(s, [&](int p, Scratch scratch) {
      const Part& part = s.order.parts[p];
      Rows mine = rows;
      if (!linear) {  // gradients of this part only, as dF/dt
        mine.G = scratch.dG - row::G * static_cast<std::ptrdiff_t>(part.node_begin);
        functions.gradient(part, edges, corners, lists, mine, k);
      }
      s.part_sums[p] = functions.edge_flux(part, flux_edges, flux_corners, lists, mine, k, scratch);
      functions.accumulate_update(part, edges, lists, mine, k, s.boundary.constraints.data(), u.reactions.data(),
                                  scratch);
      if (!s.manufactured.waves.empty())
        add_body_force(s.manufactured, *s.scene, k.material, part, t, k.dt, mine.U_new);
      if (keeps) sum_moments(s, rows, arms, p, scratch);
      if (!projected) s.reports[p] = stress_of_part(s, p, mine, k, scratch);
    });
  });
  book_loads(s, rows, rk.mean * s.dt);
  if (s.scene->monitor.energy) s.clock.time("monitor.energy", [&] { audit_stage(s, rows, rk.mean * s.dt); });
  if (keeps && !broken(s))
    s.clock.time("keep_angular_momentum",
                 [&] { s.ledger.angular_momentum_work += rk.mean * s.dt * keep_angular_momentum(s, rows, k, arms); });
  const std::string failure = projected ? project_stage(s, number) : std::string();
  book_stage(s, arms, rk.mean, number == 0);
  if (!projected) u.now = 1 - u.now;
  u.has_lagged_correction = k.leaves_lagged;
  return failure;
}

/// Rate of each condition's time factor over the step: prescribed velocities are then exact at t + dt, in every Runge-Kutta stage.
void prescribe(Simulation& s, std::vector<double>& acceleration) {
  for (std::size_t i = 0; i < acceleration.size(); ++i) {
    const TimeFunction& f = s.boundary.conditions[i].time;
    acceleration[i] = s.boundary.conditions[i].kind == BoundaryKind::velocity
                          ? (value_at(f, s.t + s.dt) - value_at(f, s.t)) / s.dt
                          : 0.0;
  }
}

/// The step for the rest of the way: at most 5 % larger than the last, and `end` is hit by sharing the last two steps.
double next_step(const Simulation& s) {
  const TimeSpec& time = s.scene->time;
  double dt = allowed_step(s);
  if (s.step > 0) dt = std::min(dt, 1.05 * s.dt);
  if (time.dt_max > 0) dt = std::min(dt, time.dt_max);
  const double left = time.end - s.t;
  return left <= dt ? left : left < 2 * dt ? 0.5 * left : dt;
}

/// Whether to go on after a step: done (so far) | breakdown | stopped, with the reason.
std::string verdict(Simulation& s, double wall, const std::function<std::string()>& asked_to_stop,
                    std::string& reason) {
  const TimeSpec& time = s.scene->time;
  const double allowed = allowed_step(s);
  if (!(allowed >= time.dt_collapse * s.first_dt)) {
    s.breakdown = collapse(s, allowed);
    reason = s.breakdown->text;
    return "breakdown";
  }
  if (s.step % s.scene->output.history_every == 0 || s.t >= time.end) {
    s.clock.time("watch", [&] {
      look(s);
      s.breakdown = ruin(s);
    });
    if (s.breakdown) {
      reason = s.breakdown->text;
      return "breakdown";
    }
  }
  if (s.t >= time.end) return "done";
  if (time.max_steps > 0 && s.step >= time.max_steps) {
    reason = "time.max_steps reached";
    s.stopped_by = "max_steps";
  } else if (time.max_wall_s > 0 && wall >= time.max_wall_s) {
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
  prescribe(s, s.acceleration);
  s.coefficients.acceleration = s.acceleration.data();
  const bool rk2 = s.scene->time.integrator == Integrator::tvd_rk2;
  const RungeKuttaStage* stages = s.scene->physics.formulation == Formulation::pFp ? projected_rk2
                                  : rk2                                            ? tvd_rk2
                                                                                   : ssp_rk3;
  const int count = rk2 ? 2 : 3;
  for (int i = 0; i < count; ++i) {
    const std::string failure = stage(s, stages[i], i, count);
    const bool stop = !failure.empty() && s.scene->projection.on_limit == OnLimit::stop;
    if (!failure.empty() && !stop) warn(s, "iteration_limit", failure);
    if (broken(s) || stop) {
      if (i + 1 < count) {
        s.state.U[0] = s.state.U[1];
        s.state.H[0] = s.state.H[1];
      }
      s.breakdown = broken(s) ? locate_breakdown(s, i + 1) : Breakdown{-1, failure, "iteration_limit"};
      break;
    }
  }
  if (s.scene->monitor.energy) book_plastic_work(s);
  s.t += s.dt;
  ++s.step;
}

double allowed_step(const Simulation& s) {
  double fastest = 0;
  for (const PartReport& r : s.reports) fastest = std::max(fastest, r.fastest);
  return s.scene->time.cfl / fastest;
}

std::string run(Simulation& s, const Observer& observer, std::string& reason) {
  const Scene& scene = *s.scene;
  const auto tell = [&](const auto& what) {
    if (what) what(s);
  };
  const double wall = wall_seconds(), cpu = cpu_seconds();
  double next_frame = scene.output.every;
  long last_history = 0, last_frame = 0;
  std::string status = "done";
  look(s);
  tell(observer.on_history);
  tell(observer.on_frame);
  while (status == "done" && s.t < scene.time.end) {
    s.dt = next_step(s);
    const bool last = s.dt == scene.time.end - s.t;
    if (s.step == 0) s.first_dt = s.dt_min = s.dt_max = s.dt;
    advance(s);
    if (last) s.t = scene.time.end;
    s.dt_min = std::min(s.dt_min, s.dt);
    s.dt_max = std::max(s.dt_max, s.dt);
    if (s.breakdown) {
      status = "breakdown";
      reason = s.breakdown->text;
    } else status = verdict(s, wall_seconds() - wall, observer.stop, reason);
    s.wall_s = wall_seconds() - wall;
    s.cpu_s = cpu_seconds() - cpu;
    tell(observer.on_step);
    if (status == "done" && s.t >= scene.time.end) break;
    if (status == "done" && s.step % scene.output.history_every == 0) {
      tell(observer.on_history);
      last_history = s.step;
    }
    if (status == "done" && scene.output.every > 0 && s.t >= next_frame) {
      tell(observer.on_frame);
      last_frame = s.step;
      while (next_frame <= s.t) next_frame += scene.output.every;
    }
  }
  s.wall_s = wall_seconds() - wall;
  s.cpu_s = cpu_seconds() - cpu;
  if (last_history < s.step) {
    seen(s);
    tell(observer.on_history);
  }
  if (last_frame < s.step) tell(observer.on_frame);
  return status;
}

}  // namespace nanson
