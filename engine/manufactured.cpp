// Waves of every row once; the body force eight rows as lanes, at each stage.
#include "engine/manufactured.hpp"

#include <cmath>
#include <numbers>

#include "engine/material.hpp"
#include "kernels/manufactured.hpp"

namespace nanson {
namespace {

/// sin and cos of pi x, exact at multiples of a half up to the rounding of x.
double sin_pi(double x) {
  const double nearest = std::round(x);
  return std::abs(x - nearest) < 1e-12 ? 0.0 : std::sin(std::numbers::pi * x);
}
double cos_pi(double x) { return sin_pi(x + 0.5); }

Waves<double> waves_at(const Scene& scene, const Vec3& X) {
  Waves<double> w;
  for (int m = 0; m < 3; ++m) {
    w.s[m] = sin_pi(X[m] / scene.initial.length);
    w.c[m] = cos_pi(X[m] / scene.initial.length);
  }
  w.k = std::numbers::pi / scene.initial.length;
  return w;
}

double omega_of(const Scene& scene) { return 2 * std::numbers::pi / scene.initial.period; }

/// Calls use(law, volumetric) as constants of the laws that have exact solutions.
template <class Use>
void with_law(const MaterialSpec& m, Use use) {
  const auto with_volumetric = [&](auto law) {
    if (m.volumetric == Volumetric::barrier) use(law, std::integral_constant<Volumetric, Volumetric::barrier>{});
    else use(law, std::integral_constant<Volumetric, Volumetric::quadratic>{});
  };
  if (m.law == Law::linear_elastic)
    use(std::integral_constant<Law, Law::linear_elastic>{},
        std::integral_constant<Volumetric, Volumetric::quadratic>{});
  if (m.law == Law::neo_hookean) with_volumetric(std::integral_constant<Law, Law::neo_hookean>{});
  if (m.law == Law::mooney_rivlin) with_volumetric(std::integral_constant<Law, Law::mooney_rivlin>{});
}

}  // namespace

Manufactured make_manufactured(const Scene& scene, const Mesh& mesh, const Order& order) {
  Manufactured out;
  if (scene.initial.field != InitialField::manufactured) return out;
  out.k = std::numbers::pi / scene.initial.length;
  out.omega = omega_of(scene);
  out.waves.assign(wave_row * static_cast<std::size_t>(order.rows), 0.0);
  for (int r = 0; r < order.rows; ++r) {
    const int n = order.node_of[static_cast<std::size_t>(r)];
    if (n < 0) continue;
    const Waves<double> w = waves_at(scene, mesh.X[static_cast<std::size_t>(n)]);
    double* lanes = &out.waves[static_cast<std::size_t>(8 * wave_row * (r / 8) + r % 8)];
    for (int m = 0; m < 3; ++m) {
      lanes[8 * m] = w.s[m];
      lanes[8 * (3 + m)] = w.c[m];
    }
  }
  return out;
}

void add_manufactured_force(const Manufactured& m, const Scene& scene, const MaterialConstants& material,
                            const Part& part, const double* X, double t, double* force) {
  const double oscillation = std::cos(m.omega * t);
  double size[3];
  for (int i = 0; i < 3; ++i) size[i] = scene.initial.amplitudes[static_cast<std::size_t>(i)] * oscillation;
  with_law(scene.material, [&](auto law, auto volumetric) {
    for (int n = part.node_begin; n < part.node_end; n += 8) {
      const double* lanes = &m.waves[static_cast<std::size_t>(wave_row * n)];
      Waves<Vec8> w;
      w.k = m.k;
      for (int d = 0; d < 3; ++d) {
        w.s[d] = load8(lanes + 8 * d);
        w.c[d] = load8(lanes + 8 * (3 + d));
      }
      Vec8 g[3];
      manufactured_body_force<law(), volumetric()>(w, size, m.omega, material, g);
      for (int lane = 0; lane < 8; ++lane)
        for (int i = 0; i < 3; ++i)
          force[4 * (n + lane) + i] += g[i][lane] * (material.rho / X[row::X * (n + lane) + 3]);
    }
  });
}

PointState manufactured_solution(const Scene& scene, const Vec3& X, double t) {
  const Waves<double> w = waves_at(scene, X);
  const double omega = omega_of(scene);
  double size[3];
  PointState out;
  for (int i = 0; i < 3; ++i) {
    const std::size_t k = static_cast<std::size_t>(i);
    const double A = scene.initial.amplitudes[k], wave = wave_derivative(w, i, {0, 0, 0});
    size[i] = A * std::cos(omega * t);
    out.u[k] = size[i] * wave;
    out.v[k] = -A * omega * std::sin(omega * t) * wave;
  }
  const Tensor<double> F = manufactured_F(w, size);
  for (int m = 0; m < 9; ++m) out.F[m / 3][m % 3] = F[m / 3][m % 3];
  return out;
}

Tensor<double> exact_stress(const MaterialSpec& spec, const MaterialConstants& m, const PointState& p) {
  Tensor<double> F, P{};
  for (int k = 0; k < 9; ++k) F[k / 3][k % 3] = p.F[k / 3][k % 3];
  with_law(spec, [&](auto law, auto volumetric) {
    P = Material<law(), volumetric(), Isochoric::F, Formulation::pF>::stress(F, F, 1.0, m).P;
  });
  return P;
}

}  // namespace nanson
