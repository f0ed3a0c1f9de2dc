// The whole step of three scenes with their real supports: fused on one and two threads and the plain loop, timed in turn, results compared first.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

#include "bench/bench.hpp"
#include "bench/naive_loop.hpp"
#include "engine/clock.hpp"
#include "engine/counted.hpp"
#include "engine/parts.hpp"

namespace nanson {
namespace {

constexpr int repetitions = 7, naive_steps = 2, fused_steps = 6;

BoundarySpec condition(BoundaryKind kind, std::initializer_list<const char*> faces) {
  BoundarySpec b;
  b.kind = kind;
  for (const char* f : faces) b.faces.push_back({f, ""});
  return b;
}

/// Free beryllium plate, neo-Hookean, {p,F} (paper, 6.2).
Scene plate() {
  Scene s;
  const int n = std::max(1, options().cells * 26 / full_cells);
  s.mesh.origin = {-0.005, -0.03, -0.005};
  s.mesh.size = {0.01, 0.06, 0.01};
  s.mesh.cells = {n, 6 * n, n};
  s.material.density = 1845;
  s.material.youngs_modulus = 318.27e9;
  s.material.poissons_ratio = 0.0539;
  s.physics.formulation = Formulation::pF;
  s.initial.field = InitialField::plate_mode;
  s.initial.amplitude = 4.3369e-5;
  s.initial.mode_omega = 2.3597e5;
  s.initial.B = 78.834;
  return s;
}

double flops_of(const Scene& s) {
  const MaterialConstants m = constants_of(s.material);
  if (s.material.law == Law::linear_elastic)
    return flops_of_law<Law::linear_elastic, Volumetric::quadratic, Isochoric::F, Formulation::pFJ>(m);
  if (s.physics.formulation == Formulation::pF)
    return flops_of_law<Law::neo_hookean, Volumetric::quadratic, Isochoric::F, Formulation::pF>(m);
  return flops_of_law<Law::neo_hookean, Volumetric::quadratic, Isochoric::F, Formulation::pFJ>(m);
}

/// What the rows of a scene show: medians over the repetitions.
struct Measured {
  std::string error;
  double naive = 0, one = 0, two = 0;  // [s] a step
  double nodes = 0;
  Work work;  // of the fused step
};

void fused(Simulation& s, int threads, int steps) {
  s.team.threads = threads;
  for (int i = 0; i < steps; ++i) {
    s.state.dt = allowed_step(s);
    advance(s);
  }
}

/// Wall and processor seconds of one step.
template <class Steps>
std::pair<double, double> timed(int count, Steps steps) {
  const double wall = wall_seconds(), thread = thread_seconds();
  steps();
  return {(wall_seconds() - wall) / count, (thread_seconds() - thread) / count};
}

/// ns per node-step on one thread with a sixth of the cells along each axis: what the cores take when memory costs nothing.
double in_cache(Scene scene) {
  for (int& n : scene.mesh.cells) n = std::max(2, n / 6);
  const Mesh mesh = box_mesh(scene.mesh);
  Simulation s = make_simulation(scene, mesh, 1);
  fused(s, 1, 20);
  std::vector<double> seconds;
  for (int r = 0; r < repetitions; ++r) seconds.push_back(timed(50, [&] { fused(s, 1, 50); }).second);
  return 1e9 * median(seconds) / s.domain.order.nodes;
}

double barrier_seconds(Simulation& s) {
  constexpr int count = 2000;
  s.team.threads = 2;
  return timed(count,
               [&] {
                 for (int i = 0; i < count; ++i) for_parts(s, [](int, Scratch) {});
               })
      .first;
}

Measured measure(const std::string& name, const Scene& scene) {
  Measured out;
  const Mesh mesh = box_mesh(scene.mesh);
  Simulation s = make_simulation(scene, mesh, 2);
  auto naive = std::make_unique<NaiveLoop>(make_naive_loop(s));
  for (int i = 0; i < 4; ++i) {
    s.state.dt = allowed_step(s);
    s.team.threads = 1 + i % 2;
    naive_advance(*naive, s.state.dt);
    advance(s);
  }
  const double difference = largest_difference(*naive, s), dt = s.state.dt;
  if (!(difference < same)) out.error = fmt::format("differs from the plain loop by {:.1e}", difference);
  std::vector<double> naive_s, one_s, two_s, ratio, speedup;
  for (int r = 0; r < repetitions; ++r) {
    const auto plain = timed(naive_steps, [&] {
      for (int i = 0; i < naive_steps; ++i) naive_advance(*naive, dt);
    });
    const auto one = timed(fused_steps, [&] { fused(s, 1, fused_steps); });
    const auto two = timed(fused_steps, [&] { fused(s, 2, fused_steps); });
    naive_s.push_back(plain.second);
    one_s.push_back(one.second);
    two_s.push_back(two.first);
    ratio.push_back(plain.second / one.second);
    speedup.push_back(one.first / two.first);
  }
  if (s.breakdown || naive->report.broken) out.error = "broke down";
  out.naive = median(naive_s);
  out.one = median(one_s);
  out.two = median(two_s);
  out.nodes = s.domain.order.nodes;
  out.work = step_work(scene.physics, Sizes(s.domain.order), flops_of(scene), 2);
  const double ns = 1e9 / out.nodes;
  if (out.error.empty())
    step_ratios().push_back({name, out.nodes, ns * out.naive, ns * out.one, ns * out.two, median(ratio),
                             *std::min_element(ratio.begin(), ratio.end()),
                             *std::max_element(ratio.begin(), ratio.end()), median(speedup), in_cache(scene),
                             out.work.bytes / out.nodes, barrier_seconds(s)});
  return out;
}

const Measured& measured(const std::string& name, Scene (*scene)()) {
  static std::map<std::string, Measured> all;
  if (!all.count(name)) all[name] = measure(name, scene());
  return all[name];
}

void show(benchmark::State& state, const Measured& m, double seconds, int threads) {
  for (auto _ : state) state.SetIterationTime(seconds);
  if (!m.error.empty()) return state.SkipWithError(m.error.c_str());
  if (threads > 0) set_columns(state, seconds, m.nodes, m.work, threads);
  state.counters["ns"] = 1e9 * seconds / m.nodes;
  state.counters["to_naive"] = m.naive / seconds;
}

}  // namespace

/// Standing wave in a cube, linear elastic, {p,F,J} (paper, 6.1).
Scene cube(int n) {
  Scene s;
  s.mesh.size = {1, 1, 1};
  s.mesh.cells = {n, n, n};
  s.material.law = Law::linear_elastic;
  s.material.density = 1100;
  s.material.youngs_modulus = 17e6;
  s.material.poissons_ratio = 0.45;
  s.initial.field = InitialField::standing_wave;
  s.initial.amplitude = 5e-4;
  s.boundary = {condition(BoundaryKind::symmetric, {"xmin", "ymin", "zmin"}),
                condition(BoundaryKind::skew_symmetric, {"xmax", "ymax", "zmax"})};
  return s;
}

/// Twisting column, neo-Hookean, {p,F,J}, foot fixed (paper, 6.5).
Scene column() {
  Scene s;
  const int n = std::max(1, options().cells * 26 / full_cells);
  s.mesh.origin = {-0.5, -0.5, 0};
  s.mesh.size = {1, 1, 6};
  s.mesh.cells = {n, n, 6 * n};
  s.material.density = 1100;
  s.material.youngs_modulus = 17e6;
  s.material.poissons_ratio = 0.495;
  s.initial.field = InitialField::twist;
  s.initial.twist_omega = 105;
  s.initial.height = 6;
  s.boundary = {condition(BoundaryKind::fixed, {"zmin"})};
  return s;
}

void register_steps() {
  constexpr Scene (*cube_of_options)() = [] { return cube(options().cells); };
  for (auto [name, scene] :
       {std::pair("cube", cube_of_options), std::pair("column", &column), std::pair("plate", &plate)}) {
    const auto add = [name = std::string(name), scene = scene](const char* what, double Measured::*seconds,
                                                               int threads) {
      benchmark::RegisterBenchmark(("step/" + name + what).c_str(),
                                   [=](benchmark::State& state) {
                                     const Measured& m = measured(name, scene);
                                     show(state, m, m.*seconds, threads);
                                   })
          ->Unit(benchmark::kMillisecond)
          ->UseManualTime()
          ->Iterations(1);
    };
    add("/threads:1", &Measured::one, 1);
    add("/threads:2", &Measured::two, 2);
    add("/naive", &Measured::naive, 0);
  }
}

}  // namespace nanson
