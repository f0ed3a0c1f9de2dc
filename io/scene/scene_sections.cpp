// The sections of a scene that are read key by key. Defaults stand in engine/scene.hpp.
#include "io/scene/scene_sections.hpp"

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
    t.fail("cells",
           fmt::format("makes {:.3g} nodes and {:.3g} tets, at most {} of each can be numbered", nodes, tets, limit));
}

void read_mesh_file(Table& t, MeshSpec& m, const std::filesystem::path& folder) {
  std::string name;
  if (!t.read(key("mesh.file"), name) || !t.has("file")) return;
  m.file = {(folder / name).string(), where(t.diagnostics(), t.place("file"))};
  std::error_code error;
  if (!std::filesystem::is_regular_file(m.file.name, error))
    t.fail("file", fmt::format("there is no file {}", m.file.name));
}

/// The core of a quarter is m x m cells, m half the tangential ones.
void read_cylinder_cells(Table& t, MeshSpec& m) {
  if (!t.read(key("mesh.cells", "cylinder"), m.cells)) return;
  if (m.cells[1] % 2 != 0)
    return t.fail(
        "cells",
        fmt::format("the second number, {} tangential cells, must be even: half of them bound the core on each side",
                    m.cells[1]));
  if (m.cells[0] <= m.cells[1] / 2)
    return t.fail(
        "cells",
        fmt::format("the first number, {} radial cells, must be above half the second, {}, which the core takes",
                    m.cells[0], m.cells[1] / 2));
  check_count(t, m.cells);
}

bool normalise(Vec3& direction) {
  const double largest = std::max({std::abs(direction[0]), std::abs(direction[1]), std::abs(direction[2])});
  if (largest == 0) return false;
  for (double& x : direction) x /= largest;  // first, so that no square over- or underflows
  const double length = std::hypot(direction[0], direction[1], direction[2]);
  for (double& x : direction) x /= length;
  return true;
}

void read_rotation(Table& t, InitialSpec& s) {
  t.read(key("initial.omega", "rotation"), s.omega);
  const toml::node* centre = t.find(key("initial.centre"));
  if (!centre || (centre->is_string() && centre->as_string()->get() == "mass")) return;
  Vec3 at{};
  if (centre->is_string()) t.fail("centre", "must be \"mass\" or three numbers");
  else if (t.read(key("initial.centre"), at)) s.centre = at;
}

}  // namespace

KindKeys kind_keys(std::span<const Key> table, std::string_view section, std::string_view word) {
  KindKeys keys;
  const auto add = [](std::vector<std::string_view>& names, std::string_view name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const Key& k : table) {
    if (k.section() != section || k.rules.of.empty()) continue;
    add(keys.all, k.name());
    if (k.is_of(word)) add(keys.own, k.name());
  }
  return keys;
}

void read_mesh_section(Table& t, MeshSpec& m, const std::filesystem::path& folder) {
  std::string beside;
  for (const std::string_view source : words(m.source)) {
    if (!t.has(source)) continue;
    if (!beside.empty())
      t.fail(source,
             fmt::format("stands beside mesh.{}, exactly one of {} is allowed", beside, join_words(words(m.source))));
    else beside = source;
  }
  if (beside.empty())
    t.missing({"box", "cylinder", "needle", "file"},
              fmt::format("mesh: exactly one of {} is needed", join_words(words(m.source))));
  if (beside == "cylinder") m.source = MeshSource::cylinder;
  if (beside == "needle") m.source = MeshSource::needle;
  if (beside == "file") m.source = MeshSource::file;
  t.section(key("mesh.box"), [&](Table& b) {
    b.read(key("mesh.box.origin"), m.origin);
    b.read(key("mesh.box.size"), m.size);
  });
  t.section(key("mesh.cylinder"), [&](Table& c) {
    c.read(key("mesh.cylinder.radius"), m.radius);
    c.read(key("mesh.cylinder.length"), m.length);
    c.read(key("mesh.cylinder.sector"), m.sector);
  });
  t.section(key("mesh.needle"), [&](Table& n) {
    const bool inner = n.read(key("mesh.needle.inner"), m.inner), outer = n.read(key("mesh.needle.outer"), m.outer);
    if (inner && outer && m.outer <= m.inner)
      n.fail("outer", fmt::format("must be above mesh.needle.inner, {:g}", m.inner));
    n.read(key("mesh.needle.angle"), m.angle);
  });
  read_mesh_file(t, m, folder);
  const KindKeys keys = kind_keys(scene_keys, "mesh", word(m.source));
  t.only(word(m.source), keys.own, keys.all);
  if (m.source == MeshSource::cylinder) read_cylinder_cells(t, m);
  if (m.source == MeshSource::needle && t.read(key("mesh.cells", "needle"), m.cells)) check_count(t, m.cells);
  if (m.source != MeshSource::box) return;
  if (t.read(key("mesh.cells", "box"), m.cells)) check_count(t, m.cells);
  t.read(key("mesh.split"), m.split);
  t.read(key("mesh.perturb"), m.perturb);
  read_regions(t, m);
}

void read_physics(Table& t, PhysicsSpec& p) {
  t.read(key("physics.formulation"), p.formulation);
  t.read(key("physics.description"), p.description);
  t.read(key("physics.stabilisation"), p.stabilisation);
  t.read(key("physics.pressure_jump"), p.pressure_jump);
  t.read(key("physics.reconstruction"), p.reconstruction);
  t.read(key("physics.flux_correction"), p.flux_correction);
  t.read(key("physics.boundary_flux"), p.boundary_flux);
  t.read(key("physics.upwind_metric"),
         p.upwind_metric);  // both words also with linear_elastic: there H = I and they agree
  t.read(key("physics.entropy_fix"), p.entropy_fix);
  t.read(key("physics.parting"), p.parting);
  t.read(key("physics.tet_stiffness"), p.tet_stiffness);
  t.read(key("physics.tet_barrier"), p.tet_barrier);
  t.read(key("physics.keep_angular_momentum"), p.keep_angular_momentum);
}

void read_projection(Table& t, ProjectionSpec& p) {
  if (read_kind(t, key("projection.solver"), p.solver) && p.solver == ProjectionSolver::pseudo_time)
    t.read(key("projection.length_scale"), p.length_scale);
  t.read(key("projection.stabilisation"), p.stabilisation);
  t.read(key("projection.drift_control"), p.drift_control);
  t.read(key("projection.tolerance"), p.tolerance);
  t.read(key("projection.max_iterations"), p.max_iterations);
  t.read(key("projection.on_limit"), p.on_limit);
}

void read_initial(Table& t, InitialSpec& s) {
  using enum InitialField;
  read_kind(t, key("initial.field"), s.field);
  if (s.field == velocity) t.read(key("initial.v"), s.v);
  if (s.field == rotation) read_rotation(t, s);
  if (s.field == twist) {
    t.read(key("initial.omega", "twist"), s.twist_omega);
    if (t.read(key("initial.height", "twist"), s.height) && s.height == 0) t.fail("height", "must not be zero");
  }
  if (s.field == punch) {
    t.read(key("initial.v0"), s.v0);
    t.read(key("initial.height", "punch"), s.height);
  }
  if (s.field == plate_mode) {
    t.read(key("initial.amplitude", "plate_mode"), s.amplitude);
    t.read(key("initial.omega", "plate_mode"), s.mode_omega);
    t.read(key("initial.B"), s.B);
  }
  if (s.field == standing_wave) t.read(key("initial.amplitude", "standing_wave"), s.amplitude);
  if (s.field == standing_wave || s.field == plane_wave) t.read(key("initial.J"), s.J);
  if (s.field == plane_wave) {
    t.read(key("initial.amplitude", "plane_wave"), s.amplitude);
    t.read(key("initial.length", "plane_wave"), s.length);
    if (t.read(key("initial.direction"), s.direction) && !normalise(s.direction))
      t.fail("direction", "must not be zero");
  }
  if (s.field == manufactured) {
    t.read(key("initial.amplitudes"), s.amplitudes);
    t.read(key("initial.length", "manufactured"), s.length);
    t.read(key("initial.period"), s.period);
  }
}

void read_time(Table& t, const PhysicsSpec& physics, TimeSpec& s) {
  t.read(key("time.end"), s.end);
  if (physics.formulation == Formulation::pFp) s.integrator = Integrator::ssp_rk3;
  t.read(key("time.integrator"), s.integrator);
  if (s.integrator == Integrator::ssp_rk3) s.cfl = 0.6;
  t.read(key("time.cfl"), s.cfl);  // no explicit scheme is stable above: larger is a slip of the pen
  t.read(key("time.step"), s.step);
  t.read(key("time.dt_max"), s.dt_max);
  t.read(key("time.dt_collapse"), s.dt_collapse);
  t.read(key("time.max_steps"), s.max_steps);
  t.read(key("time.max_wall_s"), s.max_wall_s);
}

void read_monitor(Table& t, MonitorSpec& m) {
  t.read(key("monitor.energy"), m.energy);
  t.read(key("monitor.entropy"), m.entropy);
  t.read(key("monitor.involutions"), m.involutions);
  t.read(key("monitor.geometry"), m.geometry);
  t.read(key("monitor.energy_growth"), m.energy_growth);
  t.read(key("monitor.energy_tolerance"), m.energy_tolerance);
}

}  // namespace nanson
