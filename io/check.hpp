// `nanson check`: what a run would be, without running it; writes nothing.
#pragma once
#include "io/scene/load.hpp"

namespace nanson {

int check_scene(const Loaded& loaded, int threads);

}  // namespace nanson
