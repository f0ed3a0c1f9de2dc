#include "io/mesh/run_gmsh.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <system_error>

namespace nanson {
namespace {

namespace fs = std::filesystem;

struct Ended {
  int error = 0;   // errno: the program could not be started
  int status = 0;  // as from waitpid
};

/// Runs a program found in PATH without a shell; what it prints goes to `log`.
Ended run_program(std::vector<std::string> words, const fs::path& log) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  ::posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t pid = 0;
  Ended ended;
  ended.error = ::posix_spawnp(&pid, arguments[0], &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (ended.error != 0) return ended;
  while (::waitpid(pid, &ended.status, 0) < 0)
    if (errno != EINTR) return {errno, 0};
  return ended;
}

/// gmsh's lines "Error   : ...", without the word; at most a few.
std::vector<std::string> errors_in(const fs::path& log) {
  constexpr std::size_t most = 10;
  std::vector<std::string> errors;
  std::ifstream in(log);
  for (std::string line; std::getline(in, line) && errors.size() < most;) {
    const auto colon = line.find(':');
    if (line.starts_with("Error") && colon != std::string::npos)
      errors.push_back("gmsh: " + line.substr(line.find_first_not_of(" \t", colon + 1)));
  }
  return errors;
}

}  // namespace

ScratchFolder::ScratchFolder() {
  std::string name = (fs::temp_directory_path() / "nanson_XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    throw fs::filesystem_error("cannot make a temporary folder", name, std::error_code(errno, std::generic_category()));
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::vector<std::string> run_gmsh(const fs::path& geo, const fs::path& msh) {
  const fs::path log = fs::path(msh).replace_extension(".log");
  std::error_code ignored;
  fs::remove(msh, ignored);
  const Ended ended = run_program(
      {"gmsh", "-3", "-format", "msh41", "-nt", "1", "-o", msh.string(), fs::absolute(geo).string()}, log);
  if (ended.error == ENOENT)
    return {
        "the program gmsh, which meshes it, is not installed: apt-get install gmsh, or mesh it elsewhere and name the "
        ".msh file"};
  if (ended.error != 0) return {fmt::format("gmsh cannot be started: {}", std::strerror(ended.error))};
  const bool failed = !WIFEXITED(ended.status) || WEXITSTATUS(ended.status) != 0;
  std::vector<std::string> errors = errors_in(log);
  if (WIFSIGNALED(ended.status)) errors.push_back(fmt::format("gmsh was ended by signal {}", WTERMSIG(ended.status)));
  else if (failed) errors.push_back(fmt::format("gmsh ended with exit status {}", WEXITSTATUS(ended.status)));
  else if (errors.empty() && !fs::exists(msh, ignored)) errors.push_back("gmsh wrote no mesh");
  return errors;
}

}  // namespace nanson
