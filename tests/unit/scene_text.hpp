// A valid scene as text, edited and read back through a file: what the tests of the scene reader share.
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "io/scene/read_scene.hpp"

namespace nanson {

inline const std::string column_scene = R"(scene = "column"

[mesh]
box     = { origin = [-0.5, -0.5, 0.0], size = [1.0, 1.0, 6.0] }
cells   = [4, 4, 24]
split   = "kuhn"
perturb = 0.1

[material]
law            = "neo_hookean"
density        = 1100.0
youngs_modulus = 17.0e6
poissons_ratio = 0.45
volumetric     = "barrier"
isochoric      = "J"

[physics]
formulation     = "pFHJ"
pressure_jump   = "tensor"
reconstruction  = "linear"
flux_correction = "full"
boundary_flux   = "paper"
upwind_metric   = "paper"

[initial]
field  = "twist"
omega  = 105.0
height = 6.0

[[boundary]]
face = "zmin"
kind = "fixed"

[[boundary]]
face = ["zmax", "xmax"]
kind = "traction"
t    = [0.0, 0.0, -1.0e3]
time = { kind = "ramp", until = 0.01 }

[body_force]
g = [0.0, 0.0, -9.81]

[time]
end         = 0.1
cfl         = 0.25
integrator  = "ssp_rk3"
step        = "edge"
dt_max      = 1.0e-4
dt_collapse = 1.0e-3
max_steps   = 500
max_wall_s  = 60

[output]
every         = 0.005
history_every = 10
fields        = ["displacement", "pressure"]
compress      = 1
probes        = { tip = { at = [0.5, 0.5, 6.0], fields = ["x", "velocity"] } }

[monitor]
energy           = true
energy_growth    = "stop"
energy_tolerance = 0.02
)";

/// Nothing but what is required.
inline const std::string small_scene = R"(scene = "small"
[mesh]
box = { size = [1, 2, 3] }
[material]
law = "linear_elastic"
density = 1000
youngs_modulus = 1e6
poissons_ratio = 0.3
[time]
end = 1
)";

/// A folder of its own, removed with everything in it.
struct TempFolder {
  std::filesystem::path path;
  TempFolder() {
    static int count = 0;
    path = std::filesystem::temp_directory_path()
           / ("nanson_scene_" + std::to_string(::getpid()) + "_" + std::to_string(++count));
    std::filesystem::create_directories(path);
  }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;
  ~TempFolder() { std::filesystem::remove_all(path); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::filesystem::remove(
        path / name);  // a file that is truncated instead is flushed to disk when closed: 10 ms each on ext4
    std::ofstream(path / name, std::ios::binary) << text;
    return path / name;
  }
};

/// Reads the text from a file "scene.toml"; the folder's name is cut from the errors.
inline SceneResult read_text(const std::string& text, const std::vector<std::string>& settings = {}) {
  static const TempFolder folder;
  SceneResult r = read_scene(folder.write("scene.toml", text), settings);
  const std::string prefix = folder.path.string() + "/";
  for (std::string& e : r.errors)
    for (auto i = e.find(prefix); i != std::string::npos; i = e.find(prefix)) e.erase(i, prefix.size());
  return r;
}

/// The text with the first `from` replaced.
inline std::string edited(std::string text, const std::string& from, const std::string& to) {
  const auto i = text.find(from);
  EXPECT_NE(i, std::string::npos) << "the sample scene has no: " << from;
  return i == std::string::npos ? text : text.replace(i, from.size(), to);
}

inline std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += "\n  " + line;
  return text;
}

/// One edit of a scene and the one error it must give, from its start on.
struct BadEdit {
  std::string from, to, error;
};

inline void expect_each_refused(const std::string& scene, const std::vector<BadEdit>& edits) {
  for (const BadEdit& b : edits) {
    const SceneResult r = read_text(edited(scene, b.from, b.to));
    EXPECT_TRUE(r.errors.size() == 1 && r.errors[0].starts_with(b.error))
        << b.to << "\n  expected " << b.error << joined(r.errors);
  }
}

inline void expect_each_accepted(const std::string& scene,
                                 const std::vector<std::pair<std::string, std::string>>& edits) {
  for (const auto& [from, to] : edits) {
    const SceneResult r = read_text(edited(scene, from, to));
    EXPECT_TRUE(r.errors.empty()) << to << joined(r.errors);
  }
}

}  // namespace nanson
