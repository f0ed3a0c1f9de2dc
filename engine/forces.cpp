// Traction and pressure on faces, gravity, the body force of a manufactured motion; their resultant and power.
#include "engine/forces.hpp"

#include <algorithm>

#include "engine/time_function.hpp"

namespace nanson {
namespace {

/// Tractions are dead. A pressure follows its face: -p a/3, a = (x_b - x_a) x (x_c - x_a)/2; the resultant of a closed surface is exactly zero.
void add_face_loads(const Simulation& s, const double* U, double t, double* loads) {
  const Boundary& boundary = s.domain.boundary;
  const auto x = [&](int n) { return state_of_row(U, n).position(); };
  for (const LoadedFace& f : boundary.loaded) {
    const double factor = value_at(boundary.conditions[static_cast<std::size_t>(f.condition)].time, t);
    Vec3 force = f.corner_force;
    if (f.kind == BoundaryKind::pressure) {
      const Vec3 a = x(f.node[0]);
      force = scaled(cross(x(f.node[1]) - a, x(f.node[2]) - a), -f.pressure / 6);
    }
    for (std::size_t k = 0; k < 3; ++k) loads[4 * static_cast<std::size_t>(f.slot) + k] += factor * force[k];
  }
}

void add_gravity(const Simulation& s, const double*, double, double* force) {
  const Vec3& g = s.domain.scene->body_force;
  for (int n = 0; n < s.domain.order.rows; ++n)
    for (int k = 0; k < 3; ++k) force[4 * n + k] += g[static_cast<std::size_t>(k)] * mass(s.domain, n);
}

void add_manufactured(const Simulation& s, const double*, double t, double* force) {
  const Domain& d = s.domain;
  for_parts(s, [&](int p, Scratch) {
    add_manufactured_force(d.manufactured, *d.scene, d.coefficients.material,
                           d.order.parts[static_cast<std::size_t>(p)], d.X.data(), t, force);
  });
}

/// All that there are; a scene's are those that act.
constexpr Force forces[] = {
    {"traction, pressure", ActsOn::corners, true, [](const Domain& d) { return !d.boundary.loaded.empty(); },
     add_face_loads},
    {"gravity", ActsOn::nodes, false, has_gravity, add_gravity},
    {"manufactured", ActsOn::nodes, true, [](const Domain& d) { return !d.manufactured.waves.empty(); },
     add_manufactured},
};

}  // namespace

void find_forces(Simulation& s, const double* U, double t, bool first) {
  for (const ActsOn on : {ActsOn::corners, ActsOn::nodes}) {
    Aligned<double>& row = on == ActsOn::corners ? s.state.loads : s.state.force;
    const auto here = [&](const Force& f) { return f.on == on && f.acts(s.domain); };
    if (std::ranges::none_of(forces, [&](const Force& f) { return here(f) && (f.varies || first); })) continue;
    std::ranges::fill(row, 0.0);
    for (const Force& f : forces)
      if (here(f)) f.add(s, U, t, row.data());
  }
}

Resultant resultant(const Simulation& s, const double* arms, const Vec3& about) {
  if (nothing_acts(s.domain)) return {};
  const auto sum = sums_over_parts<6>(s, [&](int p, double* out) {
    const auto add = [&](int n, const Vec3& f) {
      const Vec3 torque = cross(state_of_row(arms, n).position() - about, f);
      for (std::size_t k = 0; k < 3; ++k) {
        out[k] += f[k];
        out[3 + k] += torque[k];
      }
    };
    each_reaction(s, p, add);
    each_load(s, p, add);
  });
  return {{sum[0], sum[1], sum[2]}, {sum[3], sum[4], sum[5]}};
}

double power_of_loads(const Simulation& s, const double* W) {
  if (nothing_acts(s.domain)) return 0;
  return sum_over_parts(s, [&](int p) {
    double power = 0;
    each_load(s, p, [&](int n, const Vec3& f) {
      const double* v = W + row::W * n;
      power += f[0] * v[0] + f[1] * v[1] + f[2] * v[2];
    });
    return power;
  });
}

}  // namespace nanson
