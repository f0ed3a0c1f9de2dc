// Checkpoint files: what is no longer what was written is refused with the reason, before anything in it is believed.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "engine/mesh/mesh.hpp"
#include "engine/start.hpp"
#include "io/results/checkpoint.hpp"
#include "io/scene/scene_changes.hpp"

namespace nanson {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
void put(const fs::path& file, const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; }

/// A folder with the checkpoints of steps 1 and 2 of a small body.
class CheckpointFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("checkpoint_" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    scene_.name = "tiny";
    scene_.text = "scene = \"tiny\"\n";
    scene_.mesh.size = {1, 1, 1};
    scene_.material.density = 1000;
    scene_.material.youngs_modulus = 1e7;
    scene_.material.poissons_ratio = 0.3;
    scene_.time.end = 0.5;
    std::vector<std::string> errors;
    mesh_ = finish_mesh(make_box(scene_.mesh), errors);
    Simulation s = make_simulation(scene_, mesh_, 1);
    CheckpointWriter writer(folder_, "time.end = 0.5\n", provenance());
    for (s.state.step = 1; s.state.step < 3; ++s.state.step) writer.write(s, {100, 2, 3000});
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string refusal(const fs::path& file) {
    try {
      read_checkpoint(file);
    } catch (const CheckpointError& e) {
      const std::string text = e.what();
      return text.substr(text.rfind(file.string()) + file.string().size() + 2);
    }
    return "none";
  }

  fs::path folder_;
  Scene scene_;
  Mesh mesh_;
};

TEST_F(CheckpointFile, KeepsWhatItWasGiven) {
  const Checkpoint c = read_checkpoint(folder_ / "checkpoint.h5"),
                   before = read_checkpoint(folder_ / "checkpoint.old.h5");
  EXPECT_EQ(c.step, 2);
  EXPECT_EQ(before.step, 1);
  EXPECT_EQ(c.scene, "tiny");
  EXPECT_EQ(c.text, scene_.text);
  EXPECT_EQ(c.resolved, "time.end = 0.5\n");
  EXPECT_EQ(c.end, 0.5);
  EXPECT_EQ(c.mesh, mesh_hash(mesh_));
  EXPECT_EQ(c.nodes, 8);
  EXPECT_EQ(c.results.history_bytes, 100);
  EXPECT_EQ(c.results.frames, 2);
  EXPECT_EQ(c.results.fields_bytes, 3000);
  EXPECT_EQ(std::size_t(c.bytes), fs::file_size(c.path));
  EXPECT_FALSE(fs::exists(folder_ / "checkpoint.h5.tmp"));
}

TEST_F(CheckpointFile, CutShortAnywhereIsRefused) {
  const fs::path cut = folder_ / "cut";
  const std::string whole = content(folder_ / "checkpoint.h5");
  for (std::size_t size = 0; size < whole.size(); size += size < 600 ? 37 : 997) {
    put(cut, whole.substr(0, size));
    EXPECT_NE(refusal(cut), "none") << size;
  }
  put(cut, whole.substr(0, whole.size() - 1));
  EXPECT_EQ(refusal(cut), fmt::format("is damaged: it has {} of {} bytes", whole.size() - 1, whole.size()));
  put(cut, whole + "x");
  EXPECT_EQ(refusal(cut), fmt::format("is damaged: it has {} of {} bytes", whole.size() + 1, whole.size()));
}

TEST_F(CheckpointFile, WithAnyByteChangedIsRefused) {
  const fs::path damaged = folder_ / "damaged";
  const std::string whole = content(folder_ / "checkpoint.h5");
  for (std::size_t at = 0; at < whole.size(); at += at < 512 ? 5 : 211) {
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ 1);
    put(damaged, bytes);
    EXPECT_NE(refusal(damaged), "none") << at;
  }
}

TEST_F(CheckpointFile, ForeignFilesAreRefused) {
  const fs::path foreign = folder_ / "foreign";
  put(foreign, "");
  EXPECT_EQ(refusal(foreign), "is no checkpoint of nanson");
  put(foreign, "\x89HDF\r\n\x1a\n and more");
  EXPECT_EQ(refusal(foreign), "is no checkpoint of nanson");
  put(foreign, "nanson checkpoint 7\nbytes 20\n");
  EXPECT_EQ(refusal(foreign), "is of format 7, this program reads format 1");
  put(foreign, "nanson checkpoint 1\n");
  EXPECT_EQ(refusal(foreign), "is damaged: its first lines make no sense");
  EXPECT_EQ(refusal(folder_ / "nowhere"), "No such file or directory");
}

TEST_F(CheckpointFile, TheNewestValidOneIsTaken) {
  std::vector<std::string> complaints;
  EXPECT_EQ(newest_checkpoint(folder_, complaints).step, 2);
  EXPECT_TRUE(complaints.empty());
  put(folder_ / "checkpoint.h5.tmp", "half");  // of a run that was killed
  EXPECT_EQ(newest_checkpoint(folder_, complaints).step, 2);
  EXPECT_TRUE(complaints.empty());
  put(folder_ / "checkpoint.h5", content(folder_ / "checkpoint.h5") + "x");
  EXPECT_EQ(newest_checkpoint(folder_, complaints).step, 1);
  ASSERT_EQ(complaints.size(), 1u);
  EXPECT_NE(complaints[0].find("checkpoint.h5: is damaged"), std::string::npos) << complaints[0];
  fs::remove(folder_ / "checkpoint.h5");
  fs::remove(folder_ / "checkpoint.h5.tmp");
  EXPECT_EQ(newest_checkpoint(folder_, complaints).step, 1) << "killed between the two renames";
  fs::remove(folder_ / "checkpoint.old.h5");
  EXPECT_THROW(newest_checkpoint(folder_, complaints), CheckpointError);
  EXPECT_THROW(newest_checkpoint(folder_ / "nowhere", complaints), CheckpointError);
}

TEST(SceneChanges, NamesKeysWithBothValues) {
  const auto changes = scene_changes("a = 1\n[b]\nc = \"x\"\nd = [1, 2]\n[[e]]\nf = 1\n[[e]]\nf = 2\n",
                                     "a = 1\n[b]\nc = \"y\"\nd = [1, 2]\n[[e]]\nf = 1\n[g]\nh = true\n");
  std::vector<std::string> texts;
  for (const KeyChange& change : changes) texts.push_back(change_text(change));
  EXPECT_EQ(texts,
            (std::vector<std::string>{"b.c: \"x\" -> \"y\"", "e.1.f: 2 -> not written", "g.h: not written -> true"}));
}

TEST(SceneChanges, DefaultsAndTheSameNumberWrittenOtherwiseAreNone) {
  EXPECT_TRUE(
      scene_changes("[time]\nend = 1.0\n", "[time]\nend = 1\ncfl = 0.3\n[physics]\nformulation = \"pFJ\"\n").empty());
  EXPECT_TRUE(scene_changes("[mesh.box]\nsize = [1, 1.0, 2e0]\n", "[mesh.box]\nsize = [1, 1, 2]\n").empty());
  const auto changes = scene_changes("[time]\nend = 1\n", "[time]\nend = 1\ncfl = 0.2\n");
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(change_text(changes[0]), "time.cfl: 0.3 -> 0.2");
}

TEST(SceneChanges, OutputAndEndMayChangePhysicsMayNot) {
  for (const char* key : {"time.end", "time.cfl", "output.every", "output.probes.tip.at", "monitor.geometry"})
    EXPECT_TRUE(may_change_at_restart(key)) << key;
  for (const char* key : {"time.integrator", "material.density", "mesh.cells", "boundary.0.pressure", "monitor.energy"})
    EXPECT_FALSE(may_change_at_restart(key)) << key;
}

}  // namespace
}  // namespace nanson
