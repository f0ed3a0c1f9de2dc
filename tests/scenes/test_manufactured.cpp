// Order of accuracy at finite strain, by a body force that makes a chosen motion exact.
#include <cmath>

#include "tests/scenes/scene_run.hpp"

namespace nanson {
namespace {

struct Rates {
  double p1, P11, p1_fine;
};

Rates rates(std::vector<std::string> settings) {
  settings.push_back("mesh.cells=[6,6,6]");
  const SceneRun coarse = run_config("manufactured.toml", settings);
  settings.back() = "mesh.cells=[12,12,12]";
  const SceneRun fine = run_config("manufactured.toml", settings);
  const auto rate = [&](const char* key) {
    return std::log2(coarse.summary.errors.at(key) / fine.summary.errors.at(key));
  };
  return {rate("p1_L2"), rate("P11_L2"), fine.summary.errors.at("p1_L2")};
}

TEST(Manufactured, CorrectedSchemesAreOfSecondOrderInEveryFormulation) {
  for (const char* formulation : {"pF", "pFJ", "pFHJ"}) {
    const Rates r = rates({std::string("physics.formulation=") + formulation, "physics.flux_correction=full"});
    EXPECT_GE(r.p1, 1.7) << formulation;
    EXPECT_GE(r.P11, 2.3) << formulation;
    EXPECT_LE(r.p1_fine, 0.014) << formulation;
  }
}

/// The motion starts displaced: positions start there too, or current areas are wrong.
TEST(Manufactured, EveryDescriptionConverges) {
  for (const char* description : {"total", "updated", "pseudo_updated"}) {
    const Rates r = rates({std::string("physics.description=") + description});
    EXPECT_GE(r.p1, 1.1) << description;
    EXPECT_GE(r.P11, 2.2) << description;
  }
}

TEST(Manufactured, LawsAndNearlyIncompressibleSolidsConverge) {
  const std::vector<std::vector<std::string>> variants{
      {"material.volumetric=barrier"},
      {"material.law=mooney_rivlin", "material.xi=5e5"},
      {"material.law=linear_elastic"},
      {"material.poissons_ratio=0.495", "initial.amplitudes=[0.05,-0.03,-0.02]", "initial.period=0.03",
       "time.end=0.01"},
      {"mesh.perturb=0.1"}};
  for (const auto& variant : variants) {
    std::vector<std::string> settings = variant;
    settings.push_back("physics.flux_correction=full");
    const Rates r = rates(settings);
    EXPECT_GE(r.p1, 1.5) << variant[0];
    EXPECT_GE(r.P11, 1.5) << variant[0];
  }
}

}  // namespace
}  // namespace nanson
