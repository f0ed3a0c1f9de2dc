// Names that only the mesh can confirm, and the words of messages.
#include "io/scene/words.hpp"
#include "tests/unit/scene_text.hpp"

namespace nanson {
namespace {

Mesh box_mesh() {
  Mesh m;
  m.X = {{0.1, 0, 3}, {-0.5, 0.5, 0}, {0.5, -0.5, 6}, {0, 0, 3}};
  m.patch_names = {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};
  return m;
}

TEST(CheckNames, KnownNamesPass) {
  const SceneResult r = read_text(column_scene);
  EXPECT_TRUE(check_names(r.scene, box_mesh()).empty());
}

TEST(CheckNames, UnknownFaceListsTheKnownOnes) {
  SceneResult r = read_text(edited(column_scene, "[\"zmax\", \"xmax\"]", "[\"zmax\", \"xmx\"]"),
                            {"boundary.0.face=floor"});
  ASSERT_TRUE(r.errors.empty()) << joined(r.errors);
  const std::vector<std::string> errors = check_names(r.scene, box_mesh());
  ASSERT_EQ(errors.size(), 2u) << joined(errors);
  EXPECT_EQ(errors[0],
            "--set #1: boundary.0.face = \"floor\": unknown face, allowed: xmin | xmax | ymin | ymax | zmin | zmax");
  EXPECT_TRUE(
      errors[1].ends_with("scene.toml:35:17: boundary.1.face = \"xmx\": unknown face, did you mean \"xmax\"? allowed: "
                          "xmin | xmax | ymin | ymax | zmin | zmax"))
      << errors[1];
}

TEST(CheckNames, MeshWithoutNamedFacesSaysSo) {
  const SceneResult r = read_text(column_scene);
  Mesh bare = box_mesh();
  bare.patch_names.clear();
  const std::vector<std::string> errors = check_names(r.scene, bare);
  ASSERT_EQ(errors.size(), 3u);
  EXPECT_TRUE(errors[0].ends_with("boundary.0.face = \"zmin\": unknown face, allowed: none")) << errors[0];
}

TEST(CheckNames, ProbeOutsideTheMeshIsToldItsBox) {
  const auto probe = [](const std::string& at) {
    return check_names(read_text(edited(column_scene, "[0.5, 0.5, 6.0]", at)).scene, box_mesh());
  };
  ASSERT_EQ(probe("[0.5, 0.5, 6.1]").size(), 1u);
  EXPECT_TRUE(
      probe("[0.5, 0.5, 6.1]")[0].ends_with("scene.toml:58:32: output.probes.tip.at = [0.5, 0.5, 6.1]: lies outside "
                                            "the mesh, which spans [-0.5, -0.5, 0] to [0.5, 0.5, 6]"))
      << probe("[0.5, 0.5, 6.1]")[0];
  EXPECT_EQ(probe("[-0.6, 0.5, 6]").size(), 1u);
  EXPECT_EQ(probe("[0.5, 0.5000000001, 6.0]").size(), 0u);
}

TEST(Words, JoinedForReading) {
  EXPECT_EQ(join_words(words(Formulation{})), "pF | pFJ | pFHJ | pFp");
  EXPECT_EQ(join_words(std::vector<std::string>{"a", "b"}, ", "), "a, b");
  EXPECT_EQ(join_words(std::vector<std::string>{}), "");
}

TEST(Words, DistanceCountsInsertionsDeletionsReplacementsAndSwaps) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("abc", ""), 3u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("density", "denisty"), 1u);
  EXPECT_EQ(edit_distance("density", "densty"), 1u);
  EXPECT_EQ(edit_distance("density", "densityy"), 1u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("ab", "cd"), 2u);
  EXPECT_EQ(edit_distance("ab", "ca"), 2u);
  EXPECT_EQ(edit_distance("ab", "bc"), 2u);
}

TEST(Words, SuggestionDiffersByAThirdOfTheLettersAtMost) {
  const std::vector<std::string> known = {"time", "x", "youngs_modulus"};
  EXPECT_EQ(nearest_word("tme", known), "time");
  EXPECT_EQ(nearest_word("title", known), "");  // two of five letters
  EXPECT_EQ(nearest_word("young_modlus", known), "youngs_modulus");
  EXPECT_EQ(nearest_word("v", known), "");  // one of one
  EXPECT_EQ(nearest_word("", known), "");
}

}  // namespace
}  // namespace nanson
