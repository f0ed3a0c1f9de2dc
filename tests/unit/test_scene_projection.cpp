// Rules of formulation pFp: its own section, Poisson's ratio up to one half, and the combinations that are not built.
#include "tests/unit/scene_text.hpp"

namespace nanson {
namespace {

const std::string rubber = R"(scene = "rubber"
[mesh]
box = { size = [1, 1, 6] }
[material]
law = "neo_hookean"
density = 1100
youngs_modulus = 17e6
poissons_ratio = 0.5
[physics]
formulation = "pFp"
[projection]
tolerance = 1e-4
[time]
end = 0.1
)";

/// The scene with a line after the one that starts a section.
std::string with_line(const std::string& section, const std::string& line) {
  return edited(rubber, section + "\n", section + "\n" + line + "\n");
}

void expect_error(const std::string& scene, const std::string& error) {
  const SceneResult r = read_text(scene);
  ASSERT_EQ(r.errors.size(), 1u) << error << joined(r.errors);
  EXPECT_TRUE(r.errors[0].starts_with(error)) << "  expected " << error << joined(r.errors);
}

TEST(SceneProjection, DefaultsAreTheMeasuredOnes) {
  const SceneResult r = read_text(rubber);
  ASSERT_TRUE(r.errors.empty()) << joined(r.errors);
  const ProjectionSpec& p = r.scene.projection;
  EXPECT_EQ(r.scene.physics.formulation, Formulation::pFp);
  EXPECT_EQ(r.scene.material.poissons_ratio, 0.5);
  EXPECT_EQ(r.scene.time.integrator, Integrator::ssp_rk3);
  EXPECT_EQ(r.scene.time.cfl, 0.6);
  EXPECT_EQ(p.solver, ProjectionSolver::cg);
  EXPECT_EQ(p.stabilisation, 0.02);
  EXPECT_EQ(p.drift_control, 0.1);
  EXPECT_EQ(p.tolerance, 1e-4);
  EXPECT_EQ(p.max_iterations, 200);
  EXPECT_EQ(p.on_limit, OnLimit::stop);
  EXPECT_EQ(ProjectionSpec{}.tolerance, 1e-3);
}

TEST(SceneProjection, NumbersStayInTheirRange) {
  expect_each_refused(rubber,
                      {
                          {"= 0.5", "= 0.51", "scene.toml:8:18: material.poissons_ratio = 0.51: must be at most 0.5"},
                          {"1e-4", "0.0", "scene.toml:12:13: projection.tolerance = 0.0: must be above 0"},
                          {"1e-4", "1.0", "scene.toml:12:13: projection.tolerance = 1.0: must be below 1"},
                          {"tolerance = 1e-4", "max_iterations = 0",
                           "scene.toml:12:18: projection.max_iterations = 0: must be at least 1"},
                          {"tolerance = 1e-4", "stabilisation = -0.1",
                           "scene.toml:12:17: projection.stabilisation = -0.1: must be at least 0"},
                          {"tolerance = 1e-4", "drift_control = 1.1",
                           "scene.toml:12:17: projection.drift_control = 1.1: must be at most 1"},
                          {"tolerance = 1e-4", "on_limit = \"go\"",
                           "scene.toml:12:12: projection.on_limit = \"go\": unknown word, allowed: stop | warn"},
                          {"tolerance = 1e-4", "solver = \"gmres\"",
                           "scene.toml:12:10: projection.solver = \"gmres\": unknown word, allowed: cg | pseudo_time"},
                      });
}

TEST(SceneProjection, LengthScaleBelongsToPseudoTime) {
  expect_error(with_line("[projection]", "length_scale = 0.2"),
               "scene.toml:12:16: projection.length_scale = 0.2: is not a key of cg");
  expect_error(with_line("[projection]", "solver = \"pseudo_time\""),
               "scene.toml:11:1: projection.length_scale: is missing");
  const SceneResult r = read_text(with_line("[projection]", "solver = \"pseudo_time\"\nlength_scale = 0.2"));
  EXPECT_TRUE(r.errors.empty()) << joined(r.errors);
  EXPECT_EQ(r.scene.projection.length_scale, 0.2);
}

TEST(SceneProjection, OneHalfAndTheSectionNeedTheFormulation) {
  const std::string other = edited(rubber, "\"pFp\"", "\"pFJ\"");
  const SceneResult r = read_text(other);
  EXPECT_EQ(
      r.errors,
      (std::vector<std::string>{
          "scene.toml:8:18: material.poissons_ratio = 0.5: must be below 0.5 unless physics.formulation = \"pFp\"",
          "scene.toml:12:13: projection.tolerance = 0.0001: is a key of physics.formulation = \"pFp\" only"}))
      << joined(r.errors);
}

TEST(SceneProjection, CombinationsThatAreNotBuiltAreRefused) {
  expect_error(edited(rubber, "neo_hookean", "linear_elastic"),
               "scene.toml:5:7: material.law = \"linear_elastic\": is not built yet with formulation = \"pFp\"");
  expect_error(edited(rubber, "\"neo_hookean\"", "\"hencky_j2\"\nhardening = [[0, 1], [1, 2]]"),
               "scene.toml:5:7: material.law = \"hencky_j2\": is not built yet with formulation = \"pFp\"");
  expect_error(with_line("[material]", "volumetric = \"barrier\""),
               "scene.toml:5:14: material.volumetric = \"barrier\": formulation = \"pFp\" has the pressure");
  expect_error(with_line("[material]", "isochoric = \"J\""),
               "scene.toml:5:13: material.isochoric = \"J\": needs an evolved J");
  for (const auto& [line, error] : std::vector<std::pair<std::string, std::string>>{
           {"pressure_jump = \"tensor\"", "17: physics.pressure_jump = \"tensor\": needs an evolved J"},
           {"reconstruction = \"limited\"", "18: physics.reconstruction = \"limited\": is not built yet"},
           {"flux_correction = \"full\"", "19: physics.flux_correction = \"full\": is not built yet"},
           {"flux_correction = \"pressure\"", "19: physics.flux_correction = \"pressure\": is not built yet"},
           {"boundary_flux = \"paper\"",
            "17: physics.boundary_flux = \"paper\": formulation = \"pFp\" needs \"adjoint\""},
           {"entropy_fix = \"edge\"", "15: physics.entropy_fix = \"edge\": is not built yet"},
           {"keep_angular_momentum = true", "25: physics.keep_angular_momentum = true: is not built yet"},
           {"stabilisation = \"jst\"", "17: physics.stabilisation = \"jst\": is not built yet"}})
    expect_error(with_line("[physics]", line), "scene.toml:10:" + error);
  EXPECT_TRUE(read_text(with_line("[time]", "integrator = \"tvd_rk2\"")).errors.empty());
  expect_error(with_line("[time]", "step = \"paper\""),
               "scene.toml:14:8: time.step = \"paper\": is the speed of pressure waves");
  for (const char* line :
       {"reconstruction = \"constant\"", "upwind_metric = \"paper\"", "boundary_flux = \"adjoint\""}) {
    const SceneResult r = read_text(with_line("[physics]", line));
    EXPECT_TRUE(r.errors.empty()) << line << joined(r.errors);
  }
}

}  // namespace
}  // namespace nanson
