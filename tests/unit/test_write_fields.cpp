// run.vtkhdf and run.xdmf: what is written reads back, also beside a reader that holds the file.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numeric>

#include "io/results/write_fields.hpp"
#include "tests/support/child.hpp"
#include "tests/support/hdf5_reading.hpp"
#include "tests/support/sample_results.hpp"
#include "tests/support/temporary_folder.hpp"

namespace nanson {
namespace {

using hdf5::Dims;
using std::int64_t;
using test::beam;
using test::read;
using test::sample_values;

std::vector<Field> fields(std::initializer_list<const char*> names) {
  std::vector<Field> out;
  for (const char* name : names) out.push_back(field_named(name));
  return out;
}

/// Writes frames at t = 0, 0.5, 1, ... of the sample values.
void write_frames(FieldWriter& writer, const Mesh& mesh, int count, bool last_is_broken = false) {
  for (int i = 0; i < count; ++i) {
    const double t = 0.5 * double(writer.frames());
    std::vector<float> values;
    writer.frame(t, 10 * long(writer.frames()), last_is_broken && i + 1 == count, [&](const Field& field) {
      values = sample_values(mesh, field, t);
      return std::span<const float>(values);
    });
  }
}

void expect_frames(const std::filesystem::path& path, const Mesh& mesh, const std::vector<Field>& names,
                   std::size_t count) {
  const auto file = test::open_to_read(path);
  ASSERT_EQ(test::frame_count(file), count);
  for (const auto& field : names) {
    std::vector<float> all;
    for (std::size_t i = 0; i < count; ++i) {
      const auto expected = sample_values(mesh, field, 0.5 * double(i));
      Dims dims;
      EXPECT_EQ(read<float>(file, fmt::format("/frames/{:06}/{}", i, field.name), &dims), expected);
      const Dims one = field.components == 1 ? Dims{mesh.X.size()} : Dims{mesh.X.size(), hsize_t(field.components)};
      EXPECT_EQ(dims, one);
      all.insert(all.end(), expected.begin(), expected.end());
    }
    EXPECT_EQ(read<float>(file, fmt::format("/VTKHDF/PointData/{}", field.name)), all);
  }
}

Dims chunk_of(hid_t file, const std::string& name) {
  const auto data = hdf5::open_dataset(file, name);
  const hdf5::Handle plist(H5Dget_create_plist(data), name);
  Dims chunk(8);
  chunk.resize(std::size_t(hdf5::check(H5Pget_chunk(plist, 8, chunk.data()), name)));
  return chunk;
}

TEST(WriteFields, TheMeshReadsBack) {
  const test::TemporaryFolder folder;
  const Mesh mesh = beam(1, 2, 3);
  FieldWriter(folder.path(), mesh, fields({"displacement"}), {}, 0);
  const auto file = test::open_to_read(folder / "run.vtkhdf");
  const auto n = int64_t(mesh.X.size()), m = int64_t(mesh.tets.size());
  EXPECT_EQ(read<int64_t>(file, "/VTKHDF/NumberOfPoints"), std::vector{n});
  EXPECT_EQ(read<int64_t>(file, "/VTKHDF/NumberOfCells"), std::vector{m});
  EXPECT_EQ(read<int64_t>(file, "/VTKHDF/NumberOfConnectivityIds"), std::vector{4 * m});
  const auto points = read<double>(file, "/VTKHDF/Points");
  const auto connectivity = read<int64_t>(file, "/VTKHDF/Connectivity"),
             offsets = read<int64_t>(file, "/VTKHDF/Offsets");
  for (std::size_t a = 0; a < mesh.X.size(); ++a)
    for (std::size_t d = 0; d < 3; ++d) EXPECT_EQ(points[3 * a + d], mesh.X[a][d]);
  for (std::size_t e = 0; e < mesh.tets.size(); ++e)
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(connectivity[std::size_t(offsets[e]) + k], mesh.tets[e][k]);
  EXPECT_EQ(offsets.back(), 4 * m);
  EXPECT_EQ(read<std::uint8_t>(file, "/VTKHDF/Types"), std::vector<std::uint8_t>(mesh.tets.size(), 10));
  EXPECT_EQ(read<std::int32_t>(file, "/VTKHDF/CellData/region"), mesh.tet_region);
  EXPECT_EQ(test::read_strings(file, "/VTKHDF/CellData/region", "names"), mesh.region_names);
}

TEST(WriteFields, AllFramesReadBackAsSeriesAndOneByOne) {
  const test::TemporaryFolder folder;
  const Mesh mesh = beam(2, 2, 4);
  const auto names = fields({"displacement", "velocity", "pressure", "P"});
  FieldWriter writer(folder.path(), mesh, names, {}, 0);
  write_frames(writer, mesh, 5);
  EXPECT_EQ(writer.frames(), 5u);
  expect_frames(folder / "run.vtkhdf", mesh, names, 5);
  const auto file = test::open_to_read(folder / "run.vtkhdf");
  EXPECT_EQ(test::read_strings(file, "/VTKHDF/PointData/velocity", "unit"), std::vector<std::string>{"m/s"});
  EXPECT_EQ(test::read_attribute<double>(file, "/frames/000003", "time"), 1.5);
  EXPECT_EQ(test::read_attribute<int64_t>(file, "/frames/000003", "step"), 30);
}

TEST(WriteFields, StepsSayWhereEachFrameBegins) {
  const test::TemporaryFolder folder;
  const Mesh mesh = beam(1, 1, 1);
  FieldWriter writer(folder.path(), mesh, fields({"velocity", "J"}), {}, 0);
  write_frames(writer, mesh, 3);
  const auto file = test::open_to_read(folder / "run.vtkhdf");
  EXPECT_EQ(read<double>(file, "/VTKHDF/Steps/Values"), (std::vector{0.0, 0.5, 1.0}));
  for (const char* name : {"PointDataOffsets/velocity", "PointDataOffsets/J"})
    EXPECT_EQ(read<int64_t>(file, fmt::format("/VTKHDF/Steps/{}", name)), (std::vector<int64_t>{0, 8, 16})) << name;
  for (const char* name :
       {"PartOffsets", "PointOffsets", "CellOffsets", "ConnectivityIdOffsets", "CellDataOffsets/region"})
    EXPECT_EQ(read<int64_t>(file, fmt::format("/VTKHDF/Steps/{}", name)), std::vector<int64_t>(3, 0)) << name;
  EXPECT_EQ(read<int64_t>(file, "/VTKHDF/Steps/NumberOfParts"), std::vector<int64_t>(3, 1));
  Dims dims;
  read<int64_t>(file, "/VTKHDF/Steps/CellOffsets", &dims);
  EXPECT_EQ(dims, (Dims{3, 1}));
}

TEST(WriteFields, TheBrokenStateIsMarked) {
  const test::TemporaryFolder folder;
  const Mesh mesh = beam(1, 1, 2);
  FieldWriter writer(folder.path(), mesh, fields({"J"}), {}, 0);
  write_frames(writer, mesh, 3, true);
  const auto file = test::open_to_read(folder / "run.vtkhdf");
  EXPECT_FALSE(test::has_attribute(file, "/frames/000001", "breakdown"));
  EXPECT_EQ(test::read_attribute<std::int32_t>(file, "/frames/000002", "breakdown"), 1);
  const std::string xdmf = test::read_text(folder / "run.xdmf"), mark = R"(<Information Name="breakdown" Value="1"/>)";
  const auto found = xdmf.find(mark);
  EXPECT_GT(found, xdmf.find("frame 2"));
  EXPECT_EQ(xdmf.find(mark, found + 1), std::string::npos);
}

TEST(WriteFields, TheSidecarHasATimeForEveryFrame) {
  const test::TemporaryFolder folder;
  const Mesh mesh = beam(1, 1, 2);
  FieldWriter writer(folder.path(), mesh, fields({"displacement", "F"}), {}, 0);
  write_frames(writer, mesh, 3);
  const std::string xdmf = test::read_text(folder / "run.xdmf");
  for (const char* text : {R"(<Time Value="0"/>)", R"(<Time Value="0.5"/>)", R"(<Time Value="1"/>)",
                           "run.vtkhdf:/frames/000002/displacement",
                           R"(<Attribute Name="F" AttributeType="Tensor" Center="Node"><DataItem Dimensions="12 9")",
                           "</Grid></Domain></Xdmf>"})
    EXPECT_NE(xdmf.find(text), std::string::npos) << text;
  EXPECT_FALSE(std::filesystem::exists(folder / "run.xdmf.tmp"));
}

TEST(WriteFields, TheSidecarOfManyFramesIsWrittenNowAndThenAndWholeAtTheEnd) {
  const test::TemporaryFolder folder;
  const Mesh mesh = beam(1, 1, 1);
  const auto count = [&] {
    const std::string xdmf = test::read_text(folder / "run.xdmf");
    std::size_t frames = 0;
    for (auto at = xdmf.find("<Time"); at != std::string::npos; at = xdmf.find("<Time", at + 1)) ++frames;
    return frames;
  };
  std::size_t writes = 0, before = 0;
  {
    FieldWriter writer(folder.path(), mesh, fields({"J"}), {}, 0);
    for (std::size_t frame = 1; frame <= 200; ++frame) {
      write_frames(writer, mesh, 1);
      const std::size_t now = count();
      EXPECT_GE(now + frame / 8, frame);
      writes += now != before;
      before = now;
    }
    EXPECT_LT(writes, 60u);
    writer.finish();
    EXPECT_EQ(count(), 200u);
    write_frames(writer, mesh, 1);
  }
  EXPECT_EQ(count(), 201u);  // the end of a writer, as after an error
}

TEST(WriteFields, AttributesHoldTextOfAnyLength) {
  const test::TemporaryFolder folder;
  const std::string scene = "# \u00e9 \"quoted\"\n" + std::string(200000, 'x');
  FieldWriter(folder.path(), beam(1, 1, 1), {}, {{"generator", "nanson"}, {"commit", ""}, {"scene", scene}}, 0);
  const auto file = test::open_to_read(folder / "run.vtkhdf");
  EXPECT_EQ(test::read_strings(file, "/", "generator"), std::vector<std::string>{"nanson"});
  EXPECT_EQ(test::read_strings(file, "/", "commit"), std::vector<std::string>{""});
  EXPECT_EQ(test::read_strings(file, "/", "scene"), std::vector<std::string>{scene});
}

TEST(WriteFields, ChunksAreCappedAndNotLargerThanAFrame) {
  const test::TemporaryFolder large_folder, small_folder;
  Mesh large = beam(1, 1, 1);
  large.X.resize(70000);
  FieldWriter large_writer(large_folder.path(), large, fields({"velocity", "J"}), {}, 0);
  write_frames(large_writer, large, 3);
  expect_frames(large_folder / "run.vtkhdf", large, fields({"velocity", "J"}), 3);
  FieldWriter(small_folder.path(), beam(1, 1, 1), fields({"velocity"}), {}, 0);
  EXPECT_EQ(chunk_of(test::open_to_read(large_folder / "run.vtkhdf"), "/VTKHDF/PointData/velocity"), (Dims{65536, 3}));
  EXPECT_EQ(chunk_of(test::open_to_read(large_folder / "run.vtkhdf"), "/VTKHDF/PointData/J"), (Dims{65536}));
  EXPECT_EQ(chunk_of(test::open_to_read(small_folder / "run.vtkhdf"), "/VTKHDF/PointData/velocity"), (Dims{8, 3}));
}

TEST(WriteFields, CompressedFramesReadBackAndShareNoChunk) {
  const test::TemporaryFolder folder;
  Mesh mesh = beam(1, 1, 1);
  mesh.X.resize(70000);
  const auto names = fields({"displacement", "pressure"});
  FieldWriter writer(folder.path(), mesh, names, {}, 1);
  write_frames(writer, mesh, 3);
  expect_frames(folder / "run.vtkhdf", mesh, names, 3);
  EXPECT_EQ(chunk_of(test::open_to_read(folder / "run.vtkhdf"), "/VTKHDF/PointData/displacement"), (Dims{70000, 3}));
  EXPECT_LT(std::filesystem::file_size(folder / "run.vtkhdf"), 3u * 70000 * 4 * 4 / 2 + 70000 * 24);
}

TEST(WriteFields, AReaderInAnotherProcessDoesNotStopTheRun) {
  const test::TemporaryFolder folder;
  const Mesh mesh = beam(1, 1, 4);
  const auto names = fields({"velocity"});
  FieldWriter writer(folder.path(), mesh, names, {}, 0);
  write_frames(writer, mesh, 1);
  int ready[2], done[2];
  ASSERT_EQ(::pipe(ready) + ::pipe(done), 0);
  const pid_t reader = test::start_child([&] {
    char c = 0;
    {
      const auto file = test::open_to_read(folder / "run.vtkhdf");
      if (test::frame_count(file) != 1 || ::write(ready[1], &c, 1) != 1 || ::read(done[0], &c, 1) != 1) return 1;
    }
    return test::frame_count(test::open_to_read(folder / "run.vtkhdf")) == 3 ? 0 : 2;
  });
  char c = 0;
  ASSERT_EQ(::read(ready[0], &c, 1), 1);
  EXPECT_NO_THROW(write_frames(writer, mesh, 2));
  ASSERT_EQ(::write(done[1], &c, 1), 1);
  EXPECT_EQ(test::wait_for(reader), 0);
  expect_frames(folder / "run.vtkhdf", mesh, names, 3);
  for (const int fd : {ready[0], ready[1], done[0], done[1]}) ::close(fd);
}

TEST(WriteFields, AReaderInTheSameProcessDoesNotStopTheRun) {
  const test::TemporaryFolder folder;
  const Mesh mesh = beam(1, 1, 4);
  const auto names = fields({"velocity"});
  FieldWriter writer(folder.path(), mesh, names, {}, 0);
  write_frames(writer, mesh, 1);
  {
    const auto held = test::open_to_read(folder / "run.vtkhdf");
    EXPECT_NO_THROW(write_frames(writer, mesh, 1));
  }
  expect_frames(folder / "run.vtkhdf", mesh, names, 2);
}

TEST(WriteFields, AnEarlierFileIsNotOverwritten) {
  const test::TemporaryFolder folder;
  const Mesh mesh = beam(1, 1, 1);
  FieldWriter writer(folder.path(), mesh, fields({"J"}), {}, 0);
  write_frames(writer, mesh, 1);
  try {
    FieldWriter(folder.path(), mesh, fields({"J"}), {}, 0);
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()), (folder / "run.vtkhdf").string() + ": could not be created: File exists");
  }
  expect_frames(folder / "run.vtkhdf", mesh, fields({"J"}), 1);
}

TEST(WriteFields, AFolderThatVanishesIsReported) {
  const test::TemporaryFolder folder;
  const Mesh mesh = beam(1, 1, 1);
  std::filesystem::create_directory(folder / "run");
  FieldWriter writer(folder / "run", mesh, fields({"J"}), {}, 0);
  write_frames(writer, mesh, 1);
  std::filesystem::remove_all(folder / "run");
  try {
    write_frames(writer, mesh, 1);
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()), (folder / "run").string() + "/run.vtkhdf: frame 1 (t = 0.5 s) could not be written: No such file or directory; "
                                                                     "the frames before it stay readable");
  }
  EXPECT_EQ(writer.frames(), 1u);
}

TEST(WriteFields, AFieldOfTheWrongLengthIsRefused) {
  const test::TemporaryFolder folder;
  const Mesh mesh = beam(1, 1, 1);
  FieldWriter writer(folder.path(), mesh, fields({"J"}), {}, 0);
  const std::vector<float> short_field(7);
  EXPECT_THROW(writer.frame(0, 0, false, [&](const Field&) { return std::span<const float>(short_field); }),
               std::logic_error);
  write_frames(writer, mesh, 1);
  expect_frames(folder / "run.vtkhdf", mesh, fields({"J"}), 1);
}

}  // namespace
}  // namespace nanson
