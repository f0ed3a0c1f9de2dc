// Reads a scene with a run's settings as the child will, and turns "--set #n" into the line of the study file.
#include "io/study/study_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "engine/initial.hpp"
#include "engine/output_field.hpp"
#include "io/mesh/read_mesh.hpp"
#include "io/scene/read_scene.hpp"
#include "io/scene/words.hpp"
#include "io/text_file.hpp"

namespace nanson {
namespace {

/// Meshes are made once for the runs that share them, one after another.
struct MeshCache {
  std::string key;
  Mesh mesh;
  std::vector<std::string> errors;
};

std::string mesh_key(const MeshSpec& m, const UsedNames& used) {
  return fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {}", word(m.source), fmt::join(m.origin, " "),
                     fmt::join(m.size, " "), fmt::join(m.cells, " "), word(m.split), m.perturb, m.radius, m.length,
                     word(m.sector), m.inner, m.outer, m.angle, m.file.name, word(m.regions.axis),
                     fmt::join(m.regions.at, " "), fmt::join(m.regions.names, " "), fmt::join(used.faces, " "),
                     fmt::join(used.regions, " "));
}

const Mesh& mesh_of(MeshCache& cache, const Scene& scene) {
  const UsedNames used = used_names(scene);
  std::string key = mesh_key(scene.mesh, used);
  if (cache.key == key) return cache.mesh;
  cache.key = std::move(key);
  cache.errors.clear();
  std::vector<std::string> notes;  // the runs tell them
  cache.mesh = load_mesh(scene.mesh, used, cache.errors, notes);
  return cache.mesh;
}

/// "--set #3: ..." said at the place in the study file that sets it.
std::string placed(const std::string& error, const PlannedRun& run) {
  constexpr std::string_view mark = "--set #";
  if (!error.starts_with(mark)) return error;
  char* rest = nullptr;
  const auto number = static_cast<std::size_t>(std::strtol(error.c_str() + mark.size(), &rest, 10));
  return number >= 1 && number <= run.settings.size() ? run.settings[number - 1].where + rest : error;
}

bool does_work(const Scene& s) {
  const auto works = [](const BoundarySpec& b) {
    return b.kind == BoundaryKind::traction || b.kind == BoundaryKind::pressure || b.kind == BoundaryKind::velocity;
  };
  return std::any_of(s.boundary.begin(), s.boundary.end(), works)
         || std::any_of(s.body_force.begin(), s.body_force.end(), [](double g) { return g != 0; })
         || s.initial.field == InitialField::manufactured;
}

/// Files by name, then lines and columns as numbers.
bool stands_before(const std::string& a, const std::string& b) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (digit(a[i]) && digit(b[j])) {
      char *end_a = nullptr, *end_b = nullptr;
      const unsigned long long x = std::strtoull(&a[i], &end_a, 10), y = std::strtoull(&b[j], &end_b, 10);
      if (x != y) return x < y;
      i = static_cast<std::size_t>(end_a - a.data());
      j = static_cast<std::size_t>(end_b - b.data());
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i;
      ++j;
    }
  }
  return a.size() - i < b.size() - j;
}

/// Why this scene's summary will not have the quantity; empty when it will, or may.
std::string missing_quantity(const Scene& s, const std::string& name) {
  if (name.starts_with("errors.") && !has_exact_solution(s)) return "no exact solution of this scene is known";
  if (name.starts_with("projection.") && s.physics.formulation != Formulation::pFp)
    return "needs physics.formulation = \"pFp\"";
  for (const char* audited : {"energy.external_work", "energy.dissipated", "energy.closure"})
    if (name == audited && !s.monitor.energy) return "needs monitor.energy = true";
  if ((name == "least_tet_ratio" || name.starts_with("extremes.least_tet_ratio"))
      && s.monitor.geometry == GeometryWatch::off)
    return "needs monitor.geometry = \"warn\" or \"stop\"";
  if (!name.starts_with("probes.")) return "";
  std::vector<std::string> known;
  for (const ProbeSpec& p : s.output.probes)
    for (const std::string& field : p.fields) {
      for (int k = 0; k < field_named(field).components; ++k)
        known.push_back(fmt::format("probes.{}.{}.{}", p.name, field, k));
    }
  return std::find(known.begin(), known.end(), name) != known.end() ? "" : unknown_word("probe value", name, known);
}

}  // namespace

std::vector<StudyRun> prepare(const Study& study, std::vector<std::string>& errors) {
  std::vector<StudyRun> runs;
  std::set<std::string> said;
  MeshCache cache;
  const auto say = [&](const std::string& error) {
    if (said.insert(error).second) errors.push_back(error);
  };
  for (PlannedRun& planned : plan(study)) {
    StudyRun run;
    std::vector<std::string> settings;
    for (const StudySetting& s : planned.settings) settings.push_back(fmt::format("{}={}", s.key, s.value));
    SceneResult read = read_scene(planned.scene, settings);
    for (const std::string& error : read.errors) say(placed(error, planned));
    if (read.mesh_valid) {
      const Mesh& mesh = mesh_of(cache, read.scene);
      for (const std::string& error : cache.errors) say(placed(error, planned));
      if (cache.errors.empty())
        for (const std::string& error : check_names(read.scene, mesh)) say(placed(error, planned));
      run.cost = std::pow(static_cast<double>(mesh.X.size()), 4.0 / 3) * read.scene.time.end / read.scene.time.cfl;
    }
    if (read.errors.empty())
      for (const auto& [name, where] : study.report.where)
        if (const std::string why = missing_quantity(read.scene, name); !why.empty())
          say(fmt::format("{} = \"{}\": {} ({})", where, name, why, planned.scene.string()));
    std::string why;
    const std::string mesh_text = read.scene.mesh.source == MeshSource::file
                                      ? read_text_file(read.scene.mesh.file.name, why).value_or("")
                                      : "";
    run.hash = text_hash(fmt::format("{}\n{}\nthreads = {}", read.resolved, mesh_text, study.threads));
    run.arguments = {"run", planned.scene.string(), "--threads", std::to_string(study.threads)};
    for (const std::string& s : settings) run.arguments.insert(run.arguments.end(), {"--set", s});
    run.rules = {study.report.energy_tolerance, study.report.checkerboard_max, study.report.max_wall_s,
                 does_work(read.scene)};
    run.plan = std::move(planned);
    runs.push_back(std::move(run));
  }
  std::stable_sort(errors.begin(), errors.end(), stands_before);
  return runs;
}

}  // namespace nanson
