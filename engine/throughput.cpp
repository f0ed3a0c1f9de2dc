// Work of the steps from the traits, over the time of the sweeps.
#include "engine/throughput.hpp"

#include "engine/choices.hpp"
#include "engine/counted.hpp"
#include "engine/work.hpp"
#include "kernels/materials/hencky_j2.hpp"

namespace nanson {
namespace {

/// Of one evaluation of the scene's law; none for a law with a state, whose work depends on what flows.
std::optional<double> law_flops(const MaterialSpec& s, Formulation choice) {
  std::optional<double> flops;
  with(s.law, [&]<Law law>() {
    with(s.volumetric, [&]<Volumetric volumetric>() {
      with(s.isochoric, [&]<Isochoric isochoric>() {
        with(choice, [&]<Formulation formulation>() {
          if constexpr (is_material<
                            law, volumetric, isochoric,
                            formulation> && !Material<law, volumetric, isochoric, formulation>::traits.has_state)
            flops = flops_of_law<law, volumetric, isochoric, formulation>(constants_of(s));
        });
      });
    });
  });
  return flops;
}

}  // namespace

std::optional<Throughput> throughput(const Simulation& s, double update_bandwidth) {
  const PhysicsSpec& p = s.domain.scene->physics;
  const bool counted = p.formulation != Formulation::pFp && p.description == Description::total
                       && s.domain.mixture.empty() && p.reconstruction != Reconstruction::constant
                       && !p.keep_angular_momentum && p.parting == 0;
  const auto law = !counted ? std::nullopt : law_flops(s.domain.scene->material, p.formulation);
  double seconds = 0;
  for (const SweepTime& sweep : s.team.clock.sweeps)
    if (sweep.sweep == "gradient" || sweep.sweep == "flux_update_stress") seconds += sweep.seconds;
  if (!law || s.state.step == 0 || !(seconds > 0)) return std::nullopt;
  const int stages = s.domain.scene->time.integrator == Integrator::tvd_rk2 ? 2 : 3;
  const Sizes sizes(s.domain.order);
  Work step = step_work(p, sizes, *law, stages, s.domain.scene->monitor.energy);
  if (!s.state.force.empty()) step = step + stages * force_work(sizes);
  const double nodes = s.domain.order.nodes, steps = static_cast<double>(s.state.step),
               rate = steps * step.bytes / seconds;
  Throughput out{step.bytes / nodes, step.flops / nodes, 1e-9 * rate, 1e-9 * steps * step.flops / seconds, {}, {}};
  if (update_bandwidth > 0) {
    out.update_GB_s = 1e-9 * update_bandwidth;
    out.bandwidth_share = rate / update_bandwidth;
  }
  return out;
}

}  // namespace nanson
