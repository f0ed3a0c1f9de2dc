// Comparing what was with what is to be.
#include "io/restart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "io/results/write_fields.hpp"
#include "io/results/write_history.hpp"
#include "io/scene/scene_changes.hpp"

namespace nanson {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, std::string_view why) {
  throw CheckpointError(fmt::format("{}: {}", path.string(), why));
}

/// Changes that make another problem are refused, the others told.
void compare_scenes(const Checkpoint& from, const Loaded& loaded, Restart& out) {
  std::vector<std::string> wrong;
  bool mesh_is_named = false;
  for (const KeyChange& change : scene_changes(from.resolved, loaded.resolved)) {
    const bool allowed = may_change_at_restart(change.key);
    (allowed ? out.lines : wrong).push_back(change_text(change));
    mesh_is_named = mesh_is_named || change.key.starts_with("mesh.");
    out.new_frame_times = out.new_frame_times || change.key == "output.every";
  }
  if (!mesh_is_named && from.mesh != mesh_hash(loaded.mesh))
    wrong.push_back(
        fmt::format("mesh: another one than the {} nodes and {} tets of the checkpoint", from.nodes, from.tets));
  if (!wrong.empty())
    refuse(from.path, fmt::format("is of another problem; to be the same again, or a run from the start:\n  {}",
                                  fmt::join(wrong, "\n  ")));
}

void check_something_is_left(const Checkpoint& from, const TimeSpec& time) {
  if (from.t >= time.end)
    refuse(from.path, fmt::format("has reached time.end = {:g} s: a later one, --set time.end=..., goes on", time.end));
  if (time.max_steps > 0 && from.step >= time.max_steps)
    refuse(from.path,
           fmt::format("has done time.max_steps = {}: more of them, --set time.max_steps=..., go on", time.max_steps));
}

}  // namespace

Restart find_restart(const Loaded& loaded, const fs::path& where) {
  Restart out;
  out.from = newest_checkpoint(where, out.lines);
  out.results = fs::is_directory(where) ? where : where.parent_path();
  if (out.results.empty()) out.results = ".";
  compare_scenes(out.from, loaded, out);
  check_something_is_left(out.from, loaded.scene.time);
  const Provenance now = provenance();
  if (out.from.commit != now.commit || out.from.compiler != now.compiler || out.from.flags != now.flags)
    out.lines.push_back(fmt::format(
        "the checkpoint is of another program ({} {}, {}): the run goes on, but its last bits may be others",
        out.from.version, out.from.commit, out.from.compiler));
  return out;
}

void go_on_from(Restart& restart, Simulation& s) {
  if (!restore(restart.from, s))
    restart.lines.push_back(
        "nodes and edges are numbered in another order than in the checkpoint: the run goes on, but its last bits will "
        "be others");
  const double every = s.domain.scene->output.every;
  if (restart.new_frame_times && every > 0) s.state.next_frame = every * std::ceil(s.state.t / every);
}

std::string results_end(const Restart& restart, const std::vector<HistoryColumn>& columns, const Scene& scene) {
  std::string header;
  std::ifstream history(restart.results / "history.csv");
  if (!std::getline(history, header)) return "there is no history.csv beside the checkpoint";
  if (header + "\n" != history_header(columns)) return "the columns of history.csv are others";
  std::error_code error;
  const fs::path fields = restart.results / "run.vtkhdf";
  if (!fs::exists(fields, error)) return "there is no run.vtkhdf beside the checkpoint";
  std::vector<std::string> wanted = scene.output.fields, found;
  std::ranges::sort(wanted);
  try {
    found = fields_in(fields);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return found == wanted ? "" : "the fields of run.vtkhdf are others";
}

}  // namespace nanson
