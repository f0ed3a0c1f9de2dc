// Order of accuracy: in space on the low dispersion cube, against the prototype's figures; in time on a fixed mesh.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "engine/summary.hpp"
#include "scenes.hpp"

namespace nanson::method {
namespace {

using enum Split;
using enum Formulation;
using enum FluxCorrection;

struct CubeCase {
  Split split;
  Formulation formulation;
  FluxCorrection correction;
  InitialJ J;
  int n;
};

std::map<std::string, double> cube_errors(const CubeCase& c) {
  Scene scene = cube(c.n, c.split);
  scene.physics.formulation = c.formulation;
  scene.physics.flux_correction = c.correction;
  scene.initial.J = c.J;
  const Problem problem(scene);
  Simulation s = problem.start();
  EXPECT_EQ(run_quietly(s), "done");
  EXPECT_EQ(s.state.t, scene.time.end);
  return exact_errors(s);
}

TEST(Errors, HaveTheNamesThatStudiesMayAskFor) {
  std::vector<std::string> names;
  for (const auto& [name, value] :
       cube_errors({Split::kuhn, Formulation::pFJ, FluxCorrection::none, InitialJ::linear, 2}))
    names.push_back(name);
  std::vector<std::string> known;
  for (const SummaryEntry& entry : summary_entries())
    if (entry.name.starts_with("errors.")) known.emplace_back(entry.name.substr(7));
  std::sort(known.begin(), known.end());
  EXPECT_EQ(names, known);
}

std::string label(const CubeCase& c) {
  return fmt::format("{}_{}_{}_{}_{}", word(c.split), word(c.formulation), word(c.correction), word(c.J), c.n);
}

/// L1 and L2 errors of p1 and P11 relative to the exact field at t [1e-4]: method, sections 13 and 14. A negative figure is not known.
struct Figures {
  CubeCase cube;
  double p1_L1, p1_L2, P11_L1, P11_L2;
};
constexpr auto det = InitialJ::det, linear = InitialJ::linear;
constexpr Figures prototype[] = {
    {{kuhn, pF, none, det, 6}, 282, 347, -1, -1},
    {{kuhn, pF, none, det, 12}, 75.1, 85.0, -1, -1},
    {{kuhn, pF, none, det, 24}, 21.9, 22.6, -1, -1},
    {{kuhn, pFJ, none, det, 6}, 378, 392, 3370, 3080},
    {{kuhn, pFJ, none, det, 12}, 68.2, 74.9, 723, 688},
    {{kuhn, pFJ, none, det, 24}, 19.7, 20.5, 168, 168},
    {{kuhn, pFJ, full, det, 24}, 10.8, 10.6, 56.5, 70.7},
    {{kuhn, pFJ, full, linear, 24}, -1, 9.6, -1, 71},
    {{kuhn, pFJ, pressure, linear, 24}, -1, 9.5, -1, 73},
    {{alternating, pFJ, none, det, 12}, 42.9, 50.2, 439, 408},
    {{alternating, pFJ, none, det, 24}, 6.77, 9.84, 117, 109},
    {{alternating, pFJ, pressure, linear, 24}, -1, 5.1, -1, 25},
    {{alternating, pFJ, full, linear, 12}, -1, 32.0, -1, 106},
    {{alternating, pFJ, full, linear, 24}, -1, 4.32, -1, 26.2},
};

TEST(CubeOrder, ErrorsAreThoseOfThePrototype) {
  for (const Figures& f : prototype) {
    const auto e = cube_errors(f.cube);
    RecordProperty(label(f.cube), fmt::format("{:.2f} {:.2f} {:.2f} {:.2f}", 1e4 * e.at("p1_L1"), 1e4 * e.at("p1_L2"),
                                              1e4 * e.at("P11_L1"), 1e4 * e.at("P11_L2")));
    const std::pair<const char*, double> figures[] = {
        {"p1_L1", f.p1_L1}, {"p1_L2", f.p1_L2}, {"P11_L1", f.P11_L1}, {"P11_L2", f.P11_L2}};
    for (const auto& [key, wanted] : figures)
      EXPECT_TRUE(wanted < 0 || std::abs(1e4 * e.at(key) / wanted - 1) < 0.04)
          << label(f.cube) << ' ' << key << " = " << e.at(key);
  }
}

/// Least rates of L2 from h to h/2.
struct Rate {
  CubeCase coarse;
  double p1, P11;
};
constexpr Rate least_rates[] = {
    {{kuhn, pF, none, det, 6}, 1.9, 1.9},
    {{kuhn, pF, none, det, 12}, 1.8, 1.85},
    {{kuhn, pFJ, none, det, 6}, 2.2, 2.0},
    {{kuhn, pFJ, none, det, 12}, 1.8, 1.95},
    {{kuhn, pFHJ, none, det, 12}, 1.8, 1.95},
    {{kuhn, pFJ, full, linear, 12}, 2.3, 2.1},
    {{alternating, pFJ, none, linear, 12}, 2.0, 1.85},
    {{alternating, pFJ, pressure, linear, 12}, 2.6, 1.9},
    {{alternating, pFJ, full, linear, 12}, 2.7, 1.9},
};

TEST(CubeOrder, ErrorsFallAtLeastAtTheseRates) {
  for (const Rate& r : least_rates) {
    CubeCase fine = r.coarse;
    fine.n *= 2;
    const auto e = cube_errors(r.coarse), f = cube_errors(fine);
    const double p1 = std::log2(e.at("p1_L2") / f.at("p1_L2")), P11 = std::log2(e.at("P11_L2") / f.at("P11_L2"));
    RecordProperty(label(r.coarse), fmt::format("p1 {:.2f}, P11 {:.2f}", p1, P11));
    EXPECT_GT(p1, r.p1) << label(r.coarse);
    EXPECT_GT(P11, r.P11) << label(r.coarse);
  }
}

TEST(CubeOrder, WithLinearElasticityNothingReadsTheEvolvedH) {
  const auto J = cube_errors({kuhn, pFJ, full, det, 6}), HJ = cube_errors({kuhn, pFHJ, full, det, 6});
  EXPECT_EQ(J, HJ);
}

/// Largest difference between two states of one problem; velocities in 100 m/s.
double difference(const Simulation& a, const Simulation& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.state.U[0].size(); ++i)
    worst = std::max(worst, std::abs(a.state.U[0][i] - b.state.U[0][i]) / (i % row::U < 3 ? 100 : 1));
  return worst;
}

/// Observed order in time of a scene over 0.01 s: worse of dt to dt/2 and dt/2 to dt/4, dt at CFL 0.24, against SSP-RK3 at dt/64.
double order_in_time(Scene scene, Integrator integrator) {
  constexpr int steps = 20;
  constexpr double end = 0.01;  // [s]
  const auto solve = [&](Integrator with, int refinement) {
    scene.time.integrator = with;
    const Problem problem(scene);
    Simulation s = problem.start();
    march(s, end / (steps * refinement), steps * refinement);
    return s;
  };
  const Simulation reference = solve(Integrator::ssp_rk3, 64);
  double error[3];
  for (int k = 0; k < 3; ++k) error[k] = difference(solve(integrator, 1 << k), reference);
  return std::min(std::log2(error[0] / error[1]), std::log2(error[1] / error[2]));
}

/// Nonlinear bars. A prescribed velocity is exact at the ends of steps and linear between them: second order with either integrator.
struct TimeCase {
  const char* what;
  bool loads, prescribed_velocity;
  Integrator integrator;
  double least;
};

TEST(TimeOrder, IsTwoForTvdRk2AndThreeForSspRk3) {
  constexpr auto rk2 = Integrator::tvd_rk2, rk3 = Integrator::ssp_rk3;
  for (const TimeCase& c : {TimeCase{"free_rk2", false, false, rk2, 1.85},
                            {"free_rk3", false, false, rk3, 2.8},
                            {"loaded_rk2", true, false, rk2, 1.85},
                            {"loaded_rk3", true, false, rk3, 2.75},
                            {"driven_rk2", true, true, rk2, 1.85},
                            {"driven_rk3", true, true, rk3, 1.9}})
    for (auto formulation : formulations)
      for (auto correction : corrections) {
        Scene scene = c.loads ? loaded_bar(3) : free_bar(3);
        if (c.loads && !c.prescribed_velocity) scene.boundary.pop_back();
        scene.physics.formulation = formulation;
        scene.physics.flux_correction = correction;
        const double order = order_in_time(scene, c.integrator);
        RecordProperty(fmt::format("{}_{}_{}", c.what, word(formulation), word(correction)),
                       fmt::format("{:.2f}", order));
        EXPECT_GT(order, c.least) << c.what << ' ' << name(scene.physics);
      }
}

}  // namespace
}  // namespace nanson::method
