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

/// With several materials: the sweeps for all of them, and stress and energy of this one. `audits`: the edge loops have the plain jumps that an audit wants
/// (Coefficients::edge says whether they do audit). `takes_lagged`: of a stage that takes the flux correction of the stage before.
PartFunctions find_part_functions(const PhysicsSpec& physics, const MaterialSpec& material, bool audits = false,
                                  bool takes_lagged = false);

/// What sweeps and rules ask of a law.
LawTraits law_traits(Law law);
bool has_plasticity(const Scene& scene);

/// What the edge loops compute.
EdgeChoices edge_choices(const PhysicsSpec& physics, bool audits = false);

}  // namespace nanson
