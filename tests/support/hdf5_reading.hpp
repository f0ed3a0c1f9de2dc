// Reading results back with HDF5's own driver, as any other program would.
#pragma once
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/results/hdf5.hpp"

namespace nanson::test {

inline hdf5::Handle open_to_read(const std::filesystem::path& path) {
  hdf5::be_quiet();
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), path.string()};
}

template <class T>
std::vector<T> read(hid_t at, const std::string& name, hdf5::Dims* dims = nullptr) {
  const auto data = hdf5::open_dataset(at, name);
  const auto extent = hdf5::extent(data, name);
  std::size_t size = 1;
  for (const auto d : extent) size *= d;
  std::vector<T> values(size);
  hdf5::check(H5Dread(data, hdf5::type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
  if (dims != nullptr) *dims = extent;
  return values;
}

template <class T>
T read_attribute(hid_t file, const std::string& object, const std::string& name) {
  const hdf5::Handle attribute(H5Aopen_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), name);
  T value{};
  hdf5::check(H5Aread(attribute, hdf5::type<T>(), &value), name);
  return value;
}

inline bool has_attribute(hid_t file, const std::string& object, const std::string& name) {
  return hdf5::check(H5Aexists_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT), name) > 0;
}

inline std::vector<std::string> read_strings(hid_t file, const std::string& object, const std::string& name) {
  const hdf5::Handle attribute(H5Aopen_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), name);
  const hdf5::Handle space(H5Aget_space(attribute), name), text = hdf5::string_type(name);
  std::vector<char*> pointers(std::size_t(H5Sget_simple_extent_npoints(space)));
  hdf5::check(H5Aread(attribute, text, pointers.data()), name);
  const std::vector<std::string> values(pointers.begin(), pointers.end());
  H5Dvlen_reclaim(text, space, H5P_DEFAULT, pointers.data());
  return values;
}

/// Frames that the file itself counts as whole.
inline std::size_t frame_count(hid_t file) {
  return std::size_t(read_attribute<std::int64_t>(file, "/VTKHDF/Steps", "NSteps"));
}

}  // namespace nanson::test
