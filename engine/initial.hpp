// Initial states; where a scene has an exact solution, its start is that solution at t = 0.
#pragma once
#include <optional>

#include "engine/mesh/mesh.hpp"
#include "kernels/materials/material.hpp"

namespace nanson {

/// Displacement, velocity and deformation gradient of a material point.
struct PointState {
  Vec3 u{};  // [m]
  Vec3 v{};  // [m/s]
  double F[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
};

bool has_exact_solution(const Scene& scene);

/// Bounding box of a mesh: the plane wave starts in its middle, the plate's mode is as long as it. Taken once, not at every point.
struct Extent {
  Vec3 low, high;  // [m]
  Vec3 middle() const { return {0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.5 * (low[2] + high[2])}; }
};
Extent extent_of(const Mesh& mesh);

/// The exact solution at X and t (standing_wave: paper, eq. 63; plane_wave: d'Alembert's travelling wave; both of linear elasticity; manufactured: kernels/manufactured.hpp).
PointState exact_solution(const Scene& scene, const Extent& box, const Vec3& X, double t);

/// The state at t = 0. `centre` is the centre of mass.
PointState initial_state(const Scene& scene, const Extent& box, const Vec3& X, const Vec3& centre);

/// J that starts with F: det F or its linearisation 1 + tr(F - I); the linearisation only for the exact solutions of the linear law.
double initial_J(const Scene& scene, const double (&F)[3][3]);

}  // namespace nanson
