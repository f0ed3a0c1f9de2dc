// Every combination named here is compiled by cmake/PartInstances.cmake, the common ones each in a translation unit of its own.
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

template <class Use>
void with(bool choice, Use use) {
  choice ? use.template operator()<true>() : use.template operator()<false>();
}
template <class Use>
void with(EdgeCorrection choice, Use use) {
  switch (choice) {
    case EdgeCorrection::none: return use.template operator()<EdgeCorrection::none>();
    case EdgeCorrection::finds_pressure: return use.template operator()<EdgeCorrection::finds_pressure>();
    case EdgeCorrection::finds_full: return use.template operator()<EdgeCorrection::finds_full>();
    case EdgeCorrection::takes_pressure: return use.template operator()<EdgeCorrection::takes_pressure>();
  }
}

/// Of a full correction, the stress that is lagged stands in P already.
EdgeCorrection edge_correction(const PhysicsSpec& p, bool takes_lagged) {
  if (p.flux_correction == FluxCorrection::pressure)
    return takes_lagged ? EdgeCorrection::takes_pressure : EdgeCorrection::finds_pressure;
  return p.flux_correction == FluxCorrection::none || takes_lagged ? EdgeCorrection::none : EdgeCorrection::finds_full;
}

NodeWeights node_weights(const PhysicsSpec& p) {
  if (p.stabilisation == Stabilisation::jst) return NodeWeights::laplacian;
  return p.reconstruction == Reconstruction::limited ? NodeWeights::limiter : NodeWeights::none;
}

/// What is compiled: a correction needs gradients, and the rare options do not multiply with each other.
constexpr bool is_built(Reconstruction r, EdgeCorrection c, PressureJump jump, EntropyFix fix) {
  if (r == Reconstruction::constant && c != EdgeCorrection::none) return false;
  return jump == PressureJump::scalar || (r != Reconstruction::limited && fix == EntropyFix::none);
}

void find_gradient(PartFunctions& f, const PhysicsSpec& p, EdgeCorrection correction) {
  const bool tensor = p.pressure_jump == PressureJump::tensor && p.reconstruction == Reconstruction::linear,
             full = correction == EdgeCorrection::finds_full;
  f.corrects_stress = full;
  switch (node_weights(p)) {
    case NodeWeights::none:
      f.gradient = tensor ? (full ? gradient_part<true, true, NodeWeights::none>
                                  : gradient_part<true, false, NodeWeights::none>)
                          : (full ? gradient_part<false, true, NodeWeights::none>
                                  : gradient_part<false, false, NodeWeights::none>);
      break;
    case NodeWeights::limiter:
      f.gradient = full ? gradient_part<false, true, NodeWeights::limiter>
                        : gradient_part<false, false, NodeWeights::limiter>;
      break;
    case NodeWeights::laplacian: f.gradient = gradient_part<false, false, NodeWeights::laplacian>; break;
  }
}

template <Reconstruction reconstruction, PressureJump jump, UpwindMetric metric, EntropyFix fix>
void find_upwind(PartFunctions& f, const PhysicsSpec& p, EdgeCorrection correction, bool audits) {
  const bool with_J = evolves_J(p.formulation);
  with(correction, [&]<EdgeCorrection c>() {
    if constexpr (is_built(reconstruction, c, jump, fix))
      with(audits, [&]<bool audit>() {
        f.edge_flux = edge_flux_part<reconstruction, c, true, jump, metric, fix, audit>;
        if constexpr (jump == PressureJump::scalar)
          if (!with_J) f.edge_flux = edge_flux_part<reconstruction, c, false, jump, metric, fix, audit>;
      });
  });
}

/// Several materials: what a scene needs by default, and its leaner forms.
void find_several(PartFunctions& f, const PhysicsSpec& p, bool audits) {
  if (!takes_several_materials(p)) return;
  const bool with_J = evolves_J(p.formulation);
  const auto find = [&]<Reconstruction reconstruction, bool J>() {
    with(audits, [&]<bool audit>() {
      f.edge_flux = edge_flux_part<reconstruction, EdgeCorrection::none, J, PressureJump::scalar,
                                   UpwindMetric::deformed, EntropyFix::none, audit, Materials::several>;
    });
  };
  if (p.reconstruction == Reconstruction::linear)
    with_J ? find.template operator()<Reconstruction::linear, true>()
           : find.template operator()<Reconstruction::linear, false>();
  else
    with_J ? find.template operator()<Reconstruction::constant, true>()
           : find.template operator()<Reconstruction::constant, false>();
  f.accumulate_update =
      with_J ? accumulate_update_part<Formulation::pFJ, GradientCorrection::none, Areas::undeformed, Materials::several>
             : accumulate_update_part<Formulation::pF, GradientCorrection::none, Areas::undeformed, Materials::several>;
}

/// Current areas: {p,F,J}, upwind, nothing rare (method, section 8).
bool is_built_with_current_areas(const PhysicsSpec& p) {
  return p.formulation == Formulation::pFJ && p.stabilisation == Stabilisation::upwind
         && p.pressure_jump == PressureJump::scalar && p.reconstruction != Reconstruction::limited
         && p.flux_correction == FluxCorrection::none && p.boundary_flux == BoundaryFlux::adjoint
         && p.entropy_fix == EntropyFix::none;
}

void find_sweeps_with_current_areas(PartFunctions& f, const PhysicsSpec& p, bool audits) {
  find_gradient(f, p, EdgeCorrection::none);
  with(p.reconstruction, [&]<Reconstruction reconstruction>() {
    with(p.upwind_metric, [&]<UpwindMetric metric>() {
      if constexpr (reconstruction != Reconstruction::limited)
        with(audits, [&]<bool audit>() { f.edge_flux = current_flux_part<reconstruction, metric, audit>; });
    });
  });
  f.accumulate_update = accumulate_update_part<Formulation::pFJ, GradientCorrection::none, Areas::current>;
}

void find_sweeps(PartFunctions& f, const PhysicsSpec& p, bool audits, bool takes_lagged) {
  if (has_current_areas(p.description)) {
    if (is_built_with_current_areas(p)) find_sweeps_with_current_areas(f, p, audits);
    return;
  }
  const EdgeCorrection correction = edge_correction(p, takes_lagged);
  find_gradient(f, p, correction);
  if (p.stabilisation == Stabilisation::jst) {
    f.edge_flux = evolves_J(p.formulation) ? edge_flux_jst_part<true> : edge_flux_jst_part<false>;
  } else {
    with(p.reconstruction, [&]<Reconstruction reconstruction>() {
      with(p.upwind_metric, [&]<UpwindMetric metric>() {
        with(p.entropy_fix, [&]<EntropyFix fix>() {
          with(p.pressure_jump,
               [&]<PressureJump jump>() { find_upwind<reconstruction, jump, metric, fix>(f, p, correction, audits); });
        });
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

/// The energy of the parting: where J is evolved beside F, with the volumetric and isochoric energies that laws take by default.
constexpr bool takes_parting(Law law, Volumetric volumetric, Isochoric isochoric, Formulation formulation) {
  return evolves_J(formulation) && law != Law::linear_elastic && volumetric == Volumetric::quadratic
         && isochoric == Isochoric::F;
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
              if (!with_parting) {
                f.stress = projected_stress_part<law>;
                f.strain_energy = projected_energy_part<law>;
              }
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
            if constexpr (form == Formulation::pFJ && law != Law::linear_elastic)
              f.stress = stress_part<law, volumetric, isochoric, form, Areas::current>;
          }
        });
      });
    });
  });
}

}  // namespace

const char* const what_is_built =
    "built: upwind with constant and flux_correction none; upwind with linear or limited and flux_correction none | "
    "pressure | full; "
    "pressure_jump tensor not with limited, entropy_fix or pF; jst with linear, flux_correction none, scalar, no "
    "entropy_fix; "
    "pFp with upwind, constant or linear, scalar, flux_correction none, no entropy_fix; "
    "description updated and pseudo_updated with pFJ, upwind, constant or linear, scalar, flux_correction none, "
    "boundary_flux adjoint, no entropy_fix, not linear_elastic; "
    "several materials with upwind, pF | pFJ, constant | linear, scalar, deformed, flux_correction none, no "
    "entropy_fix, keep_angular_momentum false, description total; "
    "parting with pFJ | pFHJ, upwind, scalar, description total, one material, volumetric quadratic, isochoric F, not "
    "linear_elastic";

bool takes_several_materials(const PhysicsSpec& p) {
  return p.stabilisation == Stabilisation::upwind
         && (p.formulation == Formulation::pF || p.formulation == Formulation::pFJ)
         && p.reconstruction != Reconstruction::limited && p.flux_correction == FluxCorrection::none
         && p.pressure_jump == PressureJump::scalar && p.upwind_metric == UpwindMetric::deformed
         && p.entropy_fix == EntropyFix::none && !p.keep_angular_momentum && p.description == Description::total;
}

PartFunctions find_part_functions(const PhysicsSpec& physics, const MaterialSpec& material, Materials materials,
                                  bool audits, bool takes_lagged) {
  PartFunctions f;
  if (materials == Materials::several) {
    find_gradient(f, physics, EdgeCorrection::none);
    find_several(f, physics, audits);
  } else find_sweeps(f, physics, audits, takes_lagged);
  find_material(f, physics, material);
  if (!f.edge_flux) throw std::invalid_argument(what_is_built);
  if (!f.stress)
    throw std::invalid_argument(
        "this material is not built: linear_elastic and hencky_j2 take volumetric = \"quadratic\" and isochoric = "
        "\"F\"; isochoric = \"J\" needs pFJ or pFHJ; linear_elastic needs description = \"total\"; parting needs pFJ "
        "or pFHJ, \"quadratic\", \"F\", \"total\", not linear_elastic");
  return f;
}

}  // namespace nanson
