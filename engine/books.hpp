// Sums that a run carries from its start: what momentum and energy are compared with.
#pragma once
#include "engine/vec3.hpp"

namespace nanson {

struct Books {
  double mass = 0, volume = 0;                          // [kg], [m^3]
  double lost_at_start = 0;                             // [J] kinetic energy that the supports removed from v(0)
  double initial_energy = 0;                            // [J]
  Vec3 initial_momentum{}, initial_angular_momentum{};  // [kg m/s], [kg m^2/s]
  Vec3 impulse{};                                       // [N s] of all that acts from outside, supports too
  Vec3 angular_impulse{};                               // [N m s] of the same, TVD-RK2 only
  double external_work = 0;                             // [J] of all that acts from outside, supports too
  double dissipated = 0;                                // [J] monitor.energy
  double angular_momentum_work = 0;                     // [J] of the angular momentum projection
  double largest_work = 0;                              // [J] largest |external_work| so far
  long balanced_step = 0;                               // last history row at which energy had not grown
};

}  // namespace nanson
