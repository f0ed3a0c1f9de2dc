// The columns of history.csv, each with the value that it takes at the present step.
#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/fields.hpp"
#include "engine/monitor.hpp"

namespace nanson {

/// What the values of a row are taken from, found once for all of them.
struct Sample {
  const Simulation& s;
  Energies energy;
  Momenta momentum;
  Extrema extrema;
  EntropyProduction entropy;  // each of these two only with its monitor
  Involutions involutions;
};

/// A column that a run may have: the one table of them, which the reference tells too.
struct ColumnKind {
  std::string_view name, unit, sentence;
  bool (*has)(const Simulation& s);  // nullptr: always
  double (*value)(const Sample& r);
};
std::span<const ColumnKind> column_kinds();

struct HistoryColumn {
  std::string name;
  std::string unit;
  std::function<double(const Sample&)> value = {};
};

struct Probe {
  ProbeSpec spec;
  ProbePlace place;
};
std::vector<Probe> place_probes(const Scene& scene, const Mesh& mesh);

/// Those of the table that the scene asks for, then reactions by named face, then probes.
std::vector<HistoryColumn> history_columns(const Simulation& s, const std::vector<Probe>& probes);
/// One value a column, in the same order.
std::vector<double> history_row(const Simulation& s, const std::vector<HistoryColumn>& columns);

}  // namespace nanson
