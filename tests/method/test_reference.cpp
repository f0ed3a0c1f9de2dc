// The fast solver against the plain loop of bench/naive_loop: the same numbers for every combination that is built.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "bench/naive_loop.hpp"
#include "engine/current_areas.hpp"
#include "engine/parts.hpp"

namespace nanson {
namespace {

constexpr double tolerance = 1e-13;       // relative to the largest value of each field
constexpr double rare_tolerance = 1e-12;  // the limiter divides by small slopes

Named name_of(const char* face) { return {face, ""}; }

/// A perturbed alternating box with every kind of support and load: two parts with 12 x 12 x 12 nodes.
Scene loaded_box(std::array<int, 3> cells) {
  Scene s;
  s.mesh.origin = {-0.3, 0.1, 0.2};
  s.mesh.size = {1.0, 1.2, 0.9};
  s.mesh.cells = cells;
  s.mesh.perturb = 0.2;
  s.material.density = 1100;
  s.material.youngs_modulus = 17e6;
  s.material.poissons_ratio = 0.4;
  s.body_force = {0.5, -9.81, 2.0};
  BoundarySpec fixed, symmetric, skew, traction, pressure, velocity;
  fixed.kind = BoundaryKind::fixed;
  fixed.faces = {name_of("zmin")};
  symmetric.kind = BoundaryKind::symmetric;
  symmetric.faces = {name_of("xmin")};
  skew.kind = BoundaryKind::skew_symmetric;
  skew.faces = {name_of("ymin")};
  traction.kind = BoundaryKind::traction;
  traction.faces = {name_of("xmax")};
  traction.traction = {2e5, -1e5, 3e5};
  traction.time.kind = TimeKind::ramp;
  traction.time.until = 1e-3;
  pressure.kind = BoundaryKind::pressure;
  pressure.faces = {name_of("ymax"), name_of("xmax")};
  pressure.pressure = 4e5;
  velocity.kind = BoundaryKind::velocity;
  velocity.faces = {name_of("zmax")};
  velocity.velocity = {3.0, 0.0, -2.0};
  velocity.held = {true, false, true};
  velocity.time.kind = TimeKind::sine;
  velocity.time.frequency = 400;
  velocity.time.phase = 0.3;
  s.boundary = {fixed, symmetric, skew, traction, pressure, velocity};
  return s;
}

Mesh mesh_of(const Scene& s) {
  std::vector<std::string> errors;
  Mesh mesh = finish_mesh(make_box(s.mesh), errors);
  EXPECT_TRUE(errors.empty());
  return mesh;
}

/// Everything that is carried takes random values, det F, J and H apart from each other; then the stress of that state.
void shake(Simulation& s) {
  std::mt19937_64 random(7);
  const auto uniform = [&](double size) { return size * (static_cast<double>(random() >> 11) * 0x1p-52 - 1); };
  State& u = s.state;
  for (int n = 0; n < s.domain.order.nodes; ++n) {
    const auto r = static_cast<std::size_t>(s.domain.order.row_of[static_cast<std::size_t>(n)]);
    double* U = &u.U[0][row::U * r];
    for (int i = 0; i < 3; ++i) U[i] = uniform(5.0);
    U[3] = 1 + uniform(0.1);
    for (int m = 0; m < 9; ++m) U[4 * (m / 3 + 1) + m % 3] += uniform(0.1);
    for (int I = 0; I < 3; ++I) U[4 * (I + 1) + 3] += uniform(0.01);
    for (int m = 0; m < 9 && !u.H[0].empty(); ++m) u.H[0][row::H * r + 4 * (m / 3) + m % 3] += uniform(0.1);
  }
  Rows rows{};
  rows.X = s.domain.X.data();
  rows.U_new = u.U[0].data();
  rows.H_new = u.H[0].data();
  rows.W_new = u.W[u.now].data();
  rows.PH_new = u.PH[u.now].data();
  for (std::size_t p = 0; p < s.domain.order.parts.size(); ++p)
    s.state.reports[p] = s.domain.functions.stress(s.domain.order.parts[p], rows, s.domain.coefficients,
                                                   s.domain.step_length.data());
}

/// Power of the stabilisation over all parts, after the gradients of the present state.
double dissipation_of(Simulation& s) {
  const Rows rows = stage_rows(s.domain, s.state, 0, 0);
  const PartFunctions functions = find_part_functions(s.domain.scene->physics, s.domain.scene->material, Materials::one,
                                                      true);
  double power = 0;
  for (const Part& p : s.domain.order.parts)
    if (!s.state.G.empty())
      functions.gradient(p, s.domain.order.edges(), s.domain.order.corners(), s.domain.order.lists(), rows,
                         s.domain.coefficients);
  find_current_areas(s, rows.U_stage);
  for (const Part& p : s.domain.order.parts)
    power += functions.edge_flux(p, flux_edges(s), flux_corners(s), s.domain.order.lists(), rows, s.domain.coefficients,
                                 scratch_of(s, 0));
  return power;
}

/// Largest relative difference after some steps from a random state.
double difference_after(const Scene& scene, const Mesh& mesh, int steps, int threads, std::size_t least_parts) {
  Simulation fast = make_simulation(scene, mesh, threads);
  EXPECT_GE(fast.domain.order.parts.size(), least_parts);
  shake(fast);
  NaiveLoop naive = make_naive_loop(fast);
  if (scene.physics.stabilisation == Stabilisation::upwind) {
    EXPECT_NEAR(dissipation_of(fast) / naive_dissipation(naive), 1, 1e-12);
  }
  fast.state.dt = 0.5 * allowed_step(fast);
  for (int i = 0; i < steps; ++i) {
    naive_advance(naive, fast.state.dt);
    advance(fast);
  }
  EXPECT_FALSE(fast.breakdown.has_value());
  EXPECT_NEAR(naive.report.fastest * allowed_step(fast) / scene.time.cfl, 1, 1e-12);
  return largest_difference(naive, fast);
}

template <class Choice>
std::vector<Choice> all_of() {
  std::vector<Choice> all;
  for (std::size_t i = 0; i < words(Choice{}).size(); ++i) all.push_back(static_cast<Choice>(i));
  return all;
}

/// Options that do not multiply with the materials: one law each is enough, since no sweep but the stress knows one.
bool is_rare(const PhysicsSpec& p) {
  return p.reconstruction == Reconstruction::limited || p.entropy_fix != EntropyFix::none
         || p.stabilisation != Stabilisation::upwind;
}

/// Every set of sweeps that is built for a formulation.
std::vector<PhysicsSpec> sweeps_of(Formulation formulation) {
  std::vector<PhysicsSpec> all;
  for (auto stabilisation : all_of<Stabilisation>())
    for (auto jump : all_of<PressureJump>())
      for (auto reconstruction : all_of<Reconstruction>())
        for (auto correction : all_of<FluxCorrection>())
          for (auto boundary : all_of<BoundaryFlux>())
            for (auto metric : all_of<UpwindMetric>())
              for (auto fix : all_of<EntropyFix>()) {
                const PhysicsSpec p{formulation, stabilisation, jump,   reconstruction,
                                    correction,  boundary,      metric, fix};
                const bool tensor = jump == PressureJump::tensor;
                if (reconstruction == Reconstruction::constant && correction != FluxCorrection::none) continue;
                if (tensor && (formulation == Formulation::pF || is_rare(p))) continue;
                if (stabilisation == Stabilisation::jst
                    && (reconstruction != Reconstruction::linear || correction != FluxCorrection::none
                        || fix != EntropyFix::none))
                  continue;
                all.push_back(p);
              }
  return all;
}

std::string text_of(const PhysicsSpec& p) {
  std::string out;
  for (auto w : {word(p.formulation), word(p.stabilisation), word(p.pressure_jump), word(p.reconstruction),
                 word(p.flux_correction), word(p.boundary_flux), word(p.upwind_metric), word(p.entropy_fix)})
    out += std::string(out.empty() ? "" : "_") + std::string(w);
  return out;
}

struct MaterialCase {
  Formulation formulation;
  Law law;
  Volumetric volumetric;
  Isochoric isochoric;
  double parting = 0;
};

std::vector<MaterialCase> materials() {
  std::vector<MaterialCase> all;
  for (auto formulation : all_of<Formulation>())
    for (auto law : all_of<Law>())
      for (auto volumetric : all_of<Volumetric>())
        for (auto isochoric : all_of<Isochoric>()) {
          if (formulation == Formulation::pFp || law == Law::hencky_j2) continue;  // the plain loop has neither
          if (law == Law::linear_elastic && (volumetric != Volumetric::quadratic || isochoric != Isochoric::F))
            continue;
          if (formulation == Formulation::pF && isochoric != Isochoric::F) continue;
          all.push_back({formulation, law, volumetric, isochoric});
          if (formulation != Formulation::pF && law != Law::linear_elastic && volumetric == Volumetric::quadratic
              && isochoric == Isochoric::F)
            all.push_back({formulation, law, volumetric, isochoric, 0.8});
        }
  return all;
}

class Reference : public testing::TestWithParam<MaterialCase> {};

TEST_P(Reference, EveryBuiltCombinationGivesTheNumbersOfThePlainLoop) {
  const MaterialCase c = GetParam();
  Scene scene = loaded_box({11, 11, 11});
  scene.material.law = c.law;
  scene.material.volumetric = c.volumetric;
  scene.material.isochoric = c.isochoric;
  if (c.law == Law::mooney_rivlin) scene.material.xi = 2e5;
  const Mesh mesh = mesh_of(scene);
  const bool one_law = c.law == Law::neo_hookean && c.volumetric == Volumetric::quadratic
                       && c.isochoric == Isochoric::F;
  for (const PhysicsSpec& p : sweeps_of(c.formulation)) {
    if (is_rare(p) && (!one_law || c.parting > 0)) continue;
    if (c.parting > 0 && p.pressure_jump != PressureJump::scalar) continue;  // no scene has both
    scene.physics = p;
    scene.physics.parting = c.parting;
    EXPECT_LT(difference_after(scene, mesh, 3, 1, 2), is_rare(p) ? rare_tolerance : tolerance) << text_of(p);
  }
}

INSTANTIATE_TEST_SUITE_P(Materials, Reference, testing::ValuesIn(materials()), [](const auto& info) {
  const MaterialCase& c = info.param;
  return std::string(word(c.formulation)) + "_" + std::string(word(c.law)) + "_" + std::string(word(c.volumetric)) + "_"
         + std::string(word(c.isochoric)) + (c.parting > 0 ? "_parting" : "");
});

TEST(Reference, CurrentAreasGiveTheNumbersOfThePlainLoop) {
  Scene scene = loaded_box({11, 11, 11});
  const Mesh mesh = mesh_of(scene);
  for (auto description : {Description::updated, Description::pseudo_updated})
    for (auto integrator : {Integrator::tvd_rk2, Integrator::ssp_rk3})
      for (auto reconstruction : {Reconstruction::constant, Reconstruction::linear})
        for (auto metric : all_of<UpwindMetric>()) {
          scene.physics.description = description;
          scene.physics.reconstruction = reconstruction;
          scene.physics.upwind_metric = metric;
          scene.time.integrator = integrator;
          EXPECT_LT(difference_after(scene, mesh, 3, 2, 2), tolerance)
              << word(description) << " " << word(integrator) << " " << text_of(scene.physics);
        }
  scene.material.law = Law::mooney_rivlin;
  scene.material.xi = 2e5;
  scene.material.volumetric = Volumetric::barrier;
  scene.material.isochoric = Isochoric::J;
  EXPECT_LT(difference_after(scene, mesh, 3, 1, 2), tolerance);
}

TEST(Reference, BothIntegratorsGiveTheNumbersOfThePlainLoopOnManyParts) {
  Scene scene = loaded_box({15, 15, 16});
  const Mesh mesh = mesh_of(scene);
  for (auto integrator : {Integrator::tvd_rk2, Integrator::ssp_rk3})
    for (auto formulation : all_of<Formulation>())
      for (auto correction : all_of<FluxCorrection>()) {
        if (formulation == Formulation::pFp) continue;  // the plain loop has no projection
        scene.time.integrator = integrator;
        scene.physics = {};
        scene.physics.formulation = formulation;
        scene.physics.flux_correction = correction;
        const int threads = correction == FluxCorrection::none ? 2 : 1;
        EXPECT_LT(difference_after(scene, mesh, 4, threads, 4), tolerance)
            << word(integrator) << " " << text_of(scene.physics);
      }
}

}  // namespace
}  // namespace nanson
