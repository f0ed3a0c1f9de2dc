// What the build wrote down about itself.
#include <gtest/gtest.h>

#include <regex>

#include "io/provenance.hpp"

namespace nanson {
namespace {

TEST(Provenance, SaysWhatTheProgramIsMadeOf) {
  const auto from = provenance();
  EXPECT_TRUE(std::regex_match(from.version, std::regex("[0-9]+\\.[0-9]+\\.[0-9]+"))) << from.version;
  EXPECT_TRUE(std::regex_match(from.commit, std::regex("unknown|[0-9a-f]{7,40}\\+?"))) << from.commit;
  EXPECT_TRUE(std::regex_match(from.compiler, std::regex("(GNU|Clang) [0-9.]+"))) << from.compiler;
  EXPECT_NE(from.flags.find("-ffp-contract=off"), std::string::npos) << from.flags;
  EXPECT_FALSE(from.cpu.empty());
  EXPECT_FALSE(from.host.empty());
  EXPECT_TRUE(std::regex_match(from.start, std::regex("\\d{4}-\\d\\d-\\d\\dT\\d\\d:\\d\\d:\\d\\dZ"))) << from.start;
}

TEST(Provenance, IsWrittenToResultsWithTheScene) {
  const auto from = provenance();
  const std::vector<std::pair<std::string, std::string>> expected{
      {"generator", "nanson"}, {"version", from.version},   {"commit", from.commit}, {"compiler", from.compiler},
      {"flags", from.flags},   {"cpu", from.cpu},           {"host", from.host},     {"threads", "3"},
      {"start", from.start},   {"scene", "scene = \"x\"\n"}};
  EXPECT_EQ(results_attributes(from, 3, "scene = \"x\"\n"), expected);
}

}  // namespace
}  // namespace nanson
