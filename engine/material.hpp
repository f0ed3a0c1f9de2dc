// Material constants from what a scene says.
#pragma once
#include <cmath>

#include "engine/scene.hpp"
#include "kernels/materials/material.hpp"

namespace nanson {

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
  return c;
}

}  // namespace nanson
