// Children of a study: their end, their output, their time limit, signals passed on.
#include <gtest/gtest.h>

#include <csignal>

#include "io/child_process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace nanson {
namespace {

struct Shell {
  test::TemporaryFolder folder;
  ChildEnd run(const std::string& script, const ChildLimits& limits = {}, int signal = 0) {
    return run_child({"/bin/sh", "-c", script}, folder / "log.txt", limits,
                     [&] { return std::filesystem::exists(folder / "ready") ? signal : 0; });
  }
  std::string ready() const { return "touch '" + (folder / "ready").string() + "'; "; }
  /// With a time limit that ends the script after it was ready: on a stalled machine a longer one.
  ChildEnd run_too_long(const std::string& script, double grace_s) {
    for (double limit = 0.3;; limit *= 4) {
      const ChildEnd end = run(script, {limit, grace_s});
      if (std::filesystem::exists(folder / "ready") || limit > 60) return end;
    }
  }
};

TEST(ChildProcess, ItsExitCodeAndOutputAreKept) {
  Shell shell;
  const ChildEnd end = shell.run("echo out; echo err >&2; exit 3");
  EXPECT_EQ(end.code, 3);
  EXPECT_FALSE(end.too_slow);
  EXPECT_EQ(end.stopped, 0);
  EXPECT_EQ(test::read_text(shell.folder / "log.txt"), "out\nerr\n");
  EXPECT_EQ(shell.run("kill -9 $$").code, 137);
}

TEST(ChildProcess, ThatTakesTooLongIsAskedToEnd) {
  Shell shell;
  const ChildEnd end = shell.run_too_long(
      "trap 'echo polite; exit 143' TERM; " + shell.ready() + "while :; do sleep 0.01; done", 30);
  EXPECT_TRUE(end.too_slow);
  EXPECT_EQ(end.code, 143);
  EXPECT_GE(end.wall_s, 0.3);
  EXPECT_EQ(test::read_text(shell.folder / "log.txt"), "polite\n");
}

TEST(ChildProcess, ThatDoesNotListenIsKilled) {
  Shell shell;
  const ChildEnd end = shell.run_too_long("trap '' TERM; " + shell.ready() + "while :; do sleep 0.01; done", 0.2);
  EXPECT_TRUE(end.too_slow);
  EXPECT_EQ(end.code, 137);
}

TEST(ChildProcess, ASignalIsPassedOnOnce) {
  Shell shell;
  const ChildEnd end = shell.run(
      "trap 'echo interrupted' INT; " + shell.ready() + "for i in 1 2 3 4 5 6 7 8 9 10; do sleep 0.02; done; exit 7",
      {}, SIGINT);
  EXPECT_EQ(end.stopped, SIGINT);
  EXPECT_EQ(end.code, 7);
  EXPECT_EQ(test::read_text(shell.folder / "log.txt"), "interrupted\n");
}

TEST(ChildProcess, ThatCannotBeStartedSaysWhy) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(run_child({"/nonexistent"}, folder / "log.txt", {}, [] { return 0; }).code, 127);
  EXPECT_EQ(test::read_text(folder / "log.txt"), "No such file or directory");
  EXPECT_THROW(run_child({"/bin/sh"}, folder / "none" / "log.txt", {}, [] { return 0; }), std::runtime_error);
}

}  // namespace
}  // namespace nanson
