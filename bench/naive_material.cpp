// The material pass of the plain loop: the engine's laws, a node at a time.
#include <stdexcept>

#include "bench/naive_loop.hpp"
#include "kernels/materials/linear_elastic.hpp"
#include "kernels/materials/mooney_rivlin.hpp"
#include "kernels/materials/neo_hookean.hpp"
#include "kernels/parting.hpp"

namespace nanson {
namespace {

template <Law law, Volumetric volumetric, Isochoric isochoric, Formulation formulation>
void material_pass(NaiveLoop& n, const std::vector<NaiveNode>& nodes, const std::vector<Table<3, 3>>& H_of) {
  const MaterialConstants& m = n.material;
  const bool deformed = n.scene->physics.upwind_metric == UpwindMetric::deformed,
             jst = n.scene->physics.stabilisation == Stabilisation::jst;
  n.report = {};
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    const NaiveNode& U = nodes[a];
    Tensor<double> F, H{};
    for (int k = 0; k < 9; ++k) F[k / 3][k % 3] = U.F[k / 3][k % 3];
    if (formulation == Formulation::pFHJ)
      for (int k = 0; k < 9; ++k) H[k / 3][k % 3] = H_of[a][k / 3][k % 3];
    Stress<double> s = Material<law, volumetric, isochoric, formulation>::stress(F, H, U.J, m);
    if (n.scene->physics.parting > 0) add_parting(s, F, U.J, m.parting);
    for (int k = 0; k < 9; ++k) {
      n.stress[a].P[k / 3][k % 3] = s.P[k / 3][k % 3];
      n.stress[a].H[k / 3][k % 3] = s.H[k / 3][k % 3];
    }
    for (int k = 0; k < 9 && !n.dJ.empty(); ++k)
      n.stress[a].H[k / 3][k % 3] = dot(n.stress[a].P[k / 3], U.F[k % 3]) / U.J;
    n.W[a] = {U.v[0], U.v[1], U.v[2], !jst ? s.Sigma_J : formulation == Formulation::pF ? s.detF : U.J};
    double c = std::sqrt(s.rho_c2 / m.rho);
    if (formulation != Formulation::pF && law != Law::linear_elastic)
      c = std::max(c, s.d2U / (m.rho * m.cp) * (deformed ? std::sqrt(s.H2) : s.H2));
    n.report.fastest = std::max(n.report.fastest, c / n.step_length[a]);
    if (!(s.detF > 0) || !std::isfinite(dot(U.v, U.v)) || (formulation != Formulation::pF && !(U.J > 0)))
      n.report.broken = true;
  }
}

template <Law law, Volumetric volumetric, Isochoric isochoric>
void material_of_formulation(NaiveLoop& n, const std::vector<NaiveNode>& nodes, const std::vector<Table<3, 3>>& H) {
  switch (n.scene->physics.formulation) {
    case Formulation::pF: return material_pass<law, volumetric, Isochoric::F, Formulation::pF>(n, nodes, H);
    case Formulation::pFJ: return material_pass<law, volumetric, isochoric, Formulation::pFJ>(n, nodes, H);
    case Formulation::pFHJ: return material_pass<law, volumetric, isochoric, Formulation::pFHJ>(n, nodes, H);
    case Formulation::pFp: throw std::invalid_argument("the plain loop has no projection");
  }
}

template <Law law>
void material_of_law(NaiveLoop& n, const std::vector<NaiveNode>& nodes, const std::vector<Table<3, 3>>& H) {
  const MaterialSpec& m = n.scene->material;
  if (m.volumetric == Volumetric::quadratic && m.isochoric == Isochoric::F)
    material_of_formulation<law, Volumetric::quadratic, Isochoric::F>(n, nodes, H);
  else if (m.volumetric == Volumetric::quadratic)
    material_of_formulation<law, Volumetric::quadratic, Isochoric::J>(n, nodes, H);
  else if (m.isochoric == Isochoric::F) material_of_formulation<law, Volumetric::barrier, Isochoric::F>(n, nodes, H);
  else material_of_formulation<law, Volumetric::barrier, Isochoric::J>(n, nodes, H);
}

}  // namespace

void naive_material(NaiveLoop& n, const std::vector<NaiveNode>& nodes, const std::vector<Table<3, 3>>& H) {
  switch (n.scene->material.law) {
    case Law::linear_elastic:
      return material_of_formulation<Law::linear_elastic, Volumetric::quadratic, Isochoric::F>(n, nodes, H);
    case Law::neo_hookean: return material_of_law<Law::neo_hookean>(n, nodes, H);
    case Law::mooney_rivlin: return material_of_law<Law::mooney_rivlin>(n, nodes, H);
    case Law::hencky_j2: throw std::invalid_argument("the plain loop has no plasticity");
  }
}

}  // namespace nanson
