// The plain loop that tests trust and benches compare with: serial, scalar, edge scatter, four passes a stage, no prefetch, the node order of the engine.
// Written from the formulas of the paper and of the method (kernels/README.md), not from kernels/; only the material laws are shared, which have unit tests of their own.
#pragma once
#include <array>
#include <vector>

#include "engine/solver.hpp"
#include "kernels/materials/hencky_j2.hpp"

namespace nanson {

inline double dot(const double* p, const double* q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }

inline double determinant_of(const double (&F)[3][3]) {
  return F[0][0] * (F[1][1] * F[2][2] - F[1][2] * F[2][1]) - F[0][1] * (F[1][0] * F[2][2] - F[1][2] * F[2][0])
         + F[0][2] * (F[1][0] * F[2][1] - F[1][1] * F[2][0]);
}

struct NaiveNode {
  double v[3];  // [m/s]
  double J;
  double F[3][3];  // F[i][I]
  double x[3];     // [m]
};
struct NaiveStress {
  double P[3][3], H[3][3];  // [Pa], [-]; current areas: the Cauchy stress in place of H
};
struct NaiveEdge {
  int a, b;
  double C[3], size;  // [m^2] from a to b, |C|
};
struct NaiveCorner {
  int a, b, c;
  double C[3];  // [m^2] outward, a third of the face
};

template <int rows, int columns>
using Table = std::array<std::array<double, columns>, rows>;

/// One of the materials: what part of every node's volume it has, and its plastic state at t^n.
struct NaiveLaw {
  MaterialSpec spec;
  MaterialConstants constants;
  std::vector<double> share;                  // [-]
  std::vector<PlasticState<double>> plastic;  // hencky_j2
};

struct NaiveLoop {
  const Scene* scene = nullptr;
  std::vector<NaiveLaw> laws;
  std::vector<double> rho;                     // [kg/m^3] mean of the materials by volume
  std::vector<double> rho_cp, rho_cs, rho_cJ;  // [kg/(m^2 s)] likewise; an edge takes the mean of its nodes
  std::vector<int> row;                        // node -> row of the simulation that it was made from
  std::vector<Vec3> X;                         // [m]
  std::vector<double> volume, step_length;     // [m^3], [m]
  std::vector<NaiveEdge> edges;                // each once, sorted by (a, b)
  std::vector<NaiveCorner> corners;
  std::vector<Constraint> constraints;  // node numbers are those of this loop
  std::vector<LoadedFace> loaded;

  std::vector<NaiveNode> now, stage;        // U^n, and the state of a stage
  std::vector<Table<3, 3>> H_now, H_stage;  // pFHJ
  std::vector<std::array<double, 4>> W;     // {v, Sigma_J}; {v, J} for jst
  std::vector<NaiveStress> stress;
  std::vector<Table<4, 3>> G;            // grad of {v, Sigma_J}
  std::vector<Table<9, 3>> GP;           // grad of P, tensor jump or full correction
  std::vector<double> q;                 // [Pa] of Sigma_J, one an edge, pressure correction
  std::vector<Table<3, 3>> dP;           // correction of the stress [Pa], full correction
  std::vector<Table<3, 3>> dG;           // correction of the velocity gradient [m^3/s], flux correction
  std::vector<std::array<double, 4>> L;  // limiter of W; its pseudo-Laplacian for jst
  std::vector<std::array<int, 4>> tets;
  std::vector<double> springs;               // [N/m] of every edge, tet_stiffness
  std::vector<Vec3> crushing;                // [N] of crushed tets, tet_barrier
  std::vector<NaiveEdge> current_edges;      // the same edges with c in C
  std::vector<Vec3> current_corners;         // [m^2]
  std::vector<Table<3, 3>> grad_x, H_x;      // pseudo_updated
  std::vector<double> dJ;                    // [1/s] of the dual cells' motion
  std::vector<Vec3> lambda;                  // [1/m] jst
  std::vector<std::array<double, 4>> force;  // {force [N], J source [m^3/s]}
  double t = 0;                              // [s]
  bool has_lagged = false,
       takes_lagged =
           false;     // dG, q and dP (within P) of the last stage, for the first of the next step; taken in this stage
  PartReport report;  // of the present state
};

/// The same state, geometry, supports and loads as a simulation before its first step.
NaiveLoop make_naive_loop(const Simulation& s);

/// Stress and what is swept, of all nodes; `commits` keeps what flows plastically.
void naive_material(NaiveLoop& n, const std::vector<NaiveNode>& nodes, const std::vector<Table<3, 3>>& H, bool commits);

/// Current areas of the positions U, and the rate of J by the motion of the dual cells; adjoint boundary flux with them.
void current_geometry_pass(NaiveLoop& n, const std::vector<NaiveNode>& U);
void current_boundary_flux(NaiveLoop& n);

/// Forces of the springs between nodes; forces of crushed tets at the positions U, with what they add to the nodal stress.
void spring_pass(NaiveLoop& n, const std::vector<NaiveNode>& U);
void crushing_pass(NaiveLoop& n, const std::vector<NaiveNode>& U);
void find_springs(NaiveLoop& n);

/// Stage `number` of a step of size dt from n.t: the first writes n.stage, the last n.now; then the stress of what was written.
void naive_stage(NaiveLoop& n, int number, double dt);

/// One step of the scene's integrator.
void naive_advance(NaiveLoop& n, double dt);

/// Power that the stabilisation takes out of the present state's edges [W].
double naive_dissipation(NaiveLoop& n);

/// Largest difference to the rows {U, W, PH} over v, J, F, x, H, Sigma_J (or what is swept in its place) and P, each relative to the largest value of its field; stresses,
/// whose round-off is that of kappa (J - 1), to no less than kappa/10. Or to a simulation.
double largest_difference(const NaiveLoop& n, const std::vector<NaiveNode>& nodes, const double* U, const double* W,
                          const double* PH);
double largest_difference(const NaiveLoop& n, const Simulation& s);

}  // namespace nanson
