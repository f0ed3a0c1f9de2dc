// What people read: nothing in it steers a terminal, and no stream that fails ends the program.
#include "io/print.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>

#include "tests/support/child.hpp"

namespace nanson {
namespace {

TEST(Print, ShowsControlsAsCodes) {
  EXPECT_EQ(printable("l\x1b[31meft\a\b\r\x7f"), "l\\x1b[31meft\\x07\\x08\\x0d\\x7f");
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(printable("two\nlines\tand µ, 三, 😀"), "two\nlines\tand µ, 三, 😀");
  EXPECT_EQ(printable("caf\xe9"), "caf\\xe9");  // Latin-1
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\xc2\\x9b31m");                      // U+009B: the escape sequence's beginning in one character
  EXPECT_EQ(printable("\xe2\x82"), "\\xe2\\x82");  // cut
  EXPECT_EQ(printable("\xff\xc0\xaf"), "\\xff\\xc0\\xaf");
}

TEST(Print, AFullStreamIsReportedOnceAndEndsNothing) {
  EXPECT_EQ(test::run_child([] {
              if (std::freopen("/dev/full", "w", stdout) == nullptr) return 1;
              for (int i = 0; i < 100000; ++i) print(stdout, "line {}\n", i);
              return lost_output() == ENOSPC ? 0 : 2;
            }),
            0);
}

TEST(Print, NoFileTakesTheNumberOfAClosedStream) {
  for (int closed = 0; closed < 8; ++closed)
    EXPECT_EQ(test::run_child([=] {
                for (int fd = 0; fd < 3; ++fd)
                  if ((closed >> fd & 1) != 0) ::close(fd);
                open_standard_streams();
                std::FILE* file = std::tmpfile();
                if (file == nullptr || ::fileno(file) < 3) return 1;
                print(stdout, "lost\n");
                print(stderr, "lost\n");
                return std::fflush(stdout) + std::fflush(stderr) == 0 && std::fseek(file, 0, SEEK_END) == 0
                               && std::ftell(file) == 0
                           ? 0
                           : 2;
              }),
              0)
        << closed;
}

TEST(Print, NobodyReadingIsNoFailure) {
  EXPECT_EQ(test::run_child([] {
              int ends[2];
              if (::pipe(ends) != 0) return 1;
              ::dup2(ends[1], 1);
              ::close(ends[0]);
              open_standard_streams();
              print(stdout, "to nobody\n");
              return lost_output();
            }),
            0);
}

}  // namespace
}  // namespace nanson
