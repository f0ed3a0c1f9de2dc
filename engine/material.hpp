// Material constants from what a scene says.
#pragma once
#include <cmath>

#include "engine/scene.hpp"
#include "kernels/materials/material.hpp"

namespace nanson {

/// The hardening curve piece by piece, constant beyond the last point of a table; without a table one piece that never ends. Only laws that yield read it.
inline Hardening hardening_of(const MaterialSpec& m) {
  Hardening h;
  if (m.hardening.empty()) {
    h.count = 1;
    h.tau_y[0] = m.yield_stress;
    h.slope[0] = m.hardening_modulus;
    return h;
  }
  for (const auto& [eps_p, tau_y] : m.hardening) {
    const int i = h.count++;
    h.eps_p[i] = eps_p;
    h.tau_y[i] = tau_y;
    if (i > 0) h.slope[i - 1] = (tau_y - h.tau_y[i - 1]) / (eps_p - h.eps_p[i - 1]);
  }
  return h;
}

/// mu = E/(2(1+nu)), kappa = E/(3(1-2nu)), 2 zeta + 3 sqrt(3) xi = mu; c_p, c_s at F = I (paper, eq. 39).
inline MaterialConstants constants_of(const MaterialSpec& m) {
  MaterialConstants c;
  c.rho = m.density;
  c.mu = m.youngs_modulus / (2 * (1 + m.poissons_ratio));
  c.kappa = m.youngs_modulus / (3 * (1 - 2 * m.poissons_ratio));
  c.xi = m.law == Law::mooney_rivlin ? m.xi : 0.0;
  c.zeta = 0.5 * (c.mu - 3 * std::sqrt(3.0) * c.xi);
  c.cp = std::sqrt((c.kappa + 4.0 / 3.0 * c.mu) / c.rho);
  c.cs = std::sqrt(c.mu / c.rho);
  c.cJ = c.cp;
  c.hardening = hardening_of(m);
  return c;
}

/// The shear modulus that tets take their shares of [Pa]: mu, or of a law that yields its first yield stress, of the size of what flowing metal still resists with.
inline double tet_modulus(const MaterialSpec& m, const MaterialConstants& c) {
  return m.law == Law::hencky_j2 ? c.hardening.tau_y[0] : c.mu;
}

/// Of a material in a scene: with what the physics adds to its law.
inline MaterialConstants constants_of(const MaterialSpec& m, const PhysicsSpec& physics) {
  MaterialConstants c = constants_of(m);
  c.parting = physics.parting * c.mu;
  c.cJ = std::sqrt((c.kappa + c.parting + 4.0 / 3.0 * c.mu) / c.rho);
  c.tet_stiffness = physics.tet_stiffness * tet_modulus(m, c);
  c.tet_barrier = physics.tet_barrier * tet_modulus(m, c);
  return c;
}

}  // namespace nanson
