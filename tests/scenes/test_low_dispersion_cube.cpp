// The low dispersion cube against the paper's table 1, the measured figures of the method, and its orders.
#include <cmath>

#include "tests/scenes/scene_run.hpp"

namespace nanson {
namespace {

std::string cells(int n) {
  return "mesh.cells=[" + std::to_string(n) + "," + std::to_string(n) + "," + std::to_string(n) + "]";
}
double rate(double coarse, double fine) { return std::log2(coarse / fine); }

struct Row {
  int n;
  const char* formulation;
  double p1_L1, p1_L2;        // measured by the prototype on the same mesh
  double paper_L1, paper_L2;  // table 1, {p,F,H,J}
  double P11_L1, P11_L2;      // by the prototype, 0: not known
};

TEST(LowDispersionCube, PaperVariantReachesTheFiguresOfThePrototypeAndThePapers) {
  for (const Row& r : {Row{6, "pFJ", 3.78e-2, 3.92e-2, 4.535e-2, 5.116e-2, 3.37e-1, 3.08e-1},
                       Row{12, "pFJ", 6.82e-3, 7.49e-3, 1.155e-2, 1.265e-2, 7.23e-2, 6.88e-2},
                       Row{24, "pFJ", 1.97e-3, 2.05e-3, 3.030e-3, 3.197e-3, 1.68e-2, 1.68e-2},
                       Row{6, "pF", 2.82e-2, 3.47e-2, 4.535e-2, 5.116e-2, 0, 0},
                       Row{12, "pF", 7.51e-3, 8.50e-3, 1.155e-2, 1.265e-2, 0, 0},
                       Row{24, "pF", 2.19e-3, 2.26e-3, 3.030e-3, 3.197e-3, 0, 0}}) {
    std::vector<std::string> settings{cells(r.n), std::string("physics.formulation=") + r.formulation};
    if (std::string(r.formulation) == "pF") settings.push_back("initial.J=linear");
    const SceneRun run = run_config("low_dispersion_cube_paper.toml", settings);
    const auto& e = run.summary.errors;
    EXPECT_NEAR(e.at("p1_L1"), r.p1_L1, 0.04 * r.p1_L1) << r.n << " " << r.formulation;
    EXPECT_NEAR(e.at("p1_L2"), r.p1_L2, 0.04 * r.p1_L2) << r.n << " " << r.formulation;
    EXPECT_LE(e.at("p1_L1"), r.paper_L1);
    EXPECT_LE(e.at("p1_L2"), r.paper_L2);
    if (r.P11_L1 == 0) continue;
    EXPECT_NEAR(e.at("P11_L1"), r.P11_L1, 0.04 * r.P11_L1) << r.n;
    EXPECT_NEAR(e.at("P11_L2"), r.P11_L2, 0.04 * r.P11_L2) << r.n;
  }
}

TEST(LowDispersionCube, UncorrectedSchemeIsSecondOrderFromTheLinearisedStart) {
  const SceneRun coarse = run_config("low_dispersion_cube_paper.toml", {cells(12), "initial.J=linear"});
  const SceneRun fine = run_config("low_dispersion_cube_paper.toml", {cells(24), "initial.J=linear"});
  EXPECT_GE(rate(coarse.summary.errors.at("p1_L1"), fine.summary.errors.at("p1_L1")), 1.75);
  EXPECT_GE(rate(coarse.summary.errors.at("p1_L2"), fine.summary.errors.at("p1_L2")), 1.85);
  EXPECT_GE(rate(coarse.summary.errors.at("P11_L2"), fine.summary.errors.at("P11_L2")), 1.9);
}

TEST(LowDispersionCube, FullCorrectionOnMirroredTetsReachesItsTargets) {
  const SceneRun run = run_config("low_dispersion_cube.toml", {"physics.flux_correction=full"});
  EXPECT_EQ(run.summary.status, "done");
  EXPECT_LE(run.summary.errors.at("p1_L2"), 5e-4);
  EXPECT_LE(run.summary.errors.at("P11_L2"), 3e-3);
  EXPECT_LE(run.largest_energy, 1 + 1e-6);
}

}  // namespace
}  // namespace nanson
