// The body force of initial.field = "manufactured": what makes the chosen motion exact for the scene's law.
#pragma once
#include "engine/aligned.hpp"
#include "engine/initial.hpp"
#include "engine/order.hpp"
#include "kernels/part.hpp"

namespace nanson {

inline constexpr int wave_row = 6;  // s_1 s_2 s_3 c_1 c_2 c_3 a row

struct Manufactured {
  Aligned<double> waves;    // empty in all other scenes; eight rows side by side
  double k = 0, omega = 0;  // [1/m], [1/s]
};

Manufactured make_manufactured(const Scene& scene, const Mesh& mesh, const Order& order);

/// force += rho Omega g on the rows of a part [N], 4 a row; g the body force at time t [s], Omega from {X, 1/Omega}.
void add_manufactured_force(const Manufactured& m, const Scene& scene, const MaterialConstants& material,
                            const Part& part, const double* X, double t, double* force);

/// The motion at X and t.
PointState manufactured_solution(const Scene& scene, const Vec3& X, double t);

/// First Piola-Kirchhoff stress of the scene's law at F [Pa]; the laws of exact solutions only.
Tensor<double> exact_stress(const MaterialSpec& spec, const MaterialConstants& m, const PointState& p);

}  // namespace nanson
