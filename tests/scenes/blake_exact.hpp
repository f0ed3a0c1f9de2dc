// Blake's problem in closed form: a spherical cavity in an infinite elastic body, under pressure from t = 0 on; small strain.
#pragma once
#include <cmath>

namespace nanson {

/// Potential phi = g(tau)/r, tau = t - (r - a)/c_p: u_r = dphi/dr; g = p a^3 K/(rho0 c_p^2) [-1 + sqrt(4K/(4K-1)) exp(-alpha tau) cos(beta tau - delta)],
/// K = (1 - nu)/(2 (1 - 2 nu)), alpha = c_p/(2 a K), beta = alpha sqrt(4K - 1), tan delta = 1/sqrt(4K - 1). At rest before tau = 0.
struct Blake {
  double a = 0.1, p = 1e6;                    // [m], [Pa]
  double rho0 = 3000, E = 62.5e9, nu = 0.25;  // [kg/m^3], [Pa], [-]

  double lambda() const { return E * nu / ((1 + nu) * (1 - 2 * nu)); }
  double mu() const { return E / (2 * (1 + nu)); }
  double kappa() const { return E / (3 * (1 - 2 * nu)); }
  double cp() const { return std::sqrt((lambda() + 2 * mu()) / rho0); }

  /// g [m^3] and its first two derivatives by tau.
  struct Wave {
    double g = 0, dg = 0, ddg = 0;
  };
  Wave wave(double r, double t) const {
    const double tau = t - (r - a) / cp();
    if (tau < 0) return {};
    const double K = (1 - nu) / (2 * (1 - 2 * nu)), q = std::sqrt(4 * K - 1), alpha = cp() / (2 * a * K),
                 beta = alpha * q, phase = beta * tau - std::atan(1 / q);
    const double A = p * a * a * a * K / (rho0 * cp() * cp()), B = A * std::sqrt(4 * K) / q * std::exp(-alpha * tau),
                 c = std::cos(phase), s = std::sin(phase);
    return {B * c - A, -B * (alpha * c + beta * s), B * ((alpha * alpha - beta * beta) * c + 2 * alpha * beta * s)};
  }

  double potential(double r, double t) const { return wave(r, t).g / r; }  // [m^2]
  double u(double r, double t) const {                                     // [m]
    const Wave w = wave(r, t);
    return -w.g / (r * r) - w.dg / (r * cp());
  }
  double du(double r, double t) const {  // [-] du/dr
    const Wave w = wave(r, t);
    return 2 * w.g / (r * r * r) + 2 * w.dg / (r * r * cp()) + w.ddg / (r * cp() * cp());
  }
  double sigma_rr(double r, double t) const {
    return (lambda() + 2 * mu()) * du(r, t) + 2 * lambda() * u(r, t) / r;
  }                                                                                              // [Pa]
  double pressure(double r, double t) const { return -kappa() * (du(r, t) + 2 * u(r, t) / r); }  // [Pa] compression +
  double front(double t) const { return a + cp() * t; }                                          // [m]
  double jump(double t) const {
    return kappa() / (lambda() + 2 * mu()) * p * a / front(t);
  }  // [Pa] of the pressure at the front
};

}  // namespace nanson
