// nanson new: a small commented scene to start from.
#pragma once
#include <string>

namespace nanson {

/// A cantilever of rubber that runs in some seconds.
std::string new_scene_text(const std::string& name);

/// Writes NAME.toml where the user stands and says what to do with it; a file that exists is kept. The exit code.
int write_new_scene(const std::string& name);

}  // namespace nanson
