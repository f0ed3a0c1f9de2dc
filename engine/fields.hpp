// Named nodal fields, exact errors, probes and the state's hash: what output takes from a simulation, in the mesh's numbering.
#pragma once
#include <map>
#include <span>
#include <string>
#include <vector>

#include "engine/output_field.hpp"
#include "engine/simulation.hpp"

namespace nanson {

/// At all nodes of the mesh, the components of a node together.
std::vector<float> field(const Simulation& s, const Field& f);

/// A probe's tet and its barycentric weights there; the nearest node when no tet holds the point.
struct ProbePlace {
  int tet = -1;
  std::array<int, 4> nodes{};
  std::array<double, 4> weight{};
  Vec3 at{};  // [m] where it really is
};
ProbePlace place_probe(const Mesh& mesh, const Vec3& at);
void probe(const Simulation& s, const ProbePlace& place, const Field& f, double* out);

/// Volume-weighted relative L1 and L2 errors of p1 and P11 against the exact field at t, and of P11 against its size at t = 0 (method, section 12).
std::map<std::string, double> exact_errors(const Simulation& s);

}  // namespace nanson
