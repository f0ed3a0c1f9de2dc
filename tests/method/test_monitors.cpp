// The monitors of involutions and of geometry, and their columns in the history.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "engine/history.hpp"
#include "engine/pieces.hpp"
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
  scene.monitor.geometry = GeometryWatch::off;
  const std::size_t without = names(Problem(scene).start()).size();
  scene.physics.formulation = Formulation::pFHJ;
  EXPECT_EQ(names(Problem(scene).start()).size(), without);
  scene.monitor.entropy = scene.monitor.involutions = true;
  scene.monitor.geometry = GeometryWatch::warn;
  const Problem problem(scene);
  Simulation s = problem.start();
  march(s, 2);
  const auto columns = names(s);
  for (const char* name : {"entropy_min", "entropy_sum", "entropy_negative_share", "involution_F", "involution_H",
                           "involution_J", "min_tet_ratio", "min_detF_over_J", "max_detF_over_J"})
    EXPECT_TRUE(has(columns, name)) << name;
  EXPECT_EQ(columns.size(), without + 9);
  EXPECT_EQ(history_row(s, history_columns(s, {})).size(), columns.size());
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
  Extrema g = extrema(s);
  EXPECT_EQ(g.min_tet_ratio, 1);
  EXPECT_EQ(g.min_detF_over_J, 1);
  EXPECT_EQ(g.max_detF_over_J, 1);
  const Tensor<double> F{{{1.2, 0.1, 0}, {0, 0.5, 0.2}, {0.05, 0, 1.1}}};
  deform(s, F);
  g = extrema(s);
  EXPECT_NEAR(g.min_tet_ratio, determinant(F, cofactor(F)), 1e-12);
  EXPECT_NEAR(g.min_detF_over_J, 1, 1e-15);
}

/// Mirrors the first corner of a tet through the middle of the other three.
void turn_inside_out(Simulation& s, const Mesh& mesh, std::size_t t) {
  const auto& tet = mesh.tets[t];
  double* U = U_of(s, tet[0]);
  for (int k = 0; k < 3; ++k) {
    double middle = 0;
    for (int v = 1; v < 4; ++v) middle += mesh.X[tet[v]][k] / 3;
    U[4 * (k + 1) + 3] += 2 * (middle - U[4 * (k + 1) + 3]);
  }
}

TEST(Geometry, SeesATetTurnedInsideOut) {
  const Problem problem(free_bar(3));
  Simulation s = problem.start();
  turn_inside_out(s, problem.mesh, 11);
  EXPECT_LE(extrema(s).min_tet_ratio, -1 + 1e-12);
}

TEST(Geometry, AnInvertedTetIsNamedOnceOrStopsTheRun) {
  for (auto watch : {GeometryWatch::off, GeometryWatch::warn, GeometryWatch::stop}) {
    Scene scene = free_bar(3);
    scene.monitor.geometry = watch;
    scene.time.max_steps = 30;
    const Problem problem(scene);
    Simulation s = problem.start();
    turn_inside_out(s, problem.mesh, 11);
    std::string reason;
    const std::string status = run(s, {}, reason);
    EXPECT_EQ(status, watch == GeometryWatch::stop ? "breakdown" : "stopped") << reason;
    const auto& warnings = s.watch.warnings;
    ASSERT_EQ(warnings.size(), watch == GeometryWatch::warn ? 1u : 0u);
    const std::string text = watch == GeometryWatch::warn ? warnings[0].text : reason;
    if (watch != GeometryWatch::off) {
      for (const char* part : {"tet ", "region box", "inside out", "step 1, t = ", "finer or better shaped"})
        EXPECT_NE(text.find(part), std::string::npos) << text;
    }
    EXPECT_EQ(s.breakdown ? s.breakdown->cause : "none", watch == GeometryWatch::stop ? "inverted_tet" : "none");
    EXPECT_EQ(s.watch.extremes.least_tet_ratio.value < 0, watch != GeometryWatch::off);
  }
}

TEST(Geometry, WarnsOnceWhenJAndDetFHaveParted) {
  const Problem problem(free_bar(2));
  Simulation s = problem.start();
  look(s);
  EXPECT_FALSE(ruin(s));
  EXPECT_TRUE(s.watch.warnings.empty());
  for (const double J : {0.45, 2.1}) {
    U_of(s, 5)[3] = J;
    look(s);
    EXPECT_FALSE(ruin(s));
  }
  ASSERT_EQ(s.watch.warnings.size(), 1u);
  EXPECT_NE(s.watch.warnings[0].text.find("det F/J ranges from 1 to 2.22"), std::string::npos)
      << s.watch.warnings[0].text;
}

/// What the lanes and parts find is what a plain loop over mesh nodes and tets finds, to the bit for any number of threads.
TEST(Extremes, OfAStateAreThoseOfAPlainLoop) {
  const Problem problem(loaded_bar(5));
  Extrema first;
  for (int threads : {1, 2, 3}) {
    Simulation s = problem.start(threads);
    march(s, 12);
    const Extrema x = extrema(s);
    if (threads == 1) first = x;
    EXPECT_EQ(std::memcmp(&first, &x, sizeof x), 0) << threads;
    double least_tet = 1e300, least = 1e300, most = 0, fastest = 0;
    for (const auto& t : problem.mesh.tets) {
      Vec3 p[4];
      for (int k = 0; k < 4; ++k)
        for (int i = 0; i < 3; ++i) p[k][i] = U_of(s, t[k])[4 * (i + 1) + 3];
      const auto& X = problem.mesh.X;
      least_tet = std::min(least_tet,
                           tet_volume(p[0], p[1], p[2], p[3]) / tet_volume(X[t[0]], X[t[1]], X[t[2]], X[t[3]]));
    }
    for (int n = 0; n < s.domain.order.nodes; ++n) {
      double d, J;
      field_named("detF").at(s, n, &d);
      field_named("J").at(s, n, &J);
      least = std::min(least, d / J);
      most = std::max(most, d / J);
      const double* v = U_of(s, n);
      fastest = std::max(fastest, std::hypot(v[0], v[1], v[2]));
    }
    EXPECT_NEAR(x.min_tet_ratio, least_tet, 1e-12);
    EXPECT_NEAR(x.min_detF_over_J, least, 1e-14);
    EXPECT_NEAR(x.max_detF_over_J, most, 1e-14);
    EXPECT_NEAR(x.max_speed, fastest, 1e-12 * fastest);
  }
}

TEST(Extremes, AreTheWorstOfTheHistoryRowsWithTheirTimes) {
  Scene scene = free_bar(3);
  scene.output.history_every = 3;
  const Problem problem(scene);
  Simulation s = problem.start();
  Extreme least, fastest;
  Observer observer;
  observer.on_history = [&](const Simulation& now) {
    const Extrema x = extrema(s);
    if (!(x.min_tet_ratio >= least.value)) least = {x.min_tet_ratio, now.state.t};
    if (!(x.max_speed <= fastest.value)) fastest = {x.max_speed, now.state.t};
  };
  std::string reason;
  EXPECT_EQ(run(s, observer, reason), "done") << reason;
  EXPECT_LT(least.value, 0.95);
  EXPECT_EQ(s.watch.extremes.least_tet_ratio.value, least.value);
  EXPECT_EQ(s.watch.extremes.least_tet_ratio.t, least.t);
  EXPECT_EQ(s.watch.extremes.speed.value, fastest.value);
  EXPECT_EQ(s.watch.extremes.speed.t, fastest.t);
  EXPECT_GT(s.watch.extremes.checkerboard.value, 0);
}

/// Without an audit the work of loads, moving supports and gravity is known all the same, and no sound run doubles it.
TEST(Growth, OfASoundRunUnderEveryLoadIsNone) {
  Scene scene = loaded_bar(3);
  scene.time.end = 0.2;
  const Problem problem(scene);
  Simulation s = problem.start();
  std::string reason;
  EXPECT_EQ(run(s, {}, reason), "done") << reason;
}

TEST(Growth, ARunThatRunsAwayStopsWithItsReason) {
  Scene scene = column(4);
  scene.physics.formulation = Formulation::pF;
  scene.time.cfl = 0.8;
  const Problem problem(scene);
  Simulation s = problem.start();
  std::string reason;
  EXPECT_EQ(run(s, {}, reason), "breakdown");
  ASSERT_TRUE(s.breakdown);
  EXPECT_EQ(s.breakdown->cause, "energy_growth") << reason;
  EXPECT_NE(reason.find("lower time.cfl"), std::string::npos) << reason;
}

/// Two boxes a hair apart along x: as meshers leave them that were not told to join touching bodies.
Mesh two_boxes(double gap) {
  MeshSpec spec;
  spec.size = {1, 1, 1};
  spec.cells = {2, 2, 2};
  RawMesh raw = make_box(spec);
  const RawMesh one = raw;
  const int nodes = static_cast<int>(one.X.size());
  for (Vec3 X : one.X) raw.X.push_back({X[0] + 1 + gap, X[1], X[2]});
  for (auto tet : one.tets) {
    for (int& n : tet) n += nodes;
    raw.tets.push_back(tet);
    raw.tet_region.push_back(0);
  }
  return mesh_of(raw);
}

TEST(Pieces, AreNamedWithTheirGapAndWarnedOfWhenALoadCarriesOneAway) {
  Scene scene = free_bar(2);
  scene.initial = {};
  scene.body_force = {0, 0, -9.81};
  scene.boundary = {condition({"xmin"}, BoundaryKind::fixed)};
  const Problem whole(scene, mesh_of(make_box(scene.mesh)));
  EXPECT_EQ(pieces(whole.start()).size(), 1u);
  EXPECT_TRUE(piece_lines(pieces(whole.start()), 0.5).empty());
  const Problem parted(scene, two_boxes(1e-9));
  const auto found = pieces(parted.start());
  ASSERT_EQ(found.size(), 2u);
  for (const Piece& p : found) {
    EXPECT_EQ(p.nodes, 27);
    EXPECT_NEAR(p.mass, 1100, 1e-9);
    EXPECT_NEAR(p.gap, 1e-9, 1e-15);
  }
  EXPECT_TRUE(found[0].held != found[1].held);
  const auto lines = piece_lines(found, 0.5);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_NE(lines[1].find("nearly coincide"), std::string::npos) << lines[1];
  EXPECT_NE(loose_piece(found).find("27 nodes"), std::string::npos) << loose_piece(found);
  scene.body_force = {};
  EXPECT_EQ(loose_piece(pieces(Problem(scene, two_boxes(1e-9)).start())), "") << "nothing pushes it";
}

}  // namespace
}  // namespace nanson::method
