// Memory bandwidth as BabelStream measures it: triad and update on arrays far larger than the caches, results checked.
#include <omp.h>

#include <cmath>

#include "bench/bench.hpp"
#include "engine/aligned.hpp"
#include "engine/bandwidth.hpp"
#include "engine/clock.hpp"

namespace nanson {
namespace {

struct Arrays {
  Aligned<double> a, b, c;
};

/// 144 doubles a node of the cube: three arrays of 135 MB at full size.
std::size_t length() {
  const auto n = static_cast<std::size_t>(options().cells + 1);
  return 144 * n * n * n;
}

Arrays& arrays() {
  static Arrays x{Aligned<double>(length(), 1.0), Aligned<double>(length(), 2.0), Aligned<double>(length(), 0.5)};
  return x;
}

/// a = b + s c: 2 reads, 1 write (and a fetch of the lines of a, which is not counted, by the custom of the benchmark).
void triad(Arrays& x, int threads) {
  const auto n = static_cast<std::ptrdiff_t>(x.a.size());
  double *a = x.a.data(), *b = x.b.data(), *c = x.c.data();
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::ptrdiff_t i = 0; i < n; ++i) a[i] = b[i] + 0.5 * c[i];
}

void update(Arrays& x, int threads) {
  update_pass(x.a.data(), x.b.data(), static_cast<std::ptrdiff_t>(x.a.size()), threads);
}

bool all_near(const Aligned<double>& x, double wanted) {
  for (double v : x)
    if (!(std::abs(v - wanted) < 1e-12)) return false;
  return true;
}

using Kernel = void (*)(Arrays&, int);

/// Best of some repetitions [bytes/s]; one thread is timed by its processor time, so that other programs disturb less.
double bandwidth(Kernel kernel, int threads, int repetitions) {
  const auto now = [threads] { return threads == 1 ? thread_seconds() : wall_seconds(); };
  double best = 1e300;
  for (int i = 0; i < repetitions; ++i) {
    const double start = now();
    kernel(arrays(), threads);
    best = std::min(best, now() - start);
  }
  return 24 * static_cast<double>(length()) / best;
}

void run(benchmark::State& state, Kernel kernel, double (*wanted)(double), int threads) {
  std::fill(arrays().a.begin(), arrays().a.end(), 0.0);
  double best = 0;
  for (auto _ : state) best = std::max(best, bandwidth(kernel, threads, 1));
  if (!all_near(arrays().a, wanted(static_cast<double>(state.iterations())))) state.SkipWithError("wrong result");
  state.counters["GB/s"] = 1e-9 * best;
  state.counters["share"] = best / update_bandwidth(threads);
}

}  // namespace

double update_bandwidth(int threads) {
  static double measured[3] = {};
  double& b = measured[threads];
  if (b == 0) b = bandwidth(update, threads, 10);
  return b;
}

void register_bandwidth() {
  for (int threads : {1, 2}) {
    const std::string tail = "/threads:" + std::to_string(threads);
    const auto add = [&](const std::string& name, Kernel kernel, double (*wanted)(double)) {
      benchmark::RegisterBenchmark(("bandwidth/" + name + tail).c_str(),
                                   [=](benchmark::State& state) { run(state, kernel, wanted, threads); })
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime()
          ->Iterations(20);
    };
    add("triad", triad, [](double) { return 2.25; });
    add("update", update, [](double passes) { return 4 * (1 - std::exp2(-passes)); });
  }
}

}  // namespace nanson
