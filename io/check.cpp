// Mesh quality, the places that set the step, steps, time and memory, and what the scene leaves out.
#include "io/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/compensated_sum.hpp"
#include "engine/mesh/mesh_quality.hpp"
#include "engine/monitor.hpp"
#include "engine/pieces.hpp"
#include "engine/solver.hpp"
#include "io/print.hpp"
#include "io/progress.hpp"

namespace nanson {
namespace {

void print_limits(const Simulation& s) {
  print(stdout, "smallest steps (cfl {:g}, step {}):\n", s.domain.scene->time.cfl, word(s.domain.scene->time.step));
  for (const auto& [node, dt] : limiting_nodes(s, 10)) {
    const Vec3& X = s.domain.mesh->X[static_cast<std::size_t>(node)];
    nanson::print(stdout, "  dt {:.4e} s at node {} ({:.6g}, {:.6g}, {:.6g}) m, tets {}\n", dt, node, X[0], X[1], X[2],
                  fmt::join(tets_around(*s.domain.mesh, node), " "));
  }
}

/// What each of several materials takes up.
void print_materials(const Simulation& s) {
  for (std::size_t m = 0; m < s.domain.scene->materials.size(); ++m) {
    const MaterialSpec& spec = s.domain.scene->materials[m];
    const MaterialConstants& c = s.domain.mixture.laws[m].constants;
    CompensatedSum volume;
    for (int n = 0; n < s.domain.order.nodes; ++n)
      volume +=
          s.domain.volume[static_cast<std::size_t>(n)]
          * s.domain.mixture.share[m][static_cast<std::size_t>(s.domain.order.row_of[static_cast<std::size_t>(n)])];
    std::string regions;
    for (const Named& region : spec.regions) regions += (regions.empty() ? "" : " ") + region.name;
    print(stdout, "material {}: {}, volume {:.6g} m^3, mass {:.6g} kg, c_p {:.6g} m/s, c_s {:.6g} m/s\n", regions,
          word(spec.law), volume, volume * c.rho, c.cp, c.cs);
  }
}

/// Wall seconds of a step, best of a few: the state is thrown away afterwards.
double timed_step(Simulation& s) {
  double best = 1e300;
  for (int k = 0; k < 4; ++k) {
    s.state.dt = allowed_step(s);
    const double start = wall_seconds();
    advance(s);
    if (k > 0) best = std::min(best, wall_seconds() - start);
    if (s.breakdown) break;
  }
  return best;
}

}  // namespace

int check_scene(const Loaded& loaded, int threads) {
  const MeshQuality quality = mesh_quality(loaded.mesh);
  for (const std::string& note : loaded.notes) print(stdout, "{}\n", note);
  print(stdout, "{}", to_text(quality));
  Simulation s = make_simulation(loaded.scene, loaded.mesh, threads);
  const double dt = allowed_step(s), steps = std::ceil(loaded.scene.time.end / dt);
  print(stdout, "mass {:.6g} kg, initial energy {:.6g} J, {} edges, {} parts, set up in {:.2f} s\n", s.books.mass,
        s.books.initial_energy, s.domain.edges, s.domain.order.parts.size(), s.team.setup.total() + loaded.mesh_s);
  print_materials(s);
  if (const auto large = cfl_warning(loaded.scene)) print(stdout, "warning: {}\n", *large);
  const std::vector<Piece> bodies = pieces(s);
  for (const std::string& line : piece_lines(bodies, quality.min_edge)) print(stdout, "{}\n", line);
  if (const std::string loose = loose_piece(bodies); !loose.empty()) print(stdout, "warning: {}\n", loose);
  print_limits(s);
  const double seconds = timed_step(s);
  if (s.breakdown) print(stdout, "the first steps break down: {}\n", s.breakdown->text);
  else
    print(stdout, "about {:.0f} steps of {:.3e} s; {:.0f} ns per node-step on {} threads: {} without output\n", steps,
          dt, 1e9 * seconds / s.domain.order.nodes, s.team.threads, duration_text(steps * seconds));
  print(stdout, "memory {:.0f} bytes a node, {:.1f} MB\nfields:", bytes_per_node(s),
        1e-6 * bytes_per_node(s) * s.domain.order.nodes);
  for (const std::string& f : loaded.scene.output.fields) print(stdout, " {}", f);
  print(stdout, "\nnot paid for by this scene:\n");
  for (const std::string& f : fields_left_out(loaded.scene)) print(stdout, "  {}\n", f);
  return 0;
}

}  // namespace nanson
