// The Taylor bar: final shape and plastic strain on a coarse mesh, the energy account, and the pressure that {p,F,J} keeps smooth.
#include <cmath>

#include "engine/dual.hpp"
#include "engine/fields.hpp"
#include "tests/scenes/scene_run.hpp"

namespace nanson {
namespace {

struct Pressure {
  double checkerboard = 0;                         // chi of method, section 11: 0 for a linear field, 1 for a checkerboard
  double least = 1e300, most = -1e300;             // [Pa]
};

/// sqrt(sum W (p_b - p_a - (g_a + g_b)/2 . D)^2 / sum W (p_b - p_a)^2) over the edges, W = |C|/|D|, g the volume-weighted mean of the tets' gradients.
Pressure pressure_of(const Simulation& s) {
  const Mesh& mesh = *s.mesh;
  const Dual dual = make_dual(mesh);
  std::vector<double> p(mesh.X.size());
  Pressure out;
  for (std::size_t n = 0; n < p.size(); ++n) {
    field_at(s, "pressure", static_cast<int>(n), &p[n]);
    out.least = std::min(out.least, p[n]), out.most = std::max(out.most, p[n]);
  }
  std::vector<Vec3> g(p.size(), Vec3{});
  for (const auto& t : mesh.tets)
    for (int v = 0; v < 4; ++v) {                  // p_v times minus a third of the area opposite, a quarter of it to each node
      const auto& f = tet_faces[static_cast<std::size_t>(v)];
      const Vec3 &a = mesh.X[static_cast<std::size_t>(t[f[0]])], &b = mesh.X[static_cast<std::size_t>(t[f[1]])], &c = mesh.X[static_cast<std::size_t>(t[f[2]])];
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        const double area = 0.5 * ((b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]));
        for (const int n : t) g[static_cast<std::size_t>(n)][i] -= p[static_cast<std::size_t>(t[v])] * area / 12 / dual.volume[static_cast<std::size_t>(n)];
      }
    }
  double above = 0, below = 0;
  for (const auto& e : dual.edges) {
    const Vec3 &A = mesh.X[e.a], &B = mesh.X[e.b];
    double linear = 0, size = 0;
    for (std::size_t i = 0; i < 3; ++i) linear += 0.5 * (g[e.a][i] + g[e.b][i]) * (B[i] - A[i]), size += (B[i] - A[i]) * (B[i] - A[i]);
    const double W = std::hypot(e.C[0], e.C[1], e.C[2]) / std::sqrt(size), jump = p[e.b] - p[e.a];
    above += W * (jump - linear) * (jump - linear), below += W * jump * jump;
  }
  out.checkerboard = std::sqrt(above / below);
  return out;
}

TEST(TaylorBar, EndsInTheMeasuredShape) {
  const SceneRun run = run_config("taylor_bar.toml", {"mesh.cells=[4,4,16]"});
  ASSERT_EQ(run.summary.status, "done");
  std::printf("R %.5e L %.5e eps %.4f closure %.2e steps %ld cpu %.2f\n", run.summary.probes.at("foot").at("x")[0], run.summary.probes.at("top").at("x")[2],
              run.column("max_plastic_strain").back(), *run.summary.energy.closure, run.summary.steps, run.summary.cpu_s);
  EXPECT_NEAR(run.summary.probes.at("foot").at("x")[0], 6.5e-3, 0.02e-3);
  EXPECT_NEAR(run.summary.probes.at("top").at("x")[2], 21.8e-3, 0.02e-3);
  EXPECT_NEAR(run.column("max_plastic_strain").back(), 2, 0.02);
  EXPECT_LT(*run.summary.energy.closure, 1e-3);
  EXPECT_LE(run.largest_energy, 1 + 1e-6);
}

TEST(TaylorBar, PressureIsSmootherWithAnEvolvedJ) {
  Pressure pressure[2];
  for (const int evolved : {0, 1})
    run_config("taylor_bar.toml", {"mesh.cells=[4,4,16]", "time.end=20e-6", evolved ? "physics.formulation=pFJ" : "physics.formulation=pF"}, 2,
               [&](const Simulation& s) { pressure[evolved] = pressure_of(s); });
  for (const int e : {0, 1}) std::printf("chi %.4f %.4e %.4e\n", pressure[e].checkerboard, pressure[e].least, pressure[e].most);
  EXPECT_LT(pressure[1].checkerboard, 0.7 * pressure[0].checkerboard);
}

}  // namespace
}  // namespace nanson
