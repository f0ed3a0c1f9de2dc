// What stands where in the file, and what is looked at before it is believed.
#include "io/results/checkpoint.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <sstream>

#include "engine/hash.hpp"
#include "io/posix_file.hpp"
#include "io/results/hdf5.hpp"
#include "io/results/staged_file.hpp"

namespace nanson {
namespace {

namespace fs = std::filesystem;
using hdf5::Handle;

constexpr std::string_view first_line = "nanson checkpoint";
constexpr int format = 1;
constexpr std::size_t head_bytes = 512;  // a user block of HDF5
constexpr auto& names = checkpoint_names;

std::string head_text(std::int64_t bytes, const std::string& hash) {
  std::string text = fmt::format("{} {}\nbytes {}\nfnv1a {}\n", first_line, format, bytes, hash);
  text.resize(head_bytes, ' ');
  text.back() = '\n';
  return text;
}

[[noreturn]] void refuse(const fs::path& path, std::string_view why) {
  throw CheckpointError(fmt::format("{}: {}", path.string(), why));
}

/// Of everything from byte 512 on; empty when it cannot be read.
std::string hash_of_file(int fd) {
  Hash hash;
  std::vector<char> buffer(1 << 20);
  for (off_t at = head_bytes;;) {
    const auto got = ::pread(fd, buffer.data(), buffer.size(), at);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return {};
    if (got == 0) return hash.text();
    hash.add(buffer.data(), static_cast<std::size_t>(got));
    at += got;
  }
}

std::int64_t size_of(int fd) {
  struct stat now {};
  return ::fstat(fd, &now) == 0 ? now.st_size : -1;
}

/// The file is the one that was written, to its last byte. Returns its size.
std::int64_t check_whole(const fs::path& path) {
  const Descriptor file(path, O_RDONLY);
  if (!file) refuse(path, std::strerror(errno));
  std::array<char, head_bytes + 1> head{};
  const auto got = ::pread(file.get(), head.data(), head_bytes, 0);
  if (got < 0) refuse(path, std::strerror(errno));
  if (!std::string_view(head.data()).starts_with(first_line)) refuse(path, "is no checkpoint of nanson");
  std::istringstream text(head.data() + first_line.size());
  int number = 0;
  std::int64_t bytes = 0;
  std::string bytes_word, hash_word, hash;
  if (text >> number && number != format)
    refuse(path, fmt::format("is of format {}, this program reads format {}", number, format));
  text >> bytes_word >> bytes >> hash_word >> hash;
  if (!text || bytes_word != "bytes" || hash_word != "fnv1a") refuse(path, "is damaged: its first lines make no sense");
  const std::int64_t size = size_of(file.get());
  if (size != bytes) refuse(path, fmt::format("is damaged: it has {} of {} bytes", size, bytes));
  if (head_text(bytes, hash) != std::string_view(head.data(), head_bytes) || hash_of_file(file.get()) != hash)
    refuse(path, "is damaged: its checksum is another");
  return bytes;
}

/// Numbers as HDF5 has them.
std::int64_t stored(long value) { return value; }
std::int64_t stored(int value) { return value; }
std::int64_t stored(bool value) { return value ? 1 : 0; }
double stored(double value) { return value; }

void put(hid_t at, const char* name, const Vec3& value) { hdf5::set_attributes<double>(at, name, value); }
template <class Number>
void put(hid_t at, const char* name, Number value) {
  hdf5::set_attribute(at, name, stored(value));
}

void get(hid_t at, const char* name, Vec3& value) {
  const std::vector<double> values = hdf5::get_attributes<double>(at, name);
  if (values.size() != 3) throw hdf5::Error(fmt::format("{} is no vector", name));
  std::ranges::copy(values, value.begin());
}
template <class Number>
void get(hid_t at, const char* name, Number& value) {
  value = static_cast<Number>(hdf5::get_attribute<decltype(stored(value))>(at, name));
}

/// Texts of the file itself, in one list for both ways.
template <class SomeCheckpoint, class Visit>
void each_text(SomeCheckpoint& c, Visit visit) {
  visit("scene", c.scene);
  visit("text", c.text);
  visit("resolved", c.resolved);
  visit("version", c.version);
  visit("commit", c.commit);
  visit("compiler", c.compiler);
  visit("flags", c.flags);
  visit("host", c.host);
  visit("written", c.written);
  visit("mesh", c.mesh);
  visit("order", c.order);
  visit("state", c.state);
}
template <class SomeCheckpoint, class Visit>
void each_size(SomeCheckpoint& c, Visit visit) {
  visit("nodes", c.nodes);
  visit("tets", c.tets);
  visit("step", c.step);
  visit("t", c.t);
  visit("end", c.end);
}
template <class SomePosition, class Visit>
void each_position(SomePosition& p, Visit visit) {
  visit("history_bytes", p.history_bytes);
  visit("frames", p.frames);
  visit("fields_bytes", p.fields_bytes);
}

void write_numbers(hid_t file, const Simulation& s) {
  const Handle numbers = hdf5::create_group(file, "numbers");
  each_number(s, [&](const char* name, const auto& value) { put(numbers, name, value); });
  put(numbers, "fastest", fastest_rate(s.state));
  std::vector<std::string> causes, texts;
  for (const Warning& w : s.watch.warnings) {
    causes.emplace_back(w.cause);
    texts.push_back(w.text);
  }
  hdf5::set_strings(numbers, "warning_causes", causes);
  hdf5::set_strings(numbers, "warnings", texts);
  const Handle sweeps = hdf5::create_group(file, "sweeps");
  for (const SweepTime& sweep : s.team.clock.sweeps) put(sweeps, sweep.sweep.c_str(), sweep.seconds);
}

void write_arrays(hid_t file, const Simulation& s) {
  const Handle arrays = hdf5::create_group(file, "arrays");
  each_array(s.domain, s.state, [&](const ArrayRole& role, const Aligned<double>& array) {
    if (role.keep == Keep::work || array.empty()) return;
    const std::vector<double> values = in_mesh_order(s.domain.order, role, array);
    hdf5::write<double>(arrays, std::string(role.name), values, {values.size() / role.width, role.width});
  });
}

void write_file(const fs::path& path, const Checkpoint& c, const Simulation& s) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), "file access"), creation(H5Pcreate(H5P_FILE_CREATE), "creating");
  hdf5::check(H5Pset_userblock(creation, head_bytes), "creating");
  hdf5::check(H5Pset_fclose_degree(access, H5F_CLOSE_SEMI), "close degree");
  hdf5::use_staged_driver(access);  // for its plain reasons when the disk is full
  Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access), "creating");
  each_text(c, [&](const char* name, const std::string& text) { hdf5::set_string(file, name, text); });
  each_size(c, [&](const char* name, auto value) { hdf5::set_attribute(file, name, value); });
  {
    const Handle results = hdf5::create_group(file, "results");
    each_position(c.results, [&](const char* name, std::int64_t value) { hdf5::set_attribute(results, name, value); });
  }
  write_numbers(file, s);
  write_arrays(file, s);
  hdf5::check(H5Fflush(file, H5F_SCOPE_GLOBAL), "flushing");
  file.close("closing");
}

/// Puts length and checksum in front and has the disk take all of it. Returns errno.
int seal(const fs::path& path) {
  Descriptor file(path, O_RDWR);
  if (!file) return errno;
  const std::string hash = hash_of_file(file.get());
  if (hash.empty()) return errno;
  if (const int error = write_all(file.get(), head_text(size_of(file.get()), hash))) return error;
  if (::fsync(file.get()) != 0) return errno;
  return file.close();
}

void check_size(const Checkpoint& from, const ArrayRole& role, std::size_t expected, std::size_t found) {
  if (found != expected)
    refuse(from.path, fmt::format("has {} numbers in {} where this scene needs {}", found, role.name, expected));
}

}  // namespace

Checkpoint CheckpointWriter::about(const Simulation& s, const ResultsPosition& results) {
  if (mesh_.empty()) {
    mesh_ = mesh_hash(*s.domain.mesh);
    order_ = order_hash(s.domain.order);
  }
  const Scene& scene = *s.domain.scene;
  Checkpoint c;
  c.scene = scene.name;
  c.text = scene.text;
  c.resolved = resolved_;
  c.version = from_.version;
  c.commit = from_.commit;
  c.compiler = from_.compiler;
  c.flags = from_.flags;
  c.host = from_.host;
  c.written = provenance().start;
  c.mesh = mesh_;
  c.order = order_;
  c.state = state_hash(s);
  c.nodes = s.domain.order.nodes;
  c.tets = static_cast<std::int64_t>(s.domain.mesh->tets.size());
  c.step = s.state.step;
  c.t = s.state.t;
  c.end = scene.time.end;
  c.results = results;
  return c;
}

void CheckpointWriter::write(const Simulation& s, const ResultsPosition& results) {
  const fs::path made = folder_ / names[0], newest = folder_ / names[1], before = folder_ / names[2];
  std::string why;
  try {
    for (const char* file : {"history.csv", "run.vtkhdf"})  // what it says of them holds after a power cut too
      if (const int error = sync_file(folder_ / file); error != 0 && error != ENOENT) why = std::strerror(error);
    hdf5::be_quiet();
    write_file(made, about(s, results), s);
    if (const int error = seal(made)) why = std::strerror(error);
  } catch (const hdf5::Error& error) {
    why = error.what();
  }
  if (why.empty() && std::rename(newest.c_str(), before.c_str()) != 0 && errno != ENOENT) why = std::strerror(errno);
  if (why.empty() && std::rename(made.c_str(), newest.c_str()) != 0) why = std::strerror(errno);
  if (why.empty()) {
    if (const int error = sync_file(folder_)) why = std::strerror(error);
  } else {
    ::unlink(made.c_str());
  }
  if (!why.empty()) throw std::runtime_error(fmt::format("{}: could not be written: {}", newest.string(), why));
}

Checkpoint read_checkpoint(const fs::path& path) {
  Checkpoint c;
  c.path = path;
  c.bytes = check_whole(path);
  hdf5::be_quiet();
  try {
    const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "opening");
    each_text(c, [&](const char* name, std::string& text) { text = hdf5::get_string(file, name); });
    each_size(c, [&](const char* name, auto& value) {
      value = hdf5::get_attribute<std::remove_reference_t<decltype(value)>>(file, name);
    });
    const Handle results = hdf5::open_group(file, "results");
    each_position(c.results, [&](const char* name, std::int64_t& value) {
      value = hdf5::get_attribute<std::int64_t>(results, name);
    });
  } catch (const hdf5::Error& error) {
    refuse(path, fmt::format("cannot be read: {}", error.what()));
  }
  return c;
}

std::vector<fs::path> checkpoints_at(const fs::path& where) {
  std::error_code error;
  if (!fs::exists(where, error)) refuse(where, "no such file or folder");
  if (!fs::is_directory(where, error)) return {where};
  std::vector<fs::path> found;
  for (const char* name : names)
    if (fs::exists(where / name, error)) found.push_back(where / name);
  if (found.empty()) refuse(where, "holds no checkpoint");
  return found;
}

Checkpoint newest_checkpoint(const fs::path& where, std::vector<std::string>& complaints) {
  for (const fs::path& file : checkpoints_at(where)) {
    try {
      return read_checkpoint(file);
    } catch (const CheckpointError& e) {
      if (file.extension() != ".tmp") complaints.emplace_back(e.what());  // one that was being written
    }
  }
  const std::string why = fmt::format("{}", fmt::join(complaints, "\n"));
  throw CheckpointError(complaints.size() == 1 ? why
                                               : fmt::format("{}: holds no valid checkpoint\n{}", where.string(), why));
}

void make_newest(const Checkpoint& from, const fs::path& folder) {
  std::error_code error;
  for (const char* name : names)
    if (from.path.filename() == name && fs::equivalent(from.path, folder / name, error))
      fs::rename(from.path, folder / names[1]);
}

bool restore(const Checkpoint& from, Simulation& s) {
  const Order& order = s.domain.order;
  const bool same_order = from.order == order_hash(order);
  double fastest = 0;
  try {
    const Handle file(H5Fopen(from.path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "opening");
    const Handle numbers = hdf5::open_group(file, "numbers"), arrays = hdf5::open_group(file, "arrays"),
                 sweeps = hdf5::open_group(file, "sweeps");
    each_number(s, [&](const char* name, auto& value) { get(numbers, name, value); });
    get(numbers, "fastest", fastest);
    const std::vector<std::string> causes = hdf5::get_strings(numbers, "warning_causes"),
                                   texts = hdf5::get_strings(numbers, "warnings");
    for (std::size_t i = 0; i < causes.size() && i < texts.size(); ++i)
      s.watch.warnings.push_back({causes[i], texts[i]});
    for (const std::string& name : hdf5::attribute_names(sweeps)) {
      double seconds = 0;
      get(sweeps, name.c_str(), seconds);
      s.team.clock.add(name, seconds);
    }
    each_array(s.domain, s.state, [&](const ArrayRole& role, Aligned<double>& array) {
      if (role.keep == Keep::work || array.empty() || (role.of != Per::node && !same_order)) return;
      const std::vector<double> values = hdf5::read_all<double>(arrays, std::string(role.name));
      const std::size_t rows = role.of == Per::node ? order.row_of.size() : role.size / role.width;
      check_size(from, role, role.width * rows, values.size());
      from_mesh_order(order, role, values, array);
    });
  } catch (const hdf5::Error& error) {
    refuse(from.path, fmt::format("cannot be read: {}", error.what()));
  }
  if (same_order) go_on(s, fastest);
  else go_on_in_another_order(s);
  if (state_hash(s) != from.state) refuse(from.path, "its state is another one than was written");
  return same_order;
}

}  // namespace nanson
