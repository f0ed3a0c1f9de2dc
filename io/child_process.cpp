// fork, exec, and a wait that looks every few milliseconds.
#include "io/child_process.hpp"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <thread>

#include "io/posix_file.hpp"

namespace nanson {
namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// After fork only calls that are safe between fork and exec of a program with threads.
[[noreturn]] void become(char* const* argv, int log, pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(127);  // it died meanwhile
  std::signal(SIGPIPE, SIG_DFL);            // which this program ignores
  ::dup2(log, 1), ::dup2(log, 2);
  ::execv(argv[0], argv);
  const char* why = std::strerror(errno);
  if (::write(2, why, std::strlen(why)) < 0) ::_exit(126);
  ::_exit(127);
}

pid_t start(const std::vector<std::string>& command, const std::filesystem::path& log) {
  std::vector<char*> argv;
  for (const std::string& word : command) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  const Descriptor file(log, O_WRONLY | O_CREAT | O_TRUNC);
  if (!file) throw std::runtime_error(fmt::format("{}: could not be created: {}", log.string(), std::strerror(errno)));
  const pid_t parent = ::getpid(), child = ::fork();
  if (child < 0)
    throw std::runtime_error(fmt::format("{}: could not be started: {}", command[0], std::strerror(errno)));
  if (child == 0) become(argv.data(), file.get(), parent);
  ::setpgid(child, child);  // both sides do it: whoever comes first
  return child;
}

}  // namespace

ChildEnd run_child(const std::vector<std::string>& command, const std::filesystem::path& log, const ChildLimits& limits,
                   const std::function<int()>& stop) {
  const auto began = Clock::now();
  const pid_t child = start(command, log);
  ChildEnd end;
  double asked_at = -1;  // [s] when it was asked to end
  int status = 0;
  for (auto pause = std::chrono::milliseconds(1);; pause = std::min(2 * pause, std::chrono::milliseconds(20))) {
    const pid_t ended = ::waitpid(child, &status, WNOHANG);
    if (ended == child || (ended < 0 && errno != EINTR)) break;
    if (const int signal = end.stopped == 0 ? stop() : 0; signal != 0)
      end.stopped = signal, asked_at = since(began), ::kill(child, signal);
    if (asked_at < 0 && limits.max_wall_s > 0 && since(began) > limits.max_wall_s)
      end.too_slow = true, asked_at = since(began), ::kill(child, SIGTERM);
    if (asked_at >= 0 && since(began) > asked_at + limits.grace_s) ::kill(child, SIGKILL);
    std::this_thread::sleep_for(pause);
  }
  end.wall_s = since(began);
  end.code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  if (end.code == 0 || end.code == 3) end.too_slow = false;  // it came to its end just in time
  return end;
}

}  // namespace nanson
