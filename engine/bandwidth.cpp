// Bandwidth as BabelStream measures it, with the one kernel that fetches nothing that it does not read.
#include "engine/bandwidth.hpp"

#include <omp.h>

#include <algorithm>

#include "engine/aligned.hpp"
#include "engine/clock.hpp"

namespace nanson {

double update_bandwidth(int threads, std::size_t length, int repetitions) {
  Aligned<double> first(length, 1.0), second(length, 2.0);
  const auto n = static_cast<std::ptrdiff_t>(length);
  double *a = first.data(), *b = second.data();
  double best = 1e300;
  for (int i = 0; i < repetitions; ++i) {
    const double start = wall_seconds();
#pragma omp parallel for schedule(static) num_threads(threads)
    for (std::ptrdiff_t j = 0; j < n; ++j) a[j] = 0.5 * a[j] + b[j];
    best = std::min(best, wall_seconds() - start);
  }
  return 24 * static_cast<double>(length) / best;
}

}  // namespace nanson
