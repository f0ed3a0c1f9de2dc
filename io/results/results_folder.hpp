// The folder that a run writes into: created, locked against a second run, and free of an earlier run's files, which are moved aside, only when the new one really starts.
#pragma once
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "io/posix_file.hpp"

namespace nanson {

/// The folder cannot be used: the user's business, not a fault of the program.
struct FolderError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class ResultsFolder {
 public:
  /// `out` as it is, otherwise results/SCENE below the current folder. Creates it and holds it (a lock on the file .lock in it) as long as this lives.
  ResultsFolder(const std::string& scene, const std::optional<std::filesystem::path>& out);

  /// To be called after all checks: what an earlier run wrote, and nothing else, moves to a new folder beside this one, PATH.1, PATH.2, ..., or with `force` is
  /// removed. What was done in a line, empty when there was nothing.
  std::string begin(bool force);

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  Descriptor lock_;
};

}  // namespace nanson
