// history.csv: exact numbers, a row on disk as soon as it is written, and no half rows.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <limits>
#include <sstream>

#include "io/results/write_history.hpp"
#include "tests/support/child.hpp"
#include "tests/support/temporary_folder.hpp"

namespace nanson {
namespace {

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no exception";
}

TEST(WriteHistory, HeaderAndRows) {
  const test::TemporaryFolder folder;
  HistoryWriter history(folder / "history.csv", {{"t", "s"}, {"dt", "s"}, {"kinetic", "J"}, {"closure", "-"}});
  history.row(std::array{0.0, 1e-5, 17.25, 0.1});
  EXPECT_EQ(test::read_text(folder / "history.csv"), "t [s],dt [s],kinetic [J],closure [-]\n0,1e-05,17.25,0.1\n");
}

TEST(WriteHistory, NumbersReadBackToTheLastBit) {
  const test::TemporaryFolder folder;
  const std::vector<double> values{
      1.0 / 3, -0.1, 6.02214076e23, 5e-324, std::numeric_limits<double>::max(), std::nextafter(1.0, 2.0), -0.0};
  HistoryWriter history(folder / "history.csv", std::vector<HistoryColumn>(values.size(), {"x", "-"}));
  history.row(values);
  std::istringstream file(test::read_text(folder / "history.csv"));
  std::string text;
  std::getline(file, text);
  for (const double expected : values) {
    std::getline(file, text, ',');
    const double got = std::strtod(text.c_str(), nullptr);
    EXPECT_EQ(got, expected) << text;
    EXPECT_EQ(std::signbit(got), std::signbit(expected)) << text;
  }
}

TEST(WriteHistory, NotANumberIsNanWhateverItsSign) {
  const test::TemporaryFolder folder;
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  HistoryWriter history(folder / "history.csv", std::vector<HistoryColumn>(4, {"x", "-"}));
  history.row(std::array{nan, std::copysign(nan, -1.0), inf, -inf});
  EXPECT_NE(test::read_text(folder / "history.csv").find("\nnan,nan,inf,-inf\n"), std::string::npos);
}

TEST(WriteHistory, NamesWithCommasAndQuotesAreQuoted) {
  const test::TemporaryFolder folder;
  HistoryWriter(folder / "history.csv", {{"tip, upper.v", "m/s"}, {"a\"b", "-"}});
  EXPECT_EQ(test::read_text(folder / "history.csv"), "\"tip, upper.v [m/s]\",\"a\"\"b [-]\"\n");
}

TEST(WriteHistory, ARowIsThereWhenTheProgramIsKilledAfterIt) {
  const test::TemporaryFolder folder;
  const int ended = test::run_child([&] {
    HistoryWriter history(folder / "history.csv", {{"t", "s"}});
    for (const double t : {0.0, 0.5}) history.row(std::array{t});
    return ::raise(SIGKILL);
  });
  EXPECT_EQ(ended, 128 + SIGKILL);
  EXPECT_EQ(test::read_text(folder / "history.csv"), "t [s]\n0\n0.5\n");
}

TEST(WriteHistory, ARowOfTheWrongLengthIsRefused) {
  const test::TemporaryFolder folder;
  HistoryWriter history(folder / "history.csv", {{"t", "s"}, {"dt", "s"}});
  EXPECT_THROW(history.row(std::array{1.0}), std::logic_error);
}

TEST(WriteHistory, ARowThatDoesNotFitLeavesNoHalfRow) {
  const test::TemporaryFolder folder;
  const auto path = folder / "history.csv";
  const int ended = test::run_child([&] {
    HistoryWriter history(path, {{"t", "s"}, {"dt", "s"}});
    history.row(std::array{0.0, 0.25});
    const rlimit before{RLIM_INFINITY, RLIM_INFINITY}, tight{std::filesystem::file_size(path) + 3, RLIM_INFINITY};
    std::signal(SIGXFSZ, SIG_IGN);
    ::setrlimit(RLIMIT_FSIZE, &tight);
    const std::string reason = message_of([&] { history.row(std::array{1.0 / 3, 1.0 / 7}); });
    if (reason != path.string() + ": a row could not be written: File too large") return 1;
    ::setrlimit(RLIMIT_FSIZE, &before);
    history.row(std::array{2.0, 0.5});
    return 0;
  });
  EXPECT_EQ(ended, 0);
  EXPECT_EQ(test::read_text(path), "t [s],dt [s]\n0,0.25\n2,0.5\n");
}

TEST(WriteHistory, AFolderThatIsMissingOrVanishesIsReported) {
  const test::TemporaryFolder folder;
  const auto path = folder / "run" / "history.csv";
  EXPECT_EQ(message_of([&] {
              HistoryWriter(path, {{"t", "s"}});
            }),
            path.string() + ": could not be created: No such file or directory");
  std::filesystem::create_directory(folder / "run");
  HistoryWriter history(path, {{"t", "s"}});
  std::filesystem::remove_all(folder / "run");
  EXPECT_EQ(message_of([&] { history.row(std::array{0.0}); }),
            path.string() + ": a row could not be written: No such file or directory");
}

}  // namespace
}  // namespace nanson
