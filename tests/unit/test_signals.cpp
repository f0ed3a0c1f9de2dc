// Stop signals: the first is noted, the second ends the program.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

#include "io/signals.hpp"
#include "tests/support/child.hpp"

namespace nanson {
namespace {

TEST(Signals, TheFirstIsNotedAndTheSecondEndsTheProgram) {
  for (const int first : {SIGINT, SIGTERM, SIGHUP, SIGXCPU})
    for (const int second : {SIGINT, SIGTERM, SIGHUP, SIGXCPU})
      EXPECT_EQ(test::run_child([=] {
                  const rlimit no_core{0, 0};
                  ::setrlimit(RLIMIT_CORE, &no_core);
                  catch_stop_signals();
                  if (stop_signal() != 0) return 1;
                  ::raise(first);
                  if (stop_signal() != first) return 2;
                  ::raise(second);
                  return 3;
                }),
                128 + second)
          << first;
}

TEST(Signals, OneThatWasIgnoredStaysIgnored) {
  EXPECT_EQ(test::run_child([] {
              std::signal(SIGINT, SIG_IGN);
              catch_stop_signals();
              ::raise(SIGINT);
              if (stop_signal() != 0) return 1;
              ::raise(SIGTERM);
              ::raise(SIGINT);
              return stop_signal() == SIGTERM ? 0 : 2;
            }),
            0);
}

TEST(Signals, AFileSizeLimitDoesNotEndTheProgram) {
  EXPECT_EQ(test::run_child([] {
              catch_stop_signals();
              ::raise(SIGXFSZ);
              return 0;
            }),
            0);
}

}  // namespace
}  // namespace nanson
