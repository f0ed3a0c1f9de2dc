// The tables of keys against the readers: what is told is read, what is read is told, and the shapes in errors are right.
#include <algorithm>
#include <set>

#include "engine/physics_rules.hpp"
#include "engine/summary.hpp"
#include "io/keys.hpp"
#include "io/new_scene.hpp"
#include "io/scene/key_pages.hpp"
#include "io/scene/scene_keys.hpp"
#include "io/study/read_study.hpp"
#include "io/study/study_keys.hpp"
#include "tests/unit/scene_text.hpp"

namespace nanson {
namespace {

/// Paths that are not in `asked`; several keys of one path are told apart by their kind.
std::vector<std::string> unread(std::span<const Key> keys, const std::set<const Key*>& asked) {
  std::vector<std::string> out;
  for (const Key& k : keys)
    if (!asked.contains(&k)) out.push_back(fmt::format("{} {}", k.path, k.rules.of));
  return out;
}

TEST(Keys, EveryKeyOfTheTableIsReadByAScene) {
  std::set<const Key*> asked;
  const auto read = [&](const std::vector<std::string>& settings) {
    asked.merge(read_text(column_scene, settings).asked);  // errors do not matter here
  };
  read({});
  read({"mesh={ cylinder = {}, cells = [2, 2, 2] }"});
  read({"mesh={ needle = {}, cells = [2, 2, 2] }"});
  read({"mesh.regions={ axis = \"x\", at = [0.0], names = [\"a\", \"b\"] }"});
  read({"material=[{ region = \"box\", law = \"mooney_rivlin\" }]"});
  read({"material={ law = \"hencky_j2\", hardening = [[0, 1], [1, 2]] }"});
  read({"projection={ solver = \"pseudo_time\" }"});
  for (const std::string_view field : words(InitialField{}))
    read({fmt::format("initial={{ field = \"{}\", centre = [0, 0, 0] }}", field)});
  for (const std::string_view kind : words(BoundaryKind{})) read({fmt::format("boundary=[{{ kind = \"{}\" }}]", kind)});
  for (const std::string_view kind : words(TimeKind{}))
    read({fmt::format("boundary.1.time={{ kind = \"{}\" }}", kind)});
  EXPECT_EQ(unread(scene_keys, asked), std::vector<std::string>{});
}

TEST(Keys, EveryKeyOfTheTableIsReadByAStudy) {
  static const TempFolder folder;
  std::set<const Key*> asked;
  for (const std::string_view kind : words(StudyKind{})) {
    const std::string text = fmt::format(R"(study = "s"
kind = "{}"
scene = "s.toml"
vary = {{ "time.cfl" = {{ from = 0.1, to = 0.2, count = 2 }} }}
[[case]]
name = "a"
[report]
x = "time.cfl"
y = ["nodes"]
panels = "case"
rate_over = "time.cfl"
reference = [{{ label = "l", nodes = 1 }}]
)",
                                         kind);
    asked.merge(read_study(folder.write("study.toml", text)).asked);
  }
  EXPECT_EQ(unread(study_keys, asked), std::vector<std::string>{});
}

TEST(Keys, ShapesOfSectionsNameKeysThatExist) {
  const auto check = [](std::span<const Key> keys, const Key& section, const toml::table& shape) {
    for (auto&& [name, value] : shape) {
      const std::string path = fmt::format("{}.{}", section.path, name.str());
      const bool known = std::any_of(keys.begin(), keys.end(), [&](const Key& k) { return k.path == path; });
      EXPECT_TRUE(known) << section.path << ": " << name.str();
    }
  };
  for (const std::span<const Key> keys : {std::span<const Key>(scene_keys), std::span<const Key>(study_keys)})
    for (const Key& k : keys) {
      if (!is_section(k)) continue;
      const toml::table shape = toml::parse(fmt::format("x = {}", k.rules.example));
      const toml::node& value = *shape.get("x");
      if (k.value.type == KeyType::table || k.value.type == KeyType::table_or_tables) check(keys, k, *value.as_table());
      else if (k.value.type == KeyType::tables) check(keys, k, *value.as_array()->get(0)->as_table());
    }
}

TEST(Keys, AScalarWhereATableIsNeededIsAnsweredWithTheShape) {
  const SceneResult r = read_text(small_scene, {"body_force=[0.0, 0.0, -9.81]"});
  EXPECT_EQ(r.errors, (std::vector<std::string>{"--set #1: body_force = [0.0, 0.0, -9.81]: must be a table, written "
                                                "body_force = { g = [0.0, 0.0, -9.81] }"}))
      << joined(r.errors);
}

TEST(Keys, ASectionThatDoesNotExistIsAnsweredWithTheShapeOfTheOneThatWasMeant) {
  const SceneResult r = read_text(small_scene + "[bodyforce]\ng = [0, 0, 1]\n");
  ASSERT_EQ(r.errors.size(), 1u) << joined(r.errors);
  EXPECT_NE(r.errors[0].find("did you mean \"body_force\"?"), std::string::npos) << r.errors[0];
  EXPECT_TRUE(r.errors[0].ends_with("; written body_force = { g = [0.0, 0.0, -9.81] }")) << r.errors[0];
}

TEST(Keys, AMissingSectionIsAnsweredWithItsShape) {
  const SceneResult r = read_text("scene = \"s\"\n");
  EXPECT_EQ(r.errors.size(), 3u) << joined(r.errors);
  EXPECT_NE(joined(r.errors).find("time: is missing, written time = { end = 0.01 }"), std::string::npos)
      << joined(r.errors);
}

TEST(Keys, AreToldWithTypeRangeUnitAndDefault) {
  EXPECT_EQ(value_text(key("material.poissons_ratio")), "number above -1 and at most 0.5 [-], required");
  EXPECT_EQ(value_text(key("mesh.split")), "alternating | kuhn, default \"alternating\"");
  EXPECT_EQ(value_text(key("time.cfl")), "number above 0 and at most 2 [-], default 0.3");
  EXPECT_EQ(value_text(key("time.dt_max")), "number above 0 [s]") << "0 stands for no limit, which is not in the range";
  EXPECT_EQ(value_text(key("mesh.cells", "box")), "three whole numbers at least 1 [-], default [1, 1, 1]");
  EXPECT_EQ(value_text(key("initial.centre")), "three numbers or \"mass\" [m], default \"mass\"");
  EXPECT_EQ(value_text(key("output.compress")), "whole number at least 0 and at most 9 [-], default 0");
}

TEST(Keys, AreFoundByPathSectionAndLastName) {
  EXPECT_NE(keys_text(scene_keys, "material.poissons_ratio").find("material.poissons_ratio: number"),
            std::string::npos);
  EXPECT_EQ(keys_text(scene_keys, "poissons_ratio"), keys_text(scene_keys, "material.poissons_ratio"));
  const std::string boundary = keys_text(scene_keys, "boundary");
  for (const char* text :
       {"[[boundary]]", "  kind: fixed | free", "[boundary.time]", "  t (traction): three numbers [Pa]"})
    EXPECT_NE(boundary.find(text), std::string::npos) << text << boundary;
  EXPECT_EQ(boundary.find("density"), std::string::npos);
  EXPECT_EQ(keys_text(scene_keys, "nothing"), "");
  const std::string all = keys_text(scene_keys, "");
  for (const Key& k : scene_keys) EXPECT_NE(all.find(k.name()), std::string::npos) << k.path;
  EXPECT_NE(reference_markdown().find("| `poissons_ratio` | number above -1 and at most 0.5 [-] | required |"),
            std::string::npos);
}

TEST(Keys, ThatARuleOfPhysicsNamesAreInTheTable) {
  const auto known = [](std::string_view path) {
    return std::ranges::any_of(scene_keys, [&](const Key& k) { return k.path == path; });
  };
  for (const PhysicsRule& rule : physics_rules()) {
    EXPECT_TRUE(known(rule.key)) << rule.key;
    EXPECT_TRUE(rule.beside.empty() || known(rule.beside)) << rule.beside;
    EXPECT_NE(reference_markdown().find(rule.why.substr(0, rule.why.find('|'))), std::string::npos) << rule.why;
  }
}

TEST(Keys, DefaultsInSentencesAreThoseOfTheReader) {
  EXPECT_NE(key("time.cfl").sentence.find("0.6 where the integrator is ssp_rk3"), std::string_view::npos);
  EXPECT_EQ(read_text(small_scene, {"time.integrator=ssp_rk3"}).scene.time.cfl, 0.6);
}

TEST(NewScene, IsAValidScene) {
  const SceneResult r = read_text(new_scene_text("beam"));
  EXPECT_TRUE(r.errors.empty()) << joined(r.errors);
  EXPECT_EQ(r.scene.name, "beam");
}

TEST(Fields, HaveNamesUnitsAndSentencesOfTheirOwn) {
  std::set<std::string_view> names;
  for (const Field& f : output_fields()) {
    EXPECT_TRUE(names.insert(f.name).second) << f.name;
    EXPECT_FALSE(f.unit.empty() || f.sentence.empty()) << f.name;
    EXPECT_EQ(find_field(f.name), &f);
  }
  EXPECT_EQ(find_field("stress"), nullptr);
  EXPECT_THROW(field_named("stress"), std::invalid_argument);
  EXPECT_EQ(component_ending(field_named("P"), 5), "_23");
}

TEST(SummaryEntries, HaveNamesAndSentencesOfTheirOwn) {
  std::set<std::string_view> names;
  for (const SummaryEntry& e : summary_entries()) {
    EXPECT_TRUE(names.insert(e.name).second) << e.name;
    EXPECT_FALSE(e.sentence.empty()) << e.name;
    const SummaryValue v = e.value(Summary{});
    const bool number = std::holds_alternative<double>(v) || std::holds_alternative<long>(v);
    const bool absent = std::holds_alternative<std::monostate>(v);
    EXPECT_TRUE(absent || number == !e.unit.empty()) << e.name;
  }
}

}  // namespace
}  // namespace nanson
