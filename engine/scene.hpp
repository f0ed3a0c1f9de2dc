// A scene as plain data: what io/read_scene fills in, after every check that needs no mesh. SI units throughout.
#pragma once
#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/vec3.hpp"
#include "kernels/traits.hpp"

namespace nanson {

enum class MeshSource { box, cylinder, needle, file };
enum class Split { alternating, kuhn };
enum class Sector { quarter };
enum class Axis { x, y, z };
enum class InitialField { rest, velocity, rotation, twist, plate_mode, standing_wave, plane_wave, punch, manufactured };
enum class InitialJ { linear, det };  // J(0) = 1 + tr(F - I) | det F
enum class BoundaryKind { fixed, free, symmetric, skew_symmetric, traction, pressure, velocity };
enum class TimeKind { constant, ramp, sine, pulse, logistic, table };
enum class Integrator { tvd_rk2, ssp_rk3 };
enum class StepRule { dual, edge, paper };
enum class EnergyGrowth { warn, stop };
enum class GeometryWatch { off, warn, stop };
enum class ProjectionSolver { cg, pseudo_time };
enum class OnLimit { stop, warn };

constexpr auto words(MeshSource) { return std::array<std::string_view, 4>{"box", "cylinder", "needle", "file"}; }
constexpr auto words(Split) { return std::array<std::string_view, 2>{"alternating", "kuhn"}; }
constexpr auto words(Sector) { return std::array<std::string_view, 1>{"quarter"}; }
constexpr auto words(Axis) { return std::array<std::string_view, 3>{"x", "y", "z"}; }
constexpr auto words(InitialField) {
  return std::array<std::string_view, 9>{"rest",          "velocity",   "rotation", "twist",       "plate_mode",
                                         "standing_wave", "plane_wave", "punch",    "manufactured"};
}
constexpr auto words(InitialJ) { return std::array<std::string_view, 2>{"linear", "det"}; }
constexpr auto words(BoundaryKind) {
  return std::array<std::string_view, 7>{"fixed",    "free",     "symmetric", "skew_symmetric",
                                         "traction", "pressure", "velocity"};
}
constexpr auto words(TimeKind) {
  return std::array<std::string_view, 6>{"constant", "ramp", "sine", "pulse", "logistic", "table"};
}
constexpr auto words(Integrator) { return std::array<std::string_view, 2>{"tvd_rk2", "ssp_rk3"}; }
constexpr auto words(StepRule) { return std::array<std::string_view, 3>{"dual", "edge", "paper"}; }
constexpr auto words(ProjectionSolver) { return std::array<std::string_view, 2>{"cg", "pseudo_time"}; }
constexpr auto words(OnLimit) { return std::array<std::string_view, 2>{"stop", "warn"}; }
constexpr auto words(EnergyGrowth) { return std::array<std::string_view, 2>{"warn", "stop"}; }
constexpr auto words(GeometryWatch) { return std::array<std::string_view, 3>{"off", "warn", "stop"}; }

/// A name that can only be checked against the mesh, with the place in the scene file that says it ("file:line:column").
struct Named {
  std::string name;
  std::string where;
};

struct MeshRegions {  // box: layers along an axis
  Axis axis = Axis::x;
  std::vector<double> at;          // [m] growing: the planes between the layers, each between two rows of cells
  std::vector<std::string> names;  // one more than planes, from the lowest coordinate
};

struct MeshSpec {
  MeshSource source = MeshSource::box;
  Vec3 origin{};                      // [m] box
  Vec3 size{};                        // [m] box
  std::array<int, 3> cells{1, 1, 1};  // box: x y z; cylinder: radial tangential axial; needle: across across radial
  Split split = Split::alternating;   // box
  MeshRegions regions{Axis::x, {}, {"box"}};  // box
  double perturb = 0;                         // share of a cell by which inner nodes are moved, fixed seed; box
  double radius = 0, length = 0;              // [m] cylinder, its axis from the origin along Z
  Sector sector = Sector::quarter;            // cylinder: X >= 0, Y >= 0
  double inner = 0, outer = 0;                // [m] needle: radii, its axis from the origin along X
  double angle = 0;                           // [deg] needle: between opposite sides
  Named file;                                 // file: path as resolved against the scene's folder
};

struct MaterialSpec {
  std::vector<Named> regions;  // of the mesh, [[material]] only
  Law law = Law::neo_hookean;
  double density = 0;                              // [kg/m^3]
  double youngs_modulus = 0;                       // [Pa]
  double poissons_ratio = 0;                       // [-]
  double yield_stress = 0, hardening_modulus = 0;  // [Pa] hencky_j2 without a table
  std::vector<std::pair<double, double>>
      hardening;  // [-], [Pa] hencky_j2: points (eps_p, tau_y); constant beyond the last
  double xi = 0;  // [Pa] mooney_rivlin: 2 zeta + 3 sqrt(3) xi = mu
  Volumetric volumetric = Volumetric::quadratic;
  Isochoric isochoric = Isochoric::F;
};

struct PhysicsSpec {
  Formulation formulation = Formulation::pFJ;
  Stabilisation stabilisation = Stabilisation::upwind;
  PressureJump pressure_jump = PressureJump::scalar;
  Reconstruction reconstruction = Reconstruction::linear;
  FluxCorrection flux_correction = FluxCorrection::none;
  BoundaryFlux boundary_flux = BoundaryFlux::adjoint;
  UpwindMetric upwind_metric = UpwindMetric::deformed;
  EntropyFix entropy_fix = EntropyFix::none;
  double parting = 0;        // [-] M/mu of the energy of the parting of det F from J; 0: none
  double tet_stiffness = 0;  // [-] of the tets' modulus: energy of what they deform beyond their nodes; 0: none
  double tet_barrier = 0;    // [-] of the tets' modulus: energy of tets crushed beyond their nodes; 0: none
  bool keep_angular_momentum = false;  // tvd_rk2 only
  Description description = Description::total;
};

/// pFp only (method, section 10).
struct ProjectionSpec {
  ProjectionSolver solver = ProjectionSolver::cg;
  double stabilisation = 0.02;  // [-] beta
  double drift_control = 0.1;   // [-] theta: share of the volume error that a stage may correct
  double length_scale = 0;      // [m] pseudo_time
  double tolerance = 1e-3;      // [-] of the volume constraint, against the velocity gradient
  long max_iterations = 200;    // a stage
  OnLimit on_limit = OnLimit::stop;
};

struct InitialSpec {
  InitialField field = InitialField::rest;
  InitialJ J = InitialJ::linear;  // standing_wave, plane_wave
  Vec3 v{};                       // [m/s] velocity
  Vec3 omega{};                   // [rad/s] rotation
  std::optional<Vec3> centre;     // [m] rotation; none: the centre of mass ("mass")
  double twist_omega = 0;         // [rad/s] twist: omega = (0, 0, twist_omega sin(pi Z / (2 height)))
  double height = 0;              // [m] twist, punch
  double v0 = 0;                  // [m/s] punch: v_Z = -v0 (1/2 - |X|)(1/2 - |Y|) Z / height, X and Y in metres
  double amplitude = 0;           // [m] plate_mode, standing_wave, plane_wave
  double mode_omega = 0;          // [1/s] plate_mode
  double B = 0;                   // [1/m] plate_mode
  double length = 0;              // [m] plane_wave: half width of the pulse; manufactured: between planes of symmetry
  Vec3 amplitudes{};              // [m] manufactured, one a direction
  double period = 0;              // [s] manufactured
  Vec3 direction{1, 0, 0};        // [-] plane_wave: unit vector of travel
};

/// A factor in time, 1 where nothing is said.
struct TimeFunction {
  TimeKind kind = TimeKind::constant;
  double until = 0;                 // [s] ramp, pulse, logistic
  double from = 0;                  // [s] pulse
  double frequency = 0, phase = 0;  // [1/s], [rad] sine
  double rate = 0, centre = 0;      // [1/s], [s] logistic: 4 g/(1+g)^2, g = exp(rate (centre - t)); 0 after until
  std::vector<std::pair<double, double>> points;  // [s], [-] table, strictly growing times
};

struct BoundarySpec {
  std::vector<Named> faces;
  BoundaryKind kind = BoundaryKind::free;
  Vec3 traction{};                             // [Pa] per undeformed area, dead
  double pressure = 0;                         // [Pa] pushes in, follows the current face
  Vec3 velocity{};                             // [m/s]
  std::array<bool, 3> held{true, true, true};  // velocity: components that are prescribed ("free" leaves one)
  TimeFunction time;
};

struct TimeSpec {
  double end = 0;    // [s]
  double cfl = 0.3;  // [-]
  Integrator integrator = Integrator::tvd_rk2;
  StepRule step = StepRule::dual;
  double dt_max = 0;          // [s] 0: no limit
  double dt_collapse = 1e-4;  // stop when dt falls below this share of the first dt
  long max_steps = 0;         // 0: no limit
  double max_wall_s = 0;      // [s] 0: no limit
};

struct ProbeSpec {
  std::string name;
  Vec3 at{};  // [m] reference position
  std::string where;
  std::vector<std::string> fields;
};

struct OutputSpec {
  double every = 0;        // [s] 0: first and last frame only
  long history_every = 1;  // [steps]
  std::vector<std::string> fields{"displacement", "velocity", "pressure"};
  int compress = 0;               // gzip level
  double checkpoint_every = 600;  // [s] of wall time; 0: at the end and on signals only
  std::vector<ProbeSpec> probes;
};

struct MonitorSpec {
  bool energy = false;
  bool entropy = false;                          // production of every edge; upwind only
  bool involutions = false;                      // F - grad x, H - cof F, J - det F
  GeometryWatch geometry = GeometryWatch::warn;  // tets turned inside out, det F apart from J
  EnergyGrowth energy_growth = EnergyGrowth::warn;
  double energy_tolerance = 0.01;  // share of the initial energy
};

struct Scene {
  std::string name;
  std::filesystem::path file;
  std::string text;  // the file verbatim with the --set lines appended as comments, kept in the results
  MeshSpec mesh;
  MaterialSpec material;  // everywhere; the first one of several
  std::vector<MaterialSpec>
      materials;  // two or more [[material]], each for regions of its own; empty with one material
  PhysicsSpec physics;
  ProjectionSpec projection;
  InitialSpec initial;
  std::vector<BoundarySpec> boundary;
  Vec3 body_force{};  // [m/s^2]
  TimeSpec time;
  OutputSpec output;
  MonitorSpec monitor;
};

/// The materials of a scene, one or several.
inline std::span<const MaterialSpec> materials_of(const Scene& s) {
  return s.materials.empty() ? std::span(&s.material, 1) : std::span(s.materials);
}

}  // namespace nanson
