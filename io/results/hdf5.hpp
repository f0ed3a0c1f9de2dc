// RAII over the HDF5 C API: handles that close themselves, errors as exceptions, and the few forms of datasets and attributes that results need.
#pragma once
#include <hdf5.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace nanson::hdf5 {

struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

using Dims = std::vector<hsize_t>;

/// HDF5 prints every error by itself unless told not to; here errors are exceptions. (H5E_DEFAULT is the current thread's stack.)
inline void be_quiet() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

/// The name under which io/staged_file puts the reason of a failed system call on HDF5's error stack.
inline constexpr char driver_errors[] = "nanson";

/// What HDF5 noted down about the last failure: the system's own words where the file driver left them, otherwise the whole stack, innermost first.
/// The stack is empty afterwards.
inline std::string take_error() {
  std::string text;
  const auto collect = [](unsigned, const H5E_error2_t* entry, void* out) -> herr_t {
    auto& all = *static_cast<std::string*>(out);
    if (std::string_view(entry->func_name) == driver_errors) {
      all = entry->desc;
      return 1;  // enough: what follows only says who called whom
    }
    if (!all.empty()) all += "; ";
    all += std::string(entry->func_name) + ": " + entry->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, collect, &text);
  H5Eclear2(H5E_DEFAULT);
  return text;
}

/// Passes a result on, or throws with the name of the thing at hand when HDF5 reports a failure (negative).
template <class Result>
Result check(Result result, const std::string& what) {
  if (result < 0) {
    const std::string reason = take_error();
    throw Error(reason.find("H5") == 0 ? what + ": " + reason : reason);
  }
  return result;
}

/// Owns an id of any kind: H5Idec_ref closes files, groups, datasets, spaces and property lists alike.
class Handle {
 public:
  Handle() = default;
  Handle(hid_t id, const std::string& what) : id_(check(id, what)) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  ~Handle() {
    if (id_ >= 0 && H5Idec_ref(id_) < 0) H5Eclear2(H5E_DEFAULT);
  }
  /// Closing by hand, because the errors of the last writes surface only here and a destructor cannot throw.
  void close(const std::string& what) {
    if (id_ >= 0) check(H5Idec_ref(std::exchange(id_, H5I_INVALID_HID)), what);
  }
  operator hid_t() const { return id_; }

 private:
  hid_t id_ = H5I_INVALID_HID;
};

template <class T>
hid_t type() {
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  else if constexpr (std::is_same_v<T, float>) return H5T_NATIVE_FLOAT;
  else if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  else if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
  else {
    static_assert(std::is_same_v<T, std::uint8_t>, "this element type is not written");
    return H5T_NATIVE_UINT8;
  }
}

inline bool has_link(hid_t at, const std::string& name) {
  return check(H5Lexists(at, name.c_str(), H5P_DEFAULT), name) > 0;
}
inline bool has_attribute(hid_t at, const std::string& name) { return check(H5Aexists(at, name.c_str()), name) > 0; }
inline Handle open_group(hid_t at, const std::string& name) { return {H5Gopen2(at, name.c_str(), H5P_DEFAULT), name}; }
inline Handle open_dataset(hid_t at, const std::string& name) {
  return {H5Dopen2(at, name.c_str(), H5P_DEFAULT), name};
}
inline Handle create_group(hid_t at, const std::string& name, hid_t creation = H5P_DEFAULT) {
  return {H5Gcreate2(at, name.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), name};
}

/// Without the time of its making, so that equal runs write equal files.
inline Handle dataset_creation(const std::string& what) {
  Handle list(H5Pcreate(H5P_DATASET_CREATE), what);
  check(H5Pset_obj_track_times(list, false), what);
  return list;
}

/// A dataset of fixed shape, written at once; HDF5 turns values of another type into T piece by piece.
template <class T, class Value = T>
void write(hid_t at, const std::string& name, std::type_identity_t<std::span<const Value>> values, const Dims& dims) {
  const Handle space(H5Screate_simple(int(dims.size()), dims.data(), nullptr), name), plist = dataset_creation(name);
  Handle data(H5Dcreate2(at, name.c_str(), type<T>(), space, H5P_DEFAULT, plist, H5P_DEFAULT), name);
  check(H5Dwrite(data, type<Value>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
  data.close(name);
}

/// An empty dataset that grows along its first axis; `row` is the shape of one row, gzip 0 means uncompressed.
template <class T>
Handle create_growing(hid_t at, const std::string& name, const Dims& row, hsize_t rows_in_chunk, int gzip = 0) {
  Dims now{0}, most{H5S_UNLIMITED}, chunk{rows_in_chunk};
  for (auto* dims : {&now, &most, &chunk}) dims->insert(dims->end(), row.begin(), row.end());
  const Handle space(H5Screate_simple(int(now.size()), now.data(), most.data()), name);
  const Handle plist = dataset_creation(name);
  check(H5Pset_chunk(plist, int(chunk.size()), chunk.data()), name);
  if (gzip > 0) {
    check(H5Pset_shuffle(plist), name);
    check(H5Pset_deflate(plist, unsigned(gzip)), name);
  }
  return {H5Dcreate2(at, name.c_str(), type<T>(), space, H5P_DEFAULT, plist, H5P_DEFAULT), name};
}

inline Dims extent(hid_t dataset, const std::string& what) {
  const Handle space(H5Dget_space(dataset), what);
  Dims dims(std::size_t(check(H5Sget_simple_extent_ndims(space), what)));
  check(H5Sget_simple_extent_dims(space, dims.data(), nullptr), what);
  return dims;
}

/// Rows [first, first + rows) of a growing dataset, which ends after them. Writing the same rows twice is harmless, so a failed frame can be repeated.
template <class T>
void write_rows(hid_t at, const std::string& name, hsize_t first, hsize_t rows, std::span<const T> values) {
  Handle data = open_dataset(at, name);
  Dims dims = extent(data, name), count = dims, start(dims.size(), 0);
  dims[0] = first + rows;
  count[0] = rows;
  start[0] = first;
  check(H5Dset_extent(data, dims.data()), name);
  const Handle file_space(H5Dget_space(data), name);
  check(H5Sselect_hyperslab(file_space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr), name);
  const Handle memory_space(H5Screate_simple(int(count.size()), count.data(), nullptr), name);
  check(H5Dwrite(data, type<T>(), memory_space, file_space, H5P_DEFAULT, values.data()), name);
  data.close(name);  // chunks in HDF5's cache are written only here
}

/// A dataset `name` of shape `count` that holds no data of its own: it shows rows [first, first + count[0]) of `source` in the same file.
template <class T>
void write_view(hid_t at, const std::string& name, const std::string& source, hsize_t first, const Dims& count) {
  Dims source_dims = count, start(count.size(), 0);
  source_dims[0] += first;
  start[0] = first;
  const Handle view_space(H5Screate_simple(int(count.size()), count.data(), nullptr), name);
  const Handle source_space(H5Screate_simple(int(count.size()), source_dims.data(), nullptr), name);
  check(H5Sselect_hyperslab(source_space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr), name);
  const Handle plist = dataset_creation(name);
  check(H5Pset_virtual(plist, view_space, ".", source.c_str(), source_space), name);
  Handle(H5Dcreate2(at, name.c_str(), type<T>(), view_space, H5P_DEFAULT, plist, H5P_DEFAULT), name).close(name);
}

template <class T>
void set_attribute(hid_t at, const std::string& name, T value) {
  const Handle space(H5Screate(H5S_SCALAR), name);
  const Handle attribute(has_attribute(at, name)
                             ? H5Aopen(at, name.c_str(), H5P_DEFAULT)
                             : H5Acreate2(at, name.c_str(), type<T>(), space, H5P_DEFAULT, H5P_DEFAULT),
                         name);
  check(H5Awrite(attribute, type<T>(), &value), name);
}

template <class T>
void set_attributes(hid_t at, const std::string& name, std::span<const T> values) {
  const hsize_t size = values.size();
  const Handle space(H5Screate_simple(1, &size, nullptr), name);
  const Handle attribute(H5Acreate2(at, name.c_str(), type<T>(), space, H5P_DEFAULT, H5P_DEFAULT), name);
  check(H5Awrite(attribute, type<T>(), values.data()), name);
}

/// Fixed-length ASCII: the only form of the VTKHDF attribute `Type` that every reader takes.
inline void set_fixed_string(hid_t at, const std::string& name, const std::string& value) {
  const Handle text(H5Tcopy(H5T_C_S1), name), space(H5Screate(H5S_SCALAR), name);
  check(H5Tset_size(text, value.size()), name);
  check(H5Tset_strpad(text, H5T_STR_NULLPAD), name);
  const Handle attribute(H5Acreate2(at, name.c_str(), text, space, H5P_DEFAULT, H5P_DEFAULT), name);
  check(H5Awrite(attribute, text, value.data()), name);
}

/// UTF-8 of any length (a fixed-length attribute ends at 64 kB, and a scene may hold long tables); h5py shows it as str.
inline Handle string_type(const std::string& what) {
  Handle text(H5Tcopy(H5T_C_S1), what);
  check(H5Tset_size(text, H5T_VARIABLE), what);
  check(H5Tset_cset(text, H5T_CSET_UTF8), what);
  return text;
}

inline void set_string(hid_t at, const std::string& name, const std::string& value) {
  const Handle text = string_type(name), space(H5Screate(H5S_SCALAR), name);
  const Handle attribute(H5Acreate2(at, name.c_str(), text, space, H5P_DEFAULT, H5P_DEFAULT), name);
  const char* pointer = value.c_str();
  check(H5Awrite(attribute, text, &pointer), name);
}

inline void set_strings(hid_t at, const std::string& name, const std::vector<std::string>& values) {
  const hsize_t size = values.size();
  const Handle text = string_type(name), space(H5Screate_simple(1, &size, nullptr), name);
  const Handle attribute(H5Acreate2(at, name.c_str(), text, space, H5P_DEFAULT, H5P_DEFAULT), name);
  if (values.empty()) return;  // there, and without a text
  std::vector<const char*> pointers(values.size());
  std::transform(values.begin(), values.end(), pointers.begin(), [](const std::string& s) { return s.c_str(); });
  check(H5Awrite(attribute, text, pointers.data()), name);
}

template <class T>
T get_attribute(hid_t at, const std::string& name) {
  const Handle attribute(H5Aopen(at, name.c_str(), H5P_DEFAULT), name), space(H5Aget_space(attribute), name);
  if (check(H5Sget_simple_extent_npoints(space), name) != 1) throw Error(name + " is not one value");
  T value{};
  check(H5Aread(attribute, type<T>(), &value), name);
  return value;
}

template <class T>
std::vector<T> get_attributes(hid_t at, const std::string& name) {
  const Handle attribute(H5Aopen(at, name.c_str(), H5P_DEFAULT), name), space(H5Aget_space(attribute), name);
  std::vector<T> values(std::size_t(check(H5Sget_simple_extent_npoints(space), name)));
  check(H5Aread(attribute, type<T>(), values.data()), name);
  return values;
}

inline std::vector<std::string> get_strings(hid_t at, const std::string& name) {
  const Handle text = string_type(name), attribute(H5Aopen(at, name.c_str(), H5P_DEFAULT), name),
               space(H5Aget_space(attribute), name);
  std::vector<char*> pointers(std::size_t(check(H5Sget_simple_extent_npoints(space), name)));
  std::vector<std::string> values;
  if (pointers.empty()) return values;
  check(H5Aread(attribute, text, pointers.data()), name);
  for (const char* pointer : pointers) values.emplace_back(pointer ? pointer : "");
  check(H5Dvlen_reclaim(text, space, H5P_DEFAULT, pointers.data()), name);
  return values;
}

inline std::string get_string(hid_t at, const std::string& name) {
  const std::vector<std::string> values = get_strings(at, name);
  if (values.size() != 1) throw Error(name + " is not one text");
  return values[0];
}

inline std::vector<std::string> attribute_names(hid_t at) {
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5A_info_t*, void* out) -> herr_t {
    static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    return 0;
  };
  check(H5Aiterate2(at, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names), "attributes");
  return names;
}

inline std::vector<std::string> link_names(hid_t at) {
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
    static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    return 0;
  };
  check(H5Literate(at, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names), "links");
  return names;
}

/// A whole dataset.
template <class T>
std::vector<T> read_all(hid_t at, const std::string& name) {
  const Handle data = open_dataset(at, name), space(H5Dget_space(data), name);
  std::vector<T> values(std::size_t(check(H5Sget_simple_extent_npoints(space), name)));
  check(H5Dread(data, type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
  return values;
}

}  // namespace nanson::hdf5
