// A paragraph a checkpoint.
#include "io/info.hpp"

#include "io/print.hpp"
#include "io/results/checkpoint.hpp"

namespace nanson {

int print_info(const std::filesystem::path& where) {
  const std::vector<std::filesystem::path> files = checkpoints_at(where);
  bool valid = false;
  for (const std::filesystem::path& file : files) {
    try {
      const Checkpoint c = read_checkpoint(file);
      print(stdout,
            "{}: valid, {:.3g} MB\n"
            "  scene {}, {} nodes, {} tets, mesh {}\n"
            "  step {}, t = {:.6g} of {:.6g} s, state {}\n"
            "  written {} on {} by nanson {} ({})\n"
            "  results: {} frames, history.csv to byte {}\n",
            c.path.string(), 1e-6 * static_cast<double>(c.bytes), c.scene, c.nodes, c.tets, c.mesh, c.step, c.t, c.end,
            c.state, c.written, c.host, c.version, c.commit, c.results.frames, c.results.history_bytes);
      valid = true;
    } catch (const CheckpointError& e) {
      print(stdout, "{}\n", e.what());
    }
  }
  return valid ? 0 : 2;
}

}  // namespace nanson
