// Options of the whole step beside the {p,F,J} column without them, timed in turn on one thread; results are compared first: current areas with the plain loop, two
// layers of one material with the column of one.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "bench/bench.hpp"
#include "bench/naive_loop.hpp"

namespace nanson {
namespace {

constexpr int repetitions = 7, steps = 4;

struct Run {
  Scene scene;
  Mesh mesh;
  Simulation s;
  explicit Run(const Scene& of) : scene(of), mesh(box_mesh(scene.mesh)), s(make_simulation(scene, mesh, 1)) {}
  double seconds() {  // of a step
    const double start = thread_seconds();
    for (int i = 0; i < steps; ++i) {
      s.state.dt = allowed_step(s);
      advance(s);
    }
    return (thread_seconds() - start) / steps;
  }
};

Scene with(Description description) {
  Scene scene = column();
  scene.physics.description = description;
  return scene;
}

Scene with(FluxCorrection correction) {
  Scene scene = column();
  scene.physics.flux_correction = correction;
  return scene;
}

Scene with_energy_audit() {
  Scene scene = column();
  scene.monitor.energy = true;
  return scene;
}

Scene layers() {
  Scene scene = column();
  scene.mesh.regions = {Axis::z, {3.0}, {"low", "high"}};
  scene.materials.assign(2, scene.material);
  for (std::size_t m = 0; m < 2; ++m) scene.materials[m].regions = {{scene.mesh.regions.names[m], ""}};
  return scene;
}

/// Largest difference of {v, J}, {F, x} of the mesh's nodes after a few steps of one size, each column relative to its largest value.
double difference_to_one_material(const Run& several) {
  Run one(column()), same_start(several.scene);
  const double dt = 0.5 * allowed_step(one.s);
  for (Run* r : {&one, &same_start})
    for (int i = 0; i < 3; ++i) {
      r->s.state.dt = dt;
      advance(r->s);
    }
  double worst = 0;
  for (std::size_t column = 0; column < 4; ++column) {
    double largest = 0, difference = 0;
    for (std::size_t n = 0; n < one.mesh.X.size(); ++n)
      for (std::size_t k = 4 * column; k < 4 * column + 4; ++k) {
        const auto at = [&](const Simulation& s) {
          return s.state.U[0][row::U * static_cast<std::size_t>(s.domain.order.row_of[n]) + k];
        };
        largest = std::max(largest, std::abs(at(one.s)));
        difference = std::max(difference, std::abs(at(one.s) - at(same_start.s)));
      }
    worst = std::max(worst, difference / largest);
  }
  return worst;
}

double difference_to_plain_loop(Run& run) {
  NaiveLoop naive = make_naive_loop(run.s);
  for (int i = 0; i < 3; ++i) {
    run.s.state.dt = allowed_step(run.s);
    naive_advance(naive, run.s.state.dt);
    advance(run.s);
  }
  return largest_difference(naive, run.s);
}

void time_option(benchmark::State& state, const Scene& scene) {
  Run base(column()), option(scene);
  const double difference = scene.materials.empty() ? difference_to_plain_loop(option)
                                                    : difference_to_one_material(option);
  if (!(difference < same)) return state.SkipWithError(fmt::format("differs by {:.1e}", difference).c_str());
  std::vector<double> seconds, ratios;
  for (int r = 0; r < repetitions; ++r) {
    const double without = base.seconds();
    seconds.push_back(option.seconds());
    ratios.push_back(seconds.back() / without);
  }
  for (auto _ : state) state.SetIterationTime(median(seconds));
  if (base.s.breakdown || option.s.breakdown) return state.SkipWithError("broke down");
  state.counters["ns"] = 1e9 * median(seconds) / option.s.domain.order.nodes;
  state.counters["to_pFJ"] = median(ratios);
  state.counters["bytes_per_node"] = bytes_per_node(option.s);
}

}  // namespace

void register_step_options() {
  for (const auto& [name, scene] :
       {std::pair("pressure", with(FluxCorrection::pressure)), std::pair("full", with(FluxCorrection::full)),
        std::pair("energy_audit", with_energy_audit()), std::pair("updated", with(Description::updated)),
        std::pair("pseudo_updated", with(Description::pseudo_updated)), std::pair("several_materials", layers())})
    benchmark::RegisterBenchmark(fmt::format("option/{}", name).c_str(),
                                 [scene = scene](benchmark::State& state) { time_option(state, scene); })
        ->Unit(benchmark::kMillisecond)
        ->UseManualTime()
        ->Iterations(1);
}

}  // namespace nanson
