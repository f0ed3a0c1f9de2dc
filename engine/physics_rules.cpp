#include "engine/physics_rules.hpp"

#include <algorithm>
#include <cmath>

#include "engine/material.hpp"
#include "engine/registry.hpp"

namespace nanson {
namespace {

using Spec = MaterialSpec;

bool shows_plastic_strain(const std::vector<std::string>& fields) {
  return std::ranges::find(fields, "plastic_strain") != fields.end();
}

bool is_exact_wave(const Scene& s) {
  return s.initial.field == InitialField::standing_wave || s.initial.field == InitialField::plane_wave;
}

bool is_manufactured(const Scene& s) { return s.initial.field == InitialField::manufactured; }
bool is_projected(const Scene& s) { return s.physics.formulation == Formulation::pFp; }
bool is_jst(const Scene& s) { return s.physics.stabilisation == Stabilisation::jst; }
bool is_current(const Scene& s) { return has_current_areas(s.physics.description); }
bool is_corrected(const Scene& s) { return s.physics.flux_correction != FluxCorrection::none; }
bool is_tensor(const Scene& s) { return s.physics.pressure_jump == PressureJump::tensor; }
bool has_several(const Scene& s) { return !s.materials.empty(); }

/// Planes of symmetry on all six sides.
bool is_closed_by_symmetry(const Scene& s) {
  std::vector<std::string_view> missing{"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};
  for (const BoundarySpec& b : s.boundary) {
    if (b.kind != BoundaryKind::symmetric) return false;
    for (const Named& face : b.faces) std::erase(missing, face.name);
  }
  return missing.empty();
}

/// A box whose faces lie on multiples of the manufactured motion's length.
bool lies_between_planes(const Scene& s) {
  if (s.mesh.source != MeshSource::box) return false;
  for (std::size_t k = 0; k < 3; ++k)
    for (const double X : {s.mesh.origin[k], s.mesh.origin[k] + s.mesh.size[k]}) {
      const double halves = X / s.initial.length;
      if (!(std::abs(halves - std::round(halves)) < 1e-9)) return false;
    }
  return true;
}

/// Largest over least rho c_p of the materials.
double impedance_ratio(const Scene& s) {
  double least = HUGE_VAL, most = 0;
  for (const MaterialSpec& m : materials_of(s)) {
    const MaterialConstants c = constants_of(m);
    least = std::min(least, c.rho * c.cp);
    most = std::max(most, c.rho * c.cp);
  }
  return most / least;
}

bool is_papers_boundary(const Scene& s) { return s.physics.boundary_flux == BoundaryFlux::paper; }

constexpr std::string_view needs_adjoint =
    "needs boundary_flux = \"adjoint\": its forces on the nodes of a tet stand against the adjoint force of their mean";
constexpr std::string_view needs_J = "needs an evolved J: formulation = \"pFJ\" or \"pFHJ\"",
                           exact = "has no exact solution with initial.field = \"manufactured\"",
                           plastic_strain = "plastic_strain needs material.law = \"hencky_j2\"";

constexpr PhysicsRule rules[] = {
    // laws
    {"material.volumetric", "material.law",
     [](const Scene&, const Spec& m) {
       return law_traits(m.law).carries_energy && m.volumetric != Volumetric::quadratic;
     },
     "has no meaning for linear_elastic and hencky_j2, whose energies are their own, allowed: quadratic"},
    {"material.isochoric", "material.law",
     [](const Scene&, const Spec& m) { return law_traits(m.law).carries_energy && m.isochoric != Isochoric::F; },
     "has no meaning for linear_elastic and hencky_j2, whose energies are their own, allowed: F"},

    // formulation
    {"physics.pressure_jump", "physics.formulation",
     [](const Scene& s, const Spec&) { return is_tensor(s) && !evolves_J(s.physics.formulation); }, needs_J},
    {"physics.parting", "physics.formulation",
     [](const Scene& s, const Spec&) { return s.physics.parting > 0 && !evolves_J(s.physics.formulation); }, needs_J},
    {"initial.J", "physics.formulation",
     [](const Scene& s, const Spec&) { return s.initial.J == InitialJ::det && !evolves_J(s.physics.formulation); },
     needs_J},
    {"material.isochoric", "physics.formulation",
     [](const Scene& s, const Spec& m) { return m.isochoric == Isochoric::J && !evolves_J(s.physics.formulation); },
     needs_J},
    {"material.poissons_ratio", "physics.formulation",
     [](const Scene& s, const Spec& m) { return m.poissons_ratio == 0.5 && !is_projected(s); },
     "must be below 0.5 unless physics.formulation = \"pFp\""},

    // sweeps
    {"physics.flux_correction", "physics.reconstruction",
     [](const Scene& s, const Spec&) {
       return is_corrected(s) && s.physics.reconstruction == Reconstruction::constant;
     },
     "needs reconstruction = \"linear\" or \"limited\": the correction is made of its gradients"},
    {"physics.stabilisation", "physics.reconstruction",
     [](const Scene& s, const Spec&) {
       const PhysicsSpec& p = s.physics;
       return is_jst(s)
              && (p.reconstruction != Reconstruction::linear || is_corrected(s) || is_tensor(s)
                  || p.entropy_fix != EntropyFix::none || p.upwind_metric != UpwindMetric::deformed);
     },
     "jst has no Riemann jump: no reconstruction, flux_correction, pressure_jump, upwind_metric or entropy_fix to "
     "choose"},
    {"physics.keep_angular_momentum", "time.integrator",
     [](const Scene& s, const Spec&) {
       return s.physics.keep_angular_momentum && s.time.integrator != Integrator::tvd_rk2 && !is_projected(s);
     },
     "needs time.integrator = \"tvd_rk2\": for the stages of ssp_rk3 no arms are built that keep it exactly"},

    // energy of the parting
    {"physics.parting", "physics.stabilisation",
     [](const Scene& s, const Spec&) { return s.physics.parting > 0 && is_jst(s); },
     "acts through the jump of Sigma_J, which stabilisation = \"jst\" does not take"},
    {"physics.parting", "physics.pressure_jump",
     [](const Scene& s, const Spec&) { return s.physics.parting > 0 && is_tensor(s); },
     "acts through the jump of Sigma_J, which pressure_jump = \"tensor\" does not take"},
    {"physics.parting", "material.law",
     [](const Scene& s, const Spec& m) { return s.physics.parting > 0 && law_traits(m.law).is_linear; },
     "has no meaning for linear_elastic, whose J is 1 + tr(F - I) and not det F"},

    // energies of the tets
    {"physics.tet_stiffness", "physics.boundary_flux",
     [](const Scene& s, const Spec&) { return s.physics.tet_stiffness > 0 && is_papers_boundary(s); }, needs_adjoint},
    {"physics.tet_barrier", "physics.boundary_flux",
     [](const Scene& s, const Spec&) { return s.physics.tet_barrier > 0 && is_papers_boundary(s); }, needs_adjoint},
    {"physics.tet_barrier", "material.law",
     [](const Scene& s, const Spec& m) { return s.physics.tet_barrier > 0 && law_traits(m.law).is_linear; },
     "has no meaning for linear_elastic, whose volume is 1 + tr(F - I) and not det F"},

    // current area vectors
    {"material.law", "physics.description",
     [](const Scene& s, const Spec& m) { return is_current(s) && law_traits(m.law).is_linear; },
     "needs description = \"total\": it is linear in the geometry too"},
    {"physics.description", "physics.formulation",
     [](const Scene& s, const Spec&) { return is_current(s) && is_projected(s); },
     "is not built yet with formulation = \"pFp\", allowed: total"},
    {"physics.stabilisation", "physics.description",
     [](const Scene& s, const Spec&) { return is_current(s) && is_jst(s); },
     "is not built yet with current area vectors (physics.description), allowed: upwind"},
    {"physics.pressure_jump", "physics.description",
     [](const Scene& s, const Spec&) { return is_current(s) && is_tensor(s); },
     "is not built yet with current area vectors (physics.description), allowed: scalar"},
    {"physics.flux_correction", "physics.description",
     [](const Scene& s, const Spec&) { return is_current(s) && is_corrected(s); },
     "is not built yet with current area vectors (physics.description), allowed: none"},

    // several materials
    {"material.law", "",
     [](const Scene& s, const Spec& m) {
       return has_several(s) && law_traits(m.law).is_linear != law_traits(s.materials[0].law).is_linear;
     },
     "cannot stand beside that of material.0: linear_elastic is linear in the geometry too, an interface with another "
     "law would not keep energy"},
    {"initial.field", "",
     [](const Scene& s, const Spec&) { return has_several(s) && (is_exact_wave(s) || is_manufactured(s)); },
     "is the exact solution of one material, not of several"},
    {"physics.flux_correction", "material.youngs_modulus",
     [](const Scene& s, const Spec&) { return is_corrected(s) && impedance_ratio(s) > 100; },
     "is unsound between materials whose impedances rho c_p differ more than 1:100, allowed: none"},
    {"physics.stabilisation", "", [](const Scene& s, const Spec&) { return has_several(s) && is_jst(s); },
     "with several materials needs \"upwind\", whose edges carry impedances of both sides"},

    // {p, F, p}
    {"material.volumetric", "physics.formulation",
     [](const Scene& s, const Spec& m) { return is_projected(s) && m.volumetric != Volumetric::quadratic; },
     "formulation = \"pFp\" has the pressure for unknown, its energy p^2/(2 kappa) is \"quadratic\""},
    {"physics.boundary_flux", "physics.formulation",
     [](const Scene& s, const Spec&) { return is_projected(s) && s.physics.boundary_flux != BoundaryFlux::adjoint; },
     "formulation = \"pFp\" needs \"adjoint\": the paper's makes the pressure's operator unsymmetric"},
    {"time.step", "physics.formulation",
     [](const Scene& s, const Spec&) { return is_projected(s) && s.time.step == StepRule::paper; },
     "is the speed of pressure waves, which formulation = \"pFp\" does not resolve, allowed: dual | edge"},
    {"material.law", "physics.formulation",
     [](const Scene& s, const Spec& m) { return is_projected(s) && law_traits(m.law).carries_energy; },
     "is not built yet with formulation = \"pFp\", allowed: neo_hookean | mooney_rivlin"},
    {"physics.stabilisation", "physics.formulation",
     [](const Scene& s, const Spec&) { return is_projected(s) && is_jst(s); },
     "is not built yet with formulation = \"pFp\", allowed: upwind"},
    {"physics.reconstruction", "physics.formulation",
     [](const Scene& s, const Spec&) { return is_projected(s) && s.physics.reconstruction == Reconstruction::limited; },
     "is not built yet with formulation = \"pFp\", allowed: constant | linear"},
    {"physics.flux_correction", "physics.formulation",
     [](const Scene& s, const Spec&) { return is_projected(s) && is_corrected(s); },
     "is not built yet with formulation = \"pFp\", allowed: none"},
    {"physics.entropy_fix", "physics.formulation",
     [](const Scene& s, const Spec&) { return is_projected(s) && s.physics.entropy_fix != EntropyFix::none; },
     "is not built yet with formulation = \"pFp\", allowed: none"},
    {"physics.keep_angular_momentum", "physics.formulation",
     [](const Scene& s, const Spec&) { return is_projected(s) && s.physics.keep_angular_momentum; },
     "is not built yet with formulation = \"pFp\", allowed: false"},
    {"monitor.entropy", "physics.formulation",
     [](const Scene& s, const Spec&) { return is_projected(s) && s.monitor.entropy; },
     "is not built yet with formulation = \"pFp\", which dissipates by its projection too"},

    // monitors
    {"monitor.energy", "physics.stabilisation",
     [](const Scene& s, const Spec&) { return is_jst(s) && s.monitor.energy; },
     "audits the upwind stabilisation only, not jst"},
    {"monitor.entropy", "physics.stabilisation",
     [](const Scene& s, const Spec&) { return is_jst(s) && s.monitor.entropy; },
     "counts the edges of the upwind stabilisation only, not of jst"},
    {"monitor.energy_growth", "monitor.energy",
     [](const Scene& s, const Spec&) { return !s.monitor.energy && s.monitor.energy_growth != EnergyGrowth::warn; },
     "needs monitor.energy = true"},
    {"monitor.energy_tolerance", "monitor.energy",
     [](const Scene& s, const Spec&) {
       return !s.monitor.energy && s.monitor.energy_tolerance != MonitorSpec{}.energy_tolerance;
     },
     "needs monitor.energy = true"},
    {"output.fields", "material.law",
     [](const Scene& s, const Spec&) { return !has_plasticity(s) && shows_plastic_strain(s.output.fields); },
     plastic_strain},
    {"output.probes", "material.law",
     [](const Scene& s, const Spec&) {
       return !has_plasticity(s) && std::ranges::any_of(s.output.probes, [](const ProbeSpec& p) {
         return shows_plastic_strain(p.fields);
       });
     },
     plastic_strain},

    // exact solutions
    {"initial.field", "material.law",
     [](const Scene& s, const Spec& m) { return is_exact_wave(s) && !law_traits(m.law).is_linear; },
     "needs material.law = \"linear_elastic\": its exact solution is linear"},
    {"material.law", "initial.field",
     [](const Scene& s, const Spec& m) { return is_manufactured(s) && law_traits(m.law).has_state; }, exact},
    {"material.isochoric", "initial.field",
     [](const Scene& s, const Spec& m) { return is_manufactured(s) && m.isochoric == Isochoric::J; }, exact},
    {"physics.formulation", "initial.field",
     [](const Scene& s, const Spec&) { return is_manufactured(s) && is_projected(s); }, exact},
    {"body_force.g", "initial.field",
     [](const Scene& s, const Spec&) { return is_manufactured(s) && s.body_force != Vec3{}; }, exact},
    {"initial.field", "initial.length",
     [](const Scene& s, const Spec&) { return is_manufactured(s) && !is_closed_by_symmetry(s); },
     "needs kind = \"symmetric\" on all six faces of a box"},
    {"initial.length", "initial.field",
     [](const Scene& s, const Spec&) { return is_manufactured(s) && !lies_between_planes(s); },
     "the faces of mesh.box must lie on multiples of it"},
};

}  // namespace

std::span<const PhysicsRule> physics_rules() { return rules; }

const PhysicsRule* broken_rule(const Scene& scene) {
  for (const PhysicsRule& rule : rules)
    for (const MaterialSpec& m : materials_of(scene))
      if (rule.broken(scene, m)) return &rule;
  return nullptr;
}

}  // namespace nanson
