// Gmsh's format 2.2. Counts are text in binary files too, tags have 32 bits there.
//   $Nodes     n, then n times: tag x y z; $ParametricNodes adds: dim entity [u if dim = 1, 2] [v if dim = 2]
//   $Elements  n, then as text n times: tag type ntags tags nodes; as binary blocks: type count ntags, count times: tag tags nodes
// The first element tag is the physical group (0: none). An element in several groups is written once for each.
#include <fmt/format.h>

#include <cstdlib>

#include "io/mesh/msh_sections.hpp"

namespace nanson::msh22 {
namespace {

std::size_t read_count(MshCursor& in, std::string_view what, std::size_t text_bytes, std::size_t binary_bytes) {
  const auto count = in.checked_count(in.number<std::int64_t>(), what, in.binary ? binary_bytes : text_bytes);
  if (in.binary) in.end_of_line();
  return count;
}

/// The physical group of an element (negative tags: the surface is turned over), made known as an entity of its own.
std::int64_t read_group(MshCursor& in, std::size_t tags, int dimension, MshContent& content) {
  std::int64_t physical = 0;
  for (std::size_t i = 0; i < tags; ++i) {
    const auto tag = in.read<std::int32_t>();
    if (i == 0) physical = std::abs(tag);
  }
  auto& groups = content.groups[{dimension, physical}];
  if (groups.empty() && physical != 0) groups.push_back(physical);
  return physical;
}

}  // namespace

void read_nodes(MshCursor& in, bool parametric, MshContent& content) {
  const std::size_t count = read_count(in, "nodes", 8, 28);
  std::vector<std::int64_t> tags(count);
  content.X.resize(count);
  for (std::size_t a = 0; a < count; ++a) {
    tags[a] = in.read<std::int32_t>();
    for (double& x : content.X[a]) x = in.read<double>();
    if (!parametric) continue;
    const auto dimension = in.read<std::int32_t>();
    in.read<std::int32_t>();
    for (int i = 0; i < dimension && dimension < 3; ++i) in.read<double>();
  }
  set_node_tags(in, tags, content);
}

void read_elements(MshCursor& in, MshContent& content) {
  const std::size_t count = read_count(in, "elements", 8, 8);
  for (std::size_t read = 0; read < count;) {
    std::int64_t element = 0, in_block = 1;
    if (!in.binary) element = in.number<std::int64_t>();
    const auto type = in.read<std::int32_t>();
    const int nodes = node_count(in, type);
    if (in.binary) in_block = in.read<std::int32_t>();
    if (in_block < 1 || std::size_t(in_block) > count - read)
      in.fail(fmt::format("a block of {} elements where {} of {} are left: the file is damaged", in_block, count - read,
                          count));
    const auto tags = in.count<std::int32_t>("element tags", 2, 4);
    for (std::int64_t i = 0; i < in_block; ++i) {
      if (in.binary) element = in.read<std::int32_t>();
      const auto physical = read_group(in, tags, nodes - 1, content);
      read_element<std::int32_t>(in, element, nodes, physical, content);
    }
    read += std::size_t(in_block);
  }
}

}  // namespace nanson::msh22
