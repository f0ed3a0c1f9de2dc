// Blake's problem against its closed form: profiles over r at the end.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/scenes/blake_exact.hpp"
#include "tests/scenes/scene_run.hpp"

namespace nanson {
namespace {

/// Mean over the nodes of each radius, and what it is compared with.
struct Profile {
  std::vector<double> r, pressure, sigma_rr, exact_pressure, exact_sigma_rr;  // [m], [Pa]
  double end = 0;                                                             // [s]
};

Profile profile_of(const Simulation& s) {
  const MeshSpec& m = s.domain.scene->mesh;
  const int cells = m.cells[2];
  const std::size_t points = static_cast<std::size_t>(cells) + 1;
  Profile out;
  out.end = s.state.t;
  out.r.resize(points);
  out.pressure.assign(points, 0);
  out.sigma_rr.assign(points, 0);
  const double share = 1.0 / ((m.cells[0] + 1) * (m.cells[1] + 1));
  for (int n = 0; n < s.domain.order.nodes; ++n) {
    const Vec3& X = s.domain.mesh->X[static_cast<std::size_t>(n)];
    const double r = std::hypot(X[0], X[1], X[2]);
    const auto k = static_cast<std::size_t>(std::lround((r - m.inner) / (m.outer - m.inner) * cells));
    double p, P[9];
    field_named("pressure").at(s, n, &p);
    field_named("P").at(s, n, P);
    out.r[k] = r;
    out.pressure[k] += share * p;
    for (int i = 0; i < 9; ++i) out.sigma_rr[k] += share * P[i] * X[i / 3] * X[i % 3] / (r * r);
  }
  const Blake exact;
  for (const double r : out.r) {
    out.exact_pressure.push_back(exact.pressure(r, s.state.t));
    out.exact_sigma_rr.push_back(exact.sigma_rr(r, s.state.t));
  }
  return out;
}

double relative_L1(const std::vector<double>& ours, const std::vector<double>& exact) {
  double error = 0, size = 0;
  for (std::size_t k = 0; k < ours.size(); ++k) {
    const double weight = k == 0 || k + 1 == ours.size() ? 0.5 : 1;
    error += weight * std::abs(ours[k] - exact[k]);
    size += weight * std::abs(exact[k]);
  }
  return error / size;
}

/// How far the pressure leaves the range of the closed form, in shares of the front's jump: behind the front, and below the rest ahead of it.
struct Overshoot {
  double behind = 0, ahead = 0;
};

Overshoot overshoot(const Profile& f) {
  const Blake exact;
  const auto [least, most] = std::minmax_element(f.exact_pressure.begin(), f.exact_pressure.end());
  Overshoot out;
  for (std::size_t k = 0; k < f.r.size(); ++k)
    if (f.r[k] > exact.front(f.end)) out.ahead = std::max(out.ahead, -f.pressure[k] / exact.jump(f.end));
    else
      out.behind = std::max(
          {out.behind, (f.pressure[k] - *most) / exact.jump(f.end), (*least - f.pressure[k]) / exact.jump(f.end)});
  return out;
}

struct Result {
  double pressure = 0, sigma_rr = 0;  // relative L1
  Overshoot overshoot;
};

Result run_blake(const std::string& reconstruction, const std::string& correction,
                 std::vector<std::string> settings = {}) {
  settings.insert(settings.end(),
                  {"physics.reconstruction=" + reconstruction, "physics.flux_correction=" + correction});
  Profile f;
  const SceneRun run = run_config("blake.toml", settings, 1, [&](const Simulation& s) { f = profile_of(s); });
  EXPECT_EQ(run.summary.status, "done");
  const Result r{relative_L1(f.pressure, f.exact_pressure), relative_L1(f.sigma_rr, f.exact_sigma_rr), overshoot(f)};
  testing::Test::RecordProperty(
      fmt::format("{}_{}", reconstruction, correction),
      fmt::format("pressure {:.3f}, sigma_rr {:.3f}, overshoot behind {:.3f}, ahead {:.3f}, closure {:.1e}", r.pressure,
                  r.sigma_rr, r.overshoot.behind, r.overshoot.ahead, *run.summary.energy.closure));
  return r;
}

TEST(BlakeExact, IsTheDifferencesOfItsPotential) {
  const Blake b;
  const double t = 1.6e-4, h = 1e-4;  // [s], [m]
  for (const double r : {0.1 + 2 * h, 0.2, 0.37, 0.6, 0.85}) {
    const auto phi = [&](int k) { return b.potential(r + k * h, t); };
    const double first = (phi(-2) - 8 * phi(-1) + 8 * phi(1) - phi(2)) / (12 * h),
                 second = (-phi(-2) + 16 * phi(-1) - 30 * phi(0) + 16 * phi(1) - phi(2)) / (12 * h * h);
    EXPECT_NEAR(b.u(r, t) / first, 1, 1e-6) << r;
    EXPECT_NEAR(b.du(r, t), second, 1e-6 * b.p / b.mu()) << r;
    const double dt = h / b.cp();  // d2 phi/dt2 = c_p^2 div u
    const auto at = [&](int k) { return b.potential(r, t + k * dt); };
    const double rate = (-at(-2) + 16 * at(-1) - 30 * at(0) + 16 * at(1) - at(2)) / (12 * h * h);
    EXPECT_NEAR(-b.pressure(r, t), b.kappa() * rate, 1e-6 * b.p) << r;
  }
}

TEST(BlakeExact, StartsAtRestAndHasThePressureOnTheCavity) {
  const Blake b;
  EXPECT_NEAR(b.cp(), 5000, 1e-9);
  EXPECT_NEAR(b.front(1.6e-4), 0.9, 1e-12);
  for (const double t : {1e-9, 1e-5, 5e-5, 1.6e-4, 1e-3}) EXPECT_NEAR(b.sigma_rr(b.a, t), -b.p, 1e-9 * b.p);
  EXPECT_NEAR(b.u(0.5, 0.4 / b.cp() + 1e-15), 0, 1e-16);
  EXPECT_NEAR(b.sigma_rr(0.899999, 1.6e-4), -b.p * b.a / 0.9, 1e-4 * b.p);  // the jump at the front
  EXPECT_NEAR(b.pressure(0.899999, 1.6e-4), b.jump(1.6e-4), 1e-4 * b.p);
  EXPECT_EQ(b.sigma_rr(0.900001, 1.6e-4), 0);
}

struct Row {
  const char *reconstruction, *correction;
  double pressure, sigma_rr, behind, ahead;  // relative L1, shares of the front's jump
};

/// The prototype's relative L1 of pressure: 0.63, 0.31, 0.27; corrected 0.19, limited and corrected 0.16.
TEST(Blake, ProfilesStayWhereTheyWere) {
  for (const Row& r :
       {Row{"constant", "none", 0.625, 0.141, 0, 0}, Row{"linear", "none", 0.298, 0.070, 0.018, 0},
        Row{"limited", "none", 0.272, 0.067, 0.011, 0}, Row{"linear", "full", 0.175, 0.044, 0.003, 0.041},
        Row{"limited", "full", 0.161, 0.040, 0, 0.016}}) {
    const Result found = run_blake(r.reconstruction, r.correction);
    const std::string what = std::string(r.reconstruction) + " " + r.correction;
    EXPECT_NEAR(found.pressure, r.pressure, 0.002) << what;
    EXPECT_NEAR(found.sigma_rr, r.sigma_rr, 0.002) << what;
    EXPECT_NEAR(found.overshoot.behind, r.behind, 0.002) << what;
    EXPECT_NEAR(found.overshoot.ahead, r.ahead, 0.002) << what;
  }
}

}  // namespace
}  // namespace nanson
