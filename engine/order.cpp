// METIS k-way parts of the nodal graph, RCM inside each, rows padded to multiples of 8 nodes, edges copied to every part that they touch.
#include "engine/order.hpp"

#include <metis.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/clock.hpp"

namespace nanson {
namespace {

struct Graph {
  std::vector<idx_t> begin, to;
};

Graph nodal_graph(const Dual& dual, int nodes) {
  Graph g;
  g.begin.assign(static_cast<std::size_t>(nodes) + 1, 0);
  for (const auto& e : dual.edges) {
    ++g.begin[e.a + 1];
    ++g.begin[e.b + 1];
  }
  std::partial_sum(g.begin.begin(), g.begin.end(), g.begin.begin());
  g.to.resize(2 * dual.edges.size());
  std::vector<idx_t> next(g.begin.begin(), g.begin.end() - 1);
  for (const auto& e : dual.edges) {
    g.to[next[e.a]++] = e.b;
    g.to[next[e.b]++] = e.a;
  }
  return g;
}

/// Reverse Cuthill-McKee over the nodes whose label is `label`: breadth first from a far node, neighbours by degree. Appends to `order`.
void append_rcm(const Graph& g, const std::vector<idx_t>& label, idx_t which, const std::vector<int>& members,
                std::vector<char>& seen, std::vector<int>& order) {
  const auto degree = [&](int n) { return g.begin[n + 1] - g.begin[n]; };
  const auto breadth_first = [&](int start, std::vector<int>& visit) {
    visit.assign(1, start);
    seen[start] = 1;
    for (std::size_t i = 0; i < visit.size(); ++i) {
      const std::size_t from = visit.size();
      for (idx_t k = g.begin[visit[i]]; k < g.begin[visit[i] + 1]; ++k)
        if (const int m = g.to[k]; label[m] == which && !seen[m]) {
          seen[m] = 1;
          visit.push_back(m);
        }
      std::stable_sort(visit.begin() + static_cast<std::ptrdiff_t>(from), visit.end(),
                       [&](int p, int q) { return degree(p) < degree(q); });
    }
  };
  std::vector<int> visit;
  const std::size_t first = order.size();
  for (int n : members) {
    if (seen[n]) continue;
    breadth_first(n, visit);
    for (int m : visit) seen[m] = 0;
    breadth_first(visit.back(), visit);  // again from the far end: narrower levels
    order.insert(order.end(), visit.begin(), visit.end());
  }
  std::reverse(order.begin() + static_cast<std::ptrdiff_t>(first), order.end());
}

/// Label of every node by METIS; empty when METIS fails.
std::vector<idx_t> metis_parts(Graph& g, idx_t nodes, idx_t count) {
  std::vector<idx_t> label(static_cast<std::size_t>(nodes), 0);
  if (count == 1) return label;
  idx_t options[METIS_NOPTIONS], constraints = 1, cut = 0;
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  if (METIS_PartGraphKway(&nodes, &constraints, g.begin.data(), g.to.data(), nullptr, nullptr, nullptr, &count, nullptr,
                          nullptr, options, &cut, label.data())
      != METIS_OK)
    label.clear();
  return label;
}

/// The parts in an order in which neighbours in space are neighbours in memory: RCM of the graph of parts.
std::vector<int> order_of_parts(const Graph& g, const std::vector<idx_t>& label, int count) {
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t n = 0; n + 1 < g.begin.size(); ++n)
    for (idx_t k = g.begin[n]; k < g.begin[n + 1]; ++k)
      if (label[n] != label[g.to[k]]) pairs.emplace_back(label[n], label[g.to[k]]);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  Graph parts;
  parts.begin.assign(static_cast<std::size_t>(count) + 1, 0);
  for (const auto& p : pairs) {
    ++parts.begin[p.first + 1];
    parts.to.push_back(p.second);
  }
  std::partial_sum(parts.begin.begin(), parts.begin.end(), parts.begin.begin());
  std::vector<int> members(static_cast<std::size_t>(count)), order;
  std::iota(members.begin(), members.end(), 0);
  std::vector<char> seen(static_cast<std::size_t>(count), 0);
  append_rcm(parts, std::vector<idx_t>(static_cast<std::size_t>(count), 0), 0, members, seen, order);
  return order;
}

/// Mesh nodes of every part, in memory order.
std::vector<std::vector<int>> ordered_parts(const Dual& dual, int nodes, bool try_metis, Order& o) {
  Graph g = nodal_graph(dual, nodes);
  int count = std::max(1, (nodes + part_size(nodes) / 2) / part_size(nodes));
  std::vector<idx_t> label;
  const double start = wall_seconds();
  if (try_metis) label = metis_parts(g, nodes, count);
  o.metis_s = wall_seconds() - start;
  std::vector<char> seen(static_cast<std::size_t>(nodes), 0);
  if (label.empty()) {  // one RCM numbering, cut into parts
    o.metis_failed = true;
    std::vector<int> all(static_cast<std::size_t>(nodes)), order;
    std::iota(all.begin(), all.end(), 0);
    append_rcm(g, std::vector<idx_t>(static_cast<std::size_t>(nodes), 0), 0, all, seen, order);
    std::vector<std::vector<int>> parts(static_cast<std::size_t>(count));
    for (int i = 0; i < nodes; ++i)
      parts[static_cast<std::size_t>(static_cast<long>(i) * count / nodes)].push_back(order[i]);
    return parts;
  }
  std::vector<std::vector<int>> members(static_cast<std::size_t>(count)), parts;
  for (int n = 0; n < nodes; ++n) members[label[n]].push_back(n);
  for (int p : order_of_parts(g, label, count)) {
    if (members[p].empty()) continue;
    parts.emplace_back();
    append_rcm(g, label, p, members[p], seen, parts.back());
  }
  return parts;
}

void number_rows(Order& o, std::vector<std::vector<int>> parts, const std::vector<int>& group) {
  o.row_of.assign(static_cast<std::size_t>(o.nodes), -1);
  for (auto& members : parts) {
    if (!group.empty())
      std::stable_sort(members.begin(), members.end(), [&](int p, int q) { return group[p] < group[q]; });
    Part part{};
    part.node_begin = static_cast<int>(o.node_of.size());
    const auto pad = [&] {
      while (o.node_of.size() % 8) o.node_of.push_back(-1);
    };
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (!group.empty() && i > 0 && group[members[i]] != group[members[i - 1]]) pad();
      o.row_of[members[i]] = static_cast<int>(o.node_of.size());
      o.node_of.push_back(members[i]);
    }
    pad();
    part.node_end = static_cast<int>(o.node_of.size());
    o.most_nodes = std::max(o.most_nodes, part.node_end - part.node_begin);
    o.parts.push_back(part);
  }
  o.rows = static_cast<int>(o.node_of.size());
}

/// Every edge once in each part that it touches, owned node first; sorted by (a, b).
void place_edges(Order& o, const Dual& dual) {
  std::vector<int> part_of(static_cast<std::size_t>(o.rows));
  for (std::size_t p = 0; p < o.parts.size(); ++p)
    std::fill(part_of.begin() + o.parts[p].node_begin, part_of.begin() + o.parts[p].node_end, static_cast<int>(p));
  struct Half {
    int b, edge;
    bool flipped;
  };
  o.out.assign(static_cast<std::size_t>(o.rows) + 1, 0);
  const auto visit = [&](auto use) {
    for (int e = 0; e < static_cast<int>(dual.edges.size()); ++e) {
      const int a = o.row_of[dual.edges[e].a], b = o.row_of[dual.edges[e].b];
      if (part_of[a] != part_of[b]) {
        use(a, b, e, false);
        use(b, a, e, true);
      } else if (a < b) use(a, b, e, false);
      else use(b, a, e, true);
    }
  };
  visit([&](int a, int, int, bool) { ++o.out[a + 1]; });
  std::partial_sum(o.out.begin(), o.out.end(), o.out.begin());
  std::vector<Half> halves(static_cast<std::size_t>(o.out.back()));
  std::vector<int> next(o.out.begin(), o.out.end() - 1);
  visit([&](int a, int b, int e, bool flipped) { halves[next[a]++] = {b, e, flipped}; });
  const std::size_t count = halves.size();
  o.a.assign(count + ahead::padding, 0);
  o.b.assign(count + ahead::padding, 0);
  for (auto& C : o.C) C.assign(count + ahead::padding, 0);
  if (dual.has_springs) o.stiffness.assign(count + ahead::padding, 0);
  o.in.assign(static_cast<std::size_t>(o.rows) + 1, 0);
  for (int a = 0; a < o.rows; ++a) {
    std::sort(halves.begin() + o.out[a], halves.begin() + o.out[a + 1],
              [](const Half& p, const Half& q) { return p.b < q.b; });
    for (int i = o.out[a]; i < o.out[a + 1]; ++i) {
      const Half& h = halves[i];
      const Vec3& C = dual.edges[h.edge].C;
      o.a[i] = a;
      o.b[i] = h.b;
      for (int k = 0; k < 3; ++k) o.C[k][i] = h.flipped ? -C[k] : C[k];
      if (dual.has_springs) o.stiffness[i] = dual.edges[h.edge].stiffness;
      if (part_of[a] == part_of[h.b]) ++o.in[h.b + 1];
    }
  }
  std::partial_sum(o.in.begin(), o.in.end(), o.in.begin());
  o.in_edges.assign(static_cast<std::size_t>(o.in.back()) + 1, 0);
  o.in_nodes = o.in_edges;
  std::vector<int> slot(o.in.begin(), o.in.end() - 1);
  for (int i = 0; i < static_cast<int>(count); ++i)
    if (part_of[o.a[i]] == part_of[o.b[i]]) {
      const int at = slot[o.b[i]]++;
      o.in_edges[at] = i;
      o.in_nodes[at] = o.a[i];
    }
}

void place_corners(Order& o, const Dual& dual) {
  o.corner.assign(static_cast<std::size_t>(o.rows) + 1, 0);
  for (const auto& c : dual.corners) ++o.corner[o.row_of[c.a] + 1];
  std::partial_sum(o.corner.begin(), o.corner.end(), o.corner.begin());
  const std::size_t count = dual.corners.size();
  o.corner_b.resize(count);
  o.corner_c.resize(count);
  o.corner_load.assign(count, -1);
  o.corner_face.resize(count);
  for (auto& C : o.corner_C) C.resize(count);
  std::vector<int> next(o.corner.begin(), o.corner.end() - 1);
  for (const auto& c : dual.corners) {
    const int at = next[o.row_of[c.a]]++;
    o.corner_b[at] = o.row_of[c.b];
    o.corner_c[at] = o.row_of[c.c];
    o.corner_face[at] = c.face;
    for (int k = 0; k < 3; ++k) o.corner_C[k][at] = c.C[k];
  }
}

}  // namespace

Order make_order(const Dual& dual, int nodes, bool try_metis, const std::vector<int>& group) {
  Order o;
  o.nodes = nodes;
  number_rows(o, ordered_parts(dual, nodes, try_metis, o), group);
  place_edges(o, dual);
  place_corners(o, dual);
  for (auto& p : o.parts) {
    p.edge_begin = o.out[p.node_begin];
    p.edge_end = o.out[p.node_end];
    p.corner_begin = o.corner[p.node_begin];
    p.corner_end = o.corner[p.node_end];
    o.most_edges = std::max(o.most_edges, p.edge_end - p.edge_begin);
    o.most_corners = std::max(o.most_corners, p.corner_end - p.corner_begin);
  }
  return o;
}

}  // namespace nanson
