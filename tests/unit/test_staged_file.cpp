// Runs that are killed and disks that fill up: whatever was written before reads back.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/syscall.h>

#include <csignal>
#include <limits>
#include <random>

#include "io/write_fields.hpp"
#include "tests/support/child.hpp"
#include "tests/support/hdf5_reading.hpp"
#include "tests/support/sample_results.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

/// What happens to writes at a position, from the one numbered `after` on.
enum class Fault { none, kill, disk_full };
struct {
  Fault fault = Fault::none;
  long after = 0, seen = 0;
  off_t old_size = 0;                                // a full disk still takes writes below it
} trouble;

}  // namespace

/// Stands in front of the system's for the whole test program.
extern "C" ssize_t pwrite(int fd, const void* data, std::size_t size, off_t at) {
  if (trouble.fault == Fault::kill && ++trouble.seen > trouble.after) ::raise(SIGKILL);
  if (trouble.fault == Fault::disk_full && at + off_t(size) > trouble.old_size && ++trouble.seen > trouble.after) {
    errno = ENOSPC;
    return -1;
  }
  return ::syscall(SYS_pwrite64, fd, data, size, at);
}

namespace nanson {
namespace {

using test::beam;
using test::sample_values;

const std::vector<FieldName> two_fields{test::field_named("velocity"), test::field_named("pressure")};

void write_next(FieldWriter& writer, const Mesh& mesh) {
  const double t = double(writer.frames());
  std::vector<float> values;
  writer.frame(t, long(writer.frames()), false, [&](const FieldName& field) {
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
      EXPECT_EQ(test::read<float>(file, fmt::format("/frames/{:06}/{}", i, field.name)), expected) << "frame " << i << " of " << count;
      EXPECT_TRUE(std::equal(expected.begin(), expected.end(), all.begin() + std::ptrdiff_t(i * expected.size()))) << "frame " << i << " of " << count;
    }
  }
  return count;
}

/// Frames whose appending changes most in the file: the first ones, and those where HDF5 splits its tables (8 frames a table of names, 64 chunks a node).
bool worth_trying(std::size_t frame) { return frame < 2 || frame == 4 || frame == 8 || frame == 9 || frame == 12 || frame == 63 || frame == 64 || frame == 128; }

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

TEST(StagedFile, ADiskThatFillsUpAtAnyWriteRefusesTheFrameAndKeepsTheOthers) {
  const test::TemporaryFolder folder;
  const Mesh mesh = beam(1, 1, 1);
  const auto path = folder / "run.vtkhdf";
  FieldWriter writer(folder.path(), mesh, two_fields, {}, 0);
  long refused = 0;
  for (std::size_t frame = 0; frame < 67; ++frame) {
    for (long k = 0; worth_trying(frame) && writer.frames() == frame; ++k) {
      const auto size = std::filesystem::file_size(path);
      trouble = {Fault::disk_full, k, 0, off_t(size)};
      try {
        write_next(writer, mesh);
        trouble.fault = Fault::none;
      } catch (const std::runtime_error& error) {
        trouble.fault = Fault::none;
        EXPECT_EQ(std::string(error.what()), fmt::format("{}: frame {} (t = {} s) could not be written: No space left on device; the frames before it stay "
                                                         "readable", path.string(), frame, frame));
        EXPECT_EQ(std::filesystem::file_size(path), size);
        ++refused;
      }
      EXPECT_EQ(check_frames(path, mesh, writer.frames()), writer.frames());
      ASSERT_FALSE(HasFailure()) << "write " << k << " of frame " << frame;
    }
    if (writer.frames() == frame) write_next(writer, mesh);
  }
  EXPECT_GT(refused, 100);
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
  std::size_t total = 0;
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
    std::size_t count = std::size_t(::read(reported[0], &c, 1));
    ::usleep(std::uniform_int_distribution<useconds_t>(0, 40000)(random));
    ::kill(writer, SIGKILL);
    EXPECT_EQ(test::wait_for(writer), 128 + SIGKILL);
    while (::read(reported[0], &c, 1) == 1) ++count;
    ::close(reported[0]);
    check_frames(out / "run.vtkhdf", mesh, count);
    total += count;
  }
  EXPECT_GT(total, 40u);
}

}  // namespace
}  // namespace nanson
