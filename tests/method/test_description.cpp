// Updated and pseudo Updated Lagrangian fluxes: current area vectors (method, section 8).
#include <gtest/gtest.h>

#include <map>

#include "scenes.hpp"

namespace nanson::method {
namespace {

constexpr std::array current{Description::updated, Description::pseudo_updated};
constexpr std::array all{Description::total, Description::updated, Description::pseudo_updated};

Scene with(Scene s, Description d, Reconstruction r = Reconstruction::linear) {
  s.physics.description = d;
  s.physics.reconstruction = r;
  return s;
}

/// Random positions, velocities, F and J, each apart from the others.
void shake(Simulation& s) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int n = 0; n < s.domain.order.nodes; ++n) {
    double* U = U_of(s, n);
    for (int i = 0; i < 3; ++i) {
      U[i] = 5 * uniform(random);
      U[4 * (i + 1) + 3] += 0.02 * uniform(random);
    }
    U[3] = 1 + 0.1 * uniform(random);
    for (int m = 0; m < 9; ++m) U[4 * (m / 3 + 1) + m % 3] += 0.1 * uniform(random);
  }
  adopt_state(s);
}

Vec3 x_of(Simulation& s, int node) {
  const double* U = U_of(s, node);
  return {U[7], U[11], U[15]};
}

/// Largest difference of the rates of two descriptions, each of {v, F, x} and J relative to its largest.
void expect_equal_rates(const Rates& p, const Rates& q, const Simulation& s, double tolerance) {
  std::array<double, 16> size{}, difference{};
  for (int n : real_rows(s))
    for (int k = 0; k < 16; ++k) {
      const int field = k < 3 ? 0 : k == 3 ? 1 : 2;
      size[field] = std::max(size[field], std::abs(p.U[row::U * n + k]));
      difference[field] = std::max(difference[field], std::abs(p.U[row::U * n + k] - q.U[row::U * n + k]));
    }
  for (int field = 0; field < 3; ++field) EXPECT_LE(difference[field], tolerance * size[field]) << "field " << field;
}

TEST(Description, AllAgreeUnderHomogeneousDeformation) {
  const Tensor<double> F{{{1.2, 0.3, -0.1}, {0.05, 0.9, 0.2}, {-0.15, 0.1, 1.1}}};
  for (auto reconstruction : {Reconstruction::constant, Reconstruction::linear}) {
    std::map<Description, Rates> found;
    for (auto d : all) {
      Problem problem(with(free_bar(4), d, reconstruction));  // the twist makes the velocity differ from node to node
      Simulation s = problem.start();
      deform(s, F);
      found[d] = rates(s);
      if (d != Description::total) expect_equal_rates(found[Description::total], found[d], s, 1e-12);
    }
  }
}

TEST(Description, AllAgreeUnderHomogeneousDeformationInEveryFormulationWithEveryOption) {
  const Tensor<double> F{{{1.2, 0.3, -0.1}, {0.05, 0.9, 0.2}, {-0.15, 0.1, 1.1}}};
  for (auto formulation : formulations)
    for (auto fix : {EntropyFix::none, EntropyFix::edge})
      for (auto boundary : {BoundaryFlux::adjoint, BoundaryFlux::paper})
        for (const double parting : {0.0, 0.5}) {
          if (parting > 0 && formulation == Formulation::pF) continue;
          std::map<Description, Rates> found;
          for (auto d : all) {
            Scene scene = with(free_bar(4), d, Reconstruction::limited);
            scene.physics.formulation = formulation;
            scene.physics.entropy_fix = fix;
            scene.physics.boundary_flux = boundary;
            scene.physics.parting = parting;
            Problem problem(scene);
            Simulation s = problem.start();
            deform(s, F);
            found[d] = rates(s);
            if (d != Description::total) expect_equal_rates(found[Description::total], found[d], s, 1e-11);
          }
        }
}

/// {p, F} has no J of its own: the dual cells' motion must not touch the lane, and the energy does not grow.
TEST(Description, InEveryFormulationAFreeBarKeepsMomentumAndGainsNoEnergy) {
  for (auto d : current)
    for (auto formulation : formulations) {
      Scene scene = with(free_bar(4), d, Reconstruction::limited);
      scene.physics.formulation = formulation;
      scene.physics.entropy_fix = EntropyFix::edge;
      scene.monitor.energy = true;
      Problem problem(scene);
      Simulation s = problem.start();
      march(s, 100);
      ASSERT_FALSE(s.breakdown);
      EXPECT_LT(linear_momentum_drift(s), 1e-13) << word(d) << ' ' << word(formulation);
      const Energies e = energies(s);
      EXPECT_LE(e.kinetic + e.strain, (1 + 1e-6) * s.books.initial_energy) << word(d) << ' ' << word(formulation);
      EXPECT_GE(entropy_production(s).least, 0.0) << word(d) << ' ' << word(formulation);
      for (int n = 0; n < s.domain.order.nodes && formulation == Formulation::pF; ++n) EXPECT_EQ(U_of(s, n)[3], 1.0);
    }
}

TEST(Description, UpdatedMovesJWithTheVolumeOfTheDualCell) {
  Problem problem(with(free_bar(4), Description::updated));
  Simulation s = problem.start_changed(
      [](Domain& d) { d.coefficients.rho_cp = d.coefficients.rho_cJ = 1e200; });  // no stabilisation of J
  shake(s);
  const Rates r = rates(s);
  std::vector<double> change(problem.mesh.X.size(), 0.0);  // [m^3/s] of the dual volumes: a quarter of each tet's
  for (const auto& t : problem.mesh.tets) {
    double of_tet = 0;
    for (int v = 0; v < 4; ++v) {  // the volume is linear in each node's position
      Vec3 x[4];
      for (int k = 0; k < 4; ++k) x[k] = x_of(s, t[k]);
      const double before = tet_volume(x[0], x[1], x[2], x[3]);
      for (int i = 0; i < 3; ++i) x[v][i] += U_of(s, t[v])[i];
      of_tet += tet_volume(x[0], x[1], x[2], x[3]) - before;
    }
    for (int n : t) change[n] += of_tet / 4;
  }
  double largest = 0;
  for (std::size_t n = 0; n < change.size(); ++n) largest = std::max(largest, std::abs(change[n] / s.domain.volume[n]));
  for (std::size_t n = 0; n < change.size(); ++n)
    EXPECT_NEAR(r.U[row::U * s.domain.order.row_of[n] + 3], change[n] / s.domain.volume[n], 1e-12 * largest)
        << "node " << n;
}

TEST(Description, ATranslationMovesNoJ) {
  for (auto d : current) {
    Problem problem(with(free_bar(3), d));
    Simulation s = problem.start_changed([](Domain& d) { d.coefficients.rho_cp = d.coefficients.rho_cJ = 1e200; });
    shake(s);
    for (int n = 0; n < s.domain.order.nodes; ++n) {
      double* U = U_of(s, n);
      U[0] = 3.3;
      U[1] = -0.7;
      U[2] = 1.9;
    }
    adopt_state(s);
    const Rates r = rates(s);
    double largest = 0;
    for (int n : real_rows(s)) largest = std::max(largest, std::abs(r.U[row::U * n + 3]));
    EXPECT_LT(largest, 1e-150) << word(d);  // what is left is the stabilisation
  }
}

/// sum Omega J sigma : (dJ-gradient) + sum v . f = 0 for the central part: the forces are adjoint to what moves J, whatever the state.
TEST(Description, ForcesOfAPressureDoTheWorkOnJ) {
  for (auto d : current) {
    Problem problem(with(free_bar(4), d));
    Simulation s = problem.start_changed([](Domain& d) { d.coefficients.rho_cp = d.coefficients.rho_cs = 1e-30; });
    shake(s);
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int n : real_rows(s)) {  // sigma = p I, no jumps of Sigma_J
      double* PH = &s.state.PH[s.state.now][row::PH * n];
      const double p = uniform(random);
      for (int m = 0; m < 9; ++m) PH[8 * (m / 3) + 4 + m % 3] = m % 4 == 0 ? p : 0.0;
      s.state.W[s.state.now][row::W * n + 3] = 0;
    }
    const Rates r = rates(s);
    double on_J = 0, of_force = 0, scale = 0;
    for (int n : real_rows(s)) {
      const double volume = 1 / s.domain.X[row::X * n + 3], p = s.state.PH[s.state.now][row::PH * n + 4];
      const double *v = &s.state.W[s.state.now][row::W * n], *rate = &r.U[row::U * n];
      on_J += volume * p * rate[3];
      scale += volume * std::abs(p * rate[3]);
      for (int i = 0; i < 3; ++i) of_force += volume * s.domain.coefficients.material.rho * rate[i] * v[i];
    }
    EXPECT_GT(scale, 0);
    EXPECT_LT(std::abs(on_J + of_force), 1e-12 * scale) << word(d);
  }
}

TEST(Description, MomentumIsConstantInAFreeBarAndChangesByTheBookedImpulse) {
  for (auto d : current)
    for (auto reconstruction : {Reconstruction::constant, Reconstruction::linear})
      for (auto integrator : integrators) {
        Scene scene = with(free_bar(4), d, reconstruction);
        scene.time.integrator = integrator;
        Problem problem(scene);
        Simulation s = problem.start();
        push(s, {20, -7, 11});
        const double scale = momenta(s).linear_scale;
        march(s, 100);
        EXPECT_FALSE(s.breakdown);
        EXPECT_LT(linear_momentum_drift(s) * momenta(s).linear_scale, 1e-13 * scale)
            << word(d) << ' ' << word(reconstruction) << ' ' << word(integrator);
        Problem loaded(with(loaded_bar(3), d, reconstruction));
        loaded.scene.time.integrator = integrator;
        Simulation l = loaded.start();
        march(l, 100);
        EXPECT_FALSE(l.breakdown);
        EXPECT_LT(linear_momentum_drift(l), 1e-12) << word(d) << ' ' << word(reconstruction) << ' ' << word(integrator);
      }
}

TEST(Description, AngularMomentumIsKeptWhereAskedFor) {
  for (auto d : current) {
    Scene scene = with(free_bar(3), d);
    Problem lost(scene);
    scene.physics.keep_angular_momentum = true;
    Problem kept(scene);
    Simulation k = kept.start(), l = lost.start();
    march(k, 100);
    march(l, 100);
    EXPECT_FALSE(k.breakdown);
    EXPECT_LT(*angular_momentum_drift(k), 1e-13) << word(d);
    EXPECT_GT(*angular_momentum_drift(l), 1e-10) << word(d);
  }
}

TEST(Description, ThreadsChangeNoBit) {
  for (auto d : current)
    for (auto reconstruction : {Reconstruction::constant, Reconstruction::linear}) {
      Scene scene = with(loaded_bar(9), d, reconstruction);
      scene.monitor.energy = true;
      Problem problem(scene);
      ASSERT_GE(problem.start().domain.order.parts.size(), 2u);
      std::string once;
      for (int threads : {1, 2, 3}) {
        Simulation s = problem.start(threads);
        march(s, 3);
        const std::string bits = state_hash(s) + ' ' + std::to_string(std::bit_cast<std::uint64_t>(s.books.dissipated));
        if (threads == 1) once = bits;
        EXPECT_EQ(once, bits) << word(d) << ' ' << threads;
      }
    }
}

/// The part that owns either end of a cut edge sees bitwise opposite areas.
TEST(Description, AreasOfACutEdgeAreBitwiseOppositeInItsTwoParts) {
  for (auto d : current) {
    Problem problem(with(free_bar(9), d));
    Simulation s = problem.start();
    shake(s);
    find_current_areas(s, s.state.U[0].data());
    const EdgeArrays e = flux_edges(s);
    std::map<std::pair<int, int>, Vec3> seen;
    int pairs = 0, unequal = 0;
    for (int k = 0; k < s.domain.order.out.back(); ++k) {
      seen[{e.a[k], e.b[k]}] = {e.c[0][k], e.c[1][k], e.c[2][k]};
      const auto other = seen.find({e.b[k], e.a[k]});
      if (other == seen.end()) continue;
      ++pairs;
      for (int i = 0; i < 3; ++i) unequal += e.c[i][k] != -other->second[i];
    }
    EXPECT_GT(pairs, 100);
    EXPECT_EQ(unequal, 0) << word(d);
  }
}

TEST(Description, MonitorsOfTheStateAsItStands) {
  for (auto d : current) {
    Scene scene = with(column(2, 0.45), d);
    scene.monitor.energy = true;
    scene.monitor.entropy = true;
    Problem problem(scene);
    Simulation s = problem.start();
    march(s, 20);
    const EntropyProduction e = entropy_production(s);
    const double before = s.books.dissipated;
    s.state.dt = 1e-9;
    advance(s);
    EXPECT_NEAR((s.books.dissipated - before) / 1e-9 / e.total, 1, 1e-3) << word(d);
    double H[9], F[9];
    field_named("H").at(s, 5, H);
    field_named("F").at(s, 5, F);
    EXPECT_NEAR(H[0], F[4] * F[8] - F[5] * F[7], 1e-14) << word(d);
  }
}

}  // namespace
}  // namespace nanson::method
