// The threads of a run, what each needs beside the rows, and the clocks.
#pragma once
#include <array>
#include <vector>

#include "engine/aligned.hpp"
#include "engine/clock.hpp"

namespace nanson {

inline constexpr int part_row = 16;  // sums of a part that are taken in one sweep

struct Team {
  int threads = 1;
  std::vector<Aligned<double>> scratch;                 // one a thread
  std::vector<double> part_sums;                        // one a part, for sums in a fixed order
  std::vector<std::array<double, part_row>> part_rows;  // several a part
  Clock setup, clock;  // of what comes before the time loop (mesh, dual, metis, order, state, initial), of its sweeps
  double wall_s = 0, cpu_s = 0;  // [s] of the time loop
  double earlier_wall_s = 0;     // [s] of it, before the checkpoint that the run goes on from
};

}  // namespace nanson
