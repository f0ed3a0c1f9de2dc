// The Taylor bar: final shape and plastic strain on a coarse mesh, the energy account, and the pressure that {p,F,J} keeps smooth.
#include <cmath>

#include "engine/dual.hpp"
#include "engine/fields.hpp"
#include "tests/scenes/scene_run.hpp"

namespace nanson {
namespace {

struct Pressure {
  double checkerboard = 0;              // chi of method, section 11: 0 for a linear field, 1 for a checkerboard
  double least = 1e300, most = -1e300;  // [Pa]
};

/// sqrt(sum W (p_b - p_a - (g_a + g_b)/2 . D)^2 / sum W (p_b - p_a)^2) over the edges, W = |C|/|D|, g the volume-weighted mean of the tets' gradients.
Pressure pressure_of(const Simulation& s) {
  const Mesh& mesh = *s.domain.mesh;
  const Dual dual = make_dual(mesh);
  std::vector<double> p(mesh.X.size());
  Pressure out;
  for (std::size_t n = 0; n < p.size(); ++n) {
    field_named("pressure").at(s, static_cast<int>(n), &p[n]);
    out.least = std::min(out.least, p[n]);
    out.most = std::max(out.most, p[n]);
  }
  std::vector<Vec3> g(p.size(), Vec3{});
  for (const auto& t : mesh.tets)
    for (int v = 0; v < 4; ++v) {  // p_v times minus a third of the area opposite, a quarter of it to each node
      const auto& f = tet_faces[static_cast<std::size_t>(v)];
      const Vec3 &a = mesh.X[static_cast<std::size_t>(t[f[0]])], &b = mesh.X[static_cast<std::size_t>(t[f[1]])],
                 &c = mesh.X[static_cast<std::size_t>(t[f[2]])];
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        const double area = 0.5 * ((b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]));
        for (const int n : t)
          g[static_cast<std::size_t>(n)][i] -= p[static_cast<std::size_t>(t[v])] * area / 12
                                               / dual.volume[static_cast<std::size_t>(n)];
      }
    }
  double above = 0, below = 0;
  for (const auto& e : dual.edges) {
    const Vec3 &A = mesh.X[e.a], &B = mesh.X[e.b];
    double linear = 0, size = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      linear += 0.5 * (g[e.a][i] + g[e.b][i]) * (B[i] - A[i]);
      size += (B[i] - A[i]) * (B[i] - A[i]);
    }
    const double W = std::hypot(e.C[0], e.C[1], e.C[2]) / std::sqrt(size), jump = p[e.b] - p[e.a];
    above += W * (jump - linear) * (jump - linear);
    below += W * jump * jump;
  }
  out.checkerboard = std::sqrt(above / below);
  return out;
}

struct Row {
  const char* cells;
  double radius, length, plastic_strain;  // [m] of the foot, [m], largest [-] at 80 us
};

/// Other codes: radius 6.8 to 7.3 mm, length 21.4 to 21.7 mm on fine meshes.
TEST(TaylorBar, ShapeStaysWhereItWas) {
  for (const Row& r : {Row{"[4,4,16]", 6.236e-3, 22.052e-3, 1.697}, Row{"[6,6,24]", 6.560e-3, 21.810e-3, 2.172}}) {
    const SceneRun run = run_config("taylor_bar.toml", {std::string("mesh.cells=") + r.cells});
    ASSERT_EQ(run.summary.status, "done") << r.cells;
    EXPECT_NEAR(run.summary.probes.at("foot").at("x")[0], r.radius, 0.005e-3) << r.cells;
    EXPECT_NEAR(run.summary.probes.at("top").at("x")[2], r.length, 0.005e-3) << r.cells;
    EXPECT_NEAR(run.column("max_plastic_strain").back(), r.plastic_strain, 0.01) << r.cells;
    EXPECT_LT(*run.summary.energy.closure, 3e-4) << r.cells;
    EXPECT_LE(run.largest_energy, 1 + 1e-6) << r.cells;
  }
}

TEST(TaylorBar, PressureIsSmootherWithAnEvolvedJ) {
  Pressure pressure[3];
  double radius[3];
  const char* formulation[] = {"pF", "pFJ", "pFHJ"};
  for (int i = 0; i < 3; ++i) {
    const SceneRun run = run_config(
        "taylor_bar.toml",
        {"mesh.cells=[4,4,16]", "time.end=20e-6", std::string("physics.formulation=") + formulation[i]}, 2,
        [&](const Simulation& s) { pressure[i] = pressure_of(s); });
    radius[i] = run.summary.probes.at("foot").at("x")[0];
  }
  EXPECT_NEAR(pressure[0].checkerboard, 0.87, 0.02);
  EXPECT_NEAR(pressure[1].checkerboard, 0.34, 0.02);
  EXPECT_LT(pressure[1].most - pressure[1].least, 0.3 * (pressure[0].most - pressure[0].least));
  EXPECT_NEAR(radius[2], radius[1], 1e-6);
}

TEST(TaylorBar, StateIsTheSameToTheBitOnAnyNumberOfThreads) {
  std::string hash[2];
  for (const int threads : {1, 2})
    hash[threads - 1] =
        run_config("taylor_bar.toml", {"mesh.cells=[4,4,16]", "time.max_steps=200"}, threads).summary.state_hash;
  EXPECT_EQ(hash[0], hash[1]);
}

}  // namespace
}  // namespace nanson
