// A run that goes on from a checkpoint is the run that was never stopped, to the last bit, on any number of threads.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>

#include "engine/history.hpp"
#include "engine/physics_rules.hpp"
#include "io/results/checkpoint.hpp"
#include "tests/method/scenes.hpp"

namespace nanson::method {
namespace {

namespace fs = std::filesystem;

constexpr long steps = 12, stop = 5;  // of the whole run, and the one that the checkpoint is of

/// What a run tells.
struct Told {
  std::vector<std::vector<double>> rows;
  std::vector<std::vector<float>> frames;
  std::string status, state;
  Books books;
  Extremes extremes;
};

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

/// Runs on; with a writer, the checkpoint of step `stop` is written, and how many rows and frames had been told by then.
Told run_on(Simulation& s, CheckpointWriter* writer = nullptr, std::array<std::size_t, 2>* before = nullptr) {
  Told told;
  const std::vector<HistoryColumn> columns = history_columns(s, {});
  Observer observer;
  observer.on_history = [&](const Simulation& now) { told.rows.push_back(history_row(now, columns)); };
  observer.on_frame = [&](const Simulation& now) { told.frames.push_back(field(now, field_named("P"))); };
  observer.on_checkpoint = [&](const Simulation& now, bool) {
    if (!writer || now.state.step != stop) return;
    *before = {told.rows.size(), told.frames.size()};
    writer->write(now, {});
  };
  std::string reason;
  told.status = run(s, observer, reason);
  told.state = state_hash(s);
  told.books = s.books;
  told.extremes = s.watch.extremes;
  return told;
}

class Folder {
 public:
  Folder() : path_(fs::path(testing::TempDir()) / ("restart_" + std::to_string(::getpid()))) {
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

void expect_to_go_on(Scene scene, const std::string& what) {
  scene.time.max_steps = steps;
  scene.time.end = 1;
  scene.output.history_every = 3;
  const Problem problem(scene);
  const Folder folder;
  CheckpointWriter writer(folder.path(), "", provenance());
  std::array<std::size_t, 2> before{};
  Simulation whole = problem.start(), again = problem.start(3);
  const Told all = run_on(whole, &writer, &before);
  ASSERT_EQ(all.status, "stopped") << what;
  ASSERT_TRUE(restore(read_checkpoint(folder.path() / "checkpoint.h5"), again)) << what;
  ASSERT_EQ(again.state.step, stop) << what;
  const Told rest = run_on(again);
  EXPECT_EQ(rest.state, all.state) << what;
  ASSERT_EQ(rest.rows.size() + before[0], all.rows.size()) << what;
  ASSERT_EQ(rest.frames.size() + before[1], all.frames.size()) << what;
  for (std::size_t i = 0; i < rest.rows.size(); ++i)
    EXPECT_TRUE(same_bits(rest.rows[i], all.rows[before[0] + i])) << what << ", row " << before[0] + i;
  for (std::size_t i = 0; i < rest.frames.size(); ++i)
    EXPECT_EQ(rest.frames[i], all.frames[before[1] + i]) << what << ", frame " << before[1] + i;
  EXPECT_EQ(std::memcmp(&rest.books, &all.books, sizeof(Books)), 0) << what;
  EXPECT_EQ(std::memcmp(&rest.extremes, &all.extremes, sizeof(Extremes)), 0) << what;
}

TEST(Restart, IsTheRunThatWasNeverStoppedForEveryRowThatAStateCarries) {
  for (const Scene& scene : scenes_with_all_rows())
    expect_to_go_on(scene, name(scene.physics) + " " + std::string(word(scene.time.integrator)) + " "
                               + std::string(word(scene.physics.description)));
}

TEST(Restart, IsTheSameForEveryPhysicsAndIntegrator) {
  for (const PhysicsSpec& physics : every_physics())
    for (auto integrator : integrators) {
      Scene scene = loaded_bar(2);
      scene.physics = physics;
      scene.time.integrator = integrator;
      expect_to_go_on(scene, name(physics) + " " + std::string(word(integrator)));
    }
}

TEST(Restart, IsTheSameForEveryLaw) {
  for (auto formulation : {Formulation::pF, Formulation::pFJ, Formulation::pFHJ, Formulation::pFp})
    for (auto law : {Law::neo_hookean, Law::mooney_rivlin, Law::linear_elastic, Law::hencky_j2})
      for (auto integrator : integrators) {
        Scene scene = loaded_bar(2);
        scene.physics.formulation = formulation;
        scene.material.law = law;
        scene.material.xi = law == Law::mooney_rivlin ? 5e5 : 0;
        if (law == Law::hencky_j2) {
          scene.material.yield_stress = 1e5;
          scene.material.hardening_modulus = 1e6;
        }
        scene.time.integrator = integrator;
        if (broken_rule(scene)) continue;
        expect_to_go_on(scene,
                        name(scene.physics) + " " + std::string(word(law)) + " " + std::string(word(integrator)));
      }
}

TEST(Restart, IsTheSameForSeveralMaterialsAndMonitors) {
  Scene scene = loaded_bar(3);
  scene.mesh.regions = {Axis::z, {1}, {"below", "above"}};
  MaterialSpec below = scene.material, above = scene.material;
  below.regions = {{"below", "test"}};
  above.regions = {{"above", "test"}};
  above.law = Law::hencky_j2;
  above.youngs_modulus *= 5;
  above.yield_stress = 1e5;
  scene.materials = {below, above};
  scene.material = below;
  scene.monitor.energy = scene.monitor.entropy = scene.monitor.involutions = true;
  scene.monitor.geometry = GeometryWatch::warn;
  scene.output.every = 1e-4;
  ASSERT_EQ(broken_rule(scene), nullptr);
  expect_to_go_on(scene, "several materials");
}

/// In another order of memory the lagged correction is found anew, and the stress from the state.
TEST(Restart, InAnotherOrderGoesOnWithinTheSchemesError) {
  for (auto correction : corrections) {
    Scene scene = loaded_bar(3);
    scene.physics.flux_correction = correction;
    const Problem problem(scene);
    const Folder folder;
    CheckpointWriter writer(folder.path(), "", provenance());
    Simulation s = problem.start(), other = problem.start();
    march(s, 5);
    writer.write(s, {});
    ASSERT_TRUE(restore(read_checkpoint(folder.path() / "checkpoint.h5"), other));
    go_on_in_another_order(other);
    EXPECT_EQ(state_hash(other), state_hash(s));
    EXPECT_NEAR(allowed_step(other), allowed_step(s), 1e-12 * allowed_step(s));
    march(s, 5);
    march(other, 5);
    const Energies a = energies(s), b = energies(other);
    EXPECT_NEAR(a.kinetic, b.kinetic, 1e-3 * a.kinetic) << word(correction);
    EXPECT_NEAR(a.strain, b.strain, 1e-3 * a.strain) << word(correction);
  }
}

TEST(Restart, ACheckpointOfAnotherSceneIsRefused) {
  Scene scene = loaded_bar(2);
  const Problem problem(scene);
  const Folder folder;
  CheckpointWriter writer(folder.path(), "", provenance());
  Simulation s = problem.start();
  writer.write(s, {});
  scene.physics.formulation = Formulation::pFHJ;
  Simulation other = Problem(scene).start();
  EXPECT_THROW(restore(read_checkpoint(folder.path() / "checkpoint.h5"), other), CheckpointError);
}

}  // namespace
}  // namespace nanson::method
