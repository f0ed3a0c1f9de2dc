// What a run is between two steps, number by number and array by array: all that a checkpoint keeps.
#pragma once
#include <algorithm>
#include <span>
#include <type_traits>
#include <vector>

#include "engine/simulation.hpp"

namespace nanson {

/// The one list of the numbers that a run goes on with beside its arrays: visit(name, number), a double, long, int, bool or Vec3.
template <class SomeSimulation, class Visit>
void each_number(SomeSimulation& s, Visit visit) {
  auto& u = s.state;
  visit("t", u.t);
  visit("dt", u.dt);
  visit("step", u.step);
  visit("first_dt", u.first_dt);
  visit("dt_min", u.dt_min);
  visit("dt_max", u.dt_max);
  visit("next_frame", u.next_frame);
  visit("last_history", u.last_history);
  visit("last_frame", u.last_frame);
  visit("arm_origin", u.arm_origin);
  visit("has_lagged_correction", u.has_lagged_correction);
  visit("now", u.now);
  visit("projection.iterations", u.projection.iterations);
  visit("projection.rounds", u.projection.rounds);
  visit("projection.stages", u.projection.stages);
  visit("projection.residual", u.projection.residual);
  visit("projection.step_iterations", u.projection.step_iterations);

  auto& b = s.books;
  visit("books.mass", b.mass);
  visit("books.volume", b.volume);
  visit("books.lost_at_start", b.lost_at_start);
  visit("books.initial_energy", b.initial_energy);
  visit("books.initial_momentum", b.initial_momentum);
  visit("books.initial_angular_momentum", b.initial_angular_momentum);
  visit("books.impulse", b.impulse);
  visit("books.angular_impulse", b.angular_impulse);
  visit("books.external_work", b.external_work);
  visit("books.dissipated", b.dissipated);
  visit("books.angular_momentum_work", b.angular_momentum_work);
  visit("books.largest_work", b.largest_work);
  visit("books.balanced_step", b.balanced_step);

  auto& w = s.watch;
  visit("watch.step", w.step);
  visit("watch.kinetic", w.energies.kinetic);
  visit("watch.strain", w.energies.strain);
  auto& x = w.extrema;
  visit("watch.min_detF", x.min_detF);
  visit("watch.max_detF", x.max_detF);
  visit("watch.min_J", x.min_J);
  visit("watch.max_J", x.max_J);
  visit("watch.min_detF_over_J", x.min_detF_over_J);
  visit("watch.max_detF_over_J", x.max_detF_over_J);
  visit("watch.min_tet_ratio", x.min_tet_ratio);
  visit("watch.max_speed", x.max_speed);
  visit("watch.max_plastic_strain", x.max_plastic_strain);
  visit("watch.rows", w.rows);
  visit("watch.checkerboard_size", w.checkerboard_size);
  visit("watch.largest_size", w.largest_size);
  auto& e = w.extremes;
  const auto extreme = [&](const char* value, const char* t, auto& extreme) {
    visit(value, extreme.value);
    visit(t, extreme.t);
  };
  extreme("watch.least_tet_ratio", "watch.least_tet_ratio_t", e.least_tet_ratio);
  extreme("watch.least_detF", "watch.least_detF_t", e.least_detF);
  extreme("watch.most_detF", "watch.most_detF_t", e.most_detF);
  extreme("watch.least_detF_over_J", "watch.least_detF_over_J_t", e.least_detF_over_J);
  extreme("watch.most_detF_over_J", "watch.most_detF_over_J_t", e.most_detF_over_J);
  extreme("watch.checkerboard", "watch.checkerboard_t", e.checkerboard);
  extreme("watch.speed", "watch.speed_t", e.speed);

  visit("wall_s", s.team.wall_s);
  visit("cpu_s", s.team.cpu_s);
}

/// An array that a run goes on with, as others may read it: rows in mesh order where there is one a node, otherwise as they stand in memory.
std::vector<double> in_mesh_order(const Order& order, const ArrayRole& role, const Aligned<double>& array);
void from_mesh_order(const Order& order, const ArrayRole& role, std::span<const double> values, Aligned<double>& array);

/// Of the numbering of nodes and edges in memory: with another one a restart goes on, but not to the last bit.
std::string order_hash(const Order& order);

/// Of nodes, tets, regions and named faces.
std::string mesh_hash(const Mesh& mesh);

/// Largest c/l of the present state [1/s], which the next step is found from.
double fastest_rate(const State& u);

/// After numbers and arrays have been put into a simulation that was started from the same scene and mesh: `fastest` as it was; or, in another order of memory, where arrays
/// of edges and supports have no meaning, what a first step would find.
void go_on(Simulation& s, double fastest);
void go_on_in_another_order(Simulation& s);

}  // namespace nanson
