// Neo-Hookean law: the polyconvex law with xi = 0, zeta = mu/2 (paper, section 2.1.1); the H:H terms are left out at compile time.
#pragma once
#include "kernels/materials/mooney_rivlin.hpp"

namespace nanson {

/// psi = mu/2 (j^(-2/3) F:F - 3) + U(J) [J/m^3].
template <Volumetric volumetric, Isochoric isochoric, Formulation formulation>
struct Material<Law::neo_hookean, volumetric, isochoric, formulation>
    : PolyconvexMaterial<false, volumetric, isochoric, formulation> {};

}  // namespace nanson
