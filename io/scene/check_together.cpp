// What the sections of a scene say together: combinations that are not built, options that nothing would read.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "engine/registry.hpp"
#include "io/scene/scene_sections.hpp"

namespace nanson {
namespace {

/// Complaints at keys of the scene, each where the key stands.
class Rules {
 public:
  Rules(Table& root, const Scene& scene)
      : root_(root),
        materials_(materials_of(scene)),
        many_(root.find("material") && root.find("material")->as_array()) {}

  std::span<const MaterialSpec> materials() const { return materials_; }
  std::string material(std::size_t i) const { return many_ ? fmt::format("material.{}", i) : "material"; }
  bool sound(const std::string& path) const { return !root_.diagnostics().wrong.contains(path); }
  bool written(std::string_view section, std::string_view key) const {
    const auto* t = table_of(section);
    return t && t->contains(key) && sound(fmt::format("{}.{}", section, key));
  }
  /// At the key, or at its section where the key is not written.
  void fail(std::string_view section, std::string_view key, std::string_view why) {
    if (const auto* t = table_of(section)) Table(*t, std::string(section), root_.diagnostics()).fail(key, why);
  }
  void refuse(bool wrong, std::string_view section, std::string_view key, std::string_view why) {
    if (wrong) fail(section, key, why);
  }
  /// Only where the key is written and sound in itself.
  void refuse_written(bool wrong, std::string_view section, std::string_view key, std::string_view why) {
    if (wrong && written(section, key)) fail(section, key, why);
  }

 private:
  const toml::table* table_of(std::string_view section) const {
    const std::size_t dot = section.find('.');
    const toml::node* node = root_.find(section.substr(0, dot));
    if (const auto* list = node ? node->as_array() : nullptr)
      node = list->get(dot == section.npos ? 0 : std::stoul(std::string(section.substr(dot + 1))));
    return node ? node->as_table() : nullptr;
  }

  Table& root_;
  std::span<const MaterialSpec> materials_;
  bool many_;
};

/// "is not built with WHAT, allowed: ..." for what most special schemes go without, and for more.
struct NotBuilt {
  Rules& rules;
  std::string what;
  void unless(bool built, std::string_view section, std::string_view key, std::string_view allowed) const {
    rules.refuse_written(!built, section, key, fmt::format("is not built with {}, allowed: {}", what, allowed));
  }
  void plain_upwinding_only(const PhysicsSpec& p) const {
    unless(p.stabilisation == Stabilisation::upwind, "physics", "stabilisation", "upwind");
    unless(p.reconstruction != Reconstruction::limited, "physics", "reconstruction", "constant | linear");
    unless(p.flux_correction == FluxCorrection::none, "physics", "flux_correction", "none");
    unless(p.entropy_fix == EntropyFix::none, "physics", "entropy_fix", "none");
  }
};

bool is_exact_wave(InitialField f) { return f == InitialField::standing_wave || f == InitialField::plane_wave; }

void check_several(Rules& r, const Scene& s) {
  const PhysicsSpec& p = s.physics;
  const NotBuilt with{r, "several materials"};
  with.plain_upwinding_only(p);
  with.unless(p.formulation == Formulation::pF || p.formulation == Formulation::pFJ, "physics", "formulation",
              "pF | pFJ");
  with.unless(p.pressure_jump == PressureJump::scalar, "physics", "pressure_jump", "scalar");
  with.unless(p.upwind_metric == UpwindMetric::deformed, "physics", "upwind_metric", "deformed");
  with.unless(!p.keep_angular_momentum, "physics", "keep_angular_momentum", "false");
  with.unless(p.description == Description::total, "physics", "description", "total");
  r.refuse_written(is_exact_wave(s.initial.field) || s.initial.field == InitialField::manufactured, "initial", "field",
                   "is the exact solution of one material, not of several");
  for (std::size_t i = 1; i < s.materials.size(); ++i)
    r.refuse_written((s.materials[i].law == Law::linear_elastic) != (s.materials[0].law == Law::linear_elastic),
                     r.material(i), "law",
                     "cannot stand beside that of material.0: linear_elastic is linear in the geometry too, an "
                     "interface with another law would not keep energy");
}

/// What the incompressible scheme cannot be combined with, and what needs it.
void check_projection(Rules& r, const Scene& s) {
  const PhysicsSpec& p = s.physics;
  if (p.formulation != Formulation::pFp) {
    for (const char* key :
         {"solver", "stabilisation", "drift_control", "length_scale", "tolerance", "max_iterations", "on_limit"})
      r.refuse_written(true, "projection", key, "is a key of physics.formulation = \"pFp\" only");
    return;
  }
  const NotBuilt with{r, "formulation = \"pFp\""};
  with.plain_upwinding_only(p);
  with.unless(s.material.law != Law::linear_elastic && s.material.law != Law::hencky_j2, r.material(0), "law",
              "neo_hookean | mooney_rivlin");
  with.unless(!p.keep_angular_momentum, "physics", "keep_angular_momentum", "false");
  with.unless(s.time.integrator == Integrator::tvd_rk2, "time", "integrator", "tvd_rk2");
  with.unless(s.time.step != StepRule::paper, "time", "step", "dual | edge");
  const std::string_view no_J = "needs an evolved J, which formulation = \"pFp\" does not carry";
  r.refuse_written(p.pressure_jump != PressureJump::scalar, "physics", "pressure_jump", no_J);
  r.refuse_written(s.material.isochoric == Isochoric::J, r.material(0), "isochoric", no_J);
  r.refuse_written(s.material.volumetric != Volumetric::quadratic, r.material(0), "volumetric",
                   "formulation = \"pFp\" has the pressure for unknown, its energy p^2/(2 kappa) is \"quadratic\"");
  r.refuse_written(s.monitor.entropy, "monitor", "entropy",
                   "is not built with formulation = \"pFp\", which dissipates by its projection too");
  r.refuse_written(p.boundary_flux != BoundaryFlux::adjoint, "physics", "boundary_flux",
                   "formulation = \"pFp\" needs \"adjoint\": the paper's makes the pressure's operator unsymmetric");
}

/// An energy of det F/J acts where both are carried, and through the jump of Sigma_J.
void check_parting(Rules& r, const Scene& s) {
  const PhysicsSpec& p = s.physics;
  if (p.parting == 0) return;
  const auto refuse = [&](bool wrong, std::string_view why) { r.refuse_written(wrong, "physics", "parting", why); };
  refuse(!evolves_J(p.formulation),
         fmt::format("needs an evolved J, which formulation = \"{}\" does not carry", word(p.formulation)));
  refuse(p.stabilisation != Stabilisation::upwind,
         "acts through the jump of Sigma_J, which stabilisation = \"jst\" does not take");
  refuse(p.pressure_jump != PressureJump::scalar,
         "acts through the jump of Sigma_J, which pressure_jump = \"tensor\" does not take");
  refuse(has_current_areas(p.description),
         fmt::format("is not built with description = \"{}\", allowed: 0", word(p.description)));
  refuse(!s.materials.empty(), "is not built with several materials, allowed: 0");
  refuse(s.material.law == Law::linear_elastic,
         "has no meaning for linear_elastic, whose J is 1 + tr(F - I) and not det F");
  const NotBuilt with{r, "physics.parting"};
  with.unless(s.material.volumetric == Volumetric::quadratic, r.material(0), "volumetric", "quadratic");
  with.unless(s.material.isochoric == Isochoric::F, r.material(0), "isochoric", "F");
}

/// What current area vectors are not built with.
void check_current_areas(Rules& r, const Scene& s) {
  const PhysicsSpec& p = s.physics;
  if (!has_current_areas(p.description)) return;
  const NotBuilt with{r, fmt::format("description = \"{}\"", word(p.description))};
  with.plain_upwinding_only(p);
  r.refuse_written(p.formulation != Formulation::pFJ, "physics", "description",
                   fmt::format("needs formulation = \"pFJ\"; {}", what_is_built));
  with.unless(s.material.law != Law::linear_elastic, "material", "law", "neo_hookean | mooney_rivlin | hencky_j2");
  with.unless(p.pressure_jump == PressureJump::scalar, "physics", "pressure_jump", "scalar");
  with.unless(p.boundary_flux == BoundaryFlux::adjoint, "physics", "boundary_flux", "adjoint");
}

/// The manufactured motion is exact between planes of symmetry, under its own body force alone.
void check_manufactured(Rules& r, const Scene& s) {
  if (s.initial.field != InitialField::manufactured || !r.sound("initial.field") || !r.sound("initial.length")) return;
  const std::string_view why = "has no exact solution with initial.field = \"manufactured\"",
                         audit = "does not book the body force of initial.field = \"manufactured\"";
  r.refuse(s.material.law == Law::hencky_j2, "material", "law", why);
  r.refuse(s.material.isochoric == Isochoric::J, "material", "isochoric", why);
  r.refuse(s.physics.formulation == Formulation::pFp, "physics", "formulation", why);
  r.refuse(s.physics.keep_angular_momentum, "physics", "keep_angular_momentum", audit);
  r.refuse(s.monitor.energy, "monitor", "energy", audit);
  r.refuse(s.body_force != Vec3{}, "body_force", "g", why);
  std::vector<std::string_view> missing{"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};
  bool symmetric = true;
  for (const BoundarySpec& b : s.boundary) {
    symmetric = symmetric && b.kind == BoundaryKind::symmetric;
    for (const Named& face : b.faces) std::erase(missing, face.name);
  }
  r.refuse(!symmetric || !missing.empty(), "initial", "field", "needs kind = \"symmetric\" on all six faces of a box");
  bool planes = s.mesh.source == MeshSource::box;
  for (std::size_t k = 0; k < 3; ++k)
    for (const double X : {s.mesh.origin[k], s.mesh.origin[k] + s.mesh.size[k]}) {
      const double halves = X / s.initial.length;
      planes = planes && std::abs(halves - std::round(halves)) < 1e-9;
    }
  r.refuse(!planes, "initial", "length", "the faces of mesh.box must lie on multiples of it");
}

/// {p,F} carries no J, and only {p,F,p} reaches nu = 1/2.
void check_formulation(Rules& r, const Scene& s) {
  const bool pF = s.physics.formulation == Formulation::pF;
  const std::string_view no_J = "needs an evolved J, which formulation = \"pF\" does not carry";
  for (std::size_t i = 0; i < r.materials().size(); ++i) {
    r.refuse(pF && r.materials()[i].isochoric == Isochoric::J, r.material(i), "isochoric", no_J);
    r.refuse_written(r.materials()[i].poissons_ratio == 0.5 && s.physics.formulation != Formulation::pFp, r.material(i),
                     "poissons_ratio", "must be below 0.5 unless physics.formulation = \"pFp\"");
  }
  r.refuse(pF && s.initial.J == InitialJ::det, "initial", "J", no_J);
  r.refuse(pF && s.physics.pressure_jump == PressureJump::tensor, "physics", "pressure_jump", no_J);
  check_projection(r, s);
}

void check_monitors(Rules& r, const Scene& s) {
  const bool jst = r.sound("physics.stabilisation") && s.physics.stabilisation == Stabilisation::jst,
             unguarded = r.sound("monitor.energy") && !s.monitor.energy;
  r.refuse(jst && s.monitor.energy, "monitor", "energy", "audits the upwind stabilisation only, not jst");
  r.refuse(jst && s.monitor.entropy, "monitor", "entropy",
           "counts the edges of the upwind stabilisation only, not of jst");
  r.refuse(unguarded && s.monitor.energy_growth != EnergyGrowth::warn, "monitor", "energy_growth",
           "needs monitor.energy = true");
  r.refuse(unguarded && s.monitor.energy_tolerance != MonitorSpec{}.energy_tolerance, "monitor", "energy_tolerance",
           "needs monitor.energy = true");
  r.refuse(r.sound("physics.keep_angular_momentum") && s.physics.keep_angular_momentum && r.sound("time.integrator")
               && s.time.integrator != Integrator::tvd_rk2,
           "physics", "keep_angular_momentum",
           "needs time.integrator = \"tvd_rk2\": for the stages of ssp_rk3 no arms are built that keep it exactly");
}

/// Fields and exact waves that the laws do not have.
void check_laws(Rules& r, const Scene& s) {
  for (std::size_t i = 0; i < r.materials().size(); ++i)
    if (!r.sound(r.material(i) + ".law")) return;
  const auto shows_plastic = [](const std::vector<std::string>& fields) {
    return std::find(fields.begin(), fields.end(), "plastic_strain") != fields.end();
  };
  if (!has_plasticity(s)) {
    const std::string_view why = "plastic_strain needs material.law = \"hencky_j2\"";
    r.refuse(r.sound("output.fields") && shows_plastic(s.output.fields), "output", "fields", why);
    for (const ProbeSpec& p : s.output.probes)
      r.refuse(shows_plastic(p.fields), "output", "probes", fmt::format("{}.fields: {}", p.name, why));
  }
  r.refuse(is_exact_wave(s.initial.field) && s.materials.empty() && s.material.law != Law::linear_elastic, "initial",
           "field", "needs material.law = \"linear_elastic\": its exact solution is linear");
}

}  // namespace

void check_together(Table& root, const Scene& s) {
  Rules rules(root, s);
  if (rules.sound("physics.formulation")) check_formulation(rules, s);
  if (rules.sound("physics.description")) check_current_areas(rules, s);
  if (!s.materials.empty()) check_several(rules, s);
  if (rules.sound("physics.formulation") && rules.sound("material.law")) check_parting(rules, s);
  check_manufactured(rules, s);
  check_monitors(rules, s);
  check_laws(rules, s);
}

}  // namespace nanson
