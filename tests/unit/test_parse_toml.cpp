// What the parser must not see, and that everything else still reaches it.
#include "io/scene/parse_toml.hpp"

#include <gtest/gtest.h>

#include <string>

namespace nanson {
namespace {

std::string refusal(const std::string& text) {
  try {
    parse_toml(text);
  } catch (const toml::parse_error& e) {
    std::string text = std::to_string(e.source().begin.line);
    return text.append(":").append(std::to_string(e.source().begin.column)).append(" ").append(e.description());
  }
  return "";
}

std::string dotted(int parts, const std::string& part) {
  std::string key = part;
  for (int i = 1; i < parts; ++i) key.append(".").append(part);
  return key;
}

TEST(ParseToml, DeepKeysAreRefusedBeforeTheyOverflowTheStack) {
  for (const std::string& part : {std::string("a"), std::string("\"x\""), std::string("'.' ")}) {
    EXPECT_EQ(refusal(dotted(64, part) + " = 1"), "") << part;
    for (const int parts : {65, 1000, 40000}) {
      EXPECT_NE(refusal(dotted(parts, part) + " = 1").find("a key of more than 64 parts"), std::string::npos);
      EXPECT_NE(refusal("[" + dotted(parts, part) + "]").find("a key of more than 64 parts"), std::string::npos);
      EXPECT_NE(refusal("x = { " + dotted(parts, part) + " = 1 }").find("a key of more than 64 parts"),
                std::string::npos);
    }
  }
}

TEST(ParseToml, DotsElsewhereDoNotCount) {
  const std::string dots(100, '.');
  std::string numbers = "n = [0.5";
  for (int i = 0; i < 200; ++i) numbers += ", 0.5";
  for (const std::string& text :
       {"a = \"" + dots + "\"", "a = '" + dots + "'", "# " + dots, "a = \"\"\"\n" + dots + "\n\"\"\"",
        "a = '''\n\"" + dots + "'''", "a = \"\\\"" + dots + "\"", numbers + "]", std::string("\xef\xbb\xbf") + "a = 1"})
    EXPECT_EQ(refusal(text), "") << text;
}

TEST(ParseToml, CharactersThatTheParserCannotStandAreRefusedWithTheirPlace) {
  const std::string why = "only printable ASCII may stand outside of strings and comments";
  EXPECT_EQ(refusal(std::string("a = 1\n[\0", 8)), "2:2 " + why);
  for (int point = 0xa1; point < 0x49a; ++point) {  // U+00A1 to U+0499 end in undefined behaviour of toml++ 3.3
    const std::string character{static_cast<char>(0xc0 | point >> 6), static_cast<char>(0x80 | (point & 0x3f))};
    EXPECT_EQ(refusal("a = 1\n b" + character + " = 2"), "2:3 " + why);
    EXPECT_EQ(refusal("a = \"" + character + "\" # " + character), "");
  }
}

}  // namespace
}  // namespace nanson
