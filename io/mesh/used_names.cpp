// Triangles that are named more than once are found by sorting them.
#include "io/mesh/used_names.hpp"

#include <algorithm>
#include <numeric>
#include <span>

namespace nanson {

UsedNames used_names(const Scene& scene) {
  UsedNames used;
  for (const BoundarySpec& b : scene.boundary)
    for (const Named& face : b.faces) used.faces.push_back(face.name);
  for (const MaterialSpec& m : materials_of(scene))
    for (const Named& region : m.regions) used.regions.push_back(region.name);
  return used;
}

void keep_used_patches(RawMesh& raw, const UsedNames& used) {
  const auto is_used = [&](std::size_t i) {
    const std::string& name = raw.patch_names[static_cast<std::size_t>(raw.triangle_patch[i])];
    return std::find(used.faces.begin(), used.faces.end(), name) != used.faces.end();
  };
  std::vector<long> size(raw.patch_names.size(), 0);  // [triangles] of a patch
  for (const int patch : raw.triangle_patch) ++size[static_cast<std::size_t>(patch)];
  const auto size_of = [&](std::size_t i) { return size[static_cast<std::size_t>(raw.triangle_patch[i])]; };
  std::vector<std::array<int, 3>> nodes = raw.triangles;
  for (auto& t : nodes) std::sort(t.begin(), t.end());
  std::vector<std::size_t> order(nodes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return nodes[a] != nodes[b] ? nodes[a] < nodes[b] : a < b; });
  std::vector<char> keep(nodes.size(), 1);
  for (std::size_t begin = 0, end; begin < order.size(); begin = end) {
    end = begin + 1;
    while (end < order.size() && nodes[order[end]] == nodes[order[begin]]) ++end;
    if (end == begin + 1) continue;
    const std::span<const std::size_t> same(order.data() + begin, end - begin);
    const bool any = std::ranges::any_of(same, is_used);
    std::size_t smallest = same[0];
    for (const std::size_t i : same)
      if (size_of(i) <= size_of(smallest)) smallest = i;
    for (const std::size_t i : same) keep[i] = any ? is_used(i) : i == smallest;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (!keep[i]) continue;
    raw.triangles[kept] = raw.triangles[i];
    raw.triangle_patch[kept++] = raw.triangle_patch[i];
  }
  raw.triangles.resize(kept);
  raw.triangle_patch.resize(kept);
}

}  // namespace nanson
