// Several materials in one mesh: which nodes see which laws, and what a node on an interface makes of them (method, section 15).
#pragma once
#include <vector>

#include "engine/mesh/mesh.hpp"
#include "engine/order.hpp"
#include "engine/registry.hpp"
#include "kernels/part.hpp"

namespace nanson {

/// The materials around every mesh node. Nodes with the same ones form a group; group r < materials is that of material r alone, the others are interfaces.
struct NodeMaterials {
  int materials = 1;
  std::vector<double>
      volume;  // [m^3] Omega_a,r of the node's dual cell in material r, `materials` a node; empty with one material
  std::vector<int> group;                // a node; empty with one material
  std::vector<std::vector<int>> groups;  // materials of each group, growing
};
NodeMaterials node_materials(const Scene& scene, const Mesh& mesh);

/// Index into Scene::materials of every region of the mesh, -1 where no [[material]] names it.
std::vector<int> material_of_regions(const Scene& scene, const Mesh& mesh);

/// Rows of one part and one group: the law's kernels run over whole runs, whose rows are padded to multiples of 8.
struct MaterialRun {
  int begin = 0, end = 0, nodes = 0;  // rows, `nodes` of them no padding
  int group = 0;
};

struct MaterialLaw {
  MaterialConstants constants;
  double rho_cp = 0, rho_cs = 0, rho_cJ = 0;  // [kg/(m^2 s)]
  PartFunctions functions;                    // stress, strain_energy
  bool has_state = false;
  std::ptrdiff_t states = 0;  // where the rows of its plastic states begin: laws that share nodes have rows apart
};

/// Empty with one material.
struct Mixture {
  std::vector<MaterialLaw> laws;
  std::vector<std::vector<int>> groups;
  std::vector<MaterialRun> runs;
  std::vector<int> first_run;          // of every part, one more entry than parts
  std::vector<int> group;              // a row
  std::vector<Aligned<double>> share;  // [-] a law: Omega_a,r / Omega_a a row
  int state_sets = 1;                  // of plastic states: as many as laws have one, where these meet at a node
  Aligned<double> rho;                 // [kg/m^3] a row: sum_r Omega_a,r rho_r / Omega_a, so that the mass is exact

  bool empty() const { return laws.empty(); }
};

/// Modulus of the energy of the tets at every mesh node, mean of the materials around it [Pa]; empty where there is none.
std::vector<double> tet_stiffness_of_nodes(const Scene& scene, const NodeMaterials& nodes, std::size_t count);

/// Also the impedances of the edges of `order`, and `step_length` of nodes whose edges stabilise faster than their own waves run.
Mixture make_mixture(const Scene& scene, const NodeMaterials& nodes, Order& order, Aligned<double>& step_length);

/// Doubles that mixed_stress and mixed_energy need for a part of so many rows.
constexpr std::size_t mixture_scratch(int rows) {
  return static_cast<std::size_t>(row::PH + row::W + row::X) * static_cast<std::size_t>(rows);
}

/// Stress sweep over rows of one group: on an interface P, H and Sigma_J are the volume-weighted means of the laws, each at the node's F, H, J.
PartReport mixed_stress(const Mixture& mixture, const MaterialRun& run, const Rows& rows, const Coefficients& k,
                        const double* step_length, double* scratch);

/// Volume-weighted means over the laws, a row; empty with one material.
Aligned<double> means_of_rows(const Mixture& mixture, double (*value)(const MaterialLaw&));

/// Mean of the laws' equivalent plastic strains at a row by volume [-]; of one material its own.
double plastic_strain(const Mixture& mixture, const Aligned<double>& plastic, int row);

/// Mean of a constant of the materials at a row by volume.
double mean_at(const Mixture& mixture, int row, double MaterialConstants::*constant);

/// Sum of Omega_a,r psi_r(F, H, J) [J].
double mixed_energy(const Mixture& mixture, const MaterialRun& run, const Rows& rows, const Coefficients& k);

std::size_t mixture_bytes(const Mixture& mixture, const Order& order);

}  // namespace nanson
