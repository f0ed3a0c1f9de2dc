// The material pass of the plain loop: the engine's laws, a node at a time; where several materials meet, the mean of theirs by volume.
#include <stdexcept>

#include "bench/naive_loop.hpp"
#include "kernels/materials/linear_elastic.hpp"
#include "kernels/materials/mooney_rivlin.hpp"
#include "kernels/materials/neo_hookean.hpp"
#include "kernels/parting.hpp"

namespace nanson {
namespace {

/// The law's stress at a node; a law with a state returns from that of t^n, and keeps what flows where the stage commits.
template <Law law, Volumetric volumetric, Isochoric isochoric, Formulation formulation>
Stress<double> stress_of(NaiveLaw& of, std::size_t a, const Tensor<double>& F, const Tensor<double>& H, double J,
                         bool commits) {
  using Own = Material<law, volumetric, isochoric, formulation>;
  if constexpr (law != Law::hencky_j2) return Own::stress(F, H, J, of.constants);
  else {
    PlasticState<double>& z = of.plastic[a];
    const auto r = Own::return_mapping(F, z, of.constants);
    if (commits) z = Own::flowed(F, z, r);
    return Own::stress(F, H, J, r, of.constants);
  }
}

/// Adds the law's share to stress, Sigma_J, step bound and breakdown of every node that it has a share of.
template <Law law, Volumetric volumetric, Isochoric isochoric, Formulation formulation>
void add_material(NaiveLoop& n, NaiveLaw& of, const std::vector<NaiveNode>& nodes, const std::vector<Table<3, 3>>& H_of,
                  bool commits) {
  const MaterialConstants& m = of.constants;
  const bool deformed = n.scene->physics.upwind_metric == UpwindMetric::deformed,
             jst = n.scene->physics.stabilisation == Stabilisation::jst;
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    const double share = of.share[a];
    if (share == 0) continue;
    const NaiveNode& U = nodes[a];
    Tensor<double> F, H{};
    for (int k = 0; k < 9; ++k) F[k / 3][k % 3] = U.F[k / 3][k % 3];
    if (formulation == Formulation::pFHJ)
      for (int k = 0; k < 9; ++k) H[k / 3][k % 3] = H_of[a][k / 3][k % 3];
    Stress<double> s = stress_of<law, volumetric, isochoric, formulation>(of, a, F, H, U.J, commits);
    if (n.scene->physics.parting > 0) add_parting(s, F, U.J, m.parting);
    const double rest = n.dJ.empty() ? 1 : 0;  // current areas: without the I
    for (int k = 0; k < 9; ++k) s.P[k / 3][k % 3] -= m.tet_stiffness * (F[k / 3][k % 3] - (k % 4 == 0 ? rest : 0));
    for (int k = 0; k < 9; ++k) {
      n.stress[a].P[k / 3][k % 3] += share * s.P[k / 3][k % 3];
      n.stress[a].H[k / 3][k % 3] += share * s.H[k / 3][k % 3];
    }
    n.W[a][3] += share * (!jst ? s.Sigma_J : formulation == Formulation::pF ? s.detF : U.J);
    double c = std::sqrt(s.rho_c2 / m.rho);
    if (formulation != Formulation::pF && law != Law::linear_elastic)
      c = std::max(c, s.d2U / (m.rho * m.cJ) * (deformed ? std::sqrt(s.H2) : s.H2));
    n.report.fastest = std::max(n.report.fastest, c / n.step_length[a]);
    if (!(s.detF > 0) || !std::isfinite(dot(U.v, U.v)) || (formulation != Formulation::pF && !(U.J > 0)))
      n.report.broken = true;
  }
}

template <Law law, Volumetric volumetric, Isochoric isochoric>
void of_formulation(NaiveLoop& n, NaiveLaw& of, const std::vector<NaiveNode>& nodes, const std::vector<Table<3, 3>>& H,
                    bool commits) {
  switch (n.scene->physics.formulation) {
    case Formulation::pF: return add_material<law, volumetric, Isochoric::F, Formulation::pF>(n, of, nodes, H, commits);
    case Formulation::pFJ: return add_material<law, volumetric, isochoric, Formulation::pFJ>(n, of, nodes, H, commits);
    case Formulation::pFHJ:
      return add_material<law, volumetric, isochoric, Formulation::pFHJ>(n, of, nodes, H, commits);
    case Formulation::pFp: throw std::invalid_argument("the plain loop has no projection");
  }
}

template <Law law>
void of_energies(NaiveLoop& n, NaiveLaw& of, const std::vector<NaiveNode>& nodes, const std::vector<Table<3, 3>>& H,
                 bool commits) {
  const MaterialSpec& m = of.spec;
  if (m.volumetric == Volumetric::quadratic && m.isochoric == Isochoric::F)
    of_formulation<law, Volumetric::quadratic, Isochoric::F>(n, of, nodes, H, commits);
  else if (m.volumetric == Volumetric::quadratic)
    of_formulation<law, Volumetric::quadratic, Isochoric::J>(n, of, nodes, H, commits);
  else if (m.isochoric == Isochoric::F)
    of_formulation<law, Volumetric::barrier, Isochoric::F>(n, of, nodes, H, commits);
  else of_formulation<law, Volumetric::barrier, Isochoric::J>(n, of, nodes, H, commits);
}

}  // namespace

void naive_material(NaiveLoop& n, const std::vector<NaiveNode>& nodes, const std::vector<Table<3, 3>>& H,
                    bool commits) {
  n.report = {};
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    n.stress[a] = {};
    n.W[a] = {nodes[a].v[0], nodes[a].v[1], nodes[a].v[2], 0.0};
  }
  for (NaiveLaw& of : n.laws) {
    switch (of.spec.law) {
      case Law::linear_elastic:
        of_formulation<Law::linear_elastic, Volumetric::quadratic, Isochoric::F>(n, of, nodes, H, commits);
        break;
      case Law::neo_hookean: of_energies<Law::neo_hookean>(n, of, nodes, H, commits); break;
      case Law::mooney_rivlin: of_energies<Law::mooney_rivlin>(n, of, nodes, H, commits); break;
      case Law::hencky_j2:
        of_formulation<Law::hencky_j2, Volumetric::quadratic, Isochoric::F>(n, of, nodes, H, commits);
        break;
    }
  }
  if (n.dJ.empty()) return;
  for (std::size_t a = 0; a < nodes.size(); ++a) {  // the Cauchy stress P F^T/J in place of H
    const NaiveNode& U = nodes[a];
    const double J = n.scene->physics.formulation == Formulation::pF ? determinant_of(U.F) : U.J;
    for (int k = 0; k < 9; ++k) n.stress[a].H[k / 3][k % 3] = dot(n.stress[a].P[k / 3], U.F[k % 3]) / J;
  }
}

}  // namespace nanson
