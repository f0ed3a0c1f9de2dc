// What is wrong with a scene and is only found while it is set up: exit code 2, as for errors found by reading.
#pragma once
#include <stdexcept>

namespace nanson {

struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace nanson
