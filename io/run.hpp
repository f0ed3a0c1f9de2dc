// `nanson run`: a loaded scene to fields, history and summary.
#pragma once
#include <filesystem>
#include <optional>

#include "io/scene/load.hpp"

namespace nanson {

struct RunOptions {
  int threads = 1;
  std::optional<std::filesystem::path> out;
  bool quiet = false;
  bool force = false;  // replaces earlier results instead of moving them aside
  std::optional<std::filesystem::path>
      restart;  // goes on from a checkpoint: in that folder or file, empty: in the results' folder
};

/// Exit code: 0 done, 3 the solution broke down, 128 + n ended by signal n.
int run_scene(const Loaded& loaded, const RunOptions& options);

}  // namespace nanson
