// The account of memory and the hash of a state.
#include "engine/simulation.hpp"

#include "engine/hash.hpp"

namespace nanson {

double bytes_per_node(const Simulation& s) {
  return static_cast<double>(bytes_of(s.domain) + bytes_of(s.domain, s.state)) / s.domain.order.nodes;
}

std::string state_hash(const Simulation& s) {
  struct Unknown {
    const double* rows;
    std::size_t width;
  };
  const Order& o = s.domain.order;
  std::vector<Unknown> unknowns;
  each_array(s.domain, s.state, [&](const ArrayRole& role, const Aligned<double>& array) {
    if (role.keep == Keep::unknown && !array.empty())
      unknowns.push_back({array.data(), array.size() / static_cast<std::size_t>(o.rows)});
  });
  Hash hash;
  for (const int row : o.row_of)
    for (const auto& [rows, width] : unknowns)
      hash.add(rows + width * static_cast<std::size_t>(row), width * sizeof(double));
  return hash.text();
}

}  // namespace nanson
