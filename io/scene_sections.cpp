// The sections of a scene that are read key by key. Defaults stand in engine/scene.hpp.
#include "io/scene_sections.hpp"

#include "engine/registry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nanson {

namespace {

/// Node and tet numbers are int.
void check_count(Table& t, const std::array<int, 3>& cells) {
  double nodes = 1, tets = 6;
  for (const int n : cells) {
    nodes *= n + 1.0;
    tets *= n;
  }
  const double limit = std::numeric_limits<int>::max();
  if (std::max(nodes, tets) > limit)
    t.fail("cells", fmt::format("makes {:.3g} nodes and {:.3g} tets, at most {} of each can be numbered", nodes, tets, limit));
}

void read_mesh_file(Table& t, MeshSpec& m, const std::filesystem::path& folder) {
  std::string name;
  if (!t.read("file", name) || !t.has("file")) return;
  m.file = {(folder / name).string(), where(t.diagnostics(), t.place("file"))};
  std::error_code error;
  if (!std::filesystem::is_regular_file(m.file.name, error)) t.fail("file", fmt::format("there is no file {}", m.file.name));
}

/// The core of a quarter is m x m cells, m half the tangential ones.
void read_cylinder_cells(Table& t, MeshSpec& m) {
  if (!t.require("cells", m.cells, {.from = 1})) return;
  if (m.cells[1] % 2 != 0) return t.fail("cells", fmt::format("the second number, {} tangential cells, must be even: half of them bound the core on each side", m.cells[1]));
  if (m.cells[0] <= m.cells[1] / 2)
    return t.fail("cells", fmt::format("the first number, {} radial cells, must be above half the second, {}, which the core takes", m.cells[0], m.cells[1] / 2));
  check_count(t, m.cells);
}

bool normalise(Vec3& direction) {
  const double largest = std::max({std::abs(direction[0]), std::abs(direction[1]), std::abs(direction[2])});
  if (largest == 0) return false;
  for (double& x : direction) x /= largest;        // first, so that no square over- or underflows
  const double length = std::hypot(direction[0], direction[1], direction[2]);
  for (double& x : direction) x /= length;
  return true;
}

void read_rotation(Table& t, InitialSpec& s) {
  t.require("omega", s.omega);
  const toml::node* centre = t.find("centre");
  if (!centre || (centre->is_string() && centre->as_string()->get() == "mass")) return;
  Vec3 at{};
  if (centre->is_string()) t.fail("centre", "must be \"mass\" or three numbers");
  else if (t.read("centre", at)) s.centre = at;
}

}  // namespace

void read_mesh_section(Table& t, MeshSpec& m, const std::filesystem::path& folder) {
  std::string beside;
  for (const std::string_view source : words(m.source)) {
    if (!t.has(source)) continue;
    if (!beside.empty()) t.fail(source, fmt::format("stands beside mesh.{}, exactly one of {} is allowed", beside, join_words(words(m.source))));
    else beside = source;
  }
  if (beside.empty()) t.missing({"box", "cylinder", "needle", "file"}, fmt::format("mesh: exactly one of {} is needed", join_words(words(m.source))));
  if (beside == "cylinder") m.source = MeshSource::cylinder;
  if (beside == "needle") m.source = MeshSource::needle;
  if (beside == "file") m.source = MeshSource::file;
  t.section("box", [&](Table& b) {
    b.read("origin", m.origin);
    b.require("size", m.size, {.above = 0});
  });
  t.section("cylinder", [&](Table& c) {
    c.require("radius", m.radius, {.above = 0});
    c.require("length", m.length, {.above = 0});
    c.read("sector", m.sector);
  });
  t.section("needle", [&](Table& n) {
    const bool inner = n.require("inner", m.inner, {.above = 0}), outer = n.require("outer", m.outer, {.above = 0});
    if (inner && outer && m.outer <= m.inner) n.fail("outer", fmt::format("must be above mesh.needle.inner, {:g}", m.inner));
    n.require("angle", m.angle, {.above = 0, .to = 90});
  });
  read_mesh_file(t, m, folder);
  if (m.source == MeshSource::file) return t.only("file", {}, std::array<std::string_view, 4>{"cells", "split", "perturb", "regions"});
  if (m.source == MeshSource::cylinder) {
    t.only("cylinder", {}, std::array<std::string_view, 3>{"split", "perturb", "regions"});
    return read_cylinder_cells(t, m);
  }
  if (m.source == MeshSource::needle) {
    t.only("needle", {}, std::array<std::string_view, 3>{"split", "perturb", "regions"});
    if (t.require("cells", m.cells, {.from = 1})) check_count(t, m.cells);
    return;
  }
  if (t.read("cells", m.cells, {.from = 1})) check_count(t, m.cells);
  t.read("split", m.split);
  t.read("perturb", m.perturb, {.from = 0, .to = 0.4});
  read_regions(t, m);
}

void read_physics(Table& t, PhysicsSpec& p) {
  t.read("formulation", p.formulation);
  t.read("description", p.description);
  t.read("stabilisation", p.stabilisation);
  t.read("pressure_jump", p.pressure_jump);
  t.read("reconstruction", p.reconstruction);
  t.read("flux_correction", p.flux_correction);
  t.read("boundary_flux", p.boundary_flux);
  t.read("upwind_metric", p.upwind_metric);        // both words also with linear_elastic: there H = I and they agree
  t.read("entropy_fix", p.entropy_fix);
  t.read("keep_angular_momentum", p.keep_angular_momentum);
  const bool corrected = t.sound("flux_correction") && p.flux_correction != FluxCorrection::none;
  if (corrected && t.sound("reconstruction") && p.reconstruction == Reconstruction::constant)
    t.fail("flux_correction", "needs reconstruction = \"linear\" or \"limited\": the correction is made of its gradients");
  if (t.sound("pressure_jump") && p.pressure_jump == PressureJump::tensor && (p.reconstruction == Reconstruction::limited || p.entropy_fix != EntropyFix::none))
    t.fail("pressure_jump", fmt::format("is not built with limited or entropy_fix; {}", what_is_built));
  if (t.sound("stabilisation") && p.stabilisation == Stabilisation::jst &&
      (p.reconstruction != Reconstruction::linear || p.flux_correction != FluxCorrection::none || p.pressure_jump != PressureJump::scalar ||
       p.entropy_fix != EntropyFix::none || p.upwind_metric != UpwindMetric::deformed))
    t.fail("stabilisation", fmt::format("jst has no reconstruction, flux_correction, pressure_jump, upwind_metric or entropy_fix to choose; {}", what_is_built));
}

void read_projection(Table& t, ProjectionSpec& p) {
  if (read_kind<ProjectionSolver>(t, "solver", p.solver, false, {{ProjectionSolver::pseudo_time, {"length_scale"}}}) && p.solver == ProjectionSolver::pseudo_time)
    t.require("length_scale", p.length_scale, {.above = 0});
  t.read("stabilisation", p.stabilisation, {.from = 0});
  t.read("drift_control", p.drift_control, {.from = 0, .to = 1});
  t.read("tolerance", p.tolerance, {.above = 0, .below = 1});
  t.read("max_iterations", p.max_iterations, {.from = 1});
  t.read("on_limit", p.on_limit);
}

void read_initial(Table& t, InitialSpec& s) {
  using enum InitialField;
  read_kind<InitialField>(t, "field", s.field, false,
                          {{velocity, {"v"}},
                           {rotation, {"omega", "centre"}},
                           {twist, {"omega", "height"}},
                           {plate_mode, {"amplitude", "omega", "B"}},
                           {standing_wave, {"amplitude", "J"}},
                           {plane_wave, {"amplitude", "length", "direction", "J"}},
                           {punch, {"v0", "height"}},
                           {manufactured, {"amplitudes", "length", "period"}}});
  if (s.field == velocity) t.require("v", s.v);
  if (s.field == rotation) read_rotation(t, s);
  if (s.field == twist) {
    t.require("omega", s.twist_omega);
    if (t.require("height", s.height) && s.height == 0) t.fail("height", "must not be zero");
  }
  if (s.field == punch) {
    t.require("v0", s.v0);
    t.require("height", s.height, {.above = 0});
  }
  if (s.field == plate_mode) {
    t.require("amplitude", s.amplitude);
    t.require("omega", s.mode_omega);
    t.require("B", s.B);
  }
  if (s.field == standing_wave || s.field == plane_wave) {
    t.require("amplitude", s.amplitude);
    t.read("J", s.J);
  }
  if (s.field == plane_wave) {
    t.require("length", s.length, {.above = 0});
    if (t.read("direction", s.direction) && !normalise(s.direction)) t.fail("direction", "must not be zero");
  }
  if (s.field == manufactured) {
    t.require("amplitudes", s.amplitudes);
    t.require("length", s.length, {.above = 0});
    t.require("period", s.period, {.above = 0});
  }
}

void read_time(Table& t, TimeSpec& s) {
  t.require("end", s.end, {.above = 0});
  t.read("integrator", s.integrator);
  if (s.integrator == Integrator::ssp_rk3) s.cfl = 0.6;
  t.read("cfl", s.cfl, {.above = 0, .to = 2});     // no explicit scheme is stable above: larger is a slip of the pen
  t.read("step", s.step);
  t.read("dt_max", s.dt_max, {.above = 0});
  t.read("dt_collapse", s.dt_collapse, {.above = 0, .below = 1});
  t.read("max_steps", s.max_steps, {.from = 0});
  t.read("max_wall_s", s.max_wall_s, {.from = 0});
}

void read_monitor(Table& t, MonitorSpec& m) {
  t.read("energy", m.energy);
  t.read("entropy", m.entropy);
  t.read("involutions", m.involutions);
  t.read("geometry", m.geometry);
  t.read("energy_growth", m.energy_growth);
  t.read("energy_tolerance", m.energy_tolerance, {.above = 0});
}

namespace {

/// What is not built with several materials.
template <class At>
void check_several(const Scene& s, At at) {
  const PhysicsSpec& p = s.physics;
  const auto refuse = [&](bool wrong, std::string_view section, std::string_view key, std::string_view allowed) {
    if (wrong) at(section, key, fmt::format("is not built with several materials, allowed: {}", allowed));
  };
  refuse(p.formulation != Formulation::pF && p.formulation != Formulation::pFJ, "physics", "formulation", "pF | pFJ");
  refuse(p.stabilisation != Stabilisation::upwind, "physics", "stabilisation", "upwind");
  refuse(p.pressure_jump != PressureJump::scalar, "physics", "pressure_jump", "scalar");
  refuse(p.reconstruction == Reconstruction::limited, "physics", "reconstruction", "constant | linear");
  refuse(p.flux_correction != FluxCorrection::none, "physics", "flux_correction", "none");
  refuse(p.upwind_metric != UpwindMetric::deformed, "physics", "upwind_metric", "deformed");
  refuse(p.entropy_fix != EntropyFix::none, "physics", "entropy_fix", "none");
  refuse(p.keep_angular_momentum, "physics", "keep_angular_momentum", "false");
  refuse(p.description != Description::total, "physics", "description", "total");
  if (s.initial.field == InitialField::standing_wave || s.initial.field == InitialField::plane_wave || s.initial.field == InitialField::manufactured)
    at("initial", "field", "is the exact solution of one material, not of several");
  for (std::size_t i = 1; i < s.materials.size(); ++i)
    if ((s.materials[i].law == Law::linear_elastic) != (s.materials[0].law == Law::linear_elastic))
      at(fmt::format("material.{}", i), "law", "cannot stand beside that of material.0: linear_elastic is linear in the geometry too, an interface with another law would not keep energy");
}

/// What the incompressible scheme cannot be combined with, and what needs it.
template <class At>
void check_projection(const Scene& s, const std::string& material, At at) {
  const PhysicsSpec& p = s.physics;
  if (p.formulation != Formulation::pFp) {
    for (const char* key : {"solver", "stabilisation", "drift_control", "length_scale", "tolerance", "max_iterations", "on_limit"})
      at("projection", key, "is a key of physics.formulation = \"pFp\" only");
    return;
  }
  const auto refuse = [&](bool wrong, std::string_view section, std::string_view key, std::string_view why) {
    if (wrong) at(section, key, why);
  };
  refuse(s.material.law == Law::linear_elastic || s.material.law == Law::hencky_j2, material, "law", "is not built with formulation = \"pFp\", allowed: neo_hookean | mooney_rivlin");
  refuse(s.material.volumetric != Volumetric::quadratic, material, "volumetric", "formulation = \"pFp\" has the pressure for unknown, its energy p^2/(2 kappa) is \"quadratic\"");
  refuse(s.material.isochoric == Isochoric::J, material, "isochoric", "needs an evolved J, which formulation = \"pFp\" does not carry");
  refuse(s.monitor.entropy, "monitor", "entropy", "is not built with formulation = \"pFp\", which dissipates by its projection too");
  refuse(p.stabilisation != Stabilisation::upwind, "physics", "stabilisation", "is not built with formulation = \"pFp\", allowed: upwind");
  refuse(p.pressure_jump != PressureJump::scalar, "physics", "pressure_jump", "needs an evolved J, which formulation = \"pFp\" does not carry");
  refuse(p.reconstruction == Reconstruction::limited, "physics", "reconstruction", "is not built with formulation = \"pFp\", allowed: constant | linear");
  refuse(p.flux_correction != FluxCorrection::none, "physics", "flux_correction", "is not built with formulation = \"pFp\", allowed: none");
  refuse(p.boundary_flux != BoundaryFlux::adjoint, "physics", "boundary_flux", "formulation = \"pFp\" needs \"adjoint\": the paper's makes the pressure's operator unsymmetric");
  refuse(p.entropy_fix != EntropyFix::none, "physics", "entropy_fix", "is not built with formulation = \"pFp\", allowed: none");
  refuse(p.keep_angular_momentum, "physics", "keep_angular_momentum", "is not built with formulation = \"pFp\", allowed: false");
  refuse(s.time.integrator != Integrator::tvd_rk2, "time", "integrator", "is not built with formulation = \"pFp\", allowed: tvd_rk2");
  refuse(s.time.step == StepRule::paper, "time", "step", "is not built with formulation = \"pFp\", allowed: dual | edge");
}

/// The manufactured motion is exact between planes of symmetry, under its own body force alone.
template <class At>
void check_manufactured(const Scene& s, At at) {
  const auto refuse = [&](bool wrong, std::string_view section, std::string_view key, std::string_view why) {
    if (wrong) at(section, key, why);
  };
  const std::string_view why = "has no exact solution with initial.field = \"manufactured\"", audit = "does not book the body force of initial.field = \"manufactured\"";
  refuse(s.material.law == Law::hencky_j2, "material", "law", why);
  refuse(s.material.isochoric == Isochoric::J, "material", "isochoric", why);
  refuse(s.physics.formulation == Formulation::pFp, "physics", "formulation", why);
  refuse(s.physics.keep_angular_momentum, "physics", "keep_angular_momentum", audit);
  refuse(s.monitor.energy, "monitor", "energy", audit);
  refuse(s.body_force != Vec3{}, "body_force", "g", why);
  std::vector<std::string_view> missing{"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};
  bool symmetric = true;
  for (const BoundarySpec& b : s.boundary) {
    symmetric = symmetric && b.kind == BoundaryKind::symmetric;
    for (const Named& face : b.faces) std::erase(missing, face.name);
  }
  refuse(!symmetric || !missing.empty(), "initial", "field", "needs kind = \"symmetric\" on all six faces of a box");
  bool planes = s.mesh.source == MeshSource::box;
  for (std::size_t k = 0; k < 3; ++k)
    for (const double X : {s.mesh.origin[k], s.mesh.origin[k] + s.mesh.size[k]}) {
      const double halves = X / s.initial.length;
      planes = planes && std::abs(halves - std::round(halves)) < 1e-9;
    }
  refuse(!planes, "initial", "length", "the faces of mesh.box must lie on multiples of it");
}

/// What current area vectors are not built with.
template <class At>
void check_current_areas(const Scene& s, At at) {
  const PhysicsSpec& p = s.physics;
  if (!has_current_areas(p.description)) return;
  const auto refuse = [&](bool wrong, std::string_view section, std::string_view key, std::string_view allowed) {
    if (wrong) at(section, key, fmt::format("is not built with description = \"{}\", allowed: {}", word(p.description), allowed));
  };
  if (p.formulation != Formulation::pFJ) at("physics", "description", fmt::format("needs formulation = \"pFJ\"; {}", what_is_built));
  refuse(s.material.law == Law::linear_elastic, "material", "law", "neo_hookean | mooney_rivlin | hencky_j2");
  refuse(p.stabilisation != Stabilisation::upwind, "physics", "stabilisation", "upwind");
  refuse(p.pressure_jump != PressureJump::scalar, "physics", "pressure_jump", "scalar");
  refuse(p.reconstruction == Reconstruction::limited, "physics", "reconstruction", "constant | linear");
  refuse(p.flux_correction != FluxCorrection::none, "physics", "flux_correction", "none");
  refuse(p.boundary_flux != BoundaryFlux::adjoint, "physics", "boundary_flux", "adjoint");
  refuse(p.entropy_fix != EntropyFix::none, "physics", "entropy_fix", "none");
}

}  // namespace

void check_together(Table& root, const Scene& s) {
  // A section is reached through a table of its own: what it does not read here was reported before.
  const auto table_of = [&](std::string_view section) -> const toml::table* {
    const std::size_t dot = section.find('.');
    const toml::node* node = root.find(section.substr(0, dot));
    if (const auto* list = node ? node->as_array() : nullptr) node = list->get(dot == section.npos ? 0 : std::stoul(std::string(section.substr(dot + 1))));
    return node ? node->as_table() : nullptr;
  };
  const auto at = [&](std::string_view section, std::string_view key, std::string_view why) {
    if (const auto* t = table_of(section)) Table(*t, std::string(section), root.diagnostics()).fail(key, why);
  };
  const auto sound = [&](const std::string& path) { return !root.diagnostics().wrong.contains(path); };
  const auto materials = materials_of(s);
  const auto* written = root.find("material") ? root.find("material")->as_array() : nullptr;
  const auto section_of = [&](std::size_t i) { return written ? fmt::format("material.{}", i) : std::string("material"); };
  bool laws_sound = true;
  for (std::size_t i = 0; i < materials.size(); ++i) laws_sound = laws_sound && sound(section_of(i) + ".law");
  if (sound("physics.formulation") && s.physics.formulation == Formulation::pF) {
    const std::string_view why = "needs an evolved J, which formulation = \"pF\" does not carry";
    for (std::size_t i = 0; i < materials.size(); ++i)
      if (materials[i].isochoric == Isochoric::J) at(section_of(i), "isochoric", why);
    if (s.initial.J == InitialJ::det) at("initial", "J", why);
    if (s.physics.pressure_jump == PressureJump::tensor) at("physics", "pressure_jump", why);
  }
  const auto at_sound = [&](std::string_view section, std::string_view key, std::string_view why) {
    const auto* t = table_of(section);
    if (t && t->contains(key) && sound(fmt::format("{}.{}", section, key))) at(section, key, why);
  };
  for (std::size_t i = 0; i < materials.size(); ++i)
    if (sound("physics.formulation") && materials[i].poissons_ratio == 0.5 && s.physics.formulation != Formulation::pFp)
      at_sound(section_of(i), "poissons_ratio", "must be below 0.5 unless physics.formulation = \"pFp\"");
  if (sound("physics.formulation")) check_projection(s, section_of(0), at_sound);
  if (sound("physics.description")) check_current_areas(s, at_sound);
  if (!s.materials.empty()) check_several(s, at_sound);
  if (sound("physics.stabilisation") && s.physics.stabilisation == Stabilisation::jst && s.monitor.energy)
    at("monitor", "energy", "audits the upwind stabilisation only, not jst");
  if (sound("physics.stabilisation") && s.physics.stabilisation == Stabilisation::jst && s.monitor.entropy)
    at("monitor", "entropy", "counts the edges of the upwind stabilisation only, not of jst");
  if (sound("physics.keep_angular_momentum") && s.physics.keep_angular_momentum && sound("time.integrator") && s.time.integrator != Integrator::tvd_rk2)
    at("physics", "keep_angular_momentum", "needs time.integrator = \"tvd_rk2\": for the stages of ssp_rk3 no arms are built that keep it exactly");
  if (sound("initial.field") && sound("initial.length") && s.initial.field == InitialField::manufactured) check_manufactured(s, at);
  if (sound("monitor.energy") && !s.monitor.energy) {
    if (s.monitor.energy_growth != EnergyGrowth::warn) at("monitor", "energy_growth", "needs monitor.energy = true");
    if (s.monitor.energy_tolerance != MonitorSpec{}.energy_tolerance) at("monitor", "energy_tolerance", "needs monitor.energy = true");
  }
  const bool wave = s.initial.field == InitialField::standing_wave || s.initial.field == InitialField::plane_wave;
  const auto shows_plastic = [](const std::vector<std::string>& fields) { return std::find(fields.begin(), fields.end(), "plastic_strain") != fields.end(); };
  if (laws_sound && !has_plasticity(s)) {
    const std::string_view why = "plastic_strain needs material.law = \"hencky_j2\"";
    if (sound("output.fields") && shows_plastic(s.output.fields)) at("output", "fields", why);
    for (const ProbeSpec& p : s.output.probes)
      if (shows_plastic(p.fields)) at("output", "probes", fmt::format("{}.fields: {}", p.name, why));
  }
  if (wave && s.materials.empty() && laws_sound && s.material.law != Law::linear_elastic)
    at("initial", "field", "needs material.law = \"linear_elastic\": its exact solution is linear");
}

}  // namespace nanson
