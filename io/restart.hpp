// `nanson run --restart`: the checkpoint, whether its problem is that of the scene, and the results that go on.
#pragma once
#include "engine/history.hpp"
#include "io/results/checkpoint.hpp"
#include "io/scene/load.hpp"

namespace nanson {

struct Restart {
  Checkpoint from;
  std::filesystem::path results;   // the folder that the checkpoint lies in
  std::vector<std::string> lines;  // what the user should know
  bool new_frame_times = false;    // output.every is another one
};

/// In `where`, a folder or a file, or else in the results' folder. Throws CheckpointError with all reasons: none there, none valid, another problem, nothing left to do.
Restart find_restart(const Loaded& loaded, const std::filesystem::path& where);

/// Puts the checkpoint into a simulation that was just started.
void go_on_from(Restart& restart, Simulation& s);

/// Why history.csv and run.vtkhdf of the checkpoint cannot be gone on with, other columns or fields; empty where they can.
std::string results_end(const Restart& restart, const std::vector<HistoryColumn>& columns, const Scene& scene);

}  // namespace nanson
