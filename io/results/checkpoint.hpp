// The state of a run in a file, from which it goes on to the last bit: FOLDER/checkpoint.h5, beside it the one before, checkpoint.old.h5.
//
// bytes 0 to 511        text: what this is, its length, and the FNV-1a of all that follows, compared before HDF5 sees any of it
// /                     HDF5 from byte 512 on; attributes: the scene, who wrote it when, identities of mesh, order and state
// /numbers              attributes: every number of engine/checkpoint, the sweeps' seconds, the warnings
// /results              attributes: how far history.csv and run.vtkhdf belong to this state
// /arrays/NAME          [nodes, numbers a node] in mesh order; arrays of edges and supports in the order of memory
//
// Written beside, synced, renamed: a run that is killed or a disk that is full leaves the earlier ones as they were.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/checkpoint.hpp"
#include "io/provenance.hpp"
#include "io/results/results_folder.hpp"

namespace nanson {

/// In a folder of results, newest first: one that is being written, the newest, the one before.
inline constexpr std::array checkpoint_names{"checkpoint.h5.tmp", "checkpoint.h5", "checkpoint.old.h5"};

/// There is no checkpoint to go on from, or none for this scene: the user's business.
struct CheckpointError : FolderError {
  using FolderError::FolderError;
};

/// How far the files beside a checkpoint belong to it; what comes after is written again.
struct ResultsPosition {
  std::int64_t history_bytes = 0, frames = 0, fields_bytes = 0;
};

/// All of a checkpoint but numbers and arrays.
struct Checkpoint {
  std::filesystem::path path;
  std::int64_t bytes = 0;
  std::string scene, text, resolved;                   // name; as written; as read, with --set, keys sorted
  std::string version, commit, compiler, flags, host;  // of the program and the machine that wrote it
  std::string written;                                 // UTC
  std::string mesh, order, state;                      // hashes
  std::int64_t nodes = 0, tets = 0, step = 0;
  double t = 0, end = 0;  // [s]
  ResultsPosition results;
};

/// Checked whole. Throws CheckpointError with the path and the reason: no such file, foreign, cut short, damaged, of another format.
Checkpoint read_checkpoint(const std::filesystem::path& file);

/// Those in a folder, newest first, or the file itself. Throws CheckpointError when there is nothing.
std::vector<std::filesystem::path> checkpoints_at(const std::filesystem::path& where);

/// The newest valid one of a folder, or a file itself; `complaints` tells why newer ones were passed over. Throws when there is none.
Checkpoint newest_checkpoint(const std::filesystem::path& where, std::vector<std::string>& complaints);

/// Puts it into a simulation that was just started from the same scene and mesh. False when the order of memory is another one: the run then goes on, but not to the last bit.
bool restore(const Checkpoint& from, Simulation& s);

/// One of this folder that a run goes on from, in place of newer ones: what they say of the results no longer holds.
void make_newest(const Checkpoint& from, const std::filesystem::path& folder);

class CheckpointWriter {
 public:
  CheckpointWriter(std::filesystem::path folder, std::string resolved, Provenance from)
      : folder_(std::move(folder)), resolved_(std::move(resolved)), from_(std::move(from)) {}

  /// Throws std::runtime_error with the reason; the checkpoints before then stand as they were.
  void write(const Simulation& s, const ResultsPosition& results);

 private:
  Checkpoint about(const Simulation& s, const ResultsPosition& results);

  std::filesystem::path folder_;
  std::string resolved_;
  Provenance from_;
  std::string mesh_, order_;  // hashes, found with the first checkpoint
};

}  // namespace nanson
