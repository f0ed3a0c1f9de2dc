// The factor in time of a load or a prescribed velocity.
#pragma once
#include "engine/scene.hpp"

namespace nanson {

/// Value at time t [-]; table values are linear between points and constant outside.
double value_at(const TimeFunction& f, double t);

}  // namespace nanson
