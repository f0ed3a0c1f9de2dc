// The tets' own energies in the scheme (method, section 17): what they are of, that their forces are their derivatives, and what they keep.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "kernels/tet_barrier.hpp"
#include "scenes.hpp"

namespace nanson::method {
namespace {

/// alpha, beta.
void set_tets(Scene& s, double stiffness, double barrier) {
  s.physics.tet_stiffness = stiffness;
  s.physics.tet_barrier = barrier;
}

Scene bar(int n) {
  Scene s = free_bar(n);
  s.physics.formulation = Formulation::pF;
  s.initial.field = InitialField::rest;
  return s;
}

Scene layered_bar(int n) {
  Scene s = bar(n);
  s.mesh.regions = {Axis::z, {1.0}, {"low", "high"}};
  s.materials = {s.material, s.material};
  s.materials[0].regions = {{"low", "test"}};
  s.materials[1].regions = {{"high", "test"}};
  s.materials[1].youngs_modulus *= 5;
  s.materials[1].density *= 2;
  return s;
}

Tensor<double> F_of_tet(const Simulation& s, const std::vector<Vec3>& x, std::size_t tet) {
  const auto& t = s.domain.mesh->tets[tet];
  const auto& X = s.domain.mesh->X;
  Tensor<double> E, e;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) {
      E[i][k] = X[t[k + 1]][i] - X[t[0]][i];
      e[i][k] = x[t[k + 1]][i] - x[t[0]][i];
    }
  const Tensor<double> cof = cofactor(E);
  const double det = determinant(E, cof);
  Tensor<double> F{};
  for (int i = 0; i < 3; ++i)
    for (int I = 0; I < 3; ++I)
      for (int k = 0; k < 3; ++k) F[i][I] += e[i][k] * cof[I][k] / det;
  return F;
}

double volume_of(const Simulation& s, std::size_t tet) {
  const auto& t = s.domain.mesh->tets[tet];
  const auto& X = s.domain.mesh->X;
  return tet_volume(X[t[0]], X[t[1]], X[t[2]], X[t[3]]);
}

/// Places of the nodes; their F is the mean of the tets around them, J is det F.
void place(Simulation& s, const std::vector<Vec3>& x) {
  std::vector<Tensor<double>> F(x.size(), Tensor<double>{});
  for (std::size_t t = 0; t < s.domain.mesh->tets.size(); ++t) {
    const Tensor<double> of_tet = F_of_tet(s, x, t);
    for (const int n : s.domain.mesh->tets[t])
      for (int m = 0; m < 9; ++m)
        F[n].a[m / 3][m % 3] += 0.25 * volume_of(s, t) / s.domain.volume[n] * of_tet.a[m / 3][m % 3];
  }
  for (std::size_t n = 0; n < x.size(); ++n) {
    double* U = U_of(s, static_cast<int>(n));
    for (int i = 0; i < 3; ++i) U[4 * (i + 1) + 3] = x[n][i];
    for (int m = 0; m < 9; ++m) U[4 * (m / 3 + 1) + m % 3] = F[n].a[m % 3][m / 3];
    U[3] = determinant(F[n], cofactor(F[n]));
  }
  adopt_state(s);
}

/// Random places around a stretched and sheared body: some tets are crushed or turned when `size` of the cells is half of them.
std::vector<Vec3> random_places(const Simulation& s, double size, int seed = 3) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-size, size);
  std::vector<Vec3> x = s.domain.mesh->X;
  for (Vec3& p : x) {
    const Vec3 X = p;
    p = {1.1 * X[0] + 0.2 * X[1] + uniform(random), 0.9 * X[1] - 0.1 * X[2] + uniform(random),
         1.05 * X[2] + uniform(random)};
  }
  return x;
}

double cell(const Scene& s) { return 2.0 / s.mesh.cells[2]; }

/// Forces on the nodes [N], in the mesh's numbering, with the stabilisation too.
std::vector<Vec3> forces(Simulation& s, const std::vector<Vec3>& x) {
  place(s, x);
  const Rates r = rates(s);
  std::vector<Vec3> f(x.size());
  for (std::size_t n = 0; n < x.size(); ++n) {
    const int row = s.domain.order.row_of[n];
    for (int i = 0; i < 3; ++i) f[n][i] = mass(s.domain, row) * r.U[row::U * static_cast<std::size_t>(row) + i];
  }
  return f;
}

/// What tets add to the forces of the same body at rest without them.
std::vector<Vec3> added_forces(const Scene& scene, const std::vector<Vec3>& x) {
  Scene plain = scene;
  set_tets(plain, 0, 0);
  const Problem with(scene), without(plain);
  Simulation a = with.start(), b = without.start();
  std::vector<Vec3> f = forces(a, x);
  const std::vector<Vec3> g = forces(b, x);
  for (std::size_t n = 0; n < f.size(); ++n) f[n] = f[n] - g[n];
  return f;
}

double strain(const Scene& scene, const std::vector<Vec3>& x) {
  const Problem problem(scene);
  Simulation s = problem.start();
  place(s, x);
  return energies(s).strain;
}
double added_strain(const Scene& scene, const std::vector<Vec3>& x) {
  Scene plain = scene;
  set_tets(plain, 0, 0);
  return strain(scene, x) - strain(plain, x);
}

double largest(const std::vector<Vec3>& f) {
  double most = 0;
  for (const Vec3& v : f)
    for (double c : v) most = std::max(most, std::abs(c));
  return most;
}

int crushed_tets(const Scene& scene, const std::vector<Vec3>& x) {
  const Problem problem(scene);
  Simulation s = problem.start();
  place(s, x);
  int crushed = 0;
  for (std::size_t t = 0; t < s.domain.mesh->tets.size(); ++t) {
    const Tensor<double> F = F_of_tet(s, x, t);
    double mean = 0;
    for (const int n : s.domain.mesh->tets[t]) mean += 0.25 * U_of(s, n)[3];
    crushed += determinant(F, cofactor(F)) < crushed_share * mean;
  }
  return crushed;
}

}  // namespace

/// E = 1/2 sum_a c_a sum_(T at a) (V_T/4) |F_T - F_a|^2, with one modulus and with several.
TEST(TetStiffness, EnergyIsTheVarianceOfFAroundTheNodes) {
  for (const Scene& plain : {bar(3), layered_bar(4)}) {
    Scene scene = plain;
    set_tets(scene, 0.3, 0);
    const Problem problem(scene);
    Simulation s = problem.start();
    const std::vector<Vec3> x = random_places(s, 0.2 * cell(scene));
    place(s, x);
    double variance = 0;
    for (std::size_t t = 0; t < problem.mesh.tets.size(); ++t) {
      const Tensor<double> F = F_of_tet(s, x, t);
      for (const int n : problem.mesh.tets[t]) {
        const double* U = U_of(s, n);
        double square = 0;
        for (int m = 0; m < 9; ++m) square += std::pow(F.a[m % 3][m / 3] - U[4 * (m / 3 + 1) + m % 3], 2);
        variance += 0.5 * tet_stiffness_at(s.domain, s.domain.order.row_of[n]) * 0.25 * volume_of(s, t) * square;
      }
    }
    EXPECT_NEAR(added_strain(scene, x) / variance, 1, 1e-10);
  }
}

/// Bent by any linear map, a body of any mesh and of several materials has neither energy nor force from its tets.
TEST(TetStiffness, IsNothingForAUniformDeformation) {
  for (const Scene& plain : {bar(3), layered_bar(4)}) {
    Scene scene = plain;
    set_tets(scene, 1, 0.5);
    const Problem problem(scene);
    Simulation s = problem.start();
    const std::vector<Vec3> x = random_places(s, 0);
    const double size = largest(added_forces(scene, random_places(s, 0.2 * cell(scene))));
    EXPECT_LT(largest(added_forces(scene, x)), 1e-11 * size);
    EXPECT_LT(std::abs(added_strain(scene, x)), 1e-12 * strain(scene, x));
    const Problem without(plain);
    Simulation at_rest = problem.start(), plain_at_rest = without.start();
    EXPECT_EQ(rates(at_rest).U, rates(plain_at_rest).U) << "undeformed: to the bit";
  }
}

/// A quadratic form: its differences are exact whatever their size, on free surfaces and between materials too.
TEST(TetStiffness, ForceIsTheDerivativeOfTheEnergy) {
  for (const Scene& plain : {bar(3), layered_bar(4)}) {
    Scene scene = plain;
    set_tets(scene, 0.4, 0);
    const Problem problem(scene);
    Simulation s = problem.start();
    const std::vector<Vec3> x = random_places(s, 0.1 * cell(scene)), f = added_forces(scene, x);
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> uniform(-0.05 * cell(scene), 0.05 * cell(scene));
    std::vector<Vec3> more = x, less = x;
    double work = 0;
    for (std::size_t n = 0; n < x.size(); ++n)
      for (int i = 0; i < 3; ++i) {
        const double d = uniform(random);
        more[n][i] += d;
        less[n][i] -= d;
        work += f[n][i] * d;
      }
    EXPECT_NEAR((added_strain(scene, less) - added_strain(scene, more)) / (2 * work), 1, 1e-9);
  }
}

TEST(TetBarrier, ForceIsTheDerivativeOfTheEnergy) {
  for (const Scene& plain : {bar(3), layered_bar(4)}) {
    Scene scene = plain;
    set_tets(scene, 0, 0.5);
    const Problem problem(scene);
    Simulation s = problem.start();
    const std::vector<Vec3> x = random_places(s, 0.35 * cell(scene)), f = added_forces(scene, x);
    ASSERT_GT(crushed_tets(scene, x), 20);
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<Vec3> direction(x.size());
    for (Vec3& d : direction)
      for (double& c : d) c = uniform(random);
    double work = 0;
    for (std::size_t n = 0; n < x.size(); ++n) work += dot(f[n], direction[n]);
    const auto error = [&](double h) {
      std::vector<Vec3> more = x, less = x;
      for (std::size_t n = 0; n < x.size(); ++n)
        for (int i = 0; i < 3; ++i) {
          more[n][i] += h * direction[n][i];
          less[n][i] -= h * direction[n][i];
        }
      return std::abs((added_strain(scene, less) - added_strain(scene, more)) / (2 * h * work) - 1);
    };
    EXPECT_LT(error(1e-7 * cell(scene)), 1e-5);
  }
}

/// Neither resultant nor torque, and turned with the body the forces turn with it: springs, barrier, with current areas too.
TEST(Tets, ForcesKeepBothMomentaAndTurnWithTheBody) {
  for (auto description : {Description::total, Description::updated}) {
    Scene scene = bar(4);
    scene.physics.description = description;
    set_tets(scene, 0.3, 0.5);
    const Problem problem(scene);
    Simulation s = problem.start();
    const std::vector<Vec3> x = random_places(s, 0.3 * cell(scene));
    ASSERT_GT(crushed_tets(scene, x), 20);
    const std::vector<Vec3> f = added_forces(scene, x);
    Vec3 sum{}, torque{};
    double size = 0;
    for (std::size_t n = 0; n < f.size(); ++n) {
      sum = sum + f[n];
      torque = torque + cross(x[n], f[n]);
      size += norm(f[n]);
    }
    EXPECT_LT(norm(sum), 1e-12 * size) << word(description);
    EXPECT_LT(norm(torque), 1e-12 * size) << word(description);

    const Tensor<double> Q = random_rotation(3);
    std::vector<Vec3> turned = x;
    for (Vec3& p : turned) p = times(Q, p);
    const std::vector<Vec3> g = added_forces(scene, turned);
    double difference = 0;
    for (std::size_t n = 0; n < f.size(); ++n) difference = std::max(difference, norm(g[n] - times(Q, f[n])));
    EXPECT_LT(difference, 1e-10 * largest(f)) << word(description);
    EXPECT_NEAR(added_strain(scene, turned) / added_strain(scene, x), 1, 1e-9);
  }
}

/// What one part takes from a spring or a crushed tet the other gives, to the bit: the momentum of a body of many parts stays.
TEST(Tets, ThreadsAndPartsChangeNoBit) {
  Scene scene = free_bar(10);
  scene.initial.twist_omega = 20;
  set_tets(scene, 0.3, 0.5);
  for (auto formulation : {Formulation::pF, Formulation::pFJ})
    for (auto correction : corrections) {
      scene.physics.formulation = formulation;
      scene.physics.flux_correction = correction;
      const Problem problem(scene);
      const auto outcome = [&](int threads) {
        Simulation s = problem.start(threads);
        EXPECT_GE(s.domain.order.parts.size(), 2u);
        place(s, random_places(s, 0.25 * cell(scene)));
        march(s, 3);
        bool crushed = false;
        for (const WatchedTets& w : s.state.barrier.parts) crushed = crushed || !w.touched.empty();
        EXPECT_TRUE(crushed);
        EXPECT_LT(linear_momentum_drift(s), 1e-13);
        return state_hash(s) + fmt::format(" {} {}", energies(s).strain, allowed_step(s));
      };
      const std::string once = outcome(1);
      EXPECT_EQ(once, outcome(2));
      EXPECT_EQ(once, outcome(3));
    }
}

/// A hard twist that crushes tets: what they store is booked, and the balance closes faster than the step falls.
TEST(Tets, EnergyBalanceCloses) {
  for (auto formulation : {Formulation::pF, Formulation::pFJ}) {
    Scene scene = column(3, 0.3);
    scene.mesh.size[2] = 3;
    scene.mesh.cells = {3, 3, 9};
    scene.initial.height = 3;
    scene.initial.twist_omega = 250;
    scene.physics.formulation = formulation;
    scene.physics.parting = formulation == Formulation::pFJ ? 4 : 0;
    set_tets(scene, 0.1, 0.5);
    scene.monitor.energy = true;
    scene.time.integrator = Integrator::ssp_rk3;
    scene.time.end = 0.03;
    const auto closure = [&](double cfl, bool& crushed) {
      scene.time.cfl = cfl;
      const Problem problem(scene);
      Simulation s = problem.start();
      EXPECT_EQ(run_quietly(s), "done");
      crushed = false;
      for (const WatchedTets& w : s.state.barrier.parts) crushed = crushed || !w.touched.empty();
      return energy_closure(s, energies(s));
    };
    bool crushed = false;
    const double whole = closure(0.3, crushed), half = closure(0.15, crushed);
    RecordProperty(std::string(word(formulation)), fmt::format("{:.2e} / {:.2e}", whole, half));
    EXPECT_LT(whole, 5e-3) << word(formulation);
    EXPECT_GT(whole / half, 4) << word(formulation);
    EXPECT_TRUE(crushed) << word(formulation);
  }
}

/// The largest sound step is that without tets: 1,000 steps of noise at 0.95 of the scheme's limit, clamped at one end.
TEST(Tets, LeaveTheCflLimitAlone) {
  for (auto formulation : {Formulation::pF, Formulation::pFJ})
    for (const double alpha : {0.0, 0.1}) {
      Scene scene = column(2, 0.495);
      scene.mesh.size = {1, 1, 2};
      scene.mesh.cells = {3, 3, 6};
      scene.mesh.split = Split::kuhn;
      scene.physics.formulation = formulation;
      set_tets(scene, alpha, 0.5);
      scene.initial.field = InitialField::rest;
      scene.time.cfl = 0.95 * (formulation == Formulation::pF ? 0.425 : 0.455);
      const Problem problem(scene);
      Simulation s = problem.start();
      std::mt19937_64 random(5);
      std::uniform_real_distribution<double> uniform(-1e-3, 1e-3);
      for (int n = 0; n < s.domain.order.nodes; ++n)
        for (int k = 0; k < 3; ++k) U_of(s, n)[k] += problem.mesh.X[n][2] > 0.1 ? uniform(random) : 0;
      adopt_state(s);
      const double start = energies(s).kinetic;
      double most = 0;
      for (int i = 0; i < 10; ++i) {
        march(s, 100);
        most = std::max(most, energies(s).kinetic);
      }
      EXPECT_LT(most, start) << word(formulation) << ' ' << alpha;
    }
}

}  // namespace nanson::method
