// A program started as a child, watched until it ends: time limit, signals passed on.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace nanson {

struct ChildEnd {
  int code = 0;           // exit code, or 128 + the signal that ended it
  bool too_slow = false;  // it was asked to end for its time
  int stopped = 0;        // the signal that was passed on
  double wall_s = 0;      // [s]
};

struct ChildLimits {
  double max_wall_s = 0;  // [s] then SIGTERM; 0: none
  double grace_s = 30;    // [s] after a signal, then SIGKILL
};

/// Its output and messages go to `log`. `stop` is asked often: a signal that it returns is passed on, once. The child has a process group of its own, so that Ctrl-C
/// reaches it once only; it is told to end when this program dies. Throws std::runtime_error when it cannot be started.
ChildEnd run_child(const std::vector<std::string>& command, const std::filesystem::path& log, const ChildLimits& limits,
                   const std::function<int()>& stop);

/// This very program, also when its file was replaced since it was started; to be executed by a child of it, or read.
inline constexpr const char* own_program = "/proc/self/exe";

}  // namespace nanson
