// The monitors of involutions and of geometry, and their columns in the history.
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/history.hpp"
#include "scenes.hpp"

namespace nanson::method {
namespace {

std::vector<std::string> names(const Simulation& s) {
  std::vector<std::string> out;
  for (const HistoryColumn& c : history_columns(s, {})) out.push_back(c.name);
  return out;
}

bool has(const std::vector<std::string>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

TEST(Monitors, GiveTheirColumnsOnlyWhenAskedFor) {
  Scene scene = free_bar(2);
  const std::size_t without = names(Problem(scene).start()).size();
  scene.physics.formulation = Formulation::pFHJ;
  EXPECT_EQ(names(Problem(scene).start()).size(), without);
  scene.monitor.entropy = scene.monitor.involutions = scene.monitor.geometry = true;
  const Problem problem(scene);
  Simulation s = problem.start();
  march(s, 2);
  const auto columns = names(s);
  for (const char* name : {"entropy_min", "entropy_sum", "entropy_negative_share", "involution_F", "involution_H",
                           "involution_J", "min_tet_ratio", "min_detF_over_J", "max_detF_over_J"})
    EXPECT_TRUE(has(columns, name)) << name;
  EXPECT_EQ(columns.size(), without + 9);
  EXPECT_EQ(history_row(s, {}).size(), columns.size());
  scene.physics.formulation = Formulation::pFJ;
  const Problem other(scene);
  const auto fewer = names(other.start());
  EXPECT_FALSE(has(fewer, "involution_H"));
  EXPECT_TRUE(has(fewer, "involution_J"));
}

/// dF/dt and dx/dt are linear in v with one gradient operator: F - grad x is kept to round-off, until a flux correction changes dF/dt alone.
TEST(Involutions, FStaysTheGradientOfXUnlessAFluxCorrectionChangesIt) {
  for (auto formulation : {Formulation::pFJ, Formulation::pFHJ})
    for (auto correction : {FluxCorrection::none, FluxCorrection::full}) {
      if (formulation == Formulation::pFHJ && correction == FluxCorrection::full) continue;
      Scene scene = loaded_bar(3);
      scene.physics.formulation = formulation;
      scene.physics.flux_correction = correction;
      scene.monitor.involutions = true;
      const Problem problem(scene);
      Simulation s = problem.start();
      Involutions i = involutions(s);
      EXPECT_EQ(i.F, 0);
      EXPECT_EQ(i.H, 0);
      EXPECT_EQ(i.J, 0);
      march(s, 20);
      i = involutions(s);
      EXPECT_EQ(i.F > 1e-6, correction == FluxCorrection::full) << i.F;
      EXPECT_TRUE(i.F < 1e-13 || correction == FluxCorrection::full) << i.F;
      EXPECT_GT(i.J, 1e-6);
      EXPECT_LT(i.J, 0.1);
      EXPECT_EQ(i.H > 0, formulation == Formulation::pFHJ);
      EXPECT_LT(i.H, 0.1);
    }
}

TEST(Involutions, OfAFieldWrittenByHandAreItsDefects) {
  Scene scene = free_bar(3);
  scene.physics.formulation = Formulation::pFHJ;
  scene.monitor.involutions = true;
  const Problem problem(scene);
  Simulation s = problem.start();
  deform(s, {{{1.2, 0.1, 0}, {0, 0.9, 0.2}, {0.05, 0, 1.1}}});
  EXPECT_LT(involutions(s).F, 1e-12);  // x = F X
  EXPECT_LT(involutions(s).H, 1e-15);
  EXPECT_LT(involutions(s).J, 1e-15);
  U_of(s, 7)[3] += 0.25;
  EXPECT_NEAR(involutions(s).J, 0.25, 1e-14);
  s.state.H[0][row::H * s.domain.order.row_of[3] + 5] += 0.125;
  EXPECT_NEAR(involutions(s).H, 0.125, 1e-14);
  U_of(s, 9)[4] += 0.5;
  EXPECT_NEAR(involutions(s).F, 0.5, 1e-12);
}

TEST(Geometry, OfAHomogeneousDeformationIsItsDeterminant) {
  const Problem problem(free_bar(3));
  Simulation s = problem.start(2);
  Geometry g = geometry(s);
  EXPECT_EQ(g.min_tet_ratio, 1);
  EXPECT_EQ(g.min_detF_over_J, 1);
  EXPECT_EQ(g.max_detF_over_J, 1);
  const Tensor<double> F{{{1.2, 0.1, 0}, {0, 0.5, 0.2}, {0.05, 0, 1.1}}};
  deform(s, F);
  g = geometry(s);
  EXPECT_NEAR(g.min_tet_ratio, determinant(F, cofactor(F)), 1e-12);
  EXPECT_NEAR(g.min_detF_over_J, 1, 1e-15);
}

TEST(Geometry, SeesATetTurnedInsideOut) {
  const Problem problem(free_bar(3));
  Simulation s = problem.start();
  const auto& tet = problem.mesh.tets[11];
  double* U = U_of(s, tet[0]);
  for (int k = 0; k < 3; ++k) {  // mirrored through the middle of the other three
    double middle = 0;
    for (int v = 1; v < 4; ++v) middle += problem.mesh.X[tet[v]][k] / 3;
    U[4 * (k + 1) + 3] += 2 * (middle - U[4 * (k + 1) + 3]);
  }
  EXPECT_LE(geometry(s).min_tet_ratio, -1 + 1e-12);
}

TEST(Geometry, WarnsOnceWhenJAndDetFHaveParted) {
  Scene scene = free_bar(2);
  scene.monitor.geometry = true;
  const Problem problem(scene);
  Simulation s = problem.start();
  EXPECT_FALSE(geometry_warning(s));
  U_of(s, 5)[3] = 0.45;
  ASSERT_TRUE(geometry_warning(s));
  EXPECT_NE(geometry_warning(s)->find("det F/J ranges from 1 to 2.22"), std::string::npos) << *geometry_warning(s);
  U_of(s, 5)[3] = 2.1;
  EXPECT_TRUE(geometry_warning(s));
  U_of(s, 5)[3] = 4;  // the stabilisation draws it near its neighbours in a few steps
  adopt_state(s);
  std::vector<std::string> seen;
  Observer observer;
  observer.on_step = [&](const Simulation& now) {
    if (!now.warning.empty() && (seen.empty() || seen.back() != now.warning)) seen.push_back(now.warning);
  };
  std::string reason;
  EXPECT_EQ(run(s, observer, reason), "done") << reason;
  EXPECT_EQ(seen.size(), 1u);
}

}  // namespace
}  // namespace nanson::method
