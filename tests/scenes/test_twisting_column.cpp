// The twisting column against the figures measured before the design, among them the paper's boundary flux that feeds energy in.
#include "tests/scenes/scene_run.hpp"

namespace nanson {
namespace {

struct Row {
  const char *formulation, *split, *boundary, *isochoric;
  double tip[3], energy;  // [m] of the corner that starts at (0.5, 0.5, 6); E/E0
};

TEST(TwistingColumn, ReachesTheFiguresOfThePrototype) {
  for (const Row& r : {Row{"pF", "kuhn", "paper", "F", {0.543, 0.351, 6.013}, 0.755},
                       Row{"pF", "kuhn", "adjoint", "F", {0.544, 0.332, 6.018}, 0.738},
                       Row{"pF", "alternating", "paper", "F", {0.741, 0.194, 6.111}, 1.496},
                       Row{"pF", "alternating", "adjoint", "F", {0.684, 0.186, 5.995}, 0.798},
                       Row{"pFJ", "kuhn", "paper", "J", {0.546, 0.336, 5.974}, 0.697},
                       Row{"pFJ", "kuhn", "paper", "F", {0.548, 0.335, 5.985}, 0.71},
                       Row{"pFJ", "kuhn", "adjoint", "F", {0.530, 0.360, 5.986}, 0.713},
                       Row{"pFJ", "alternating", "adjoint", "F", {0.569, 0.421, 5.967}, 0.747},
                       Row{"pFHJ", "alternating", "adjoint", "F", {0.569, 0.421, 5.967}, 0.747}}) {
    const std::string name = std::string(r.formulation) + " " + r.split + " " + r.boundary;
    const SceneRun run = run_config(
        "twisting_column.toml",
        {"mesh.cells=[4,4,24]", std::string("mesh.split=") + r.split,
         std::string("physics.formulation=") + r.formulation, std::string("physics.boundary_flux=") + r.boundary,
         std::string("material.isochoric=") + r.isochoric, "physics.upwind_metric=paper", "time.step=paper"});
    ASSERT_EQ(run.summary.status, "done") << name;
    const auto& tip = run.summary.probes.at("tip").at("x");
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(tip[static_cast<std::size_t>(k)], r.tip[k], 5e-3) << name << " component " << k;
    EXPECT_NEAR((run.summary.energy.kinetic + run.summary.energy.strain) / run.summary.energy.initial, r.energy, 0.01)
        << name;
    if (std::string(r.boundary) == "adjoint") {
      EXPECT_LT(*run.summary.energy.closure, 1e-3) << name;
      EXPECT_LE(run.largest_energy, 1 + 1e-6) << name;
    }
    if (name == "pF alternating paper") {
      EXPECT_GT(run.largest_energy, 1.4);  // the paper's boundary feeds energy in
    }
  }
}

/// Total, Updated and pseudo Updated Lagrangian column (paper, section 6.5): the tip within 1 % of the column's length.
TEST(TwistingColumn, DescriptionsAgreeAndTheirEnergiesStayWhereTheyWere) {
  Vec3 tip[3];
  double energy[3];
  const char* const descriptions[] = {"total", "updated", "pseudo_updated"};
  for (int d = 0; d < 3; ++d) {
    const SceneRun run = run_config("twisting_column.toml", {std::string("physics.description=") + descriptions[d]});
    ASSERT_EQ(run.summary.status, "done") << descriptions[d];
    EXPECT_EQ(run.summary.description, descriptions[d]);
    for (std::size_t k = 0; k < 3; ++k) tip[d][k] = run.summary.probes.at("tip").at("x")[k];
    energy[d] = (run.summary.energy.kinetic + run.summary.energy.strain) / run.summary.energy.initial;
    EXPECT_LT(std::hypot(tip[d][0] - tip[0][0], tip[d][1] - tip[0][1], tip[d][2] - tip[0][2]), 0.06) << descriptions[d];
    EXPECT_LE(run.largest_energy, 1 + 1e-6) << descriptions[d];
    EXPECT_LT(run.summary.linear_momentum_drift, 1e-13) << descriptions[d];
  }
  EXPECT_NEAR(energy[0], 0.892, 1e-3);
  EXPECT_NEAR(energy[1], 0.894, 1e-3);
  EXPECT_NEAR(energy[2], 0.901, 1e-3);
  EXPECT_GT(std::abs(tip[1][0] - tip[0][0]), 1e-4);  // they are three schemes
  EXPECT_GT(std::abs(tip[2][0] - tip[1][0]), 1e-4);
}

}  // namespace
}  // namespace nanson
