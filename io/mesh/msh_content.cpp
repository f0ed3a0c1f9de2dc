// Node tags, element types and physical groups of .msh files.
#include "io/mesh/msh_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "engine/complaints.hpp"

namespace nanson {
namespace {

/// Shapes by gmsh's element type, for messages only.
const std::map<std::int64_t, std::string>& shapes() {
  static const std::map<std::int64_t, std::string> table{
      {3, "4-node quadrangle"},   {5, "8-node hexahedron"}, {6, "6-node prism"},        {7, "5-node pyramid"},
      {8, "3-node line"},         {9, "6-node triangle"},   {10, "9-node quadrangle"},  {11, "10-node tetrahedron"},
      {12, "27-node hexahedron"}, {13, "18-node prism"},    {14, "14-node pyramid"},    {16, "8-node quadrangle"},
      {17, "20-node hexahedron"}, {18, "15-node prism"},    {19, "13-node pyramid"},    {20, "9-node triangle"},
      {21, "10-node triangle"},   {26, "4-node line"},      {29, "20-node tetrahedron"}};
  return table;
}

/// A physical group without a name is called by its tag.
std::string name_of(const MshContent& content, MshGroup physical) {
  const auto named = content.names.find(physical);
  return named == content.names.end() ? std::to_string(physical.second) : named->second;
}

/// Distinct names of the physical groups that an entity is in.
std::vector<std::string> names_of(const MshContent& content, MshGroup entity) {
  std::vector<std::string> names;
  const auto groups = content.groups.find(entity);
  if (groups == content.groups.end()) return names;
  for (const auto tag : groups->second) {
    const std::string name = name_of(content, {entity.first, tag});
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

int id_of(const std::string& name, std::vector<std::string>& names) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return int(found - names.begin());
  names.push_back(name);
  return int(names.size()) - 1;
}

/// Names that occur in the runs, in the order of their physical tags: the same whatever order the elements have.
template <std::size_t nodes>
std::vector<std::string> names_in_order(const MshContent& content, int dimension, const MshElements<nodes>& elements) {
  std::vector<std::int64_t> tags;
  for (const auto& run : elements.runs) {
    const auto groups = content.groups.find({dimension, run.entity});
    if (groups != content.groups.end()) tags.insert(tags.end(), groups->second.begin(), groups->second.end());
  }
  std::sort(tags.begin(), tags.end());
  std::vector<std::string> names;
  for (const auto tag : tags) id_of(name_of(content, {dimension, tag}), names);
  return names;
}

void set_regions(const MshContent& content, RawMesh& mesh, std::vector<std::string>& errors) {
  Complaints shared("volumes in several physical groups");
  std::vector<std::int64_t> told;
  mesh.region_names = names_in_order(content, 3, content.tets);
  mesh.tet_region.reserve(content.tets.elements.size());
  for (const auto& run : content.tets.runs) {
    const auto names = names_of(content, {3, run.entity});
    if (names.size() > 1 && std::find(told.begin(), told.end(), run.entity) == told.end()) {
      told.push_back(run.entity);
      shared.add([&] {
        return fmt::format(
            "volume {} is in {} physical groups, among them \"{}\" and \"{}\": put every volume into one only",
            run.entity, names.size(), names[0], names[1]);
      });
    }
    mesh.tet_region.resize(run.end, id_of(names.empty() ? "unnamed" : names[0], mesh.region_names));
  }
  shared.append_to(errors);
}

/// One triangle a patch it is in; finish_mesh refuses two patches where that is on the boundary.
void set_patches(const MshContent& content, RawMesh& mesh) {
  mesh.patch_names = names_in_order(content, 2, content.triangles);
  const auto* elements = content.triangles.elements.data();
  std::size_t begin = 0;
  for (const auto& run : content.triangles.runs) {
    for (const auto& name : names_of(content, {2, run.entity})) {
      mesh.triangles.insert(mesh.triangles.end(), elements + begin, elements + run.end);
      mesh.triangle_patch.resize(mesh.triangles.size(), id_of(name, mesh.patch_names));
    }
    begin = run.end;
  }
}

/// Gmsh saves the points that a geometry was constructed with (centres of circles) as nodes of point elements: not part of the body.
void drop_construction_points(const std::vector<char>& on_skeleton, RawMesh& mesh) {
  std::vector<char> keep(mesh.X.size(), 0);
  for (std::size_t a = 0; a < keep.size(); ++a) keep[a] = !on_skeleton[a];
  for (const auto& tet : mesh.tets)
    for (const int a : tet) keep[a] = 1;
  for (const auto& triangle : mesh.triangles)
    for (const int a : triangle) keep[a] = 1;
  if (std::find(keep.begin(), keep.end(), 0) == keep.end()) return;
  std::vector<int> now(mesh.X.size(), -1);
  int kept = 0;
  for (std::size_t a = 0; a < now.size(); ++a)
    if (keep[a]) {
      mesh.X[kept] = mesh.X[a];
      now[a] = kept++;
    }
  mesh.X.resize(kept);
  for (auto& tet : mesh.tets)
    for (int& a : tet) a = now[a];
  for (auto& triangle : mesh.triangles)
    for (int& a : triangle) a = now[a];
}

}  // namespace

std::pair<std::int64_t, bool> NodeIndex::build(const std::vector<std::int64_t>& tags) {
  if (tags.empty()) return {0, false};
  const auto [low, high] = std::minmax_element(tags.begin(), tags.end());
  first_ = *low;
  const std::uint64_t range = std::uint64_t(*high) - std::uint64_t(*low);
  if (range / 4 <= tags.size()) {
    table_.assign(range + 1, -1);
    for (std::size_t i = 0; i < tags.size(); ++i) {
      int& entry = table_[std::uint64_t(tags[i]) - std::uint64_t(first_)];
      if (entry >= 0) return {tags[i], true};
      entry = int(i);
    }
    return {0, false};
  }
  for (std::size_t i = 0; i < tags.size(); ++i) sorted_.push_back({tags[i], int(i)});
  std::sort(sorted_.begin(), sorted_.end());
  const auto twice = std::adjacent_find(sorted_.begin(), sorted_.end(),
                                        [](const auto& s, const auto& t) { return s.first == t.first; });
  return twice == sorted_.end() ? std::pair{std::int64_t{0}, false} : std::pair{twice->first, true};
}

int NodeIndex::find(std::int64_t tag) const {
  if (!table_.empty()) {
    const std::uint64_t offset = std::uint64_t(tag) - std::uint64_t(first_);
    return offset < table_.size() ? table_[offset] : -1;
  }
  const auto found = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair{tag, std::numeric_limits<int>::min()});
  return found != sorted_.end() && found->first == tag ? found->second : -1;
}

int node_count(const MshCursor& in, std::int64_t type) {
  switch (type) {
    case 15: return 1;
    case 1: return 2;
    case 2: return 3;
    case 4: return 4;
  }
  const auto shape = shapes().find(type);
  const bool first_order = type == 3 || (type >= 5 && type <= 7);
  in.fail(fmt::format("element type {}{} is not supported: mesh with {}", type,
                      shape == shapes().end() ? "" : " (" + shape->second + ")",
                      first_order ? "triangles and tetrahedra only" : "first order elements"));
}

void set_node_tags(const MshCursor& in, const std::vector<std::int64_t>& tags, MshContent& content) {
  constexpr auto most = std::size_t(std::numeric_limits<int>::max());
  if (tags.size() > most) in.fail(fmt::format("{} nodes are more than the {} that can be numbered", tags.size(), most));
  const auto [tag, twice] = content.index.build(tags);
  if (twice) in.fail(fmt::format("node {} is given twice", tag));
  content.on_skeleton.assign(tags.size(), 0);
}

template <class OnDisk>
void read_element(MshCursor& in, std::int64_t element, int nodes, std::int64_t entity, MshContent& content) {
  std::array<int, 4> index{};
  for (int v = 0; v < nodes; ++v) {
    const std::int64_t tag = in.read<OnDisk>();
    index[v] = content.index.find(tag);
    if (index[v] < 0)
      in.fail(fmt::format("element {} has the node {}, which is not among the nodes of the file", element, tag));
  }
  if (nodes == 4) content.tets.add(entity, index);
  else if (nodes == 3) content.triangles.add(entity, {index[0], index[1], index[2]});
  else
    for (int v = 0; v < nodes; ++v) content.on_skeleton[index[v]] = 1;
}

template void read_element<std::int32_t>(MshCursor&, std::int64_t, int, std::int64_t, MshContent&);
template void read_element<std::int64_t>(MshCursor&, std::int64_t, int, std::int64_t, MshContent&);

RawMesh to_raw_mesh(MshContent content, std::vector<std::string>& errors) {
  RawMesh mesh;
  set_regions(content, mesh, errors);
  set_patches(content, mesh);
  mesh.X = std::move(content.X);
  mesh.tets = std::move(content.tets.elements);
  drop_construction_points(content.on_skeleton, mesh);
  return mesh;
}

}  // namespace nanson
