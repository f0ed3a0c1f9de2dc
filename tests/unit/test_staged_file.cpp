// Runs that are killed and disks that fill up: whatever was written before reads back.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/syscall.h>

#include <csignal>
#include <limits>
#include <random>

#include "io/results/write_fields.hpp"
#include "tests/support/child.hpp"
#include "tests/support/hdf5_reading.hpp"
#include "tests/support/sample_results.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

/// What happens to writes at a position, from the one numbered `after` on. A full disk still takes those below the old end of the file.
enum class Fault { none, kill, disk_full, disk_broken };
struct {
  Fault fault = Fault::none;
  long after = 0, seen = 0;
  off_t old_size = 0;
} trouble;

}  // namespace

/// Stands in front of the system's for the whole test program.
extern "C" ssize_t pwrite(int fd, const void* data, std::size_t size, off_t at) {
  const bool concerned = trouble.fault != Fault::none
                         && (trouble.fault != Fault::disk_full || at + off_t(size) > trouble.old_size);
  if (concerned && ++trouble.seen > trouble.after) {
    if (trouble.fault == Fault::kill) ::raise(SIGKILL);
    errno = trouble.fault == Fault::disk_full ? ENOSPC : EIO;
    return -1;
  }
  return ::syscall(SYS_pwrite64, fd, data, size, at);
}

namespace nanson {
namespace {

using test::beam;
using test::sample_values;

const std::vector<Field> two_fields{field_named("velocity"), field_named("pressure")};

void write_next(FieldWriter& writer, const Mesh& mesh) {
  const double t = double(writer.frames());
  std::vector<float> values;
  writer.frame(t, long(writer.frames()), false, [&](const Field& field) {
    values = sample_values(mesh, field, t);
    return std::span<const float>(values);
  });
}

/// The number of whole frames, at least `reported`, after comparing every one of them both in the series and through its own datasets.
std::size_t check_frames(const std::filesystem::path& path, const Mesh& mesh, std::size_t reported) {
  const auto file = test::open_to_read(path);
  const auto count = test::frame_count(file);
  EXPECT_GE(count, reported);
  const auto times = test::read<double>(file, "/VTKHDF/Steps/Values");
  for (const auto& field : two_fields) {
    const auto all = test::read<float>(file, "/VTKHDF/PointData/" + std::string(field.name));
    for (std::size_t i = 0; i < count; ++i) {
      const auto expected = sample_values(mesh, field, double(i));
      EXPECT_EQ(times[i], double(i));
      EXPECT_EQ(test::read<float>(file, fmt::format("/frames/{:06}/{}", i, field.name)), expected)
          << "frame " << i << " of " << count;
      EXPECT_TRUE(std::equal(expected.begin(), expected.end(), all.begin() + std::ptrdiff_t(i * expected.size())))
          << "frame " << i << " of " << count;
    }
  }
  return count;
}

/// Frames whose appending changes most in the file: the first ones, and those where HDF5 splits its tables (8 frames a table of names, 64 chunks a node).
bool worth_trying(std::size_t frame) {
  return frame < 2 || frame == 4 || frame == 8 || frame == 9 || frame == 12 || frame == 63 || frame == 64
         || frame == 128;
}

TEST(StagedFile, ARunKilledBeforeAnyOfItsWritesKeepsEarlierFrames) {
  const test::TemporaryFolder folder;
  const Mesh mesh = beam(1, 1, 1);
  const auto path = folder / "run.vtkhdf";
  for (const int compress : {0, 1}) {
    std::filesystem::remove(path);
    FieldWriter writer(folder.path(), mesh, two_fields, {}, compress);
    long kills = 0;
    for (std::size_t frame = 0; frame < 130; ++frame) {
      const std::string before = test::read_text(path);
      for (long k = 0; worth_trying(frame); ++k) {
        const int ended = test::run_child([&] {
          trouble = {Fault::kill, k, 0, 0};
          write_next(writer, mesh);
          return 0;
        });
        const auto count = check_frames(path, mesh, frame);
        test::write_text(path, before);
        if (ended == 0) break;
        ASSERT_EQ(ended, 128 + SIGKILL);
        EXPECT_LE(count, frame + 1);
        ASSERT_FALSE(HasFailure()) << "killed at write " << k << " of frame " << frame << ", compress = " << compress;
        ++kills;
      }
      write_next(writer, mesh);
    }
    EXPECT_GT(kills, 300);
  }
}

/// Writes 67 frames, with trouble from every possible write on before it succeeds, and returns how often that was.
long frames_with_trouble(const test::TemporaryFolder& folder, Fault fault, const std::string& reason) {
  const Mesh mesh = beam(1, 1, 1);
  const auto path = folder / "run.vtkhdf";
  FieldWriter writer(folder.path(), mesh, two_fields, {}, 0);
  long refused = 0;
  while (writer.frames() < 67) {
    const auto frame = writer.frames();
    for (long k = 0; worth_trying(frame) && writer.frames() == frame && !testing::Test::HasFailure(); ++k) {
      const auto size = std::filesystem::file_size(path);
      trouble = {fault, k, 0, off_t(size)};
      try {
        write_next(writer, mesh);
        trouble.fault = Fault::none;
      } catch (const std::runtime_error& error) {
        trouble.fault = Fault::none;
        EXPECT_EQ(std::string(error.what()),
                  fmt::format("{}: frame {} (t = {} s) could not be written: {}; the frames before it stay readable",
                              path.string(), frame, frame, reason));
        EXPECT_TRUE(fault == Fault::disk_broken || std::filesystem::file_size(path) == size);
        ++refused;
      }
      EXPECT_LE(check_frames(path, mesh, writer.frames()), writer.frames() + (fault == Fault::disk_full ? 0 : 1))
          << "write " << k << " of frame " << frame;
    }
    if (testing::Test::HasFailure()) return refused;
    if (writer.frames() == frame) write_next(writer, mesh);
  }
  EXPECT_EQ(check_frames(path, mesh, 67), 67u);
  return refused;
}

TEST(StagedFile, ADiskThatFillsUpAtAnyWriteRefusesTheFrameAndKeepsTheOthers) {
  EXPECT_GT(frames_with_trouble(test::TemporaryFolder(), Fault::disk_full, "No space left on device"), 100);
}

TEST(StagedFile, ADiskThatBreaksAtAnyWriteKeepsEarlierFrames) {
  EXPECT_GT(frames_with_trouble(test::TemporaryFolder(), Fault::disk_broken, "Input/output error"), 200);
}

TEST(StagedFile, AFileThatCannotBeCreatedForLackOfSpaceIsReported) {
  const test::TemporaryFolder folder;
  trouble = {Fault::disk_full, 3, 0, 0};
  std::string reason;
  try {
    FieldWriter(folder.path(), beam(1, 1, 1), two_fields, {}, 0);
  } catch (const std::runtime_error& error) {
    reason = error.what();
  }
  trouble.fault = Fault::none;
  EXPECT_EQ(reason, (folder / "run.vtkhdf").string() + ": could not be created: No space left on device");
}

TEST(StagedFile, EveryFrameReportedBeforeAKillReadsBack) {
  const test::TemporaryFolder folder;
  const Mesh mesh = beam(4, 4, 10);
  std::mt19937 random(7);
  for (int run = 0; run < 20; ++run) {
    const auto out = folder / fmt::format("run{}", run);
    std::filesystem::create_directory(out);
    int reported[2];
    ASSERT_EQ(::pipe(reported), 0);
    const pid_t writer = test::start_child([&] {
      FieldWriter fields(out, mesh, two_fields, {}, run % 2);
      for (const char c = 'x';;) {
        write_next(fields, mesh);
        if (::write(reported[1], &c, 1) != 1) return 1;
      }
    });
    ::close(reported[1]);
    char c = 0;
    std::size_t count = 0;
    for (const auto enough = std::uniform_int_distribution<std::size_t>(1, 15)(random); count < enough; ++count)
      ASSERT_EQ(::read(reported[0], &c, 1), 1);
    ::usleep(std::uniform_int_distribution<useconds_t>(0, 3000)(random));  // somewhere in the next frame or two
    ::kill(writer, SIGKILL);
    EXPECT_EQ(test::wait_for(writer), 128 + SIGKILL);
    while (::read(reported[0], &c, 1) == 1) ++count;
    ::close(reported[0]);
    check_frames(out / "run.vtkhdf", mesh, count);
  }
}

}  // namespace
}  // namespace nanson
