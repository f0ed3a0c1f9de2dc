// The Jameson-Schmidt-Turkel scheme: what it leaves alone, its figures on the low dispersion cube (method, section 9), its place behind upwind.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "scenes.hpp"

namespace nanson::method {
namespace {

std::map<std::string, double> cube_errors(int n, Stabilisation stabilisation) {
  Scene scene = cube(n);
  scene.physics.stabilisation = stabilisation;
  const Problem problem(scene);
  Simulation s = problem.start();
  EXPECT_EQ(run_quietly(s), "done");
  return exact_errors(s);
}

TEST(Jst, PseudoLaplacianOfLinearFieldsIsZeroOnAnIrregularMesh) {
  Scene scene = free_bar(5);
  scene.physics.stabilisation = Stabilisation::jst;
  const Problem problem(scene);
  Simulation s = problem.start();
  Aligned<double> W(row::W * s.domain.order.rows, 0.0);
  Rows rows = stage_rows(s.domain, s.state, 0, 0);
  rows.W = W.data();
  const auto largest = [&] {
    for (const Part& part : s.domain.order.parts)
      s.domain.functions.gradient(part, s.domain.order.edges(), s.domain.order.corners(), s.domain.order.lists(), rows,
                                  s.domain.coefficients);
    double worst = 0;
    for (int n : real_rows(s))
      for (int i = 0; i < 4; ++i) worst = std::max(worst, std::abs(s.state.L[row::L * n + i]));
    return worst;
  };
  for (int n : real_rows(s)) {
    const Vec3& X = problem.mesh.X[s.domain.order.node_of[n]];
    for (int i = 0; i < 4; ++i) W[row::W * n + i] = 0.5 * i + (i + 1) * X[0] - 2 * X[1] + (3 - i) * X[2];
  }
  EXPECT_LT(largest(), 1e-12);
  for (int n : real_rows(s)) W[row::W * n] += std::pow(problem.mesh.X[s.domain.order.node_of[n]][0], 2);
  EXPECT_GT(largest(), 1e-2);
}

/// p1 L1, L2 [1e-4] (method, section 9); upwind is better from 1/12 on.
TEST(Jst, ErrorsOnTheCubeAreThoseOfThePrototypeAndBehindUpwinds) {
  struct Figures {
    int n;
    double L1, L2;
  };
  for (const Figures& f : {Figures{12, 89.1, 103}, Figures{24, 26.9, 28.0}}) {
    const auto jst = cube_errors(f.n, Stabilisation::jst), upwind = cube_errors(f.n, Stabilisation::upwind);
    RecordProperty(fmt::format("n_{}", f.n),
                   fmt::format("jst {:.2f} {:.2f}, upwind {:.2f} {:.2f}", 1e4 * jst.at("p1_L1"), 1e4 * jst.at("p1_L2"),
                               1e4 * upwind.at("p1_L1"), 1e4 * upwind.at("p1_L2")));
    EXPECT_NEAR(1e4 * jst.at("p1_L1") / f.L1, 1, 0.04) << f.n;
    EXPECT_NEAR(1e4 * jst.at("p1_L2") / f.L2, 1, 0.04) << f.n;
    EXPECT_LT(upwind.at("p1_L1"), jst.at("p1_L1")) << f.n;
    EXPECT_LT(upwind.at("p1_L2"), jst.at("p1_L2")) << f.n;
  }
}

TEST(Jst, ThreadsChangeNoBit) {
  Scene scene = loaded_bar(9);
  scene.physics.stabilisation = Stabilisation::jst;
  const Problem problem(scene);
  std::set<std::string> hashes;
  for (int threads : {1, 2, 3}) {
    Simulation s = problem.start(threads);
    ASSERT_GE(s.domain.order.parts.size(), 2u);
    march(s, 3);
    hashes.insert(state_hash(s));
  }
  EXPECT_EQ(hashes.size(), 1u);
}

}  // namespace
}  // namespace nanson::method
