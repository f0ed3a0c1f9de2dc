// The scene's text, which README.md shows (configs/reference.py compares), and the file that is never overwritten.
#include "io/new_scene.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>

#include "io/posix_file.hpp"
#include "io/print.hpp"
#include "io/scene/words.hpp"

namespace nanson {

std::string new_scene_text(const std::string& name) {
  return fmt::format(R"(scene = "{0}"                           # results go to results/{0}/

[mesh]
box   = {{ origin = [0, 0, 0], size = [1, 0.1, 0.1] }}   # [m] or file = "part.msh"
cells = [30, 3, 3]                       # each becomes six tets

[material]
law            = "neo_hookean"
density        = 1100                    # [kg/m^3]
youngs_modulus = 17e6                    # [Pa]
poissons_ratio = 0.45

[[boundary]]
face = "xmin"                            # faces without a [[boundary]] are free
kind = "fixed"

[[boundary]]
face = "xmax"
kind = "traction"
t    = [0, 0, -2000]                     # [Pa]
time = {{ kind = "ramp", until = 0.01 }}   # [s]

[time]
end = 0.3                                # [s]

[output]
every  = 0.02                            # [s] between frames
probes = {{ tip = {{ at = [1, 0.05, 0.05], fields = ["displacement"] }} }}
)",
                     name);
}

int write_new_scene(const std::string& name) {
  if (!is_plain(name)) {
    print(stderr, "{}: names a scene and its folder: use letters, digits, - and _ only\n", name);
    return 2;
  }
  const std::string file = name + ".toml";
  const Descriptor out(file, O_WRONLY | O_CREAT | O_EXCL);
  int error = out ? 0 : errno;
  if (out) error = write_all(out.get(), new_scene_text(name));
  if (error != 0) {
    print(stderr, "{}: could not be written: {}\n", file, std::strerror(error));
    return error == EEXIST ? 2 : 1;
  }
  print(stdout, "{}: written; next: check {}, run {}\n", file, file, file);
  return 0;
}

}  // namespace nanson
