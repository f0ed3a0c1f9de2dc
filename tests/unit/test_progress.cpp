// The progress line: how often, on what, and what it says.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <memory>

#include "io/progress.hpp"

namespace nanson {
namespace {

using Clock = Progress::Clock;
using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

constexpr Clock::time_point start{};
Clock::time_point after(double seconds) {
  return start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

std::string written(std::FILE* file) {
  std::rewind(file);
  std::string text(10000, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), file));
  return text;
}

/// What a run of 1000 steps, each of the given wall time, writes to a log.
std::string log_of(double seconds_a_step, bool quiet, std::optional<double> closure = {}) {
  const File file(std::tmpfile(), std::fclose);
  {
    Progress progress(0, 1, quiet, file.get(), start);
    for (int i = 1; i <= 1000; ++i) progress.update(i, i * 1e-3, 1e-3, closure, after(i * seconds_a_step));
  }
  return written(file.get());
}

long lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

TEST(Progress, ALogHasALineEveryTenPercent) {
  const std::string log = log_of(0.01, false);
  EXPECT_EQ(lines(log), 11) << log;
  EXPECT_NE(log.find(" 50.0 %  step      500  t 5.0000e-01 s  dt 1.00e-03 s  ETA 5s\n"), std::string::npos) << log;
  EXPECT_NE(log.find("100.0 %  step     1000  t 1.0000e+00 s  dt 1.00e-03 s  ETA 0s\n"), std::string::npos) << log;
  EXPECT_EQ(log.find('\r'), std::string::npos);
}

TEST(Progress, ALogHasALineEveryMinuteWhenTenPercentTakeLonger) {
  const std::string log = log_of(6, false);  // 100 minutes: a line each, as every tenth falls on a full minute
  EXPECT_EQ(lines(log), 101) << log;
  EXPECT_NE(log.find("  1.1 %  step       11"), std::string::npos) << log;
}

TEST(Progress, TheEnergyBalanceIsShownWhereItIsKnown) {
  EXPECT_NE(log_of(0.01, false, 2.5e-5).find("s  dE/E +2.5e-05  ETA"), std::string::npos);
  EXPECT_EQ(log_of(0.01, false).find("dE/E"), std::string::npos);
}

TEST(Progress, QuietShowsMessagesOnly) {
  EXPECT_EQ(log_of(0.01, true), "");
  const File file(std::tmpfile(), std::fclose);
  Progress progress(0, 1, true, file.get(), start);
  progress.message("the energy grows");
  EXPECT_EQ(written(file.get()), "the energy grows\n");
}

TEST(Progress, ATerminalLineIsRedrawnFiveTimesASecondAndEndsInItsFinalState) {
  const int controller = ::posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_GE(controller, 0);
  ASSERT_EQ(::grantpt(controller) + ::unlockpt(controller), 0);
  {
    const File terminal(std::fopen(::ptsname(controller), "w"), std::fclose);
    ASSERT_NE(terminal.get(), nullptr);
    Progress progress(0, 1, false, terminal.get(), start);
    for (int i = 1; i <= 99; ++i) progress.update(i, i * 1e-2, 1e-2, {}, after(i * 1e-2));
    progress.message("a message");
    for (int i = 0; i < 2; ++i) progress.update(100, 1.0, 1e-2, {}, after(1.0));
    progress.end();
    std::fputs("done\n", terminal.get());
  }
  std::string text;
  for (char c = 0; ::read(controller, &c, 1) == 1;) text += c;  // until the other end is closed: it arrives in pieces
  ::close(controller);
  std::size_t drawn = 0;
  for (auto at = text.find("step "); at != std::string::npos; at = text.find("step ", at + 1)) ++drawn;
  EXPECT_EQ(drawn, 6u) << text;  // at 0.2, 0.4, 0.6, 0.8 s, again below the message, and at the end
  EXPECT_EQ(text.rfind("\r\033[K100.0 %"), text.rfind("\033[K") - 1) << text;
  EXPECT_NE(text.find("\r\033[Ka message\r\n 8"), std::string::npos) << text;
  EXPECT_NE(text.find("ETA 0s\r\ndone\r\n"), std::string::npos) << text;
  EXPECT_EQ(text.substr(text.size() - 6), "done\r\n");
}

TEST(Progress, DurationsAreShort) {
  EXPECT_EQ(duration_text(0.4), "0s");
  EXPECT_EQ(duration_text(59.4), "59s");
  EXPECT_EQ(duration_text(187), "3m07s");
  EXPECT_EQ(duration_text(7500), "2h05m");
  EXPECT_EQ(duration_text(-1), "--");
  EXPECT_EQ(duration_text(0.0 / 0.0), "--");
  EXPECT_EQ(duration_text(1e9), "--");
}

}  // namespace
}  // namespace nanson
