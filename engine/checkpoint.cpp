// Rows between memory and mesh order, the identities of mesh and order, and what is found anew.
#include "engine/checkpoint.hpp"

#include "engine/hash.hpp"
#include "engine/start.hpp"

namespace nanson {
namespace {

template <class List>
void add_list(Hash& hash, const List& list) {
  hash.add(list.data(), list.size() * sizeof(list[0]));
}

void add_names(Hash& hash, const std::vector<std::string>& names) {
  for (const std::string& name : names) hash.add(name.c_str(), name.size() + 1);
}

}  // namespace

std::vector<double> in_mesh_order(const Order& order, const ArrayRole& role, const Aligned<double>& array) {
  if (role.of != Per::node) return {array.begin(), array.end()};
  std::vector<double> values(role.width * order.row_of.size());
  for (std::size_t n = 0; n < order.row_of.size(); ++n)
    std::copy_n(&array[role.width * static_cast<std::size_t>(order.row_of[n])], role.width, &values[role.width * n]);
  return values;
}

void from_mesh_order(const Order& order, const ArrayRole& role, std::span<const double> values,
                     Aligned<double>& array) {
  if (role.of != Per::node) {
    std::ranges::copy(values, array.begin());
    return;
  }
  for (std::size_t n = 0; n < order.row_of.size(); ++n)
    std::copy_n(&values[role.width * n], role.width, &array[role.width * static_cast<std::size_t>(order.row_of[n])]);
}

std::string order_hash(const Order& order) {
  Hash hash;
  add_list(hash, order.row_of);
  add_list(hash, order.a);
  add_list(hash, order.b);
  for (const Part& part : order.parts) hash.add(&part.node_begin, sizeof part.node_begin);
  return hash.text();
}

std::string mesh_hash(const Mesh& mesh) {
  Hash hash;
  add_list(hash, mesh.X);
  add_list(hash, mesh.tets);
  add_list(hash, mesh.tet_region);
  add_names(hash, mesh.region_names);
  add_list(hash, mesh.faces);
  add_names(hash, mesh.patch_names);
  return hash.text();
}

double fastest_rate(const State& u) {
  double fastest = 0;
  for (const PartReport& r : u.reports) fastest = std::max(fastest, r.fastest);
  return fastest;
}

void go_on(Simulation& s, double fastest) {
  for (PartReport& r : s.state.reports) r = {};
  s.state.reports[0].fastest = fastest;
}

void go_on_in_another_order(Simulation& s) {
  s.state.has_lagged_correction = false;
  find_stress(s);
}

}  // namespace nanson
