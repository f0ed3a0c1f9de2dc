// The flux correction of a step's last stage is that of the next step's first stage too (method, section 14): what is left to it, what readers see, what it costs in accuracy.
#include <gtest/gtest.h>

#include "scenes.hpp"

namespace nanson::method {
namespace {

using enum FluxCorrection;

Problem corrected(Scene scene, FluxCorrection correction, Formulation formulation = Formulation::pFJ) {
  scene.physics.flux_correction = correction;
  scene.physics.formulation = formulation;
  return Problem(scene);
}

/// The same state with nothing from a step before.
Simulation fresh(const Problem& problem, Simulation& s) {
  Simulation same = problem.start();
  same.state.U[0] = s.state.U[0];
  same.state.H[0] = s.state.H[0];
  adopt_state(same);
  return same;
}

TEST(LaggedCorrection, IsThatOfTheVelocityGradientInTheLastStage) {
  for (auto correction : {pressure, full}) {
    const Problem problem = corrected(loaded_bar(4), correction);
    Simulation s = problem.start();
    march(s, 3);
    ASSERT_TRUE(s.state.has_lagged_correction);
    const auto G = [&](int n, int i, int K) {
      return s.state.G[row::G * static_cast<std::size_t>(s.domain.order.row_of[n]) + 4 * K + i];
    };  // still that of the last stage
    std::vector<Tensor<double>> dG(problem.mesh.X.size());
    for (const DualEdge& e : make_dual(problem.mesh).edges)
      for (int i = 0; i < 3; ++i) {
        double q = 0;
        for (int K = 0; K < 3; ++K)
          q += (G(e.a, i, K) - G(e.b, i, K)) * (problem.mesh.X[e.b][K] - problem.mesh.X[e.a][K])
               / 6;  // theta/4, theta = 2/3
        for (int I = 0; I < 3; ++I) {
          dG[e.a][i][I] += q * e.C[I] / s.domain.volume[e.a];
          dG[e.b][i][I] -= q * e.C[I] / s.domain.volume[e.b];
        }
      }
    double largest = 0;
    for (const auto& g : dG)
      for (int m = 0; m < 9; ++m) largest = std::max(largest, std::abs(g[m / 3][m % 3]));
    for (int n = 0; n < s.domain.order.nodes; ++n)
      for (int m = 0; m < 9; ++m)
        EXPECT_NEAR(s.state.U[1][row::U * static_cast<std::size_t>(s.domain.order.row_of[n]) + 4 * (m / 3) + m % 3],
                    dG[n][m % 3][m / 3], 1e-13 * largest);
  }
}

TEST(LaggedCorrection, StandsInTheStressRowsButNotInWhatIsWritten) {
  for (auto law : {Law::linear_elastic, Law::neo_hookean}) {
    Scene scene = free_bar(3);
    scene.material.law = law;
    const Problem problem = corrected(scene, full);
    Simulation s = problem.start();
    march(s, 3);
    Simulation plain = fresh(problem, s);
    double of_rows = 0;
    for (int n = 0; n < s.domain.order.nodes; ++n) {
      const std::size_t r = row::PH * static_cast<std::size_t>(s.domain.order.row_of[n]);
      of_rows = std::max(of_rows, std::abs(s.state.PH[s.state.now][r] - plain.state.PH[plain.state.now][r]));
      for (const char* name : {"P", "pressure", "von_mises"}) {
        double ours[9] = {}, theirs[9] = {};
        field_named(name).at(s, n, ours);
        field_named(name).at(plain, n, theirs);
        for (int k = 0; k < 9; ++k)
          EXPECT_NEAR(ours[k], theirs[k], 1e-11 * s.domain.coefficients.material.kappa) << name;
      }
    }
    EXPECT_GT(of_rows, 1e-6 * s.domain.coefficients.material.kappa);
  }
}

TEST(LaggedCorrection, IsForTvdRk2WithACorrectionOnlyAndNotForTheFirstStep) {
  for (auto integrator : integrators)
    for (auto correction : corrections) {
      Scene scene = free_bar(3);
      scene.time.integrator = integrator;
      const Problem problem = corrected(scene, correction);
      Simulation s = problem.start();
      EXPECT_FALSE(s.state.has_lagged_correction);
      march(s, 2);
      EXPECT_EQ(s.state.has_lagged_correction, correction != none && integrator == Integrator::tvd_rk2);
    }
}

/// What the lag changes over a fixed time falls like the step squared: second order in time stays.
TEST(LaggedCorrection, ChangesTheResultBySecondOrderOfTheStep) {
  for (auto correction : {pressure, full})
    for (auto formulation : formulations) {
      const Problem problem = corrected(loaded_bar(3), correction, formulation);
      double change[3];
      for (int k = 0; k < 3; ++k) {
        const int steps = 20 << k;
        Simulation lagged = problem.start(), found = problem.start();
        for (int i = 0; i < steps; ++i) {
          lagged.state.dt = found.state.dt = 0.01 / steps;
          found.state.has_lagged_correction = false;
          if (correction == full && i > 0) {  // the stress without the correction, as a stage that finds it reads it
            State& u = found.state;
            for (int r : real_rows(found))
              for (int m = 0; m < 9; ++m)
                u.PH[u.now][row::PH * r + 8 * (m / 3) + m % 3] -= u.dP[row::dP * r + 4 * (m / 3) + m % 3];
          }
          advance(lagged);
          advance(found);
        }
        change[k] = 0;
        for (std::size_t i = 0; i < lagged.state.U[0].size(); ++i)
          change[k] = std::max(change[k],
                               std::abs(lagged.state.U[0][i] - found.state.U[0][i]) / (i % row::U < 3 ? 100 : 1));
      }
      EXPECT_GT(change[0], 1e-9);
      EXPECT_GT(std::log2(change[0] / change[1]), 1.8) << name(problem.scene.physics);
      EXPECT_GT(std::log2(change[1] / change[2]), 1.8) << name(problem.scene.physics);
    }
}

}  // namespace
}  // namespace nanson::method
