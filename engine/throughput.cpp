// Work of the steps from the traits, over the time of the sweeps.
#include "engine/throughput.hpp"
#include "engine/counted.hpp"
#include "engine/work.hpp"

namespace nanson {
namespace {

template <Law law, Volumetric volumetric, Isochoric isochoric>
double flops(Formulation f, const MaterialConstants& m) {
  if (f == Formulation::pF) return flops_of_law<law, volumetric, Isochoric::F, Formulation::pF>(m);
  if (f == Formulation::pFJ) return flops_of_law<law, volumetric, isochoric, Formulation::pFJ>(m);
  return flops_of_law<law, volumetric, isochoric, Formulation::pFHJ>(m);
}
template <Law law, Volumetric volumetric>
double flops(const MaterialSpec& s, Formulation f, const MaterialConstants& m) {
  return s.isochoric == Isochoric::J ? flops<law, volumetric, Isochoric::J>(f, m)
                                     : flops<law, volumetric, Isochoric::F>(f, m);
}
template <Law law>
double flops(const MaterialSpec& s, Formulation f, const MaterialConstants& m) {
  return s.volumetric == Volumetric::barrier ? flops<law, Volumetric::barrier>(s, f, m)
                                             : flops<law, Volumetric::quadratic>(s, f, m);
}

/// Of one evaluation of the scene's law; none for plasticity, whose work depends on what flows.
std::optional<double> law_flops(const MaterialSpec& s, Formulation f) {
  const MaterialConstants m = constants_of(s);
  if (s.law == Law::linear_elastic) return flops<Law::linear_elastic>(s, f, m);
  if (s.law == Law::neo_hookean) return flops<Law::neo_hookean>(s, f, m);
  if (s.law == Law::mooney_rivlin) return flops<Law::mooney_rivlin>(s, f, m);
  return std::nullopt;
}

}  // namespace

std::optional<Throughput> throughput(const Simulation& s, double update_bandwidth) {
  const PhysicsSpec& p = s.domain.scene->physics;
  const bool counted = p.formulation != Formulation::pFp && p.description == Description::total
                       && s.domain.mixture.empty() && s.domain.manufactured.waves.empty()
                       && p.reconstruction != Reconstruction::constant && !p.keep_angular_momentum && p.parting == 0;
  const auto law = !counted ? std::nullopt : law_flops(s.domain.scene->material, p.formulation);
  double seconds = 0;
  for (const SweepTime& sweep : s.team.clock.sweeps)
    if (sweep.sweep == "gradient" || sweep.sweep == "flux_update_stress") seconds += sweep.seconds;
  if (!law || s.state.step == 0 || !(seconds > 0)) return std::nullopt;
  const Work step = step_work(p, Sizes(s.domain.order), *law,
                              s.domain.scene->time.integrator == Integrator::tvd_rk2 ? 2 : 3,
                              s.domain.scene->monitor.energy);
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
