// Opens mesh files, walks through the sections of .msh files, and picks the source of a scene's mesh.
#include "io/mesh/read_mesh.hpp"

#include <fmt/format.h>

#include <fstream>
#include <limits>
#include <memory>
#include <optional>
#include <set>

#include "io/mesh/msh_sections.hpp"
#include "io/mesh/read_inp.hpp"
#include "io/mesh/run_gmsh.hpp"

namespace nanson {
namespace {

enum class Version { none, v22, v41 };

/// Why this path cannot be a mesh file; empty when it can.
std::string path_problem(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto kind = std::filesystem::status(path, ignored).type();
  if (kind == std::filesystem::file_type::not_found) return "there is no such file";
  if (kind != std::filesystem::file_type::regular) return "this is not a file";
  if (path.extension() == ".step" || path.extension() == ".stp")
    return fmt::format("mesh it first: gmsh -3 {} -o {}", path.string(),
                       std::filesystem::path(path).replace_extension(".msh").string());
  if (path.extension() != ".msh" && path.extension() != ".geo" && path.extension() != ".inp")
    return fmt::format(
        "unknown file ending \"{}\": meshes are Gmsh .msh or .geo files, or .inp decks of Abaqus or CalculiX",
        path.extension().string());
  return {};
}

Version read_format(MshCursor& in) {
  const double version = in.number<double>();
  if (version != 2.2 && version != 4.1)
    in.fail(fmt::format("version {} of the .msh format is not supported: save as 4.1 (gmsh -format msh41) or 2.2",
                        version));
  const auto mode = in.number<std::int64_t>();
  if (mode != 0 && mode != 1) in.fail(fmt::format("file type {} is neither 0 (text) nor 1 (binary)", mode));
  const auto real = in.number<std::int64_t>();
  if (real != 8) in.fail(fmt::format("numbers of {} bytes are not supported, only of 8", real));
  if (mode == 1) {
    in.end_of_line();
    in.binary = true;
    const auto one = in.read<std::int32_t>();
    if (one == 0x01000000) in.fail("written on a machine with the other byte order: save it as text there");
    if (one != 1) in.fail("the binary file does not start with a one: it is damaged");
  }
  in.expect("$EndMeshFormat");
  return version == 4.1 ? Version::v41 : Version::v22;
}

/// n, then lines: dimension tag "name". The name is all between the first and the last quote.
void read_names(MshCursor& in, MshContent& content) {
  const auto count = in.checked_count(in.number<std::int64_t>(), "physical names", 7);
  for (std::size_t i = 0; i < count; ++i) {
    const auto dimension = in.number<std::int64_t>(), tag = in.number<std::int64_t>();
    const auto line = in.rest_of_line();
    const auto open = line.find('"'), close = line.rfind('"');
    if (open == close) in.fail("a physical name stands between double quotes");
    content.names[{int(dimension), tag}] = line.substr(open + 1, close - open - 1);
  }
}

/// Whether the section matters; others are skipped.
bool is_read(std::string_view name, Version version) {
  return name == "$PhysicalNames" || name == "$Nodes" || name == "$Elements"
         || name == (version == Version::v22 ? "$ParametricNodes" : "$Entities");
}

void read_section(MshCursor& in, std::string_view name, Version version, MshContent& content) {
  if (name == "$PhysicalNames") return read_names(in, content);
  in.end_of_line();
  if (name == "$Entities") return msh41::read_entities(in, content);
  if (name == "$Elements")
    return version == Version::v22 ? msh22::read_elements(in, content) : msh41::read_elements(in, content);
  if (version == Version::v22) return msh22::read_nodes(in, name == "$ParametricNodes", content);
  msh41::read_nodes(in, content);
}

MshContent read_content(MshCursor& in) {
  MshContent content;
  Version version = Version::none;
  std::set<std::string, std::less<>> seen;
  while (!in.at_end()) {
    const std::string name(in.word());
    if (name[0] != '$')
      in.fail("expected the heading of a section, such as $Nodes: this is not a Gmsh .msh file, or it is damaged");
    if (name == "$PartitionedEntities")
      in.fail("the mesh is partitioned: save it without partitions, nanson makes its own");
    if (name == "$MeshFormat" && version == Version::none) {
      version = read_format(in);
      continue;
    }
    if (version == Version::none && name != "$Comments")
      in.fail("$MeshFormat must come first: this is not a Gmsh .msh file, or one older than version 2.2");
    const std::string end = fmt::format("$End{}", name.substr(1));
    if (!is_read(name, version)) {
      in.skip_past(end);
      continue;
    }
    if (!seen.insert(name == "$ParametricNodes" ? "$Nodes" : name).second)
      in.fail(fmt::format("a second section {}", name));
    if (name == "$Elements" && !seen.contains("$Nodes")) in.fail("$Elements must come after $Nodes");
    read_section(in, name, version, content);
    in.expect(end);
  }
  if (!seen.contains("$Elements")) in.fail("there is no section $Elements: the file is cut off or has no mesh");
  return content;
}

struct Bytes {
  std::unique_ptr<char[]> data;
  std::size_t size = 0;
  bool complete = false;
};

Bytes read_bytes(const std::filesystem::path& path) {
  std::error_code problem;
  Bytes bytes;
  const auto size = std::filesystem::file_size(path, problem);
  std::ifstream file(path, std::ios::binary);
  if (problem || !file) return bytes;
  bytes.size = size;
  bytes.data = std::make_unique_for_overwrite<char[]>(size);
  bytes.complete = bool(file.read(bytes.data.get(), std::streamsize(size)));
  return bytes;
}

/// The .msh file to read: the given one, or what gmsh makes of a .geo file, which goes when this goes.
struct MshFile {
  std::optional<ScratchFolder> made;
  std::filesystem::path path;
  std::vector<std::string> problems;

  explicit MshFile(const std::filesystem::path& given) : path(given) {
    if (const auto problem = path_problem(given); !problem.empty()) problems.push_back(problem);
    if (!problems.empty() || given.extension() != ".geo") return;
    path = made.emplace().path() / "mesh.msh";
    problems = run_gmsh(given, path);
  }
};

/// Errors start with `name`.
RawMesh read_file(const std::filesystem::path& file, const std::string& name, const UsedNames& used,
                  std::vector<std::string>& errors, std::vector<std::string>& notes) {
  if (file.extension() == ".inp") return read_inp(file, used, errors, notes);
  const Bytes bytes = read_bytes(file);
  if (bytes.complete) return read_msh({bytes.data.get(), bytes.size}, name, errors);
  errors.push_back(name + ": cannot be read");
  return {};
}

RawMesh make_mesh(const MeshSpec& spec) {
  if (spec.source == MeshSource::cylinder) return make_cylinder(spec);
  return spec.source == MeshSource::needle ? make_needle(spec) : make_box(spec);
}

}  // namespace

RawMesh read_msh(std::string_view bytes, const std::string& name, std::vector<std::string>& errors) {
  MshCursor in(bytes);
  try {
    std::vector<std::string> problems;
    RawMesh mesh = to_raw_mesh(read_content(in), problems);
    for (const auto& problem : problems) errors.push_back(fmt::format("{}: {}", name, problem));
    return mesh;
  } catch (const MshError& problem) {
    errors.push_back(fmt::format("{}:{}", name, problem.what()));
    return {};
  }
}

RawMesh read_mesh(const std::filesystem::path& path, std::vector<std::string>& errors) {
  const MshFile file(path);
  for (const auto& problem : file.problems) errors.push_back(path.string() + ": " + problem);
  std::vector<std::string> notes;
  return file.problems.empty() ? read_file(file.path, path.string(), {}, errors, notes) : RawMesh{};
}

Mesh load_mesh(const MeshSpec& spec, std::vector<std::string>& errors) {
  std::vector<std::string> notes;
  return load_mesh(spec, {}, errors, notes);
}

Mesh load_mesh(const MeshSpec& spec, const UsedNames& used, std::vector<std::string>& errors,
               std::vector<std::string>& notes) {
  std::vector<std::string> problems;
  Mesh mesh;
  if (spec.source != MeshSource::file) {
    double nodes = 1;  // a bound for the cylinder, whose core has fewer
    for (const int n : spec.cells) nodes *= n + 1.0;
    if (6 * nodes > std::numeric_limits<int>::max())
      problems.push_back(fmt::format("{:.3g} nodes are more than can be numbered: take fewer cells", nodes));
    else mesh = finish_mesh(make_mesh(spec), problems);
    for (const auto& problem : problems) errors.push_back(fmt::format("mesh.{}: {}", word(spec.source), problem));
    return mesh;
  }
  const MshFile file(spec.file.name);
  for (const auto& problem : file.problems)
    errors.push_back(fmt::format("{}: mesh.file = \"{}\": {}", spec.file.where, spec.file.name, problem));
  if (!file.problems.empty()) return mesh;
  const std::size_t before = errors.size();
  RawMesh raw = read_file(file.path, spec.file.name, used, errors, notes);
  if (errors.size() != before) return mesh;
  keep_used_patches(raw, used);
  mesh = finish_mesh(std::move(raw), problems);
  for (const auto& problem : problems) errors.push_back(spec.file.name + ": " + problem);
  return mesh;
}

}  // namespace nanson
