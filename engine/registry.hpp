// The one table of what is built: from a scene's choices to the part functions of its sweeps.
#pragma once
#include "engine/scene.hpp"
#include "kernels/part.hpp"

namespace nanson {

struct PartFunctions {
  void (*gradient)(const Part&, const EdgeArrays&, const CornerArrays&, const NodeLists&, const Rows&,
                   const Coefficients&) = nullptr;
  double (*edge_flux)(const Part&, const EdgeArrays&, const CornerArrays&, const NodeLists&, const Rows&,
                      const Coefficients&, const Scratch&) = nullptr;
  void (*accumulate_update)(const Part&, const EdgeArrays&, const NodeLists&, const Rows&, const Coefficients&,
                            const Constraint*, double*, const Scratch&) = nullptr;
  PartReport (*stress)(const Part&, const Rows&, const Coefficients&, const double*) = nullptr;
  double (*strain_energy)(const Part&, const Rows&, const Coefficients&) = nullptr;
  bool corrects_stress =
      false;  // the gradient sweep writes the corrected stress into Rows::PH_new: the edges read it there (full flux correction)
};

/// The combinations of physics that are compiled, in a sentence.
extern const char* const what_is_built;

/// With several materials: the sweeps for all of them, and stress and energy of this one. `audits`: the edge loops return the power of the stabilisation. `takes_lagged`:
/// of a stage that takes the flux correction of the stage before.
PartFunctions find_part_functions(const PhysicsSpec& physics, const MaterialSpec& material,
                                  Materials materials = Materials::one, bool audits = false, bool takes_lagged = false);

/// Whether the sweeps of these choices are compiled for several materials.
bool takes_several_materials(const PhysicsSpec& physics);

}  // namespace nanson
