// Creating, locking and freeing the folder, each refusal with its reason.
#include "io/results/results_folder.hpp"

#include <fmt/format.h>
#include <sys/file.h>

#include <array>
#include <cstring>
#include <vector>

namespace nanson {
namespace {

namespace fs = std::filesystem;

/// The summary goes first: one that says "done" must not stand beside the files of a run that is still at work.
constexpr std::array result_files{"summary.json", "history.csv",   "run.xdmf",
                                  "run.vtkhdf",   "checkpoint.h5", "checkpoint.old.h5"};

fs::path folder_of(const std::string& scene, const std::optional<fs::path>& out) {
  if (out) {
    if (out->empty()) throw FolderError("the name of the results folder is empty");
    return *out;
  }
  if (scene.empty() || scene == "." || scene == ".." || scene.find('/') != std::string::npos)
    throw FolderError(
        fmt::format("the scene's name \"{}\" cannot be the name of a folder; name one with --out", scene));
  return fs::path("results") / scene;
}

void create(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw FolderError(fmt::format("{}: is a file, not a folder", folder.string()));
  fs::create_directories(folder, error);
  if (error)
    throw FolderError(fmt::format("{}: the folder could not be created: {}", folder.string(), error.message()));
}

std::string holder(int fd) {
  std::array<char, 64> text{};
  const auto size = ::pread(fd, text.data(), text.size() - 1, 0);
  return size > 0 ? fmt::format(" (process {})", text.data()) : "";
}

/// The process number in the file is for the message only. The file stays when the run ends: removing it would let two runs lock two different files.
Descriptor lock(const fs::path& folder) {
  Descriptor file(folder / ".lock", O_RDWR | O_CREAT);
  if (!file)
    throw FolderError(fmt::format("{}: the folder cannot be written to: {}", folder.string(), std::strerror(errno)));
  if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK)
      throw FolderError(fmt::format("{}: the folder cannot be locked: {}", folder.string(), std::strerror(errno)));
    throw FolderError(
        fmt::format("{}: another run{} is writing to this folder; wait for it or name another one with --out",
                    folder.string(), holder(file.get())));
  }
  const int error = ::ftruncate(file.get(), 0) != 0 ? errno : write_all(file.get(), std::to_string(::getpid()));
  if (error != 0)
    throw FolderError(fmt::format("{}: the folder cannot be written to: {}", folder.string(), std::strerror(error)));
  return file;
}

/// PATH.1, PATH.2, ...: the first that is free.
fs::path new_folder_beside(const fs::path& path) {
  std::error_code error;
  const fs::path real = fs::canonical(path, error);
  const fs::path& base = path.filename() == real.filename() ? path : real;  // not so: a/ . .. and links
  for (long number = 1;; ++number) {
    fs::path beside = base;
    beside += fmt::format(".{}", number);
    if (fs::create_directory(beside, error)) return beside;
    if (error && !fs::exists(fs::symlink_status(beside)))
      throw FolderError(fmt::format("{}: earlier results cannot be moved to {}: {}; --force replaces them",
                                    path.string(), beside.string(), error.message()));
  }
}

}  // namespace

ResultsFolder::ResultsFolder(const std::string& scene, const std::optional<fs::path>& out)
    : path_(folder_of(scene, out)) {
  create(path_);
  lock_ = lock(path_);
}

std::string ResultsFolder::begin(bool force) {
  std::vector<std::string> found;
  for (const char* name : result_files) {
    const fs::path file = path_ / name;
    std::error_code error;
    const fs::file_status status = fs::symlink_status(file, error);
    if (fs::is_directory(status))
      throw FolderError(fmt::format("{}: is a folder, where results are to be written", file.string()));
    if (fs::exists(status)) found.emplace_back(name);
  }
  if (found.empty()) return "";
  std::error_code error;
  if (force) {
    for (const std::string& name : found)
      if (!fs::remove(path_ / name, error) && error)
        throw FolderError(fmt::format("{}: an earlier run's file could not be removed: {}", (path_ / name).string(),
                                      error.message()));
    return fmt::format("replaces an earlier run's {}", fmt::join(found, " "));
  }
  const fs::path kept = new_folder_beside(path_);
  for (const std::string& name : found) {
    fs::rename(path_ / name, kept / name, error);
    if (error)
      throw FolderError(fmt::format("{}: an earlier run's file could not be moved to {}: {}; --force replaces it",
                                    (path_ / name).string(), kept.string(), error.message()));
  }
  return fmt::format("earlier results moved to {}", kept.string());
}

}  // namespace nanson
