// Runs a scene of configs/ in this process, with settings as on the command line, and keeps what the tests compare.
#pragma once
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "engine/monitor.hpp"
#include "engine/solver.hpp"
#include "engine/summarise.hpp"
#include "io/scene/load.hpp"

namespace nanson {

struct SceneRun {
  Summary summary;
  std::vector<HistoryColumn> columns;
  std::vector<std::vector<double>> history;
  double largest_energy = 0;  // largest (kinetic + strain - external work)/initial over the history rows

  /// The column of that name over all rows.
  std::vector<double> column(const std::string& name) const {
    for (std::size_t c = 0; c < columns.size(); ++c)
      if (columns[c].name == name) {
        std::vector<double> values;
        for (const auto& row : history) values.push_back(row[c]);
        return values;
      }
    ADD_FAILURE() << "no history column " << name;
    return {};
  }
};

inline SceneRun run_config(const std::string& scene, const std::vector<std::string>& settings = {}, int threads = 2,
                           const std::function<void(const Simulation&)>& at_end = {}) {
  SceneRun out;
  std::vector<std::string> errors;
  const auto loaded = load(std::string(NANSON_SOURCE_DIR) + "/configs/" + scene, settings, errors);
  for (const std::string& e : errors) ADD_FAILURE() << e;
  if (!loaded) return out;
  Simulation s = make_simulation(loaded->scene, loaded->mesh, threads);
  const std::vector<Probe> probes = place_probes(loaded->scene, loaded->mesh);
  out.columns = history_columns(s, probes);
  Observer observer;
  observer.on_history = [&](const Simulation&) {
    out.history.push_back(history_row(s, out.columns));
    const Energies e = energies(s);
    out.largest_energy = std::max(out.largest_energy,
                                  (e.kinetic + e.strain - s.books.external_work) / s.books.initial_energy);
  };
  std::string reason;
  const std::string status = run(s, observer, reason);
  out.summary = summarise(s, probes, status, reason);
  if (at_end) at_end(s);
  return out;
}

}  // namespace nanson
