// Each sweep by itself, one thread, for every trait that it branches on, on a deformed alternating box. Before it is timed, one stage with the same sweeps is
// compared with the plain loop.
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "bench/bench.hpp"
#include "bench/naive_loop.hpp"
#include "engine/counted.hpp"
#include "engine/node_geometry.hpp"
#include "engine/parts.hpp"
#include "engine/start.hpp"

namespace nanson {
namespace {

Scene scene_of_bed() {
  Scene scene;
  const int n = options().cells;
  scene.mesh.size = {1, 1, 1};
  scene.mesh.cells = {n, n, n};
  scene.material.density = 1100;
  scene.material.youngs_modulus = 17e6;
  scene.material.poissons_ratio = 0.495;
  scene.material.xi = 2e5;
  return scene;
}

Simulation with_weights(const Scene& scene, const Mesh& mesh) {
  Team team = make_team(1);
  Domain d = make_domain(scene, mesh, team.setup);
  d.lambda = laplacian_weights(mesh, make_dual(mesh), d.order);
  return nanson::start(std::move(d), std::move(team));
}

/// A simulation that carries every row, so that any set of sweeps can run on it.
struct Bed {
  Scene scene = scene_of_bed();
  Mesh mesh = box_mesh(scene.mesh);
  Simulation s = with_weights(scene, mesh);
  Coefficients k = s.domain.coefficients;
  PartFunctions functions, audited;

  Bed() {
    PhysicsSpec& all = scene.physics;  // not a combination that is built, but every row is there
    all.stabilisation = Stabilisation::jst;
    all.formulation = Formulation::pFHJ;
    all.pressure_jump = PressureJump::tensor;
    all.flux_correction = FluxCorrection::full;
    s.state = make_state(s.domain);
    s.state.q.assign(s.domain.order.C[0].size(), 0.0);
    deform();
  }

  /// Smooth velocities and a finite deformation; det F, J and H a little apart.
  void deform() {
    for (int r = 0; r < s.domain.order.rows; ++r) {
      const double* X = &s.domain.X[static_cast<std::size_t>(row::X * r)];
      double *U = &s.state.U[0][static_cast<std::size_t>(row::U * r)],
             *H = &s.state.H[0][static_cast<std::size_t>(row::H * r)];
      const auto wave = [&](int k) { return std::sin(k + 3 * X[k % 3] + 2 * X[(k + 1) % 3] + 1.3 * X[(k + 2) % 3]); };
      for (int i = 0; i < 3; ++i) U[i] = 10 * wave(i);
      U[3] = 1 + 0.02 * wave(3);
      for (int m = 0; m < 9; ++m) {
        U[4 * (m / 3 + 1) + m % 3] += 0.1 * wave(4 + m);
        H[4 * (m / 3) + m % 3] += 0.1 * wave(13 + m);
      }
    }
  }

  void choose(const PhysicsSpec& p, const MaterialSpec& m) {
    scene.physics = p;
    scene.material = m;
    functions = find_part_functions(p, m);
    audited = find_part_functions(p, m, true);
    k.material = constants_of(m, p);
    k.edge = edge_choices(p);
    k.sweeps_J = p.stabilisation == Stabilisation::jst;
  }

  Rows rows() { return stage_rows(s.domain, s.state, 0, 1); }  // of the first stage of a step
  Coefficients coefficients(double dt) {
    Coefficients of_stage = k;
    of_stage.dt = dt;
    return of_stage;
  }

  template <class Sweep>
  void over_parts(Sweep sweep) {
    for (const Part& p : s.domain.order.parts) sweep(p, scratch_of(s, 0));
  }
  void start() {  // stress of the start
    Rows r = rows();
    r.U_new = s.state.U[0].data();
    r.H_new = s.state.H[0].data();
    r.W_new = s.state.W[0].data();
    r.PH_new = s.state.PH[0].data();
    over_parts([&](const Part& p, Scratch) { functions.stress(p, r, k, s.domain.step_length.data()); });
  }
  void gradient() {
    over_parts([&](const Part& p, Scratch) {
      functions.gradient(p, s.domain.order.edges(), s.domain.order.corners(), s.domain.order.lists(), rows(), k);
    });
  }
  double flux(const Part& p, Scratch scratch, bool audits = false) {
    Coefficients of_loop = k;
    of_loop.edge.audits = audits;
    return (audits ? audited : functions)
        .edge_flux(p, s.domain.order.edges(), s.domain.order.corners(), s.domain.order.lists(), rows(), of_loop,
                   scratch);
  }
  void update(const Part& p, Scratch scratch, double dt) {
    functions.accumulate_update(p, s.domain.order.edges(), s.domain.order.lists(), rows(), coefficients(dt),
                                s.domain.boundary.constraints.data(), s.state.reactions.data(), scratch);
  }
  void stress(const Part& p) { functions.stress(p, rows(), k, s.domain.step_length.data()); }
  double dissipation() {
    double power = 0;
    over_parts([&](const Part& p, Scratch scratch) { power += flux(p, scratch, true); });
    return power;
  }

  /// Difference to the plain loop after one stage, and of the stabilisation's power.
  double difference() {
    const double dt = 1e-3 / (options().cells * k.material.cp);
    start();
    gradient();
    if (functions.corrects_stress) std::swap(s.state.PH[0], s.state.PH[1]);
    over_parts([&](const Part& p, Scratch scratch) { flux(p, scratch), update(p, scratch, dt), stress(p); });
    start();
    NaiveLoop naive = make_naive_loop(s);
    naive_material(naive, naive.now, naive.H_now, false);
    const double of_power = scene.physics.stabilisation == Stabilisation::upwind
                                ? std::abs(dissipation() / naive_dissipation(naive) - 1)
                                : 0.0;
    naive_stage(naive, 0, dt);
    return std::max(of_power, largest_difference(naive, naive.stage, s.state.U[1].data(), s.state.W[1].data(),
                                                 s.state.PH[1].data()));
  }
};

Bed& bed() {
  static auto all = std::make_unique<Bed>();
  return *all;
}

/// Checks, then times `sweep` one by one; the median counts.
template <class Sweep, class Model>
void time_sweep(benchmark::State& state, const PhysicsSpec& p, const MaterialSpec& m, Sweep sweep, Model model) {
  Bed& b = bed();
  b.choose(p, m);
  const double difference = b.difference();
  if (!(difference < same))
    return state.SkipWithError(fmt::format("differs from the plain loop by {:.1e}", difference).c_str());
  std::vector<double> seconds;
  for (auto _ : state) {
    const double start = thread_seconds();
    sweep(b);
    seconds.push_back(thread_seconds() - start);
  }
  set_columns(state, median(seconds), b.s.domain.order.nodes, model(Sizes(b.s.domain.order)), 1);
}

template <class Sweep, class Model>
void add(const std::string& name, const PhysicsSpec& p, const MaterialSpec& m, Sweep sweep, Model model) {
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    time_sweep(state, p, m, sweep, model);
  })->Unit(benchmark::kMillisecond);
}

MaterialSpec material_of(Law law, Volumetric volumetric = Volumetric::quadratic, Isochoric isochoric = Isochoric::F) {
  MaterialSpec m;
  m.law = law;
  m.density = 1100;
  m.youngs_modulus = 17e6;
  m.poissons_ratio = 0.495;
  m.xi = 2e5;
  m.volumetric = volumetric;
  m.isochoric = isochoric;
  return m;
}

PhysicsSpec sweeps(Formulation formulation, PressureJump jump, Reconstruction reconstruction, FluxCorrection correction,
                   UpwindMetric metric = UpwindMetric::deformed) {
  PhysicsSpec p;
  p.formulation = formulation;
  p.pressure_jump = jump;
  p.reconstruction = reconstruction;
  p.flux_correction = correction;
  p.upwind_metric = metric;
  return p;
}

std::string traits_of(const PhysicsSpec& p) {
  std::string out;
  for (auto w : {word(p.reconstruction), word(p.flux_correction),
                 word(p.formulation == Formulation::pFHJ ? Formulation::pFJ : p.formulation), word(p.pressure_jump),
                 word(p.upwind_metric)})
    out += "/" + std::string(w);
  return out;
}

void register_edge_sweeps() {
  for (auto metric : {UpwindMetric::deformed, UpwindMetric::paper})
    for (auto [formulation, jump] :
         {std::pair(Formulation::pF, PressureJump::scalar), std::pair(Formulation::pFJ, PressureJump::scalar),
          std::pair(Formulation::pFJ, PressureJump::tensor)})
      for (auto [reconstruction, correction] : {std::pair(Reconstruction::constant, FluxCorrection::none),
                                                std::pair(Reconstruction::linear, FluxCorrection::none),
                                                std::pair(Reconstruction::linear, FluxCorrection::pressure),
                                                std::pair(Reconstruction::linear, FluxCorrection::full)}) {
        const PhysicsSpec p = sweeps(formulation, jump, reconstruction, correction, metric);
        const MaterialSpec m = material_of(Law::neo_hookean);
        add(
            "edge_flux" + traits_of(p), p, m,
            [](Bed& b) { b.over_parts([&](const Part& part, Scratch scratch) { b.flux(part, scratch); }); },
            [p](const Sizes& s) { return edge_flux_work(Carried(p), s); });
        if (correction == FluxCorrection::none)
          add(
              "edge_flux" + traits_of(p) + "/audit", p, m, [](Bed& b) { benchmark::DoNotOptimize(b.dissipation()); },
              [p](const Sizes& s) { return edge_flux_work(Carried(p), s, true); });
      }
}

void register_gradients() {
  for (auto jump : {PressureJump::scalar, PressureJump::tensor})
    for (auto correction : {FluxCorrection::none, FluxCorrection::full}) {
      const PhysicsSpec p = sweeps(Formulation::pFJ, jump, Reconstruction::linear, correction);
      add(
          "gradient/" + std::string(word(jump)) + "/" + std::string(word(correction)), p, material_of(Law::neo_hookean),
          [](Bed& b) { b.gradient(); }, [p](const Sizes& s) { return gradient_work(Carried(p), s); });
    }
}

/// Options beside the main road: limiter, entropy fix, Jameson-Schmidt-Turkel.
void register_options() {
  PhysicsSpec limited, fixed, jst;
  limited.reconstruction = Reconstruction::limited;
  fixed.entropy_fix = EntropyFix::edge;
  jst.stabilisation = Stabilisation::jst;
  const MaterialSpec m = material_of(Law::neo_hookean);
  const auto gradient = [](Bed& b) { b.gradient(); };
  const auto flux = [](Bed& b) { b.over_parts([&](const Part& part, Scratch scratch) { b.flux(part, scratch); }); };
  for (auto [name, p] : {std::pair("limited", limited), std::pair("jst", jst)})
    add("gradient/" + std::string(name), p, m, gradient,
        [p = p](const Sizes& s) { return gradient_work(Carried(p), s); });
  for (auto [name, p] : {std::pair("limited", limited), std::pair("entropy_fix", fixed), std::pair("jst", jst)})
    add("edge_flux/" + std::string(name), p, m, flux,
        [p = p](const Sizes& s) { return edge_flux_work(Carried(p), s); });
}

void register_updates() {
  for (auto formulation : {Formulation::pF, Formulation::pFJ, Formulation::pFHJ})
    for (auto correction : {FluxCorrection::none, FluxCorrection::pressure}) {
      const PhysicsSpec p = sweeps(formulation, PressureJump::scalar, Reconstruction::linear, correction);
      add(
          "accumulate_update/" + std::string(word(formulation))
              + (correction == FluxCorrection::none ? "" : "/corrected"),
          p, material_of(Law::neo_hookean),
          [](Bed& b) { b.over_parts([&](const Part& part, Scratch scratch) { b.update(part, scratch, 1e-9); }); },
          [p](const Sizes& s) { return accumulate_update_work(Carried(p), s, true); });
    }
}

template <Law law, Volumetric volumetric, Isochoric isochoric, Formulation formulation>
void register_stress() {
  PhysicsSpec p;
  p.formulation = formulation;
  const MaterialSpec m = material_of(law, volumetric, isochoric);
  std::string name = "stress";
  for (auto w : {word(law), word(volumetric), word(isochoric), word(formulation)}) name += "/" + std::string(w);
  add(
      name, p, m, [](Bed& b) { b.over_parts([&](const Part& part, Scratch) { b.stress(part); }); },
      [p, m](const Sizes& s) {
        return stress_work(Carried(p), s, flops_of_law<law, volumetric, isochoric, formulation>(constants_of(m)), true);
      });
}

template <Law law, Volumetric volumetric>
void register_finite_strain() {
  register_stress<law, volumetric, Isochoric::F, Formulation::pF>();
  register_stress<law, volumetric, Isochoric::F, Formulation::pFJ>();
  register_stress<law, volumetric, Isochoric::F, Formulation::pFHJ>();
  register_stress<law, volumetric, Isochoric::J, Formulation::pFJ>();
  register_stress<law, volumetric, Isochoric::J, Formulation::pFHJ>();
}

}  // namespace

void register_sweeps() {
  register_gradients();
  register_edge_sweeps();
  register_options();
  register_updates();
  register_stress<Law::linear_elastic, Volumetric::quadratic, Isochoric::F, Formulation::pF>();
  register_stress<Law::linear_elastic, Volumetric::quadratic, Isochoric::F, Formulation::pFJ>();
  register_stress<Law::linear_elastic, Volumetric::quadratic, Isochoric::F, Formulation::pFHJ>();
  register_finite_strain<Law::neo_hookean, Volumetric::quadratic>();
  register_finite_strain<Law::neo_hookean, Volumetric::barrier>();
  register_finite_strain<Law::mooney_rivlin, Volumetric::quadratic>();
  register_finite_strain<Law::mooney_rivlin, Volumetric::barrier>();
}

}  // namespace nanson
