// Meshes a geometry with the gmsh program, as a child process: nanson links nothing of it, and runs without it where no .geo is read.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace nanson {

/// A folder of its own below the system's temporary one, removed with everything in it.
class ScratchFolder {
 public:
  ScratchFolder();  // throws std::filesystem::filesystem_error
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Runs gmsh on `geo`, which writes `msh` (format 4.1, volumes, one thread: the same mesh on every machine with the same gmsh).
/// What went wrong, in gmsh's own words where it has some; empty when `msh` was written.
std::vector<std::string> run_gmsh(const std::filesystem::path& geo, const std::filesystem::path& msh);

}  // namespace nanson
