// The keys of hencky_j2 and the plastic_strain field.
#include "tests/unit/scene_text.hpp"

#include "engine/material.hpp"

namespace nanson {
namespace {

/// Lines 8 to 10 are those of the law.
std::string with_law(const std::string& lines) {
  return edited(small_scene, "law = \"linear_elastic\"\ndensity = 1000\nyoungs_modulus = 1e6\npoissons_ratio = 0.3",
                "density = 1000\nyoungs_modulus = 1e6\npoissons_ratio = 0.3\nlaw = \"hencky_j2\"\n" + lines);
}
const std::string linear = with_law("yield_stress = 1e4\nhardening_modulus = 2e4");
const std::string curve = with_law("hardening = [[0, 1e4], [0.1, 1e4], [0.2, 3e4]]");

TEST(Scene, LinearHardeningIsOnePieceThatNeverEnds) {
  const SceneResult r = read_text(linear);
  ASSERT_TRUE(r.errors.empty()) << joined(r.errors);
  EXPECT_EQ(r.scene.material.law, Law::hencky_j2);
  const Hardening h = constants_of(r.scene.material).hardening;
  EXPECT_EQ(h.count, 1);
  EXPECT_EQ(h.tau_y[0], 1e4);
  EXPECT_EQ(h.slope[0], 2e4);
}

TEST(Scene, HardeningCurveEndsOnALevel) {
  const SceneResult r = read_text(curve);
  ASSERT_TRUE(r.errors.empty()) << joined(r.errors);
  const Hardening h = constants_of(r.scene.material).hardening;
  EXPECT_EQ(h.count, 3);
  EXPECT_EQ(h.tau_y[0], 1e4);
  EXPECT_EQ(h.slope[0], 0);
  EXPECT_DOUBLE_EQ(h.slope[1], 2e5);
  EXPECT_EQ(h.slope[2], 0);
}

TEST(Scene, PlasticityKeysAreChecked) {
  expect_each_refused(
      linear,
      {
          {"yield_stress = 1e4\n", "", "scene.toml:4:1: material.yield_stress: is missing"},
          {"yield_stress = 1e4", "yield_stress = 0", "scene.toml:9:16: material.yield_stress = 0: must be above 0"},
          {"hardening_modulus = 2e4", "",
           "scene.toml:4:1: material.hardening_modulus: exactly one of hardening_modulus | hardening is needed"},
          {"hardening_modulus = 2e4", "hardening_modulus = -1",
           "scene.toml:10:21: material.hardening_modulus = -1: must be at least 0"},
          {"hardening_modulus", "hardening = [[0, 1e4], [1, 2e4]]\nhardening_modulus",
           "scene.toml:10:13: material.hardening = [[0, 10000.0], [1, 20000.0]]: stands beside hardening_modulus"},
          {"hardening_modulus", "volumetric = \"barrier\"\nhardening_modulus",
           "scene.toml:10:14: material.volumetric = \"barrier\": has no meaning for linear_elastic and hencky_j2, "
           "whose energies are their own, allowed: quadratic"},
          {"hardening_modulus", "isochoric = \"J\"\nhardening_modulus",
           "scene.toml:10:13: material.isochoric = \"J\": has no meaning for linear_elastic and hencky_j2, whose "
           "energies are their own, allowed: F"},
          {"hardening_modulus", "xi = 0\nhardening_modulus",
           "scene.toml:10:6: material.xi = 0: is not a key of hencky_j2"},
      });
  expect_each_accepted(linear,
                       {{"hardening_modulus = 2e4", "hardening_modulus = 0"},
                        {"hardening_modulus", "volumetric = \"quadratic\"\nisochoric = \"F\"\nhardening_modulus"}});
}

TEST(Scene, HardeningCurveIsChecked) {
  expect_each_refused(
      curve,
      {
          {"[[0, 1e4], [0.1, 1e4], [0.2, 3e4]]", "[[0, 1e4]]",
           "scene.toml:9:13: material.hardening = [[0, 10000.0]]: must be a list of 2 to 16 points [eps_p, tau_y]"},
          {"[[0, 1e4],", "[[0.01, 1e4],",
           "scene.toml:9:14: material.hardening.0 = [0.01, 10000.0]: must start the curve: eps_p = 0, tau_y above 0"},
          {"[0.1, 1e4]", "[0, 1e4]",
           "scene.toml:9:24: material.hardening.1 = [0, 10000.0]: must come after the point at eps_p = 0"},
          {"[0.2, 3e4]", "[0.2, 0.5e4]",
           "scene.toml:9:36: material.hardening.2 = [0.2, 5000.0]: softens: tau_y must be at least 10000, that of the "
           "point before"},
          {"[0.2, 3e4]", "[0.2]", "scene.toml:9:36: material.hardening.2 = [0.2]: must be two numbers [eps_p, tau_y]"},
          {"hardening =", "yield_stress = 2e4\nhardening =",
           "scene.toml:9:16: material.yield_stress = 20000.0: is not the curve's first tau_y, 10000: leave it out"},
      });
  std::string long_curve = "[[0, 1e4]";
  for (int k = 1; k <= 16; ++k) long_curve += ", [" + std::to_string(k) + ", 1e4]";
  expect_each_refused(
      curve, {{"[[0, 1e4], [0.1, 1e4], [0.2, 3e4]]", long_curve + "]", "scene.toml:9:13: material.hardening = "}});
  expect_each_accepted(curve, {{"hardening =", "yield_stress = 1e4\nhardening ="}});
}

TEST(Scene, PlasticStrainIsShownByPlasticLawsOnly) {
  const std::string field = "[output]\nfields = [\"plastic_strain\"]\n",
                    probe = "[output]\nprobes = { tip = { at = [0, 0, 0], fields = [\"plastic_strain\"] } }\n";
  const std::string why = "plastic_strain needs material.law = \"hencky_j2\"";
  for (const std::string& output : {field, probe}) EXPECT_TRUE(read_text(linear + output).errors.empty());
  const auto refused = [&](const std::string& output, const std::string& error) {
    const SceneResult r = read_text(small_scene + output);
    EXPECT_TRUE(r.errors.size() == 1 && r.errors[0].starts_with(error) && r.errors[0].ends_with(why))
        << joined(r.errors);
  };
  refused(field, "scene.toml:12:10: output.fields");
  refused(probe, "scene.toml:12:10: output.probes");
}

}  // namespace
}  // namespace nanson
