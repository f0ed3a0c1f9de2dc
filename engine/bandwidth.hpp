// What the memory gives: the ceiling that a run's traffic is compared with.
#pragma once
#include <cstddef>

namespace nanson {

/// Bandwidth of a = a/2 + b, 2 reads and 1 write, best of some repetitions over two arrays of `length` doubles, well beyond L3 [bytes/s].
double update_bandwidth(int threads, std::size_t length, int repetitions);

}  // namespace nanson
