// A vector in space, and what is done with it.
#pragma once
#include <array>
#include <cmath>

namespace nanson {

using Vec3 = std::array<double, 3>;

inline Vec3 operator+(const Vec3& p, const Vec3& q) { return {p[0] + q[0], p[1] + q[1], p[2] + q[2]}; }
inline Vec3 operator-(const Vec3& p, const Vec3& q) { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }
inline Vec3 scaled(const Vec3& p, double s) { return {p[0] * s, p[1] * s, p[2] * s}; }
inline double dot(const Vec3& p, const Vec3& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }
inline Vec3 cross(const Vec3& p, const Vec3& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}
inline double norm(const Vec3& p) { return std::sqrt(dot(p, p)); }
inline Vec3 unit(const Vec3& p) { return scaled(p, 1 / norm(p)); }
inline void add(Vec3& sum, const Vec3& term) { sum = sum + term; }

}  // namespace nanson
