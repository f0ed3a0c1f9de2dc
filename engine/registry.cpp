// Every combination named here is compiled by cmake/PartInstances.cmake, the common ones each in a translation unit of its own.
#include "engine/registry.hpp"

#include <algorithm>
#include <stdexcept>

#include "engine/choices.hpp"
#include "kernels/jst.hpp"
#include "kernels/materials/hencky_j2.hpp"
#include "kernels/materials/linear_elastic.hpp"
#include "kernels/materials/mooney_rivlin.hpp"
#include "kernels/materials/neo_hookean.hpp"

namespace nanson {
namespace {

/// What the edge loop finds: nothing of a correction that is lagged, which stands in P already (full) or on the edges (pressure).
FluxCorrection found_by_edges(const PhysicsSpec& p, bool takes_lagged) {
  return takes_lagged ? FluxCorrection::none : p.flux_correction;
}

NodeWeights node_weights(const PhysicsSpec& p) {
  if (p.stabilisation == Stabilisation::jst) return NodeWeights::laplacian;
  return p.reconstruction == Reconstruction::limited ? NodeWeights::limiter : NodeWeights::none;
}

template <bool tensor, bool full>
void find_gradient(PartFunctions& f, NodeWeights weights) {
  if (weights == NodeWeights::none) f.gradient = gradient_part<tensor, full, NodeWeights::none>;
  if (weights == NodeWeights::limiter) f.gradient = gradient_part<tensor, full, NodeWeights::limiter>;
  if (weights == NodeWeights::laplacian) f.gradient = gradient_part<false, false, NodeWeights::laplacian>;
}

void find_gradient(PartFunctions& f, const PhysicsSpec& p, FluxCorrection found) {
  const bool tensor = p.pressure_jump == PressureJump::tensor && p.reconstruction != Reconstruction::constant;
  f.corrects_stress = found == FluxCorrection::full;
  with(tensor, [&]<bool of_P>() {
    with(f.corrects_stress, [&]<bool full>() { find_gradient<of_P, full>(f, node_weights(p)); });
  });
}

/// What edge loops load: a correction is made of gradients, current areas want the plain jumps and have no rows of P's jump.
template <Reconstruction reconstruction, FluxCorrection found>
void find_upwind(PartFunctions& f, const PhysicsSpec& p, bool plain_jumps) {
  if constexpr (reconstruction != Reconstruction::constant || found == FluxCorrection::none) {
    if (has_current_areas(p.description)) {
      f.edge_flux = edge_flux_part<reconstruction, found, PressureJump::scalar, true, Areas::current>;
      return;
    }
    with(p.pressure_jump, [&]<PressureJump jump>() {
      with(plain_jumps,
           [&]<bool plain>() { f.edge_flux = edge_flux_part<reconstruction, found, jump, plain, Areas::undeformed>; });
    });
  }
}

void find_sweeps(PartFunctions& f, const PhysicsSpec& p, bool audits, bool takes_lagged) {
  const FluxCorrection correction = found_by_edges(p, takes_lagged);
  find_gradient(f, p, correction);
  if (p.stabilisation == Stabilisation::jst) {
    f.edge_flux = edge_flux_jst_part;
  } else {
    with(p.reconstruction, [&]<Reconstruction reconstruction>() {
      with(correction, [&]<FluxCorrection found>() {
        find_upwind<reconstruction, found>(f, p, audits || p.entropy_fix != EntropyFix::none);
      });
    });
  }
  const bool corrected = p.flux_correction != FluxCorrection::none;
  with(p.formulation == Formulation::pFp ? Formulation::pF : p.formulation,
       [&]<Formulation formulation>() {  // the projection follows the update
         if constexpr (formulation != Formulation::pFp)
           f.accumulate_update = !corrected     ? accumulate_update_part<formulation, GradientCorrection::none>
                                 : takes_lagged ? accumulate_update_part<formulation, GradientCorrection::lagged>
                                                : accumulate_update_part<formulation, GradientCorrection::found>;
       });
}

/// Of {p, F, p}: the isochoric part alone.
template <Law law, Volumetric volumetric, Isochoric isochoric>
constexpr bool is_projected_material = volumetric == Volumetric::quadratic&& isochoric == Isochoric::F
                                       && !Material<law, volumetric, isochoric, Formulation::pF>::traits.carries_energy;

void find_material(PartFunctions& f, const PhysicsSpec& p, const MaterialSpec& m) {
  with(m.law, [&]<Law law>() {
    with(m.volumetric, [&]<Volumetric volumetric>() {
      with(m.isochoric, [&]<Isochoric isochoric>() {
        with(p.formulation, [&]<Formulation formulation>() {
          if constexpr (formulation == Formulation::pFp) {
            if constexpr (is_projected_material<law, volumetric, isochoric>) {
              f.stress = projected_stress_part<law>;
              f.strain_energy = projected_energy_part<law>;
            }
          } else if constexpr (is_material<law, volumetric, isochoric, formulation>) {
            f.stress = stress_part<law, volumetric, isochoric, formulation>;
            f.strain_energy = strain_energy_part<law, volumetric, isochoric, formulation>;
          }
        });
      });
    });
  });
}

}  // namespace

LawTraits law_traits(Law choice) {
  LawTraits traits;
  with(choice,
       [&]<Law law>() { traits = Material<law, Volumetric::quadratic, Isochoric::F, Formulation::pFJ>::traits; });
  return traits;
}

bool has_plasticity(const Scene& s) {
  return std::ranges::any_of(materials_of(s), [](const MaterialSpec& m) { return law_traits(m.law).has_state; });
}

EdgeChoices edge_choices(const PhysicsSpec& p, bool audits) {
  return {evolves_J(p.formulation), p.upwind_metric == UpwindMetric::deformed, p.entropy_fix == EntropyFix::edge,
          audits, p.flux_correction == FluxCorrection::pressure};
}

PartFunctions find_part_functions(const PhysicsSpec& physics, const MaterialSpec& material, bool audits,
                                  bool takes_lagged) {
  PartFunctions f;
  find_sweeps(f, physics, audits, takes_lagged);
  find_material(f, physics, material);
  if (!f.edge_flux || !f.stress)
    throw std::logic_error("a combination that engine/physics_rules allows is not compiled");
  return f;
}

}  // namespace nanson
