// What the benches share: size of the meshes, timers, columns, measured bandwidth.
#pragma once
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "engine/mesh/mesh.hpp"
#include "engine/work.hpp"

namespace nanson {

inline constexpr int full_cells = 48;  // cells a side of the cube; results are kept and compared at this size only
inline constexpr double same = 1e-11;  // largest relative difference to the plain loop

struct BenchOptions {
  int cells = full_cells;
  bool keep = false, large = false;
};
BenchOptions& options();

/// Processor time of the calling thread [s].
double thread_seconds();
double median(std::vector<double> x);

/// Bandwidth of a += s b, 2 reads and 1 write, arrays well beyond L3 [bytes/s]; measured at the first call.
double update_bandwidth(int threads);

/// The columns of every row: ns a node, GB/s of the byte model, its share of the update bandwidth, GF/s.
void set_columns(benchmark::State& state, double seconds, double nodes, const Work& work, int threads);

Mesh box_mesh(const MeshSpec& spec);

/// The standing wave in a cube of n cells a side.
Scene cube(int n);

/// The twisting column of the step benches, 26 of 48 cells across.
Scene column();

/// One row of the table at the end.
struct StepRatio {
  std::string scene;
  double nodes, naive, one, two;          // [ns per node-step]: processor time of one thread, wall time of two; medians
  double ratio, ratio_least, ratio_most;  // naive to one thread: median and extremes over the repetitions
  double speedup;                         // one thread to two, wall time
  double in_cache,
      bytes;  // one thread on a mesh that stays in its L2 [ns per node-step]; DRAM traffic of the model [bytes per node-step]
  double barrier;  // [s] of a parallel loop over parts that do nothing, two threads
};
std::vector<StepRatio>& step_ratios();

void register_bandwidth();
void register_sweeps();
void register_steps();
void register_variants();
void register_step_options();
void register_setup();

}  // namespace nanson
