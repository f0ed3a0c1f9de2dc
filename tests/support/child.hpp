// Code that a test runs in a child process, because it is killed there, changes limits or holds a lock.
#pragma once
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>

namespace nanson::test {

/// Starts `body` (int()) in a child that ends with its result and without tidying up.
template <class Body>
pid_t start_child(Body body) {
  const pid_t pid = ::fork();
  if (pid < 0) throw std::runtime_error("fork failed");
  if (pid == 0) {
    int result = 99;
    try {
      result = body();
    } catch (...) {}
    ::_exit(result);
  }
  return pid;
}

/// The child's exit code, or 128 + the signal that ended it.
inline int wait_for(pid_t pid) {
  int status = 0;
  if (::waitpid(pid, &status, 0) != pid) throw std::runtime_error("waitpid failed");
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

template <class Body>
int run_child(Body body) {
  return wait_for(start_child(body));
}

}  // namespace nanson::test
