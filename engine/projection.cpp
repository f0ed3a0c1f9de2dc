// Coefficients of the projection, and whether the supports close the domain.
#include "engine/projection.hpp"

#include <algorithm>
#include <cmath>

namespace nanson {
namespace {

/// Whether the force of a constant pressure, -sum C_gamma at the undeformed boundary, is taken by the supports at every node.
bool supports_close(const Order& o, const Boundary& boundary, const std::vector<std::int32_t>& held) {
  constexpr double slack = 1e-2;  // directions closer than 1e-3 rad were joined
  for (int n = 0; n < o.rows; ++n) {
    double area[3] = {}, size = 0;
    for (int g = o.corner[n]; g < o.corner[n + 1]; ++g) {
      for (int k = 0; k < 3; ++k) area[k] += o.corner_C[k][g];
      size += std::hypot(o.corner_C[0][g], o.corner_C[1][g], o.corner_C[2][g]);
    }
    if (held[n] >= 0) {
      const Constraint& c = boundary.constraints[held[n]];
      for (int m = 0; m < c.count; ++m) {
        const double along = area[0] * c.d[m][0] + area[1] * c.d[m][1] + area[2] * c.d[m][2];
        for (int k = 0; k < 3; ++k) area[k] -= along * c.d[m][k];
      }
    }
    if (std::hypot(area[0], area[1], area[2]) > slack * size) return false;
  }
  return true;
}

}  // namespace

ProjectionSetup make_projection_setup(const Scene& scene, const Order& order, const Boundary& boundary,
                                      const Aligned<double>& X, const MaterialConstants& material,
                                      const Mixture& mixture) {
  ProjectionSetup p;
  if (scene.physics.formulation != Formulation::pFp) return p;
  p.parts = order.parts;
  for (Part& part : p.parts)
    while (part.node_end > part.node_begin && order.node_of[part.node_end - 1] < 0) --part.node_end;
  p.held.assign(static_cast<std::size_t>(order.rows), -1);
  for (std::size_t i = 0; i < boundary.constraints.size(); ++i)
    p.held[boundary.constraints[i].node] = static_cast<std::int32_t>(i);
  for (int n = 0; n < order.rows; ++n)
    if (order.node_of[n] >= 0) p.total_volume += 1.0 / X[row::X * n + 3];
  ProjectionCoefficients& k = p.coefficients;
  k.rho = material.rho;
  for (const MaterialLaw& law : mixture.laws)
    k.rho = std::min(k.rho, law.constants.rho);  // sets the pseudo-time's pace
  k.inverse_kappa = 1.0 / material.kappa;
  k.beta = scene.projection.stabilisation;
  k.beta_over_rho_cs = scene.projection.stabilisation / (material.rho * material.cs);
  k.theta = scene.projection.drift_control;
  k.still = material.cs;
  p.inverse_kappa = means_of_rows(mixture, [](const MaterialLaw& l) { return 1.0 / l.constants.kappa; });
  const bool incompressible = mixture.empty() ? k.inverse_kappa == 0
                                              : std::ranges::all_of(p.inverse_kappa, [](double c) { return c == 0; });
  p.closed = incompressible && supports_close(order, boundary, p.held);
  return p;
}

}  // namespace nanson
