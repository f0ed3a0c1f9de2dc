// What a simulation computes on, and with what: never changes after set-up.
#pragma once
#include <vector>

#include "engine/boundary.hpp"
#include "engine/clock.hpp"
#include "engine/current_geometry.hpp"
#include "engine/manufactured.hpp"
#include "engine/mixture.hpp"
#include "engine/projection.hpp"
#include "engine/registry.hpp"
#include "engine/tets.hpp"

namespace nanson {

struct Domain {
  const Scene* scene = nullptr;
  const Mesh* mesh = nullptr;
  long edges = 0;               // of the mesh
  std::vector<double> volume;   // [m^3] dual, mesh numbering
  Order order;                  // of nodes and edges in memory, with the edges' and corners' area vectors
  Aligned<double> X;            // {X, 1/Omega} a row
  Aligned<double> step_length;  // [m] a row: dt = cfl min l/c
  Aligned<double> lambda;       // weights of the pseudo-Laplacian, jst only
  Boundary boundary;
  Mixture mixture;                            // several materials only
  Tets tets;                                  // empty where nobody looks at them
  TetRings rings;                             // current areas only
  ProjectionSetup projection;                 // pFp only
  Manufactured manufactured;                  // its body force; empty in all other scenes
  PartFunctions functions, lagged_functions;  // of a stage; of one that takes the flux correction of the stage before
  Coefficients coefficients;                  // without those of a stage
};

/// Everything of it, in one place; `setup` takes the times.
Domain make_domain(const Scene& scene, const Mesh& mesh, Clock& setup);

/// Undeformed density of a row [kg/m^3], and its mass [kg].
inline double density(const Domain& d, int n) {
  return d.mixture.empty() ? d.coefficients.material.rho : d.mixture.rho[static_cast<std::size_t>(n)];
}
/// Modulus of the energy of the tets at a row [Pa].
inline double tet_stiffness_at(const Domain& d, int n) {
  return d.mixture.empty() ? d.coefficients.material.tet_stiffness
                           : mean_at(d.mixture, n, &MaterialConstants::tet_stiffness);
}
inline double mass(const Domain& d, int n) { return density(d, n) / d.X[static_cast<std::size_t>(row::X * n + 3)]; }

inline bool is_padding(const Domain& d, int n) { return d.order.node_of[static_cast<std::size_t>(n)] < 0; }

/// Nodes of a part, without the padding at its end; with several materials there is padding inside too.
inline int nodes_of(const Domain& d, const Part& part) {
  int end = part.node_end;
  while (end > part.node_begin && is_padding(d, end - 1)) --end;
  return end - part.node_begin;
}

inline bool has_gravity(const Domain& d) { return d.scene->body_force != Vec3{}; }
inline bool has_forces_on_nodes(const Domain& d) { return has_gravity(d) || !d.manufactured.waves.empty(); }

/// Neither loads nor supports.
inline bool nothing_acts(const Domain& d) {
  return d.boundary.constraints.empty() && d.boundary.loaded.empty() && !has_forces_on_nodes(d);
}

std::size_t bytes_of(const Domain& d);

}  // namespace nanson
