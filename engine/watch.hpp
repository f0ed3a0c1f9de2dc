// What a run keeps an eye on whatever the scene asks for: the state at a history row in a few numbers, and the worst of them over the run.
#pragma once
#include <limits>
#include <string>
#include <vector>

namespace nanson {

struct Energies {
  double kinetic = 0, strain = 0;  // [J]
};

struct Extrema {
  double min_detF = 0, max_detF = 0, min_J = 0, max_J = 0;  // [-]
  double min_detF_over_J = 1, max_detF_over_J = 1;          // [-] pFJ, pFHJ
  double min_tet_ratio = 1;                                 // [-] deformed over undeformed volume; monitor.geometry
  double max_speed = 0;                                     // [m/s]
  double max_plastic_strain = 0;                            // [-] hencky_j2
};

/// A number at its worst, and when; not a number where it was not looked at.
struct Extreme {
  double value = std::numeric_limits<double>::quiet_NaN();
  double t = std::numeric_limits<double>::quiet_NaN();  // [s]
};

/// Over a run, at its history rows.
struct Extremes {
  Extreme least_tet_ratio, least_detF, most_detF, least_detF_over_J, most_detF_over_J;  // [-]
  Extreme checkerboard;  // [-] where the pressure differs by a tenth of its most or more
  Extreme speed;         // [m/s]
};

/// What a run should tell its user, once a cause: energy_growth | iteration_limit | inverted_tet | parted | loose_piece | cfl.
struct Warning {
  std::string cause;
  std::string text;
};

struct Watch {
  long step = -1;  // of the state that the next two are of
  Energies energies;
  Extrema extrema;
  long rows = 0;                 // that were looked at
  double checkerboard_size = 0;  // [N^2] the pressure's differences where `extremes.checkerboard` was found
  double largest_size = 0;       // [N^2] of all that were looked at
  Extremes extremes;
  std::vector<Warning> warnings;
};

}  // namespace nanson
