// The satellite: angular momentum constant to round-off with the projection, lost without; linear momentum and energy as they should be.
#include "tests/scenes/scene_run.hpp"

namespace nanson {
namespace {

TEST(Satellite, KeepsItsAngularMomentumForTwoSecondsAndItsArmsStayWhereTheyWere) {
  for (const std::string formulation : {"pF", "pFJ"}) {
    const std::vector<std::string> settings{"time.end=2.0", "physics.formulation=" + formulation};
    const SceneRun kept = run_config("satellite.toml", settings);
    EXPECT_EQ(kept.summary.status, "done");
    EXPECT_LE(*kept.summary.angular_momentum_drift, 1e-13) << formulation;
    EXPECT_LE(kept.summary.linear_momentum_drift, 1e-12) << formulation;
    EXPECT_LT(*kept.summary.energy.closure, 1e-3) << formulation;
    EXPECT_LE(kept.largest_energy, 1 + 1e-6) << formulation;
    if (formulation == "pFJ") {
      EXPECT_NEAR(kept.summary.mass, 1.0134e5, 0.01e5);  // [kg] 1000 x volume of the faceted body
      const auto& u = kept.summary.probes.at("arm").at("displacement");
      EXPECT_NEAR(u[0], -5.735, 0.02);
      EXPECT_NEAR(u[1], 7.269, 0.02);
    }
    std::vector<std::string> plain = settings;
    plain.push_back("physics.keep_angular_momentum=false");
    const SceneRun lost = run_config("satellite.toml", plain);
    EXPECT_GE(*lost.summary.angular_momentum_drift, 1e-4) << formulation;
    EXPECT_LE(lost.summary.linear_momentum_drift, 1e-12) << formulation;
    EXPECT_LE(lost.largest_energy, 1 + 1e-6) << formulation;
  }
}

/// Arms bend about concave edges, where nothing but D^J ties J to det F: tets turn inside out, unless the parting has an energy.
TEST(Satellite, NoTetTurnsInsideOutWithAnEnergyOfTheParting) {
  const std::vector<std::string> settings{"output.history_every=20"};
  const auto least = [](const SceneRun& r, const char* name) {
    const auto c = r.column(name);
    return *std::min_element(c.begin(), c.end());
  };
  const auto most = [](const SceneRun& r, const char* name) {
    const auto c = r.column(name);
    return *std::max_element(c.begin(), c.end());
  };
  const SceneRun plain = run_config("satellite.toml", settings);
  EXPECT_LT(least(plain, "min_tet_ratio"), -0.2);
  EXPECT_LT(least(plain, "min_detF_over_J"), 0.4);
  EXPECT_GT(most(plain, "max_detF_over_J"), 1.7);
  for (const std::string formulation : {"pFJ", "pFHJ"}) {
    std::vector<std::string> with = settings;
    with.insert(with.end(), {"physics.parting=1.0", "physics.formulation=" + formulation});
    const SceneRun held = run_config("satellite.toml", with);
    EXPECT_EQ(held.summary.status, "done");
    EXPECT_GT(least(held, "min_tet_ratio"), 0) << formulation;
    EXPECT_GT(least(held, "min_detF_over_J"), 0.6) << formulation;
    EXPECT_LT(most(held, "max_detF_over_J"), 1.35) << formulation;
    EXPECT_LT(*held.summary.energy.closure, 1e-5) << formulation;
    EXPECT_LE(held.largest_energy, 1 + 1e-6) << formulation;
    EXPECT_LE(*held.summary.angular_momentum_drift, 1e-13) << formulation;
  }
}

}  // namespace
}  // namespace nanson
