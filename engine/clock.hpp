// Wall and processor time, and timers whose label is the sweep's name in every report.
#pragma once
#include <chrono>
#include <ctime>
#include <string_view>
#include <vector>

#include "engine/summary.hpp"

namespace nanson {

inline double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Of the whole process, all threads.
inline double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Clock {
  std::vector<SweepTime> sweeps;
  void add(std::string_view label, double seconds) {
    for (SweepTime& s : sweeps)
      if (s.sweep == label) {
        s.seconds += seconds;
        return;
      }
    sweeps.push_back({std::string(label), seconds});
  }
  double total() const {
    double seconds = 0;
    for (const SweepTime& s : sweeps) seconds += s.seconds;
    return seconds;
  }
  /// Runs the sweep and adds its wall time under the label.
  template <class Sweep>
  void time(std::string_view label, Sweep sweep) {
    const double start = wall_seconds();
    sweep();
    add(label, wall_seconds() - start);
  }
};

}  // namespace nanson
