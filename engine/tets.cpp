#include "engine/tets.hpp"

#include <algorithm>
#include <numeric>

namespace nanson {

TetArrays Tets::arrays() const {
  return {{corner[0].data(), corner[1].data(), corner[2].data(), corner[3].data()}, volume6.data()};
}

Tets make_tets(const Mesh& mesh, const Order& order, const Aligned<double>& X) {
  const auto row_of = [&](int node) { return order.row_of[static_cast<std::size_t>(node)]; };
  std::vector<int> lowest(mesh.tets.size()), sorted(mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& n = mesh.tets[t];
    lowest[t] = std::min({row_of(n[0]), row_of(n[1]), row_of(n[2]), row_of(n[3])});
  }
  std::iota(sorted.begin(), sorted.end(), 0);
  std::stable_sort(sorted.begin(), sorted.end(), [&](int s, int t) {
    return lowest[static_cast<std::size_t>(s)] < lowest[static_cast<std::size_t>(t)];
  });
  Tets out;
  const auto add = [&](int t) {
    for (std::size_t k = 0; k < 4; ++k) out.corner[k].push_back(row_of(mesh.tets[static_cast<std::size_t>(t)][k]));
  };
  for (auto& c : out.corner) c.reserve(mesh.tets.size() + 8 * order.parts.size());
  auto next = sorted.begin();
  for (const Part& part : order.parts) {
    out.first.push_back(static_cast<int>(out.corner[0].size()));
    const auto begin = next;
    for (; next != sorted.end() && lowest[static_cast<std::size_t>(*next)] < part.node_end; ++next) add(*next);
    out.last.push_back(static_cast<int>(out.corner[0].size()));
    while (begin != next && out.corner[0].size() % 8 != 0) add(*(next - 1));
  }
  out.first.push_back(static_cast<int>(out.corner[0].size()));
  out.volume6.resize(out.corner[0].size());
  for (std::size_t t = 0; t < out.volume6.size(); t += 8)
    store8(&out.volume6[t], volumes6(out.arrays(), static_cast<std::ptrdiff_t>(t), X.data(), row::X, 0, 1));
  return out;
}

void find_foreign(Tets& tets, const Order& order) {
  std::vector<std::vector<int>> of_part(order.parts.size());
  std::vector<int> part_of(static_cast<std::size_t>(order.rows));
  for (std::size_t p = 0; p < order.parts.size(); ++p)
    std::fill(part_of.begin() + order.parts[p].node_begin, part_of.begin() + order.parts[p].node_end,
              static_cast<int>(p));
  for (std::size_t p = 0; p < order.parts.size(); ++p)
    for (int t = tets.first[p]; t < tets.last[p]; ++t)
      for (const auto& corner : tets.corner) {
        const int q = part_of[static_cast<std::size_t>(corner[static_cast<std::size_t>(t)])];
        auto& list = of_part[static_cast<std::size_t>(q)];
        if (q != static_cast<int>(p) && (list.empty() || list.back() != t)) list.push_back(t);
      }
  for (const auto& list : of_part) {
    tets.first_foreign.push_back(static_cast<int>(tets.foreign.size()));
    tets.foreign.insert(tets.foreign.end(), list.begin(), list.end());
  }
  tets.first_foreign.push_back(static_cast<int>(tets.foreign.size()));
}

}  // namespace nanson
