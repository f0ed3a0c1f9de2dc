// What the memory gives: the ceiling that a run's traffic is compared with.
#pragma once
#include <cstddef>

namespace nanson {

/// a = a/2 + b over n doubles: 2 reads and 1 write, and nothing is fetched that is not read.
void update_pass(double* a, const double* b, std::ptrdiff_t n, int threads);

/// Bandwidth of that pass, best of some repetitions over two arrays of `length` doubles, well beyond L3 [bytes/s].
double update_bandwidth(int threads, std::size_t length, int repetitions);

}  // namespace nanson
