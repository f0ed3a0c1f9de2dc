// Named nodal fields, exact errors, probes and the state's hash: what output takes from a simulation, in the mesh's numbering.
#pragma once
#include <map>
#include <span>
#include <string>
#include <vector>

#include "engine/simulation.hpp"

namespace nanson {

/// A field of field_names at one mesh node; tensors row by row. Units as in the table.
void field_at(const Simulation& s, std::string_view name, int node, double* out);
std::vector<float> field(const Simulation& s, const FieldName& name);

/// A probe's tet and its barycentric weights there; the nearest node when no tet holds the point.
struct ProbePlace {
  int tet = -1;
  std::array<int, 4> nodes{};
  std::array<double, 4> weight{};
  Vec3 at{};  // [m] where it really is
};
ProbePlace place_probe(const Mesh& mesh, const Vec3& at);
void probe(const Simulation& s, const ProbePlace& place, const FieldName& name, double* out);

/// Volume-weighted relative L1 and L2 errors of p1 and P11 against the exact field at t, and of P11 against its size at t = 0 (method, section 12).
std::map<std::string, double> exact_errors(const Simulation& s);

}  // namespace nanson
