// The force is the adjoint of the velocity gradient: for any P and v, sum Omega P : grad v + sum v . f = sum v . t (method, section 3).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scenes.hpp"

namespace nanson::method {
namespace {

/// v random or smooth; P either independent of v, or the velocity gradient itself, so that the internal power is a sum of squares that nothing cancels.
enum class Velocity { random, smooth };
enum class Stress { random, gradient };

void fill_rows(Simulation& s, Velocity velocity, Stress stress) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  double wave[4][4];
  for (auto& k : wave)
    for (double& c : k) c = 3 * uniform(random);
  double *W = s.state.W[s.state.now].data(), *PH = s.state.PH[s.state.now].data();
  for (int n : real_rows(s)) {
    const double* X = &s.domain.X[row::X * n];
    for (int i = 0; i < 4; ++i)
      W[row::W * n + i] = velocity == Velocity::random
                              ? uniform(random)
                              : std::sin(wave[i][0] * X[0] + wave[i][1] * X[1] + wave[i][2] * X[2] + wave[i][3]);
    for (int m = 0; m < 9; ++m) {
      PH[row::PH * n + 8 * (m / 3) + m % 3] = uniform(random);
      PH[row::PH * n + 8 * (m / 3) + 4 + m % 3] = m % 4 == 0;
    }
  }
  for (double& load : s.state.loads) load = uniform(random);
  if (stress == Stress::random) return;
  const Rates r = rates(s);
  for (int n : real_rows(s)) {  // Sigma_J = tr P/3, as the pressure correction takes P apart
    for (int m = 0; m < 9; ++m) PH[row::PH * n + 8 * (m / 3) + m % 3] = r.G[row::G * n + 4 * (m / 3) + m % 3];
    W[row::W * n + 3] = (PH[row::PH * n] + PH[row::PH * n + 9] + PH[row::PH * n + 18]) / 3;
  }
}

struct Defect {
  double of_sizes;  // |sum Omega P : grad v + sum v . f - sum v . t| over the sum of the terms' sizes
  double of_power;  // the same over |sum Omega P : grad v|
};

/// Without stabilisation.
Defect defect(const PhysicsSpec& physics, Velocity velocity, Stress stress, int n = 4) {
  Scene scene = free_bar(n);
  scene.physics = physics;
  scene.boundary = {condition({"xmax", "zmin"}, BoundaryKind::traction)};
  const Problem problem(scene);
  Simulation s = problem.start_changed([](Domain& d) { d.coefficients.rho_cp = d.coefficients.rho_cs = 1e-200; });
  fill_rows(s, velocity, stress);
  const Rates r = rates(s);
  double internal = 0, rest = 0, size = 0;
  const auto add = [&](double& sum, double power) { sum += power, size += std::abs(power); };
  const double *W = s.state.W[s.state.now].data(), *PH = s.state.PH[s.state.now].data();
  for (int n : real_rows(s)) {
    const double volume = 1 / s.domain.X[row::X * n + 3], mass = volume * s.domain.coefficients.material.rho;
    const double* rate = &r.U[row::U * n];
    for (int m = 0; m < 9; ++m)
      add(internal, volume * PH[row::PH * n + 8 * (m / 3) + m % 3] * rate[4 * (m / 3 + 1) + m % 3]);
    for (int i = 0; i < 3; ++i) add(rest, mass * W[row::W * n + i] * rate[i]);
  }
  for (std::size_t slot = 0; slot < s.domain.boundary.slot_nodes.size(); ++slot)
    for (int n : s.domain.boundary.slot_nodes[slot])
      for (std::size_t i = 0; i < 3; ++i) add(rest, -s.state.loads[4 * slot + i] * W[row::W * n + i]);
  return {std::abs(internal + rest) / size, std::abs(internal + rest) / std::abs(internal)};
}

std::string record(const Defect& random, const Defect& smooth) {
  return fmt::format("random v {:.3g}, smooth v {:.3g}", random.of_power, smooth.of_power);
}

TEST(Adjoint, ForceIsTheAdjointOfTheGradientForAnyFields) {
  double worst = 0;
  for (auto formulation : formulations)
    for (auto reconstruction : {Reconstruction::constant, Reconstruction::linear})
      for (auto velocity : {Velocity::random, Velocity::smooth})
        for (auto stress : {Stress::random, Stress::gradient}) {
          PhysicsSpec p;
          p.formulation = formulation;
          p.reconstruction = reconstruction;
          worst = std::max(worst, defect(p, velocity, stress).of_sizes);
        }
  RecordProperty("defect", fmt::format("{:.3g}", worst));
  EXPECT_LT(worst, 1e-14);
}

TEST(Adjoint, PaperBoundaryFluxIsNotAdjoint) {
  PhysicsSpec p;
  p.boundary_flux = BoundaryFlux::paper;
  const Defect random = defect(p, Velocity::random, Stress::gradient),
               smooth = defect(p, Velocity::smooth, Stress::gradient);
  RecordProperty("defect", record(random, smooth));
  EXPECT_GT(random.of_power, 0.05);
  EXPECT_GT(smooth.of_power, 3e-3);
}

struct CorrectionCase {
  FluxCorrection correction;
  double largest, least_ratio;  // defect at n = 4, and how much smaller it must be at n = 8
};

TEST(Adjoint, FluxCorrectionsAreAdjointUpToAnErrorThatFallsWithTheMesh) {
  for (const auto& c :
       {CorrectionCase{FluxCorrection::pressure, 0.1, 2.5}, CorrectionCase{FluxCorrection::full, 0.02, 6}}) {
    PhysicsSpec p;
    p.flux_correction = c.correction;
    const double coarse = defect(p, Velocity::smooth, Stress::gradient, 4).of_power,
                 fine = defect(p, Velocity::smooth, Stress::gradient, 8).of_power;
    RecordProperty(std::string(word(c.correction)),
                   fmt::format("{:.3g}, at h/2 {:.3g}; random v {:.3g}", coarse, fine,
                               defect(p, Velocity::random, Stress::gradient).of_power));
    EXPECT_LT(coarse, c.largest) << name(p);
    EXPECT_LT(fine, coarse / c.least_ratio) << name(p);
  }
}

}  // namespace
}  // namespace nanson::method
