// Angular momentum: with the projection it changes by the angular impulse of loads and supports alone, to round-off, and nothing else is disturbed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scenes.hpp"

namespace nanson::method {
namespace {

/// Soft bar, 1 x 1 x 2 m, that turns about a slanted axis and is stretched by it: a period of turning is 6 s.
Scene soft_bar(int n = 2) {
  Scene s;
  s.name = "soft_bar";
  s.mesh.origin = {-0.5, -0.5, 0};
  s.mesh.size = {1, 1, 2};
  s.mesh.cells = {n, n, 2 * n};
  s.mesh.perturb = 0.2;
  s.material.density = 1000;
  s.material.youngs_modulus = 5e4;
  s.material.poissons_ratio = 0.3;
  s.initial.field = InitialField::rotation;
  s.initial.omega = {0.4, -0.3, 0.9};
  s.physics.keep_angular_momentum = true;
  s.time.end = 1;
  return s;
}

/// The bar with every kind of load, and with a fixed, a sliding and a driven face.
Scene driven_bar(bool held) {
  Scene s = soft_bar();
  s.boundary = {condition({"xmax"}, BoundaryKind::traction), condition({"ymax"}, BoundaryKind::pressure)};
  s.boundary[0].traction = {300, -200, 500};
  s.boundary[1].pressure = 800;
  s.boundary[1].time.kind = TimeKind::sine;
  s.boundary[1].time.frequency = 0.7;
  s.body_force = {0.3, -0.5, -0.8};
  if (!held) return s;
  s.boundary.push_back(condition({"zmin"}, BoundaryKind::fixed));
  s.boundary.push_back(condition({"xmin"}, BoundaryKind::symmetric));
  s.boundary.push_back(condition({"zmax"}, BoundaryKind::velocity));
  s.boundary[4].velocity = {0, 0.2, 0};
  s.boundary[4].held = {false, true, false};
  s.boundary[4].time.kind = TimeKind::ramp;
  s.boundary[4].time.until = 0.5;
  return s;
}

/// The scene's box turned by the angle around an axis that lies in no plane of it, then moved along x.
Mesh turned(const Scene& scene, double angle, double shift) {
  RawMesh raw = make_box(scene.mesh);
  const double q = std::sqrt(14.0), axis[3] = {1 / q, 2 / q, 3 / q}, cosine = std::cos(angle), sine = std::sin(angle);
  for (Vec3& X : raw.X) {
    const double along = axis[0] * X[0] + axis[1] * X[1] + axis[2] * X[2];
    const Vec3 Y = X;
    for (int k = 0; k < 3; ++k)
      X[k] = cosine * Y[k] + sine * (axis[(k + 1) % 3] * Y[(k + 2) % 3] - axis[(k + 2) % 3] * Y[(k + 1) % 3])
             + (1 - cosine) * along * axis[k];
    X[0] += shift;
  }
  return mesh_of(std::move(raw));
}

/// Runs a scene on its box, turned about (1, 2, 3) by `angle` [rad] and moved by `shift` [m] along x: supports are inclined then.
struct Trial {
  Scene scene;
  Mesh mesh;
  Simulation s;
  std::string status;

  explicit Trial(const Scene& given, double angle = 0, double shift = 0, int threads = 1)
      : scene(given), mesh(turned(scene, angle, shift)), s(make_simulation(scene, mesh, threads)) {
    status = run_quietly(s);
  }
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;
  double drift() { return *angular_momentum_drift(s); }
};

Scene without(Scene s) { return s.physics.keep_angular_momentum = false, s; }

TEST(AngularMomentum, OfAFreeBarIsConstantOverTenSecondsAndLostWithoutTheProjection) {
  for (auto formulation : formulations) {
    Scene scene = soft_bar();
    scene.physics.formulation = formulation;
    scene.time.end = 10;
    Trial kept(scene), lost(without(scene));
    RecordProperty(fmt::format("drift_{}", word(formulation)),
                   fmt::format("{:.2e} in {} steps, {:.2e} without", kept.drift(), kept.s.state.step, lost.drift()));
    EXPECT_EQ(kept.status, "done");
    EXPECT_GT(kept.s.state.step, 300);
    EXPECT_LE(kept.drift(), 1e-13) << word(formulation);
    EXPECT_GE(lost.drift(), 1e-4) << word(formulation);
  }
}

TEST(AngularMomentum, ChangesByTheImpulseOfLoadsAndSupportsOnlyFixedSlidingDrivenAndInclined) {
  for (bool held : {false, true})
    for (double angle : {0.0, 0.7})
      for (auto correction : {FluxCorrection::none, FluxCorrection::full}) {
        Scene scene = driven_bar(held);
        scene.physics.flux_correction = correction;
        Trial kept(scene, angle), lost(without(scene), angle);
        EXPECT_EQ(kept.status, "done");
        EXPECT_LE(kept.drift(), 1e-13) << held << ' ' << angle;
        EXPECT_GE(lost.drift(), 1e-6) << held << ' ' << angle;
      }
}

TEST(AngularMomentum, IsKeptInEveryScheme) {
  for (int variant = 0; variant < 4; ++variant) {
    Scene scene = driven_bar(true);
    if (variant == 0) scene.physics.reconstruction = Reconstruction::constant;
    if (variant == 1) scene.physics.reconstruction = Reconstruction::limited;
    if (variant == 2) scene.physics.stabilisation = Stabilisation::jst;
    if (variant == 3) scene.physics.boundary_flux = BoundaryFlux::paper;
    scene.time.cfl = 0.2;
    Trial kept(scene, 0.7);
    EXPECT_EQ(kept.status, "done");
    EXPECT_LE(kept.drift(), 1e-13) << variant;
    EXPECT_LE(linear_momentum_drift(kept.s), 1e-13) << variant;
  }
}

TEST(AngularMomentum, FarFromTheOriginItIsKeptAsWell) {
  Trial far(soft_bar(), 0, 1000);
  EXPECT_LE(far.drift(), 1e-13);
}

TEST(AngularMomentum, TheProjectionLeavesLinearMomentumAlone) {
  Scene moving = soft_bar();
  moving.initial.centre = Vec3{3, 1, 0};
  moving.time.end = 5;
  for (const Scene& scene : {moving, driven_bar(false), driven_bar(true)}) {
    Trial kept(scene, 0.7);
    EXPECT_LE(linear_momentum_drift(kept.s), 1e-13);
  }
}

TEST(AngularMomentum, HeldVelocitiesStayExact) {
  Trial kept(driven_bar(true));
  const double expected = 0.2;  // [m/s] the ramp has ended
  int driven = 0;
  for (const Face& f : kept.mesh.faces)
    if (f.patch >= 0 && kept.mesh.patch_names[static_cast<std::size_t>(f.patch)] == "zmax")
      for (int n : f.nodes) {
        double v[3];
        field_named("velocity").at(kept.s, n, v);
        EXPECT_NEAR(v[1], expected, 1e-14);
        ++driven;
      }
  EXPECT_GT(driven, 0);
}

TEST(AngularMomentum, TheEnergyAuditClosesWithThePowerOfTheProjection) {
  for (bool loaded : {false, true})
    for (auto formulation : formulations) {
      Scene scene = loaded ? driven_bar(true) : soft_bar();
      scene.physics.formulation = formulation;
      scene.monitor.energy = true;
      if (loaded) {
        scene.boundary[4].velocity = {0, 0, 0};
        scene.initial.field = InitialField::twist;
        scene.initial.twist_omega = 0.9;
        scene.initial.height = 2;
      }
      double residual[2];
      for (int half = 0; half < 2; ++half) {
        scene.time.cfl = (loaded ? 0.25 : 0.3) / (half ? 2 : 1);  // loads that start at once are harder
        Trial kept(scene);
        residual[half] = energy_closure(kept.s, energies(kept.s));
        const double work = std::abs(kept.s.books.angular_momentum_work) / kept.s.books.initial_energy;
        RecordProperty(fmt::format("closure_{}_{}_{}", loaded, word(formulation), half),
                       fmt::format("{:.2e}, work of the projection {:.2e}", residual[half], work));
        EXPECT_GT(work, 10 * residual[half]) << "too little to be missed";
      }
      EXPECT_LT(residual[0], 1e-3) << loaded << word(formulation);
      EXPECT_LT(residual[1], residual[0] / 3) << loaded << word(formulation);
    }
}

TEST(AngularMomentum, RunsAreBitwiseEqualForAnyNumberOfThreads) {
  Scene scene = driven_bar(true);
  scene.mesh.cells = {12, 12, 24};
  scene.time.max_steps = 8;
  scene.monitor.energy = true;
  Trial one(scene, 0.7, 0, 1);
  EXPECT_GE(one.s.domain.order.parts.size(), 3u);
  for (int threads : {2, 3}) {
    Trial more(scene, 0.7, 0, threads);
    EXPECT_EQ(state_hash(one.s), state_hash(more.s)) << threads;
    EXPECT_EQ(one.s.books.angular_impulse, more.s.books.angular_impulse) << threads;
    EXPECT_EQ(one.s.books.angular_momentum_work, more.s.books.angular_momentum_work) << threads;
  }
}

TEST(AngularMomentum, UnderSspRk3TheDriftOfLoadedBodiesIsNotClaimed) {
  Scene scene = without(driven_bar(true));
  scene.time.integrator = Integrator::ssp_rk3;
  scene.time.max_steps = 2;
  Trial loaded(scene);
  EXPECT_FALSE(angular_momentum_drift(loaded.s).has_value());
  scene.boundary.clear();
  scene.body_force = {};
  Trial free(scene);
  EXPECT_TRUE(angular_momentum_drift(free.s).has_value());
}

}  // namespace
}  // namespace nanson::method
