// Named initial fields and exact solutions.
#include "engine/initial.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/manufactured.hpp"
#include "engine/material.hpp"

namespace nanson {
namespace {

constexpr double pi = std::numbers::pi;

/// u = U0 cos(sqrt(3)/2 c_d pi t) [s1 c2 c3, c1 s2 c3, c1 c2 s3], s_i = sin(pi X_i/2) (paper, eq. 63 with A = B = C = 1).
PointState standing_wave(const Scene& scene, const Vec3& X, double t) {
  const double omega = std::sqrt(3.0) / 2 * constants_of(scene.material).cp * pi, U0 = scene.initial.amplitude;
  double s[3], c[3];
  for (int i = 0; i < 3; ++i) {
    s[i] = std::sin(pi * X[i] / 2);
    c[i] = std::cos(pi * X[i] / 2);
  }
  PointState out;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    out.u[i] = U0 * std::cos(omega * t) * s[i] * c[j] * c[k];
    out.v[i] = -U0 * omega * std::sin(omega * t) * s[i] * c[j] * c[k];
    const double a = U0 * std::cos(omega * t) * pi / 2;
    out.F[i][i] += a * c[i] * c[j] * c[k];
    out.F[i][j] += -a * s[i] * s[j] * c[k];
    out.F[i][k] += -a * s[i] * c[j] * s[k];
  }
  return out;
}

/// u = amplitude (1 - s^2)^4 n for |s| < 1, s = ((X - X0).n - c_p t)/length, X0 the middle of the mesh's bounding box.
PointState plane_wave(const Scene& scene, const Vec3& middle, const Vec3& X, double t) {
  const InitialSpec& w = scene.initial;
  const double cp = constants_of(scene.material).cp;
  double along = 0;
  for (int k = 0; k < 3; ++k) along += (X[k] - middle[k]) * w.direction[k];
  const double s = (along - cp * t) / w.length;
  PointState out;
  if (std::abs(s) >= 1) return out;
  const double slope = w.amplitude / w.length * -8 * s * std::pow(1 - s * s, 3);
  for (int i = 0; i < 3; ++i) {
    out.u[i] = w.amplitude * std::pow(1 - s * s, 4) * w.direction[i];
    out.v[i] = -cp * slope * w.direction[i];
    for (int I = 0; I < 3; ++I) out.F[i][I] += slope * w.direction[i] * w.direction[I];
  }
  return out;
}

Vec3 rotation(const Vec3& omega, const Vec3& r) {
  return {omega[1] * r[2] - omega[2] * r[1], omega[2] * r[0] - omega[0] * r[2], omega[0] * r[1] - omega[1] * r[0]};
}

/// First free-free bending mode of a beam along Y, in Z, at y from its end (paper, eq. 64): g1 and g2 are those of B length = 4.730.
Vec3 plate_mode(const InitialSpec& s, double from_end) {
  constexpr double g1 = 56.637, g2 = 57.646;
  const double y = s.B * from_end;
  return {0, 0, s.amplitude * s.mode_omega * (g1 * (std::sinh(y) + std::sin(y)) - g2 * (std::cosh(y) + std::cos(y)))};
}

}  // namespace

bool has_exact_solution(const Scene& scene) {
  using enum InitialField;
  return scene.initial.field == standing_wave || scene.initial.field == plane_wave
         || scene.initial.field == manufactured;
}

Extent extent_of(const Mesh& mesh) {
  Extent box;
  for (int k = 0; k < 3; ++k) {
    const auto [least, most] = std::minmax_element(mesh.X.begin(), mesh.X.end(),
                                                   [k](const Vec3& p, const Vec3& q) { return p[k] < q[k]; });
    box.low[k] = (*least)[k];
    box.high[k] = (*most)[k];
  }
  return box;
}

PointState exact_solution(const Scene& scene, const Extent& box, const Vec3& X, double t) {
  if (scene.initial.field == InitialField::manufactured) return manufactured_solution(scene, X, t);
  return scene.initial.field == InitialField::standing_wave ? standing_wave(scene, X, t)
                                                            : plane_wave(scene, box.middle(), X, t);
}

PointState initial_state(const Scene& scene, const Extent& box, const Vec3& X, const Vec3& centre) {
  const InitialSpec& s = scene.initial;
  PointState out;
  switch (s.field) {
    case InitialField::rest: break;
    case InitialField::velocity: out.v = s.v; break;
    case InitialField::rotation: {
      const Vec3 c = s.centre.value_or(centre);
      out.v = rotation(s.omega, {X[0] - c[0], X[1] - c[1], X[2] - c[2]});
      break;
    }
    case InitialField::twist: out.v = rotation({0, 0, s.twist_omega * std::sin(pi * X[2] / (2 * s.height))}, X); break;
    case InitialField::plate_mode: out.v = plate_mode(s, X[1] - box.low[1]); break;
    case InitialField::punch:
      out.v = {0, 0, -s.v0 * (0.5 - std::abs(X[0])) * (0.5 - std::abs(X[1])) * X[2] / s.height};
      break;  // downwards (method, section 12)
    case InitialField::manufactured:
    case InitialField::standing_wave:
    case InitialField::plane_wave: return exact_solution(scene, box, X, 0);
  }
  return out;
}

double initial_J(const Scene& scene, const double (&F)[3][3]) {
  const bool linear = scene.initial.field == InitialField::manufactured ? scene.material.law == Law::linear_elastic
                                                                        : scene.initial.J == InitialJ::linear;
  if (has_exact_solution(scene) && linear) return 1 + (F[0][0] - 1) + (F[1][1] - 1) + (F[2][2] - 1);
  Tensor<double> T;
  for (int i = 0; i < 9; ++i) T[i / 3][i % 3] = F[i / 3][i % 3];
  return determinant(T, cofactor(T));
}

}  // namespace nanson
