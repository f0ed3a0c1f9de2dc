// The limited reconstruction in runs: threads, energy, and that it does what it is for.
#include <gtest/gtest.h>

#include <set>

#include "scenes.hpp"

namespace nanson::method {
namespace {

TEST(Limiter, ThreadsChangeNoBit) {
  for (auto correction : {FluxCorrection::none, FluxCorrection::full}) {
    Scene scene = loaded_bar(9);
    scene.physics.reconstruction = Reconstruction::limited;
    scene.physics.flux_correction = correction;
    const Problem problem(scene);
    std::set<std::string> hashes;
    for (int threads : {1, 2, 3}) {
      Simulation s = problem.start(threads);
      ASSERT_GE(s.domain.order.parts.size(), 2u);
      march(s, 3);
      hashes.insert(state_hash(s));
    }
    EXPECT_EQ(hashes.size(), 1u) << word(correction);
  }
}

/// Constant < limited < linear in the energy that is left.
TEST(Limiter, DissipatesMoreThanLinearAndLessThanConstant) {
  double left[3];
  for (auto reconstruction : {Reconstruction::constant, Reconstruction::limited, Reconstruction::linear}) {
    Scene scene = free_bar(3);
    scene.physics.reconstruction = reconstruction;
    scene.monitor.energy = true;
    const Problem problem(scene);
    Simulation s = problem.start();
    EXPECT_EQ(run_quietly(s), "done");
    const Energies e = energies(s);
    left[static_cast<int>(reconstruction)] = (e.kinetic + e.strain) / s.books.initial_energy;
    EXPECT_LT(energy_closure(s, energies(s)), reconstruction == Reconstruction::limited ? 3e-3 : 1e-3)
        << word(reconstruction);  // a limiter has kinks, the integrator feels them
  }
  EXPECT_LT(left[static_cast<int>(Reconstruction::constant)], left[static_cast<int>(Reconstruction::limited)]);
  EXPECT_LT(left[static_cast<int>(Reconstruction::limited)], left[static_cast<int>(Reconstruction::linear)]);
}

}  // namespace
}  // namespace nanson::method
