// Wires a simulation to its files: the observer writes, the engine computes.
#include "io/run.hpp"

#include <fmt/format.h>

#include "engine/bandwidth.hpp"
#include "engine/mesh/mesh_quality.hpp"
#include "engine/monitor.hpp"
#include "engine/pieces.hpp"
#include "engine/solver.hpp"
#include "engine/summarise.hpp"
#include "engine/throughput.hpp"
#include "io/peak_memory.hpp"
#include "io/print.hpp"
#include "io/progress.hpp"
#include "io/provenance.hpp"
#include "io/restart.hpp"
#include "io/results/results_folder.hpp"
#include "io/results/write_fields.hpp"
#include "io/results/write_history.hpp"
#include "io/results/write_summary.hpp"
#include "io/signals.hpp"

namespace nanson {
namespace {

void say(const RunOptions& options, const std::string& line) {
  if (!options.quiet) {
    print(stdout, "{}\n", line);
    std::fflush(stdout);
  }
}

/// "1.93 s: mesh 0.40, dual 0.35, metis 0.80 (41 %), ..."
std::string setup_text(const Clock& setup) {
  std::string text;
  for (const SweepTime& s : setup.sweeps)
    text += fmt::format("{}{} {:.2f}{}", text.empty() ? "" : ", ", s.sweep, s.seconds,
                        s.sweep == "metis" ? fmt::format(" ({:.0f} %)", 100 * s.seconds / setup.total()) : "");
  return fmt::format("{:.2f} s: {}", setup.total(), text);
}

void print_start(const RunOptions& options, Simulation& s, const std::vector<Probe>& probes,
                 const std::filesystem::path& folder) {
  const Energies e = energies(s);
  const Momenta m = momenta(s);
  say(options,
      fmt::format("{}: {} nodes, {} tets, {} edges in {} parts, {} thread{}, {:.0f} bytes a node", s.domain.scene->name,
                  s.domain.order.nodes, s.domain.mesh->tets.size(), s.domain.edges, s.domain.order.parts.size(),
                  s.team.threads, s.team.threads == 1 ? "" : "s", bytes_per_node(s)));
  say(options, "set-up: " + setup_text(s.team.setup));
  say(options, fmt::format("start: mass {:.6g} kg, volume {:.6g} m^3, kinetic {:.6g} J, strain {:.6g} J, momentum "
                           "({:.4g}, {:.4g}, {:.4g}) kg m/s, angular momentum "
                           "({:.4g}, {:.4g}, {:.4g}) kg m^2/s",
                           s.books.mass, s.books.volume, e.kinetic, e.strain, m.linear[0], m.linear[1], m.linear[2],
                           m.angular[0], m.angular[1], m.angular[2]));
  if (s.books.lost_at_start > 1e-12 * s.books.initial_energy)
    say(options, fmt::format("start: the supports remove {:.4g} J of kinetic energy from the initial velocity",
                             s.books.lost_at_start));
  if (s.domain.mesh->reoriented > 0)
    say(options, fmt::format("mesh: {} tets were inverted and have been turned", s.domain.mesh->reoriented));
  if (s.domain.mesh->unnamed_faces > 0)
    say(options, fmt::format("mesh: {} boundary triangles have no name: free", s.domain.mesh->unnamed_faces));
  if (!s.domain.boundary.free_faces.empty())
    say(options,
        fmt::format("faces that no [[boundary]] names are free: {}", fmt::join(s.domain.boundary.free_faces, " ")));
  if (auto large = cfl_warning(*s.domain.scene)) warn(s, "cfl", *large);
  const std::vector<Piece> bodies = pieces(s);
  if (bodies.size() > 1)
    for (const std::string& line : piece_lines(bodies, mesh_quality(*s.domain.mesh).min_edge)) say(options, line);
  if (const std::string loose = loose_piece(bodies); !loose.empty()) warn(s, "loose_piece", loose);
  if (s.domain.order.metis_failed) say(options, "order: METIS failed; one RCM numbering was cut into parts instead");
  for (const Probe& p : probes)
    say(options, p.place.tet >= 0
                     ? fmt::format("probe {}: in tet {}", p.spec.name, p.place.tet)
                     : fmt::format("probe {}: outside the mesh, nearest node {} at ({:.6g}, {:.6g}, {:.6g})",
                                   p.spec.name, p.place.nodes[0], p.place.at[0], p.place.at[1], p.place.at[2]));
  say(options, fmt::format("results: {}", folder.string()));
}

struct Results {
  FieldWriter fields;
  HistoryWriter history;
  ResultsPosition position() const {
    return {std::int64_t(history.size()), std::int64_t(fields.frames()), std::int64_t(fields.bytes())};
  }
};

std::vector<Field> fields_of(const Scene& scene) {
  std::vector<Field> fields;
  for (const std::string& name : scene.output.fields) fields.push_back(field_named(name));
  return fields;
}

Results new_results(const RunOptions& options, ResultsFolder& folder, const Simulation& s,
                    const std::vector<HistoryColumn>& columns, const Provenance& from) {
  const std::string earlier = folder.begin(options.force);
  if (!earlier.empty() && !options.force) print(stderr, "{}\n", earlier);  // with `quiet` too
  else if (!earlier.empty()) say(options, earlier);
  const Scene& scene = *s.domain.scene;
  return {{folder.path(), *s.domain.mesh, fields_of(scene), results_attributes(from, s.team.threads, scene.text),
           scene.output.compress},
          {folder.path() / "history.csv", columns}};
}

/// History and fields of a checkpoint, cut back to it; or new ones where columns or fields are others.
Results go_on_with_results(const RunOptions& options, ResultsFolder& folder, const Restart& restart,
                           const Simulation& s, const std::vector<HistoryColumn>& columns, const Provenance& from) {
  namespace fs = std::filesystem;
  const Scene& scene = *s.domain.scene;
  const std::string ended = results_end(restart, columns, scene);
  for (const std::string& line : restart.lines) print(stderr, "{}\n", line);
  say(options,
      fmt::format("goes on from {}: step {}, t = {:.6g} s", restart.from.path.string(), s.state.step, s.state.t));
  if (!ended.empty()) {
    print(stderr, "results begin anew at t = {:.6g} s: {}\n", s.state.t, ended);
    return new_results(options, folder, s, columns, from);
  }
  const ResultsPosition& at = restart.from.results;
  const fs::path history = folder.path() / "history.csv";
  if (fs::equivalent(restart.results, folder.path())) {
    fs::remove(folder.path() / "summary.json");  // what it says of an end is over
    make_newest(restart.from, folder.path());
  } else {
    if (const std::string earlier = folder.begin(options.force); !earlier.empty()) print(stderr, "{}\n", earlier);
    fs::copy_file(restart.results / "history.csv", history);
  }
  return {{folder.path(), *s.domain.mesh, fields_of(scene), results_attributes(from, s.team.threads, scene.text),
           scene.output.compress,
           EarlierFrames{restart.results / "run.vtkhdf", std::size_t(at.frames), std::size_t(at.fields_bytes)}},
          {history, columns, std::size_t(at.history_bytes)}};
}

}  // namespace

int run_scene(const Loaded& loaded, const RunOptions& options) {
  const Scene& scene = loaded.scene;
  ResultsFolder folder(scene.name, options.out);
  std::optional<Restart> restart;
  if (options.restart) restart = find_restart(loaded, options.restart->empty() ? folder.path() : *options.restart);
  Simulation s = make_simulation(scene, loaded.mesh, options.threads);
  s.team.setup.add("mesh", loaded.mesh_s);
  if (restart) go_on_from(*restart, s);
  const std::vector<Probe> probes = place_probes(scene, loaded.mesh);
  const Provenance from = provenance();
  const std::vector<HistoryColumn> columns = history_columns(s, probes);
  Results results = restart ? go_on_with_results(options, folder, *restart, s, columns, from)
                            : new_results(options, folder, s, columns, from);
  std::size_t warned = s.watch.warnings.size();  // before the checkpoint
  for (const std::string& note : loaded.notes) say(options, note);
  print_start(options, s, probes, folder.path());
  CheckpointWriter checkpoints(folder.path(), loaded.resolved, from);

  Progress progress(s.state.t, scene.time.end, options.quiet);
  catch_stop_signals();
  double checkpoint_at = wall_seconds();
  std::vector<float> buffer;
  Observer observer;
  observer.on_step = [&](const Simulation& now) {
    progress.update(now.state.step, now.state.t, now.state.dt, std::nullopt);
    for (; warned < now.watch.warnings.size(); ++warned)
      progress.message("warning: " + now.watch.warnings[warned].text);
  };
  observer.on_history = [&](const Simulation& now) { results.history.row(history_row(now, columns)); };
  observer.on_frame = [&](const Simulation& now) {
    results.fields.frame(now.state.t, now.state.step, now.breakdown.has_value(), [&](const Field& f) {
      buffer = field(now, f);
      return std::span<const float>(buffer);
    });
  };
  s.state.projection.asked_to_stop = [most_s = scene.time.max_wall_s, start = wall_seconds()] {
    return stop_signal() != 0 || (most_s > 0 && wall_seconds() - start >= most_s);
  };
  observer.on_checkpoint = [&](const Simulation& now, bool ends) {
    const bool asked = checkpoint_signal();
    const double every = scene.output.checkpoint_every, time = wall_seconds();
    if (!ends && !asked && !(every > 0 && time - checkpoint_at >= every)) return;
    try {
      checkpoints.write(now, results.position());
      if (asked)
        progress.message(fmt::format("checkpoint of step {}, t = {:.6g} s written", now.state.step, now.state.t));
    } catch (const std::runtime_error& e) {
      progress.message(fmt::format("warning: {}", e.what()));
    }
    checkpoint_at = wall_seconds();
  };
  observer.stop = [] { return stop_signal() ? fmt::format("signal {}", stop_signal()) : std::string(); };
  std::string reason;
  const std::string status = run(s, observer, reason);
  results.fields.finish();
  Summary summary = summarise(s, probes, status, reason);
  summary.peak_bytes = peak_bytes();  // before the bandwidth is measured, which takes 128 MB
  summary.throughput = throughput(s, 0);
  write_summary(folder.path() / "summary.json", summary, from);
  if (!options.quiet && summary.throughput) {   // again with the bandwidth: nothing is lost if its measurement fails
    constexpr std::size_t beyond_L3 = 8 << 20;  // doubles: 64 MB an array
    summary.throughput = throughput(s, update_bandwidth(s.team.threads, beyond_L3, 3));
    write_summary(folder.path() / "summary.json", summary, from);
  }
  if (!reason.empty()) progress.message(status + ": " + reason);
  for (const std::string& warning : summary.warnings) progress.message("warning: " + warning);
  progress.end();
  for (const std::string& line : closing_lines(summary)) say(options, line);
  say(options, fmt::format("results in {}", folder.path().string()));
  if (status == "stopped") say(options, "the run goes on from here with --restart");
  return status == "breakdown" ? 3 : stop_signal() ? 128 + stop_signal() : 0;
}

}  // namespace nanson
