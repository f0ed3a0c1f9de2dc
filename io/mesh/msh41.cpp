// Gmsh's format 4.1: everything in blocks by geometric entity, entities carry the physical groups. Counts and tags of nodes and
// elements have 64 bits in binary files, dimensions, entity tags, physical tags and element types 32.
//   $Entities  numbers of points, curves, surfaces, volumes; each: tag, box (3 or 6 reals), n, n physical tags; but points: m, m boundary tags
//   $Nodes     blocks nodes min max; each block: dim entity parametric n, n tags, n times: x y z [dim parameters]
//   $Elements  blocks elements min max; each block: dim entity type n, n times: tag, nodes
#include <fmt/format.h>

#include <cstdlib>

#include "io/mesh/msh_sections.hpp"

namespace nanson::msh41 {
namespace {

struct Block {
  std::int64_t dimension, entity, kind;  // kind: parametric or the element type
  std::size_t count;
};

/// `announced` is the total of the section, `read` what was read of it before.
Block read_block(MshCursor& in, std::string_view what, std::size_t announced, std::size_t read) {
  Block block{};
  block.dimension = in.read<std::int32_t>();
  if (block.dimension < 0 || block.dimension > 3)
    in.fail(fmt::format("an entity has the dimension {}", block.dimension));
  block.entity = in.read<std::int32_t>();
  block.kind = in.read<std::int32_t>();
  const auto count = in.read<std::int64_t>();
  if (count < 0 || std::size_t(count) > announced - read)
    in.fail(fmt::format("a block of {} {} where {} of {} are left: the file is damaged", count, what, announced - read,
                        announced));
  block.count = std::size_t(count);
  return block;
}

void check_total(const MshCursor& in, std::string_view what, std::size_t announced, std::size_t read) {
  if (read != announced) in.fail(fmt::format("the blocks hold {} {}, {} were announced", read, what, announced));
}

void read_entity(MshCursor& in, int dimension, MshContent& content) {
  const auto tag = in.read<std::int32_t>();
  for (int i = 0; i < (dimension == 0 ? 3 : 6); ++i) in.read<double>();
  auto& groups = content.groups[{dimension, tag}];
  const auto physical = in.count<std::int64_t>("physical groups", 2, 4);
  for (std::size_t i = 0; i < physical; ++i) groups.push_back(std::abs(in.read<std::int32_t>()));
  const auto boundary = dimension == 0 ? 0 : in.count<std::int64_t>("boundary entities", 2, 4);
  for (std::size_t i = 0; i < boundary; ++i) in.read<std::int32_t>();
}

}  // namespace

void read_entities(MshCursor& in, MshContent& content) {
  std::array<std::size_t, 4> count{};
  for (auto& n : count) n = in.count<std::int64_t>("entities", 10, 36);
  for (int dimension = 0; dimension < 4; ++dimension)
    for (std::size_t i = 0; i < count[dimension]; ++i) read_entity(in, dimension, content);
}

void read_nodes(MshCursor& in, MshContent& content) {
  const auto blocks = in.count<std::int64_t>("blocks of nodes", 8, 20);
  const auto count = in.count<std::int64_t>("nodes", 8, 32);
  in.read<std::int64_t>();
  in.read<std::int64_t>();
  std::vector<std::int64_t> tags;
  tags.reserve(count);
  content.X.reserve(count);
  for (std::size_t b = 0; b < blocks; ++b) {
    const Block block = read_block(in, "nodes", count, tags.size());
    for (std::size_t i = 0; i < block.count; ++i) tags.push_back(in.read<std::int64_t>());
    for (std::size_t i = 0; i < block.count; ++i) {
      Vec3 x;
      for (double& c : x) c = in.read<double>();
      content.X.push_back(x);
      for (std::int64_t parameter = 0; block.kind && parameter < block.dimension; ++parameter) in.read<double>();
    }
  }
  check_total(in, "nodes", count, tags.size());
  set_node_tags(in, tags, content);
}

void read_elements(MshCursor& in, MshContent& content) {
  const auto blocks = in.count<std::int64_t>("blocks of elements", 8, 20);
  const auto count = in.count<std::int64_t>("elements", 4, 16);
  in.read<std::int64_t>();
  in.read<std::int64_t>();
  std::size_t read = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    const Block block = read_block(in, "elements", count, read);
    const int nodes = node_count(in, block.kind);
    for (std::size_t i = 0; i < block.count; ++i) {
      const auto element = in.read<std::int64_t>();
      read_element<std::int64_t>(in, element, nodes, block.entity, content);
    }
    read += block.count;
  }
  check_total(in, "elements", count, read);
}

}  // namespace nanson::msh41
