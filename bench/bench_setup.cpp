// What a cube's set-up takes, in one-thread steps of the same run: the dual to the first stress, METIS' share of it apart, and the mesh before it.
#include <fmt/format.h>

#include "bench/bench.hpp"
#include "engine/clock.hpp"
#include "engine/solver.hpp"

namespace nanson {
namespace {

void time_setup(benchmark::State& state, int cells) {
  const Scene scene = cube(cells);
  const double start = thread_seconds();
  const Mesh mesh = box_mesh(scene.mesh);
  const double meshed = thread_seconds();
  Simulation s = make_simulation(scene, mesh, 1);
  const double ready = thread_seconds();
  std::vector<double> steps;
  for (int i = 0; i < 9; ++i) {
    const double before = thread_seconds();
    s.state.dt = allowed_step(s);
    advance(s);
    steps.push_back(thread_seconds() - before);
  }
  for (auto _ : state) state.SetIterationTime(ready - meshed);
  if (s.breakdown) return state.SkipWithError(s.breakdown->text.c_str());
  state.counters["steps"] = (ready - meshed) / median(steps);
  state.counters["mesh_steps"] = (meshed - start) / median(steps);
  for (const SweepTime& part : s.team.setup.sweeps) state.counters[part.sweep] = part.seconds / s.team.setup.total();
}

}  // namespace

void register_setup() {
  std::vector<int> sizes{options().cells};
  if (options().large) sizes.push_back(2 * options().cells);
  for (const int cells : sizes)
    benchmark::RegisterBenchmark(fmt::format("setup/nodes:{}", (cells + 1) * (cells + 1) * (cells + 1)).c_str(),
                                 [cells](benchmark::State& state) { time_setup(state, cells); })
        ->Unit(benchmark::kMillisecond)
        ->UseManualTime()
        ->Iterations(1);
}

}  // namespace nanson
