// What a .msh file holds, whatever its version, and how it becomes a raw mesh.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/mesh/mesh.hpp"
#include "io/mesh/msh_cursor.hpp"

namespace nanson {

/// From node tags to indices. Tags may be sparse and of 64 bits: a table where they are dense, else binary search.
class NodeIndex {
 public:
  /// Returns a tag that occurs twice, if there is one, as {tag, true}.
  std::pair<std::int64_t, bool> build(const std::vector<std::int64_t>& tags);
  int find(std::int64_t tag) const;  // -1 where there is none

 private:
  std::int64_t first_ = 0;
  std::vector<int> table_;
  std::vector<std::pair<std::int64_t, int>> sorted_;
};

using MshGroup = std::pair<int, std::int64_t>;  // dimension and tag

/// Elements of one dimension in file order. A run is a stretch of elements on one entity.
template <std::size_t nodes>
struct MshElements {
  struct Run {
    std::int64_t entity;
    std::size_t end;
  };
  std::vector<std::array<int, nodes>> elements;
  std::vector<Run> runs;

  void add(std::int64_t entity, const std::array<int, nodes>& element) {
    if (runs.empty() || runs.back().entity != entity) runs.push_back({entity, 0});
    elements.push_back(element);
    runs.back().end = elements.size();
  }
};

struct MshContent {
  std::map<MshGroup, std::string> names;  // of physical groups
  std::map<MshGroup, std::vector<std::int64_t>>
      groups;           // physical tags of an entity; version 2.2: entity = physical tag
  std::vector<Vec3> X;  // [m]
  NodeIndex index;
  std::vector<char> on_skeleton;  // per node: whether a point or line element uses it
  MshElements<3> triangles;
  MshElements<4> tets;
};

/// Number of nodes of the element types that are read (points, lines, triangles, tets); fails with a sentence for all others.
int node_count(const MshCursor& in, std::int64_t element_type);

/// Node tags, which must be unique, once all coordinates are in.
void set_node_tags(const MshCursor& in, const std::vector<std::int64_t>& tags, MshContent& content);

/// Reads the node tags of one element, stored as OnDisk in binary files, and keeps it where it matters.
template <class OnDisk>
void read_element(MshCursor& in, std::int64_t element, int nodes, std::int64_t entity, MshContent& content);

/// Resolves names. Errors: volumes in two physical groups.
RawMesh to_raw_mesh(MshContent content, std::vector<std::string>& errors);

}  // namespace nanson
