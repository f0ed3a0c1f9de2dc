// The columns of history.csv and their values at the present step.
#pragma once
#include <string>
#include <vector>

#include "engine/fields.hpp"

namespace nanson {

struct HistoryColumn {
  std::string name;
  std::string unit;
};

struct Probe {
  ProbeSpec spec;
  ProbePlace place;
};
std::vector<Probe> place_probes(const Scene& scene, const Mesh& mesh);

std::vector<HistoryColumn> history_columns(const Simulation& s, const std::vector<Probe>& probes);
/// One value a column, in the same order.
std::vector<double> history_row(const Simulation& s, const std::vector<Probe>& probes);

/// Field of field_names by its name.
const FieldName& field_named(std::string_view name);

}  // namespace nanson
