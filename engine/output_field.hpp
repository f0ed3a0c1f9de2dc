// The nodal fields that a run can write: name, shape, unit and how each is computed, in the one table that scene, writers, probes and reference share.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace nanson {

struct Simulation;

struct Field {
  std::string_view name;
  int components;  // 1 | 3 | 9: a tensor row by row
  std::string_view unit, sentence;
  void (*at)(const Simulation& s, int node, double* out);  // at one node of the mesh
};

std::span<const Field> output_fields();

/// nullptr when no field is called so.
const Field* find_field(std::string_view name);

/// The same for a name that was checked: throws std::invalid_argument.
const Field& field_named(std::string_view name);

std::vector<std::string_view> output_field_names();

/// Ending of a component in a column's name: none, _x _y _z, or _11 _12 ... _33.
std::string component_ending(const Field& f, int c);

}  // namespace nanson
