// Writes small .msh files in all forms that are read, and a folder for them that disappears with the test.
#pragma once
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "engine/mesh/mesh.hpp"

namespace nanson {

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::random_device random;
    do
      path_ = std::filesystem::temp_directory_path()
              / ("nanson_test_" + std::to_string(random()) + std::to_string(random()));
    while (!std::filesystem::create_directory(path_));
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name, std::ios::binary).write(content.data(), std::streamsize(content.size()));
    return path_ / name;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A geometric entity with its elements, all of one gmsh type.
struct MshEntity {
  int dimension;
  int tag;
  std::vector<int> physical;
  int type;
  std::vector<std::vector<std::int64_t>> elements;
};

struct MshFile {
  std::map<std::pair<int, int>, std::string> names;
  std::vector<std::int64_t> tags;
  std::vector<Vec3> X;
  std::vector<MshEntity> entities;
};

struct MshForm {
  bool v41, binary;
  bool parametric = false;
};
inline constexpr MshForm all_forms[] = {{false, false}, {false, true}, {true, false}, {true, true}};
inline std::string form_name(const MshForm& form) {
  return std::string(form.v41 ? "4.1" : "2.2") + (form.binary ? " binary" : " text");
}

/// Numbers one after another, as text with blanks or as bytes.
class MshOutput {
 public:
  explicit MshOutput(bool binary) : binary_(binary) { out_.precision(17); }
  void text(const std::string& text) { out_ << text; }
  template <class OnDisk, class Value>
  void put(Value value) {
    const OnDisk stored = OnDisk(value);
    if (binary_) out_.write(reinterpret_cast<const char*>(&stored), sizeof stored);
    else out_ << value << ' ';
  }
  void end_row() {
    if (!binary_) out_ << '\n';
  }
  std::string str() const { return out_.str(); }

 private:
  std::ostringstream out_;
  bool binary_;
};

inline void put_head(MshOutput& out, const MshFile& file, const MshForm& form) {
  out.text(std::string("$MeshFormat\n") + (form.v41 ? "4.1 " : "2.2 ") + (form.binary ? "1 8\n" : "0 8\n"));
  if (form.binary) {
    out.put<std::int32_t>(1);
    out.text("\n");
  }
  out.text("$EndMeshFormat\n$PhysicalNames\n" + std::to_string(file.names.size()) + "\n");
  for (const auto& [group, name] : file.names)
    out.text(std::to_string(group.first) + " " + std::to_string(group.second) + " \"" + name + "\"\n");
  out.text("$EndPhysicalNames\n");
}

inline std::string write_msh22(const MshFile& file, const MshForm& form) {
  MshOutput out(form.binary);
  put_head(out, file, form);
  out.text((form.parametric ? "$ParametricNodes\n" : "$Nodes\n") + std::to_string(file.X.size()) + "\n");
  for (std::size_t a = 0; a < file.X.size(); ++a) {
    out.put<std::int32_t>(file.tags[a]);
    for (const double x : file.X[a]) out.put<double>(x);
    const int dimension = int(a % 4);
    if (form.parametric) {
      out.put<std::int32_t>(dimension);
      out.put<std::int32_t>(1);
    }
    for (int i = 0; form.parametric && i < dimension && dimension < 3; ++i) out.put<double>(0.5);
    out.end_row();
  }
  std::size_t count = 0;
  for (const auto& e : file.entities) count += e.elements.size() * std::max<std::size_t>(1, e.physical.size());
  out.text(std::string(form.binary ? "\n" : "") + (form.parametric ? "$EndParametricNodes\n" : "$EndNodes\n")
           + "$Elements\n" + std::to_string(count) + "\n");
  int number = 0;
  for (const auto& e : file.entities)
    for (const int physical : e.physical.empty() ? std::vector<int>{0} : e.physical) {
      if (form.binary) {
        out.put<std::int32_t>(e.type);
        out.put<std::int32_t>(e.elements.size());
        out.put<std::int32_t>(2);
      }
      for (const auto& nodes : e.elements) {
        out.put<std::int32_t>(++number);
        if (!form.binary) {
          out.put<std::int32_t>(e.type);
          out.put<std::int32_t>(2);
        }
        out.put<std::int32_t>(physical);
        out.put<std::int32_t>(e.tag);
        for (const auto node : nodes) out.put<std::int32_t>(node);
        out.end_row();
      }
    }
  out.text(std::string(form.binary ? "\n" : "") + "$EndElements\n");
  return out.str();
}

inline void put_entities41(MshOutput& out, const MshFile& file) {
  for (int dimension = 0; dimension < 4; ++dimension)
    out.put<std::int64_t>(std::count_if(file.entities.begin(), file.entities.end(),
                                        [&](const MshEntity& e) { return e.dimension == dimension; }));
  out.end_row();
  for (int dimension = 0; dimension < 4; ++dimension)
    for (const auto& e : file.entities) {
      if (e.dimension != dimension) continue;
      out.put<std::int32_t>(e.tag);
      for (int i = 0; i < (dimension ? 6 : 3); ++i) out.put<double>(0.25);
      out.put<std::int64_t>(e.physical.size());
      for (const int physical : e.physical) out.put<std::int32_t>(physical);
      if (dimension) {
        out.put<std::int64_t>(2);
        out.put<std::int32_t>(1);
        out.put<std::int32_t>(-2);
      }
      out.end_row();
    }
}

inline std::string write_msh41(const MshFile& file, const MshForm& form) {
  const std::string end = form.binary ? "\n" : "";
  MshOutput out(form.binary);
  put_head(out, file, form);
  out.text("$Entities\n");
  put_entities41(out, file);
  out.text(end + "$EndEntities\n$Nodes\n");
  const std::size_t half = file.X.size() / 2;  // two blocks
  out.put<std::int64_t>(2);
  out.put<std::int64_t>(file.X.size());
  out.put<std::int64_t>(1);
  out.put<std::int64_t>(99);
  out.end_row();
  for (const int block : {0, 1}) {
    const std::size_t first = block ? half : 0, last = block ? file.X.size() : half;
    const int dimension = block ? 2 : 1;
    out.put<std::int32_t>(dimension);
    out.put<std::int32_t>(1);
    out.put<std::int32_t>(form.parametric);
    out.put<std::int64_t>(last - first);
    out.end_row();
    for (std::size_t a = first; a < last; ++a) {
      out.put<std::int64_t>(file.tags[a]);
      out.end_row();
    }
    for (std::size_t a = first; a < last; ++a) {
      for (const double x : file.X[a]) out.put<double>(x);
      for (int i = 0; form.parametric && i < dimension; ++i) out.put<double>(0.5);
      out.end_row();
    }
  }
  std::size_t count = 0;
  for (const auto& e : file.entities) count += e.elements.size();
  out.text(end + "$EndNodes\n$Elements\n");
  out.put<std::int64_t>(file.entities.size());
  out.put<std::int64_t>(count);
  out.put<std::int64_t>(1);
  out.put<std::int64_t>(count);
  out.end_row();
  std::int64_t number = 0;
  for (const auto& e : file.entities) {
    out.put<std::int32_t>(e.dimension);
    out.put<std::int32_t>(e.tag);
    out.put<std::int32_t>(e.type);
    out.put<std::int64_t>(e.elements.size());
    out.end_row();
    for (const auto& nodes : e.elements) {
      out.put<std::int64_t>(++number);
      for (const auto node : nodes) out.put<std::int64_t>(node);
      out.end_row();
    }
  }
  out.text(end + "$EndElements\n");
  return out.str();
}

inline std::string write_msh(const MshFile& file, const MshForm& form) {
  return form.v41 ? write_msh41(file, form) : write_msh22(file, form);
}

}  // namespace nanson
