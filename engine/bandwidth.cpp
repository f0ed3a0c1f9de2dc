// Bandwidth as BabelStream measures it, with the one kernel that fetches nothing that it does not read.
#include "engine/bandwidth.hpp"

#include <omp.h>

#include <algorithm>

#include "engine/aligned.hpp"
#include "engine/clock.hpp"

namespace nanson {

void update_pass(double* a, const double* b, std::ptrdiff_t n, int threads) {
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::ptrdiff_t i = 0; i < n; ++i) a[i] = 0.5 * a[i] + b[i];
}

double update_bandwidth(int threads, std::size_t length, int repetitions) {
  Aligned<double> first(length, 1.0), second(length, 2.0);
  double best = 1e300;
  for (int i = 0; i < repetitions; ++i) {
    const double start = wall_seconds();
    update_pass(first.data(), second.data(), static_cast<std::ptrdiff_t>(length), threads);
    best = std::min(best, wall_seconds() - start);
  }
  return 24 * static_cast<double>(length) / best;
}

}  // namespace nanson
