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
  if (!t.read("file", name) || !t.has("file")) return;
  m.file = {(folder / name).string(), where(t.diagnostics(), t.place("file"))};
  std::error_code error;
  if (!std::filesystem::is_regular_file(m.file.name, error))
    t.fail("file", fmt::format("there is no file {}", m.file.name));
}

/// The core of a quarter is m x m cells, m half the tangential ones.
void read_cylinder_cells(Table& t, MeshSpec& m) {
  if (!t.require("cells", m.cells, {.from = 1})) return;
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
    if (inner && outer && m.outer <= m.inner)
      n.fail("outer", fmt::format("must be above mesh.needle.inner, {:g}", m.inner));
    n.require("angle", m.angle, {.above = 0, .to = 90});
  });
  read_mesh_file(t, m, folder);
  if (m.source == MeshSource::file)
    return t.only("file", {}, std::array<std::string_view, 4>{"cells", "split", "perturb", "regions"});
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
  t.read("upwind_metric", p.upwind_metric);  // both words also with linear_elastic: there H = I and they agree
  t.read("entropy_fix", p.entropy_fix);
  t.read("parting", p.parting, {.from = 0});
  t.read("keep_angular_momentum", p.keep_angular_momentum);
}

void read_projection(Table& t, ProjectionSpec& p) {
  if (read_kind<ProjectionSolver>(t, "solver", p.solver, false, {{ProjectionSolver::pseudo_time, {"length_scale"}}})
      && p.solver == ProjectionSolver::pseudo_time)
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
  t.read("cfl", s.cfl, {.above = 0, .to = 2});  // no explicit scheme is stable above: larger is a slip of the pen
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

}  // namespace nanson
