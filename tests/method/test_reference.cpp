// The fast solver against the plain loop of bench/naive_loop: the same numbers for every combination that is built.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "bench/naive_loop.hpp"
#include "engine/current_areas.hpp"
#include "engine/parts.hpp"
#include "engine/physics_rules.hpp"

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
void shake(Simulation& s, double distance = 0.01) {
  std::mt19937_64 random(7);
  const auto uniform = [&](double size) { return size * (static_cast<double>(random() >> 11) * 0x1p-52 - 1); };
  State& u = s.state;
  for (int n = 0; n < s.domain.order.nodes; ++n) {
    const auto r = static_cast<std::size_t>(s.domain.order.row_of[static_cast<std::size_t>(n)]);
    double* U = &u.U[0][row::U * r];
    for (int i = 0; i < 3; ++i) U[i] = uniform(5.0);
    U[3] = 1 + uniform(0.1);
    for (int m = 0; m < 9; ++m) U[4 * (m / 3 + 1) + m % 3] += uniform(0.1);
    for (int I = 0; I < 3; ++I) U[4 * (I + 1) + 3] += uniform(distance);
    for (int m = 0; m < 9 && !u.H[0].empty(); ++m) u.H[0][row::H * r + 4 * (m / 3) + m % 3] += uniform(0.1);
  }
  Rows rows{};
  rows.X = s.domain.X.data();
  rows.U_new = u.U[0].data();
  rows.H_new = u.H[0].data();
  rows.W_new = u.W[u.now].data();
  rows.PH_new = u.PH[u.now].data();
  rows.plastic = u.plastic.data();
  rows.detF = u.barrier.detF.data();
  for (std::size_t p = 0; p < s.domain.order.parts.size(); ++p)
    u.reports[p] = stress_of_part(s.domain, static_cast<int>(p), rows, s.domain.coefficients, scratch_of(s, 0));
  u.barrier.is_watched = false;
}

/// Power of the stabilisation over all parts, after the gradients of the present state.
double dissipation_of(Simulation& s) {
  const Rows rows = stage_rows(s.domain, s.state, 0, 0);
  const PartFunctions functions = find_part_functions(s.domain.scene->physics, s.domain.scene->material, true);
  Coefficients k = s.domain.coefficients;
  k.edge.audits = true;
  double power = 0;
  for (const Part& p : s.domain.order.parts)
    if (!s.state.G.empty())
      functions.gradient(p, s.domain.order.edges(), s.domain.order.corners(), s.domain.order.lists(), rows,
                         s.domain.coefficients);
  find_current_areas(s, rows.U_stage);
  for (const Part& p : s.domain.order.parts)
    power += functions.edge_flux(p, flux_edges(s), flux_corners(s), s.domain.order.lists(), rows, k, scratch_of(s, 0));
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
bool is_plain(const PhysicsSpec& p) {
  return !is_rare(p) && p.boundary_flux == BoundaryFlux::adjoint && p.upwind_metric == UpwindMetric::deformed;
}

/// The boundary's flux touches no edge: with one metric and without the fix is enough.
bool is_worth_its_time(const PhysicsSpec& p) {
  return p.boundary_flux == BoundaryFlux::adjoint
         || (p.upwind_metric == UpwindMetric::deformed && p.entropy_fix == EntropyFix::none);
}

/// Every choice of physics that the rules allow beside a scene's materials; the plain loop has no projection. Every other one has springs, which all loops add alike.
std::vector<PhysicsSpec> allowed_physics(Scene scene, Formulation formulation) {
  std::vector<PhysicsSpec> all;
  for (auto stabilisation : all_of<Stabilisation>())
    for (auto jump : all_of<PressureJump>())
      for (auto reconstruction : all_of<Reconstruction>())
        for (auto correction : all_of<FluxCorrection>())
          for (auto boundary : all_of<BoundaryFlux>())
            for (auto metric : all_of<UpwindMetric>())
              for (auto fix : all_of<EntropyFix>())
                for (auto description : all_of<Description>())
                  for (const double parting : {0.0, 0.8}) {
                    scene.physics = {formulation, stabilisation, jump,       reconstruction, correction,
                                     boundary,    metric,        fix,        parting,        0,
                                     0,           false,         description};
                    if (broken_rule(scene)) continue;
                    all.push_back(scene.physics);
                    scene.physics.tet_stiffness = all.size() % 2 == 0 ? 0 : 0.3;
                    if (!broken_rule(scene)) all.back() = scene.physics;
                  }
  return all;
}

std::string text_of(const PhysicsSpec& p) {
  std::string out;
  for (auto w : {word(p.formulation), word(p.stabilisation), word(p.pressure_jump), word(p.reconstruction),
                 word(p.flux_correction), word(p.boundary_flux), word(p.upwind_metric), word(p.entropy_fix),
                 word(p.description)})
    out += std::string(out.empty() ? "" : "_") + std::string(w);
  return out + (p.parting > 0 ? "_parting" : "") + (p.tet_stiffness > 0 ? "_springs" : "");
}

struct MaterialCase {
  Formulation formulation;
  Law law;
  Volumetric volumetric;
  Isochoric isochoric;
};

Scene scene_of(const MaterialCase& c) {
  Scene scene = loaded_box({11, 11, 11});
  scene.material.law = c.law;
  scene.material.volumetric = c.volumetric;
  scene.material.isochoric = c.isochoric;
  if (c.law == Law::mooney_rivlin) scene.material.xi = 2e5;
  if (law_traits(c.law).has_state) {
    scene.material.yield_stress = 1e6;
    scene.material.hardening_modulus = 4e6;
  }
  return scene;
}

std::vector<MaterialCase> materials() {
  std::vector<MaterialCase> all;
  for (auto formulation : {Formulation::pF, Formulation::pFJ, Formulation::pFHJ})
    for (auto law : all_of<Law>())
      for (auto volumetric : all_of<Volumetric>())
        for (auto isochoric : all_of<Isochoric>()) {
          const bool own = volumetric == Volumetric::quadratic && isochoric == Isochoric::F;
          if (law_traits(law).carries_energy && !own) continue;  // the scene's reader refuses it
          const MaterialCase c{formulation, law, volumetric, isochoric};
          Scene scene = scene_of(c);
          scene.physics.formulation = formulation;
          if (!broken_rule(scene)) all.push_back(c);
        }
  return all;
}

class Reference : public testing::TestWithParam<MaterialCase> {};

TEST_P(Reference, EveryAllowedCombinationGivesTheNumbersOfThePlainLoop) {
  const MaterialCase c = GetParam();
  Scene scene = scene_of(c);
  const Mesh mesh = mesh_of(scene);
  const bool one_law = c.law == Law::neo_hookean && c.volumetric == Volumetric::quadratic
                       && c.isochoric == Isochoric::F;
  for (const PhysicsSpec& p : allowed_physics(scene, c.formulation)) {
    if (one_law ? !is_worth_its_time(p) : !is_plain(p)) continue;
    scene.physics = p;
    const bool divides = is_rare(p) || law_traits(c.law).has_state;
    EXPECT_LT(difference_after(scene, mesh, 3, 1, 2), divides ? rare_tolerance : tolerance) << text_of(p);
  }
}

INSTANTIATE_TEST_SUITE_P(Materials, Reference, testing::ValuesIn(materials()), [](const auto& info) {
  const MaterialCase& c = info.param;
  return std::string(word(c.formulation)) + "_" + std::string(word(c.law)) + "_" + std::string(word(c.volumetric)) + "_"
         + std::string(word(c.isochoric));
});

/// The same for layers of three materials, two of which flow, in the third a law with energies of its own choice.
class ReferenceOfLayers : public testing::TestWithParam<Formulation> {};

Scene layers() {
  Scene scene = scene_of({Formulation::pFJ, Law::hencky_j2, Volumetric::quadratic, Isochoric::F});
  scene.mesh.regions = {Axis::z, {0.2 + 0.9 * 4 / 11, 0.2 + 0.9 * 7 / 11}, {"low", "middle", "high"}};
  scene.materials = {scene.material, scene.material, scene.material};
  scene.materials[0].regions = {name_of("low")};
  scene.materials[1].regions = {name_of("middle")};
  scene.materials[1].density = 2200;
  scene.materials[1].youngs_modulus = 60e6;
  scene.materials[1].yield_stress = 3e6;
  scene.materials[2].regions = {name_of("high")};
  scene.materials[2].law = Law::mooney_rivlin;
  scene.materials[2].xi = 2e5;
  scene.materials[2].volumetric = Volumetric::barrier;
  return scene;
}

TEST_P(ReferenceOfLayers, EveryAllowedCombinationGivesTheNumbersOfThePlainLoop) {
  Scene scene = layers();
  const Mesh mesh = mesh_of(scene);
  const auto all = allowed_physics(scene, GetParam());
  EXPECT_EQ(all.size(), GetParam() == Formulation::pF ? 104u : 264u);
  for (const PhysicsSpec& p : all) {
    if (!is_worth_its_time(p)) continue;
    scene.physics = p;
    EXPECT_LT(difference_after(scene, mesh, 3, 1, 2), rare_tolerance) << text_of(p);
  }
}

INSTANTIATE_TEST_SUITE_P(Formulations, ReferenceOfLayers,
                         testing::Values(Formulation::pF, Formulation::pFJ, Formulation::pFHJ),
                         [](const auto& info) { return std::string(word(info.param)); });

/// Places so random that tets are crushed and turned, in a body of several materials and parts.
TEST(Reference, CrushedTetsGiveTheNumbersOfThePlainLoop) {
  Scene scene = layers();
  const Mesh mesh = mesh_of(scene);
  for (auto formulation : {Formulation::pF, Formulation::pFJ, Formulation::pFHJ})
    for (auto correction : all_of<FluxCorrection>())
      for (auto description : all_of<Description>()) {
        scene.physics = {};
        scene.physics.formulation = formulation;
        scene.physics.flux_correction = correction;
        scene.physics.description = description;
        scene.physics.tet_stiffness = 0.2;
        scene.physics.tet_barrier = 0.5;
        if (broken_rule(scene)) continue;
        Simulation fast = make_simulation(scene, mesh, 2);
        shake(fast, 0.03);
        NaiveLoop naive = make_naive_loop(fast);
        fast.state.dt = 0.02 * allowed_step(fast);
        std::size_t crushed = 0;
        for (int i = 0; i < 3; ++i) {
          naive_advance(naive, fast.state.dt);
          advance(fast);
          for (const WatchedTets& w : fast.state.barrier.parts) crushed += w.touched.size();
        }
        EXPECT_GT(crushed, 1000u);
        EXPECT_FALSE(fast.breakdown.has_value());
        EXPECT_LT(largest_difference(naive, fast), 1e-10) << text_of(scene.physics);
      }
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
