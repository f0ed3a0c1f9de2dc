// Every combination named here is compiled in a translation unit of its own (CMakeLists.txt, engine/instance.cpp.in): many in one file made slower code.
#include "engine/registry.hpp"

#include <stdexcept>

namespace nanson {
namespace {

/// Calls use.template operator()<value>() for the value of a choice.
template <class Choice, std::size_t at = 0, class Use>
auto with(Choice choice, Use use) {
  constexpr std::size_t count = words(Choice{}).size();
  if constexpr (at + 1 < count)
    if (static_cast<std::size_t>(choice) != at) return with<Choice, at + 1>(choice, use);
  return use.template operator()<static_cast<Choice>(at)>();
}

NodeWeights node_weights(const PhysicsSpec& p) {
  if (p.stabilisation == Stabilisation::jst) return NodeWeights::laplacian;
  return p.reconstruction == Reconstruction::limited ? NodeWeights::limiter : NodeWeights::none;
}

/// What is compiled: a correction needs gradients, and the rare options do not multiply with each other.
constexpr bool is_built(Reconstruction r, FluxCorrection c, PressureJump jump, EntropyFix fix) {
  if (r == Reconstruction::constant && c != FluxCorrection::none) return false;
  return jump == PressureJump::scalar || (r != Reconstruction::limited && fix == EntropyFix::none);
}

void find_gradient(PartFunctions& f, const PhysicsSpec& p) {
  const bool tensor = p.pressure_jump == PressureJump::tensor && p.reconstruction == Reconstruction::linear, full = p.flux_correction == FluxCorrection::full;
  switch (node_weights(p)) {
    case NodeWeights::none:
      f.gradient = tensor ? (full ? gradient_part<true, true, NodeWeights::none> : gradient_part<true, false, NodeWeights::none>)
                          : (full ? gradient_part<false, true, NodeWeights::none> : gradient_part<false, false, NodeWeights::none>);
      break;
    case NodeWeights::limiter: f.gradient = full ? gradient_part<false, true, NodeWeights::limiter> : gradient_part<false, false, NodeWeights::limiter>; break;
    case NodeWeights::laplacian: f.gradient = gradient_part<false, false, NodeWeights::laplacian>; break;
  }
}

template <Reconstruction reconstruction, PressureJump jump, UpwindMetric metric, EntropyFix fix>
void find_upwind(PartFunctions& f, const PhysicsSpec& p) {
  const bool with_J = evolves_J(p.formulation);
  with(p.flux_correction, [&]<FluxCorrection correction>() {
    if constexpr (is_built(reconstruction, correction, jump, fix)) {
      f.edge_flux = edge_flux_part<reconstruction, correction, true, jump, metric, fix>;
      if constexpr (jump == PressureJump::scalar)
        if (!with_J) f.edge_flux = edge_flux_part<reconstruction, correction, false, jump, metric, fix>;
    }
  });
  if constexpr (is_built(reconstruction, FluxCorrection::none, jump, fix)) {
    f.dissipation = dissipation_part<reconstruction, true, jump, metric, fix>;
    if constexpr (jump == PressureJump::scalar)
      if (!with_J) f.dissipation = dissipation_part<reconstruction, false, jump, metric, fix>;
  }
}

/// Several materials: what a scene needs by default, and its leaner forms.
void find_several(PartFunctions& f, const PhysicsSpec& p) {
  if (!takes_several_materials(p)) return;
  const bool with_J = evolves_J(p.formulation);
  const auto find = [&]<Reconstruction reconstruction, bool J>() {
    f.edge_flux = edge_flux_part<reconstruction, FluxCorrection::none, J, PressureJump::scalar, UpwindMetric::deformed, EntropyFix::none, Materials::several>;
    f.dissipation = dissipation_part<reconstruction, J, PressureJump::scalar, UpwindMetric::deformed, EntropyFix::none, Areas::undeformed, Materials::several>;
  };
  if (p.reconstruction == Reconstruction::linear) with_J ? find.template operator()<Reconstruction::linear, true>() : find.template operator()<Reconstruction::linear, false>();
  else with_J ? find.template operator()<Reconstruction::constant, true>() : find.template operator()<Reconstruction::constant, false>();
  f.accumulate_update = with_J ? accumulate_update_part<Formulation::pFJ, false, Areas::undeformed, Materials::several> : accumulate_update_part<Formulation::pF, false, Areas::undeformed, Materials::several>;
}

/// Current areas: {p,F,J}, upwind, nothing rare (method, section 8).
bool is_built_with_current_areas(const PhysicsSpec& p) {
  return p.formulation == Formulation::pFJ && p.stabilisation == Stabilisation::upwind && p.pressure_jump == PressureJump::scalar &&
         p.reconstruction != Reconstruction::limited && p.flux_correction == FluxCorrection::none && p.boundary_flux == BoundaryFlux::adjoint &&
         p.entropy_fix == EntropyFix::none;
}

void find_sweeps_with_current_areas(PartFunctions& f, const PhysicsSpec& p) {
  find_gradient(f, p);
  with(p.reconstruction, [&]<Reconstruction reconstruction>() {
    with(p.upwind_metric, [&]<UpwindMetric metric>() {
      if constexpr (reconstruction != Reconstruction::limited) {
        f.edge_flux = current_flux_part<reconstruction, metric>;
        f.dissipation = dissipation_part<reconstruction, true, PressureJump::scalar, metric, EntropyFix::none, Areas::current>;
      }
    });
  });
  f.accumulate_update = accumulate_update_part<Formulation::pFJ, false, Areas::current>;
}

void find_sweeps(PartFunctions& f, const PhysicsSpec& p) {
  if (has_current_areas(p.description)) {
    if (is_built_with_current_areas(p)) find_sweeps_with_current_areas(f, p);
    return;
  }
  find_gradient(f, p);
  if (p.stabilisation == Stabilisation::jst) {
    f.edge_flux = evolves_J(p.formulation) ? edge_flux_jst_part<true> : edge_flux_jst_part<false>;
  } else {
    with(p.reconstruction, [&]<Reconstruction reconstruction>() {
      with(p.upwind_metric, [&]<UpwindMetric metric>() {
        with(p.entropy_fix, [&]<EntropyFix fix>() {
          with(p.pressure_jump, [&]<PressureJump jump>() { find_upwind<reconstruction, jump, metric, fix>(f, p); });
        });
      });
    });
  }
  const bool corrected = p.flux_correction != FluxCorrection::none;
  with(p.formulation == Formulation::pFp ? Formulation::pF : p.formulation, [&]<Formulation formulation>() {  // the projection follows the update
    if constexpr (formulation != Formulation::pFp)
      f.accumulate_update = corrected ? accumulate_update_part<formulation, true> : accumulate_update_part<formulation, false>;
  });
}

/// The energy of the parting: where J is evolved beside F, with the volumetric and isochoric energies that laws take by default.
constexpr bool takes_parting(Law law, Volumetric volumetric, Isochoric isochoric, Formulation formulation) {
  return evolves_J(formulation) && law != Law::linear_elastic && volumetric == Volumetric::quadratic && isochoric == Isochoric::F;
}

void find_material(PartFunctions& f, const PhysicsSpec& p, const MaterialSpec& m) {
  const bool current_areas = has_current_areas(p.description), with_parting = p.parting > 0;
  with(m.law, [&]<Law law>() {
    with(m.volumetric, [&]<Volumetric volumetric>() {
      with(m.isochoric, [&]<Isochoric isochoric>() {
        with(p.formulation, [&]<Formulation form>() {
          constexpr bool own_energy = law == Law::linear_elastic || law == Law::hencky_j2;
          if constexpr (form == Formulation::pFp) {
            if constexpr (!own_energy && volumetric == Volumetric::quadratic && isochoric == Isochoric::F)
              if (!with_parting) f.stress = projected_stress_part<law>, f.strain_energy = projected_energy_part<law>;
          } else if constexpr (own_energy && (volumetric != Volumetric::quadratic || isochoric != Isochoric::F)) return;
          else if constexpr (form == Formulation::pF && isochoric != Isochoric::F) return;
          else {
            f.stress = stress_part<law, volumetric, isochoric, form>;
            f.strain_energy = strain_energy_part<law, volumetric, isochoric, form>;
            if (!current_areas && !with_parting) return;
            f.stress = nullptr;
            if (with_parting) {
              if constexpr (takes_parting(law, volumetric, isochoric, form))
                if (!current_areas) {
                  f.stress = stress_part<law, volumetric, isochoric, form, Areas::undeformed, Parting::energy>;
                  f.strain_energy = strain_energy_part<law, volumetric, isochoric, form, Parting::energy>;
                }
              return;
            }
            if constexpr (form == Formulation::pFJ && law != Law::linear_elastic) f.stress = stress_part<law, volumetric, isochoric, form, Areas::current>;
          }
        });
      });
    });
  });
}

}  // namespace

const char* const what_is_built =
    "built: upwind with constant and flux_correction none; upwind with linear or limited and flux_correction none | pressure | full; "
    "pressure_jump tensor not with limited, entropy_fix or pF; jst with linear, flux_correction none, scalar, no entropy_fix; "
    "pFp with upwind, constant or linear, scalar, flux_correction none, no entropy_fix; "
    "description updated and pseudo_updated with pFJ, upwind, constant or linear, scalar, flux_correction none, boundary_flux adjoint, no entropy_fix, not linear_elastic; "
    "several materials with upwind, pF | pFJ, constant | linear, scalar, deformed, flux_correction none, no entropy_fix, keep_angular_momentum false, description total; "
    "parting with pFJ | pFHJ, upwind, scalar, description total, one material, volumetric quadratic, isochoric F, not linear_elastic";

bool takes_several_materials(const PhysicsSpec& p) {
  return p.stabilisation == Stabilisation::upwind && (p.formulation == Formulation::pF || p.formulation == Formulation::pFJ) && p.reconstruction != Reconstruction::limited &&
         p.flux_correction == FluxCorrection::none && p.pressure_jump == PressureJump::scalar && p.upwind_metric == UpwindMetric::deformed && p.entropy_fix == EntropyFix::none &&
         !p.keep_angular_momentum && p.description == Description::total;
}

PartFunctions find_part_functions(const PhysicsSpec& physics, const MaterialSpec& material, Materials materials) {
  PartFunctions f;
  if (materials == Materials::several) find_gradient(f, physics), find_several(f, physics);
  else find_sweeps(f, physics);
  find_material(f, physics, material);
  if (!f.edge_flux)
    throw std::invalid_argument(what_is_built);
  if (!f.stress)
    throw std::invalid_argument("this material is not built: linear_elastic and hencky_j2 take volumetric = \"quadratic\" and isochoric = \"F\"; isochoric = \"J\" needs pFJ or pFHJ; linear_elastic needs description = \"total\"; parting needs pFJ or pFHJ, \"quadratic\", \"F\", \"total\", not linear_elastic");
  return f;
}

}  // namespace nanson
