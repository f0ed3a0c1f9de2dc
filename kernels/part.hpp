// What a part function sees: a part's nodes, edges and boundary corners, the nodal rows, and the coefficients of a stage.
#pragma once
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "kernels/materials/material.hpp"

namespace nanson {

/// Doubles in a row of each role. Rows are 32-byte multiples, arrays 64-byte aligned.
namespace row {
inline constexpr std::ptrdiff_t U =
    16;  // {v, J | columns of F, each with a component of x}; pFp: the pressure in place of J
inline constexpr std::ptrdiff_t H = 12;  // {columns of H, 0}, pFHJ only
inline constexpr std::ptrdiff_t W = 4;   // {v, Sigma_J}: what is reconstructed and swept
inline constexpr std::ptrdiff_t PH =
    24;  // per column I: {P_iI, 0 | H_iI, u_I}; current areas: {P_iI, 0 | sigma_iI, u_I}; displacement u: tet_stiffness only
inline constexpr std::ptrdiff_t G = 12;   // per direction I: d{v, Sigma_J}/dX_I
inline constexpr std::ptrdiff_t dP = 12;  // {columns of dP, 0}: what the full flux correction adds to the nodal stress
inline constexpr std::ptrdiff_t GP = 36;  // per direction K, column I: dP_iI/dX_K, tensor pressure jump only
inline constexpr std::ptrdiff_t L = 4;    // limiter of {v, Sigma_J} (limited), or pseudo-Laplacian of {v, J} (jst)
inline constexpr std::ptrdiff_t x = 4;    // {x, 0}, current areas only
inline constexpr std::ptrdiff_t X = 4;    // {X, 1/Omega}
inline constexpr std::ptrdiff_t lambda = 4;   // {lambda, 0}: makes the pseudo-Laplacian vanish on linear fields (jst)
inline constexpr std::ptrdiff_t plastic = 8;  // {C_p^-1 11 22 33, eps_p | 12 23 31, 0} (hencky_j2)
}  // namespace row

/// How far ahead of a loop rows and arrays are asked for (measured). Neighbours are looked up in the edge arrays to find their rows: these arrays go on for
/// `padding` entries past the last edge.
namespace ahead {
inline constexpr int nodes = 40;         // rows of the part's own nodes
inline constexpr int wide_rows = 40;     // edges; rows of three lines
inline constexpr int rows = 60;          // edges
inline constexpr int single_rows = 100;  // edges; a line, or a part of one, and little work an edge
inline constexpr int swept_rows = 200;   // edges; W of the gradient sweep
inline constexpr int blocks = 64;        // edges; matrices of the edges themselves
inline constexpr int arrays = 256;       // entries of the edge arrays
inline constexpr int rings = 512;        // entries of the tets around edges
inline constexpr std::size_t padding = 512;
}  // namespace ahead
static_assert(ahead::arrays + ahead::swept_rows <= ahead::padding);  // the furthest look-up

/// Edges as structure of arrays, grouped by part, sorted by their first node a, which the part owns; an edge between two parts stands in both.
struct EdgeArrays {
  const std::int32_t* a;           // row of the owned node
  const std::int32_t* b;           // row of the other node
  const double* C[3];              // [m^2] area vector from a to b
  const double* c[3] = {};         // [m^2] current area vector from a to b, current areas only
  const double* rho_cp = nullptr;  // [kg/(m^2 s)] impedances, several materials only
  const double* rho_cs = nullptr;
  const double* rho_cJ = nullptr;
  const double* stiffness = nullptr;  // [N/m] springs between the nodes, physics.tet_stiffness only
};

/// |C| [m^2] of an edge, and of eight.
NANSON_INLINE double edge_size(const EdgeArrays& edges, std::ptrdiff_t e) {
  const double C0 = edges.C[0][e], C1 = edges.C[1][e], C2 = edges.C[2][e];
  return root(fma(C2, C2, fma(C1, C1, C0 * C0)));
}
NANSON_INLINE Vec8 edge_sizes(const EdgeArrays& edges, std::ptrdiff_t e) {
  const Vec8 C0 = load8_anywhere(edges.C[0] + e), C1 = load8_anywhere(edges.C[1] + e),
             C2 = load8_anywhere(edges.C[2] + e);
  return root(fma(C2, C2, fma(C1, C1, C0 * C0)));
}

/// Sense of a half-edge: the area vector from its node is that of the edge, or the opposite.
using Outward = std::integral_constant<int, 1>;
using Inward = std::integral_constant<int, -1>;
template <class Sense>
constexpr auto opposite(Sense) {
  return std::integral_constant<int, -Sense::value>();
}
template <class Sense, class Real>
NANSON_INLINE Real add_product(Sense, Real a, Real b, Real sum) {
  if constexpr (Sense::value > 0) return fma(a, b, sum);
  else return fnma(a, b, sum);
}

/// Boundary corners (a; b, c): a third of a boundary face, in rows by owning node a.
struct CornerArrays {
  const std::int32_t* b;
  const std::int32_t* c;
  const double* C[3];        // [m^2] outward, a third of the face
  const std::int32_t* load;  // index into the loads of the stage, -1 without
  const double* c_gamma[3] =
      {};  // [m^2] current area vector, current areas only; and the same face's corners at b and c
  const std::int32_t* at_b = nullptr;
  const std::int32_t* at_c = nullptr;
};

/// Per node: where its out-edges, in-edges (owned edges that end in it) and corners begin; one more entry than nodes.
struct NodeLists {
  const std::int32_t* out;
  const std::int32_t* in;
  const std::int32_t* in_edges;  // edge numbers ...
  const std::int32_t*
      in_nodes;  // ... and their first nodes a: looked up through the edge, they would wait for each other
  const std::int32_t* corner;
};

struct Part {
  std::int32_t node_begin, node_end;  // rows; a multiple of 8, padded with nodes that have no edges
  std::int32_t edge_begin, edge_end;
  std::int32_t corner_begin, corner_end;
  std::int32_t constraint_begin, constraint_end;
};

/// The rows of a stage: what is read first, what is written last.
struct Rows {
  const double* X;
  const double* U_old;    // state at the start of the step
  const double* U_stage;  // state whose rates are taken
  const double* H_old;
  const double* H_stage;
  const double* W;   // of the stage
  const double* PH;  // of the stage
  double* G;
  double* dP;
  double* GP;
  double* L;
  const double* lambda;
  const double* rho;              // [kg/m^3] a node, several materials only
  const double* loads;            // [N] 4 a loaded face: the force on each of its corners
  const double* force = nullptr;  // [N] {f, 0} a node: what acts on nodes from outside; null without such forces
  double* U_new;
  double* H_new;
  double* W_new;
  double* PH_new;
  const double* plastic;  // at the start of the step ...
  double* plastic_new;    // ... and where a stage that commits leaves it: the same rows
  double* lagged_dG =
      nullptr;  // row::U a node, flux correction only: {columns of dG, 0}, in the rows that the next step's first stage overwrites
  double* lagged_q = nullptr;        // [Pa] q of Sigma_J an edge, pressure correction only
  double* dJ = nullptr;              // [1/s] rate of J by the motion of the dual cell, one a node, current areas only
  double* detF = nullptr;            // [-] of the new state, one a node, physics.tet_barrier only
  const double* crushing = nullptr;  // [N] row of 4 {force of crushed tets, 0} a node; none where no tet is crushed
};

/// Directions in which a node is held, orthonormal, with what prescribes the acceleration along each.
struct Constraint {
  std::int32_t node = 0;
  std::int32_t count = 0;
  double d[3][3] = {};
  std::int32_t face[3] = {};       // index of the named face that holds the direction
  std::int32_t source[3][3] = {};  // boundary conditions whose prescribed velocities enter direction k ...
  double weight[3][3] = {};        // ... with these weights (0: none)
};

inline constexpr int reaction_row = 4;  // per constraint: force of the support along each direction [N], its power [W]

/// What an edge loop computes, asked once a block of eight edges. What it loads is a type (edge_flux_part).
struct EdgeChoices {
  bool evolves_J = true;        // D^J
  bool deformed_metric = true;  // c_p max(1, |H N|), else c_p; for the step bound too
  bool entropy_fix = false;     // these two of loops with plain jumps only
  bool audits = false;          // returns the power of the stabilisation
  bool adds_pressure = false;   // q of Sigma_J, found by this loop or lagged (pressure correction)
};

/// Constants of a scene and of a stage.
struct Coefficients {
  MaterialConstants material;
  double rho_cp = 0, rho_cs = 0, rho_cJ = 0;  // [kg/(m^2 s)] impedances
  double theta = 2.0 / 3;                     // [-] flux correction
  bool adjoint = true;                        // boundary flux
  EdgeChoices edge;
  bool current_areas = false;  // rows of the Cauchy stress in place of H
  bool sweeps_J = false;       // W is {v, J} in place of {v, Sigma_J} (jst)
  double old_weight = 0, stage_weight = 1,
         dt = 0;         // U_new = old_weight U_old + stage_weight U_stage + dt dU/dt; dt [s]
  bool streams = false;  // the mesh is larger than the caches: rows that only other sweeps read are written past them
  bool takes_lagged =
      false;  // the flux correction is that of the step before's last stage: dG from Rows::lagged_dG and q from lagged_q, dP stands in PH already
  bool leaves_lagged = false;  // the next step's first stage takes the flux correction of this one
  bool commits = false;        // the stress of this stage is that of the new state: what flowed plastically is kept
  const double* acceleration = nullptr;  // [m/s^2] per boundary condition: rate of its time factor over the step
};

/// Part-local buffers of one thread.
struct Scratch {
  double*
      edge;  // row of 4 {flux, D^J} an edge, of 8 where a flux correction is found: {q, 0} too; eight rows more are overwritten
  double* corner;            // row of 4 {force, 0} a boundary corner
  double* force;             // row of 4 {force, J source} a node
  double* dG;                // row of 12 a node, where a flux correction is found
  double* motion = nullptr;  // [m^3/s] (v_b - v_a) . c an edge, current areas only; eight more are overwritten
};

/// What a part reports after its update: never checked inside, the step decides.
struct PartReport {
  double fastest = 0;       // [1/s] largest c/l over the nodes; dt = cfl/fastest
  bool broken = false;      // some node with !(det F > 0), !(J > 0) where carried, or v not finite
  double plastic_work = 0;  // [J] of what was committed (hencky_j2)
};

/// What the gradient sweep adds to row L of a node.
enum class NodeWeights { none, limiter, laplacian };

/// What fluxes multiply stresses with: the undeformed area vectors C, P and H; or the current ones c and the Cauchy stress.
enum class Areas { undeformed, current };

/// What an update does about the flux correction of the velocity gradient: there is none | it takes that of the last stage | it finds it.
enum class GradientCorrection { none, lagged, found };

// The part functions; which of them a scene uses is picked once, in engine/registry.cpp. Definitions stand in the file named after each.
template <bool tensor_jump, bool full_correction, NodeWeights>
void gradient_part(const Part&, const EdgeArrays&, const CornerArrays&, const NodeLists&, const Rows&,
                   const Coefficients&);

/// The edge loops return the power that the stabilisation takes out of the edges that the part counts [W], where they audit, else 0 (jst: always).
/// The types are what is loaded: gradients and limiters, what the flux correction finds in them, rows of P, nodal jumps beside the reconstructed ones, area vectors.
template <Reconstruction, FluxCorrection found, PressureJump, bool plain_jumps, Areas>
double edge_flux_part(const Part&, const EdgeArrays&, const CornerArrays&, const NodeLists&, const Rows&,
                      const Coefficients&, const Scratch&);

template <Formulation, GradientCorrection>
void accumulate_update_part(const Part&, const EdgeArrays&, const NodeLists&, const Rows&, const Coefficients&,
                            const Constraint*, double* reactions, const Scratch&);

template <Law, Volumetric, Isochoric, Formulation>
PartReport stress_part(const Part&, const Rows&, const Coefficients&, const double* step_length);

template <Law>
PartReport projected_stress_part(const Part&, const Rows&, const Coefficients&, const double* step_length);

/// Strain energy of a part's nodes in U_stage, H_stage [J].
template <Law, Volumetric, Isochoric, Formulation>
double strain_energy_part(const Part&, const Rows&, const Coefficients&);
template <Law>
double projected_energy_part(const Part&, const Rows&, const Coefficients&);

}  // namespace nanson
