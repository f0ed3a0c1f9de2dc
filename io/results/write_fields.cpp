// The layout of run.vtkhdf and how a frame is added to it.
#include "io/results/write_fields.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <thread>

#include "io/posix_file.hpp"
#include "io/replace_file.hpp"
#include "io/results/hdf5.hpp"
#include "io/results/results_folder.hpp"
#include "io/results/staged_file.hpp"
#include "io/results/xdmf.hpp"

namespace nanson {
namespace {

using hdf5::Dims;
using hdf5::Handle;
using std::int64_t;
using Clock = std::chrono::steady_clock;

/// SEMI: closing a file while a handle is open is an error, where HDF5 would otherwise leave the file open without a word.
/// Earliest format: no consistency flags, which would make the file of a killed run unreadable, and the tables that io/staged_file knows.
Handle file_access(bool lock) {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), "file access");
  hdf5::check(H5Pset_file_locking(access, lock, true), "file locking");
  hdf5::check(H5Pset_fclose_degree(access, H5F_CLOSE_SEMI), "close degree");
  hdf5::use_staged_driver(access);
  hdf5::check(H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST), "format bounds");
  return access;
}

/// Locked, so that a reader who comes now is told so instead of seeing half a frame. A reader who holds the file gets `patience` milliseconds to finish, as
/// it would mix old and new tables; but one who stays (a window left open) must not stop the run, so patience halves every time it was in vain.
Handle open_for_append(const std::filesystem::path& path, int& patience) {
  const Handle access = file_access(true);
  for (int waited = 0; waited <= patience; ++waited) {
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, access);
    if (file >= 0) {
      patience = most_patience;
      return {file, "opening"};
    }
    H5Eclear2(H5E_DEFAULT);
    if (waited < patience) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  patience /= 2;
  return {H5Fopen(path.c_str(), H5F_ACC_RDWR, file_access(false)), "opening"};
}

/// Closing alone would hide that a write failed.
void flush_and_close(Handle& file) {
  hdf5::check(H5Fflush(file, H5F_SCOPE_GLOBAL), "flushing");
  file.close("closing");
}

/// By hand first: O_EXCL keeps an earlier run's results, and the system's reason is plainer than HDF5's.
Handle create_file(const std::filesystem::path& path) {
  if (!Descriptor(path, O_WRONLY | O_CREAT | O_EXCL)) throw hdf5::Error(std::strerror(errno));
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, file_access(false)), "creating"};
}

/// The group of all frames, with room for 8000 names of 8 bytes. A heap of names is one block only as long as it has not grown, and io/staged_file can
/// change a single block safely, not two that refer to each other.
void create_frames(hid_t file) {
  const Handle creation(H5Pcreate(H5P_GROUP_CREATE), "frames");
  hdf5::check(H5Pset_local_heap_size_hint(creation, 1 << 16), "frames");
  hdf5::create_group(file, "frames", creation);
}

Dims shape(const Field& field, std::size_t rows) {
  return field.components == 1 ? Dims{rows} : Dims{rows, hsize_t(field.components)};
}

/// At most 65536 rows, so that a chunk stays small beside a frame. But compressed chunks hold whole frames as far as possible (HDF5 allows 4 GiB): a chunk
/// that two frames share would change its size with the second, move, and be lost with a run that is killed just then.
hsize_t rows_in_chunk(const Field& field, std::size_t nodes, int compress) {
  const std::size_t most = compress > 0 ? (std::size_t{1} << 30) / (sizeof(float) * std::size_t(field.components))
                                        : 65536;
  return std::min(nodes, most);
}

void write_mesh(hid_t vtkhdf, const Mesh& mesh) {
  const std::size_t n = mesh.X.size(), m = mesh.tets.size();
  hdf5::set_attributes<int64_t>(vtkhdf, "Version", std::array<int64_t, 2>{2, 0});
  hdf5::set_fixed_string(vtkhdf, "Type", "UnstructuredGrid");
  const auto count = [&](const char* name, std::size_t value) {
    hdf5::write<int64_t>(vtkhdf, name, std::array{int64_t(value)}, {1});
  };
  count("NumberOfPoints", n);
  count("NumberOfCells", m);
  count("NumberOfConnectivityIds", 4 * m);

  hdf5::write<double>(vtkhdf, "Points", std::span(mesh.X.data()->data(), 3 * n),
                      {n, 3});  // no copies of the mesh: a run's memory is fullest here
  hdf5::write<int64_t, int>(vtkhdf, "Connectivity", std::span(mesh.tets.data()->data(), 4 * m), {4 * m});
  std::vector<int64_t> offsets(m + 1);
  for (std::size_t i = 0; i <= m; ++i) offsets[i] = int64_t(4 * i);
  hdf5::write<int64_t>(vtkhdf, "Offsets", offsets, {m + 1});
  hdf5::write<std::uint8_t>(vtkhdf, "Types", std::vector<std::uint8_t>(m, 10), {m});  // 10: VTK_TETRA

  const Handle cell_data = hdf5::create_group(vtkhdf, "CellData");
  hdf5::write<std::int32_t>(cell_data, "region", mesh.tet_region, {m});
  if (!mesh.region_names.empty())
    hdf5::set_strings(hdf5::open_dataset(cell_data, "region"), "names", mesh.region_names);
}

/// The datasets of VTKHDF that every step adds one row to, apart from the offsets of the fields: all zero but for the time, as the mesh does not change.
constexpr std::array step_rows{"PartOffsets", "PointOffsets", "CellDataOffsets/region"};
constexpr std::array step_columns{"CellOffsets", "ConnectivityIdOffsets"};  // of shape [steps, 1]
constexpr hsize_t steps_in_chunk = 256;

constexpr const char* file_name = "run.vtkhdf";

void create_series(hid_t vtkhdf, const std::vector<Field>& fields, std::size_t nodes, int compress) {
  const Handle data = hdf5::create_group(vtkhdf, "PointData"), steps = hdf5::create_group(vtkhdf, "Steps");
  const Handle offsets = hdf5::create_group(steps, "PointDataOffsets"),
               cell_offsets = hdf5::create_group(steps, "CellDataOffsets");
  for (const auto& field : fields) {
    const std::string name(field.name);
    const Dims row = field.components == 1 ? Dims{} : Dims{hsize_t(field.components)};
    const Handle dataset = hdf5::create_growing<float>(data, name, row, rows_in_chunk(field, nodes, compress),
                                                       compress);
    hdf5::set_string(dataset, "unit", std::string(field.unit));
    hdf5::create_growing<int64_t>(offsets, name, {}, steps_in_chunk);
  }
  hdf5::create_growing<double>(steps, "Values", {}, steps_in_chunk);
  hdf5::create_growing<int64_t>(steps, "NumberOfParts", {}, steps_in_chunk);
  for (const auto* name : step_rows) hdf5::create_growing<int64_t>(steps, name, {}, steps_in_chunk);
  for (const auto* name : step_columns) hdf5::create_growing<int64_t>(steps, name, {1}, steps_in_chunk);
  hdf5::set_attribute<int64_t>(steps, "NSteps", 0);
}

void append_step(hid_t file, const std::vector<Field>& fields, std::size_t nodes, std::size_t index, double t) {
  const Handle steps = hdf5::open_group(file, "/VTKHDF/Steps");
  const auto put = [&](const std::string& name, int64_t value) {
    hdf5::write_rows<int64_t>(steps, name, index, 1, std::array{value});
  };
  for (const auto& field : fields) put("PointDataOffsets/" + std::string(field.name), int64_t(index * nodes));
  for (const auto* name : step_rows) put(name, 0);
  for (const auto* name : step_columns) put(name, 0);
  put("NumberOfParts", 1);
  hdf5::write_rows<double>(steps, "Values", index, 1, std::array{t});
}

}  // namespace

std::vector<std::string> fields_in(const std::filesystem::path& path) {
  hdf5::be_quiet();
  try {
    const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "opening");
    return hdf5::link_names(hdf5::open_group(file, "/VTKHDF/PointData"));
  } catch (const hdf5::Error& error) {
    throw std::runtime_error(fmt::format("{}: cannot be read: {}", path.string(), error.what()));
  }
}

FieldWriter::FieldWriter(const std::filesystem::path& folder, const Mesh& mesh, std::vector<Field> fields,
                         const Attributes& attributes, int compress)
    : path_(folder / file_name),
      fields_(std::move(fields)),
      nodes_(mesh.X.size()),
      tets_(mesh.tets.size()),
      compress_(compress) {
  hdf5::be_quiet();
  try {
    create(mesh, attributes);
  } catch (const hdf5::Error& error) {
    throw std::runtime_error(fmt::format("{}: could not be created: {}", path_.string(), error.what()));
  }
  replace_file(folder / "run.xdmf", xdmf_file(""));
}

FieldWriter::FieldWriter(const std::filesystem::path& folder, const Mesh& mesh, std::vector<Field> fields,
                         const Attributes& attributes, int compress, const EarlierFrames& earlier)
    : path_(folder / file_name),
      fields_(std::move(fields)),
      nodes_(mesh.X.size()),
      tets_(mesh.tets.size()),
      compress_(compress) {
  hdf5::be_quiet();
  const std::filesystem::path own = path_;
  std::error_code error;
  const bool as_it_was = std::filesystem::equivalent(earlier.file, own, error)
                         && std::filesystem::file_size(earlier.file, error) == earlier.bytes;
  try {
    if (!as_it_was) path_ += ".tmp";
    take(earlier, !as_it_was, mesh, attributes);
    if (const int lost = as_it_was ? 0 : sync_file(path_)) throw hdf5::Error(std::strerror(lost));
    if (!as_it_was && std::rename(path_.c_str(), own.c_str()) != 0) throw hdf5::Error(std::strerror(errno));
    path_ = own;
  } catch (const hdf5::Error& e) {
    if (!as_it_was) std::filesystem::remove(path_, error);
    throw FolderError(fmt::format("{}: the run cannot go on in it: {}", earlier.file.string(), e.what()));
  }
  replace_file(folder / "run.xdmf", xdmf_file(xdmf_frames_));
  xdmf_count_ = frames_;
}

void FieldWriter::create(const Mesh& mesh, const Attributes& attributes) {
  Handle file = create_file(path_);
  for (const auto& [name, value] : attributes) hdf5::set_string(file, name, value);
  {
    const Handle vtkhdf = hdf5::create_group(file, "VTKHDF");
    write_mesh(vtkhdf, mesh);
    create_series(vtkhdf, fields_, nodes_, compress_);
    create_frames(file);
  }
  flush_and_close(file);
}

/// `anew`: everything is written as it was the first time, one frame after another.
void FieldWriter::take(const EarlierFrames& earlier, bool anew, const Mesh& mesh, Attributes attributes) {
  const Handle file(H5Fopen(earlier.file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "opening");
  const int64_t whole = hdf5::get_attribute<int64_t>(hdf5::open_group(file, "/VTKHDF/Steps"), "NSteps");
  if (whole < int64_t(earlier.frames)) throw hdf5::Error(fmt::format("it has {} of {} frames", whole, earlier.frames));
  if (anew) {
    std::error_code none;
    std::filesystem::remove(path_, none);  // of an attempt that was killed
    for (auto& [name, value] : attributes)
      if (hdf5::has_attribute(file, name)) value = hdf5::get_string(file, name);
    create(mesh, attributes);
  }
  while (frames_ < earlier.frames) {
    const Handle group = hdf5::open_group(file, fmt::format("/frames/{:06}", frames_));
    const double t = hdf5::get_attribute<double>(group, "time");
    const auto step = long(hdf5::get_attribute<int64_t>(group, "step"));
    std::vector<float> values;
    if (anew)
      append(t, step, false, [&](const Field& f) {
        values = hdf5::read_all<float>(group, std::string(f.name));
        return std::span<const float>(values);
      });
    count_frame(t, false);
  }
}

void FieldWriter::count_frame(double t, bool breakdown) {
  xdmf_frames_ += xdmf_frame({file_name, nodes_, tets_}, fields_, frames_, t, breakdown);
  ++frames_;
}

std::size_t FieldWriter::bytes() const {
  std::error_code error;
  const auto size = std::filesystem::file_size(path_, error);
  return error ? 0 : size;
}

void FieldWriter::frame(double t, long step, bool breakdown, const GetField& get) {
  try {
    append(t, step, breakdown, get);
  } catch (const hdf5::Error& error) {
    throw std::runtime_error(
        fmt::format("{}: frame {} (t = {} s) could not be written: {}; the frames before it stay readable",
                    path_.string(), frames_, t, error.what()));
  }
  count_frame(t, breakdown);
  const bool many = frames_ - xdmf_count_ > frames_ / 8;
  const auto since = Clock::now() - xdmf_written_;
  if (breakdown || many || (since > std::chrono::seconds(1) && since > 20 * xdmf_cost_)) finish();
}

void FieldWriter::finish() {
  if (xdmf_count_ == frames_) return;
  const auto start = Clock::now();
  auto xdmf = path_;
  replace_file(xdmf.replace_extension(".xdmf"), xdmf_file(xdmf_frames_));
  xdmf_count_ = frames_;
  xdmf_written_ = Clock::now();
  xdmf_cost_ = xdmf_written_ - start;
}

/// After an error the frames before it are listed all the same, where there is room for that.
FieldWriter::~FieldWriter() {
  try {
    finish();
  } catch (const std::exception&) {}
}

/// All data first, flushed; then the count that makes the frame visible. Every handle is closed before the file.
void FieldWriter::append(double t, long step, bool breakdown, const GetField& get) {
  Handle file = open_for_append(path_, patience_);
  const std::string name = fmt::format("/frames/{:06}", frames_);
  {
    const bool again = hdf5::has_link(
        file, name);  // left by a failed attempt; kept, since removing a name can make HDF5 move the heap of names
    const Handle group = again ? hdf5::open_group(file, name) : hdf5::create_group(file, name);
    hdf5::set_attribute<double>(group, "time", t);
    hdf5::set_attribute<int64_t>(group, "step", step);
    if (breakdown || hdf5::has_attribute(group, "breakdown"))
      hdf5::set_attribute<std::int32_t>(group, "breakdown", breakdown);
    for (const auto& field : fields_) {
      const auto values = get(field);
      if (values.size() != nodes_ * std::size_t(field.components))
        throw std::logic_error(fmt::format("field {} came with {} values instead of {} x {}", field.name, values.size(),
                                           nodes_, field.components));
      const std::string source = "/VTKHDF/PointData/" + std::string(field.name);
      hdf5::write_rows<float>(file, source, frames_ * nodes_, nodes_, values);
      if (!hdf5::has_link(group, std::string(field.name)))
        hdf5::write_view<float>(group, std::string(field.name), source, frames_ * nodes_, shape(field, nodes_));
    }
  }
  append_step(file, fields_, nodes_, frames_, t);
  hdf5::check(H5Fflush(file, H5F_SCOPE_GLOBAL), "flushing");
  hdf5::set_attribute<int64_t>(hdf5::open_group(file, "/VTKHDF/Steps"), "NSteps", int64_t(frames_ + 1));
  flush_and_close(file);
}

}  // namespace nanson
