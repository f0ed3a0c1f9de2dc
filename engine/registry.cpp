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

void find_sweeps(PartFunctions& f, const PhysicsSpec& p) {
  const bool evolves_J = p.formulation != Formulation::pF, corrected = p.flux_correction != FluxCorrection::none;
  const bool tensor = p.pressure_jump == PressureJump::tensor, full = p.flux_correction == FluxCorrection::full;
  const bool stress_gradient = tensor && p.reconstruction == Reconstruction::linear;
  f.gradient = stress_gradient ? (full ? gradient_part<true, true> : gradient_part<true, false>) : (full ? gradient_part<false, true> : gradient_part<false, false>);
  with(p.reconstruction, [&]<Reconstruction reconstruction>() {
    with(p.upwind_metric, [&]<UpwindMetric metric>() {
      with(p.flux_correction, [&]<FluxCorrection correction>() {
        if constexpr (reconstruction == Reconstruction::linear || correction == FluxCorrection::none) {
          f.edge_flux = !evolves_J ? edge_flux_part<reconstruction, correction, false, PressureJump::scalar, metric>
                        : tensor   ? edge_flux_part<reconstruction, correction, true, PressureJump::tensor, metric>
                                   : edge_flux_part<reconstruction, correction, true, PressureJump::scalar, metric>;
        }
      });
      f.dissipation = !evolves_J ? dissipation_part<reconstruction, false, PressureJump::scalar, metric>
                      : tensor   ? dissipation_part<reconstruction, true, PressureJump::tensor, metric>
                                 : dissipation_part<reconstruction, true, PressureJump::scalar, metric>;
    });
  });
  with(p.formulation, [&]<Formulation formulation>() {
    f.accumulate_update = corrected ? accumulate_update_part<formulation, true> : accumulate_update_part<formulation, false>;
  });
}

void find_material(PartFunctions& f, Formulation formulation, const MaterialSpec& m) {
  with(m.law, [&]<Law law>() {
    with(m.volumetric, [&]<Volumetric volumetric>() {
      with(m.isochoric, [&]<Isochoric isochoric>() {
        with(formulation, [&]<Formulation form>() {
          constexpr bool linear = law == Law::linear_elastic;
          if constexpr (linear && (volumetric != Volumetric::quadratic || isochoric != Isochoric::F)) return;
          else if constexpr (form == Formulation::pF && isochoric != Isochoric::F) return;
          else {
            f.stress = stress_part<law, volumetric, isochoric, form>;
            f.strain_energy = strain_energy_part<law, volumetric, isochoric, form>;
          }
        });
      });
    });
  });
}

}  // namespace

PartFunctions find_part_functions(const PhysicsSpec& physics, const MaterialSpec& material) {
  PartFunctions f;
  find_sweeps(f, physics);
  find_material(f, physics.formulation, material);
  if (!f.edge_flux)
    throw std::invalid_argument("physics.flux_correction needs physics.reconstruction = \"linear\"; built: constant with none; linear with none, pressure, full");
  if (!f.stress)
    throw std::invalid_argument("this material is not built: linear_elastic takes volumetric = \"quadratic\" and isochoric = \"F\"; isochoric = \"J\" needs pFJ or pFHJ");
  return f;
}

}  // namespace nanson
