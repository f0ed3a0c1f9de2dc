// The strict table on its own: what a read answers and leaves in the value, and what it remembers about keys.
#include "io/scene/config_table.hpp"

#include <gtest/gtest.h>

#include "engine/scene.hpp"

namespace nanson {
namespace {

const std::string sample = R"(number = 2.5
whole = 7
far = -3000000000
wide = 3000000000
three = [1, 2, inf]
cells = [1, 2.5, 3]
names = ["a", 3]
flag = 1
word = "kuhm"
)";

/// A key of the sample; what it holds does not matter to the reader.
constexpr Key a_key(std::string_view path, KeyRules rules = {}) { return {path, {KeyType::number}, "-", "x", rules}; }

struct Reading {
  toml::table entries = toml::parse(sample);
  Diagnostics d{"f.toml", {}, {}, {}};
  Table t{entries, "s", d};
};

TEST(ConfigTable, WrongValueIsToldAndLeavesTheDefaultAlone) {
  Reading r;
  double number = 1;
  long wide = 1;
  int whole = 1;
  bool flag = true;
  Vec3 three{4, 5, 6};
  std::array<int, 3> cells{4, 5, 6};
  std::string text = "default";
  std::vector<Word> names{{"default", {}, {}}};
  Split split = Split::alternating;
  EXPECT_FALSE(r.t.read(a_key("s.number", {.range = {.below = 2}}), number));
  EXPECT_FALSE(r.t.read(a_key("s.wide", {.range = {.to = 8}}), wide));
  EXPECT_FALSE(r.t.read(a_key("s.wide"), whole));
  EXPECT_FALSE(r.t.read(a_key("s.far"), whole));
  EXPECT_FALSE(r.t.read(a_key("s.flag"), flag));
  EXPECT_FALSE(r.t.read(a_key("s.three"), three));
  EXPECT_FALSE(r.t.read(a_key("s.cells"), cells));
  EXPECT_FALSE(r.t.read(a_key("s.number"), text));
  EXPECT_FALSE(r.t.read(a_key("s.names"), names));
  EXPECT_FALSE(r.t.read(a_key("s.word"), split));
  EXPECT_EQ(number, 1);
  EXPECT_EQ(wide, 1);
  EXPECT_EQ(whole, 1);
  EXPECT_EQ(flag, true);
  EXPECT_EQ(three, (Vec3{4, 5, 6}));
  EXPECT_EQ(cells, (std::array<int, 3>{4, 5, 6}));
  EXPECT_EQ(text, "default");
  EXPECT_EQ(names.size(), 1u);
  EXPECT_EQ(split, Split::alternating);
  EXPECT_EQ(r.d.found.size(), 10u);
}

TEST(ConfigTable, GoodValueIsRead) {
  Reading r;
  double number = 1;
  int whole = 1;
  EXPECT_TRUE(r.t.read(a_key("s.number", {.range = {.above = 2, .below = 3}}), number));
  EXPECT_TRUE(r.t.read(a_key("s.whole", {.range = {.from = 7, .to = 7}}), whole));
  EXPECT_EQ(number, 2.5);
  EXPECT_EQ(whole, 7);
  EXPECT_TRUE(r.d.found.empty());
}

TEST(ConfigTable, AbsentKeyIsFineUnlessRequired) {
  Reading r;
  double number = 1;
  EXPECT_TRUE(r.t.read(a_key("s.absent"), number));
  EXPECT_TRUE(r.t.sound("absent"));
  EXPECT_FALSE(r.t.read(a_key("s.absent", {.required = true}), number));
  EXPECT_FALSE(r.t.sound("absent"));
  EXPECT_EQ(number, 1);
}

TEST(ConfigTable, WrongPartMakesTheWholeUnsound) {
  Reading r;
  Vec3 three{};
  std::vector<Word> names;
  r.t.read(a_key("s.three"), three);
  r.t.read(a_key("s.names"), names);
  EXPECT_FALSE(r.t.sound("three"));
  EXPECT_FALSE(r.t.sound("names"));
  EXPECT_TRUE(r.t.sound("number"));
}

TEST(ConfigTable, FailureOfAnAbsentKeyIsAtItsTable) {
  Reading r;
  r.t.fail("absent", "is needed here");
  EXPECT_EQ(listed(r.d), (std::vector<std::string>{"f.toml:1:1: s.absent: is needed here"}));
  EXPECT_FALSE(r.t.sound("absent"));
}

TEST(ConfigTable, KeysThatWereNotAskedForAreReportedAtTheEnd) {
  Reading r;
  double number = 0;
  r.t.read(a_key("s.number"), number);
  r.t.pass(std::array<std::string_view, 6>{"whole", "far", "wide", "three", "cells", "names"});
  r.t.only("kind", {}, std::array<std::string_view, 1>{"word"});
  r.t.finish();
  EXPECT_EQ(listed(r.d), (std::vector<std::string>{"f.toml:8:1: s.flag = 1: unknown key, allowed: number",
                                                   "f.toml:9:8: s.word = \"kuhm\": is not a key of kind"}));
}

}  // namespace
}  // namespace nanson
