// Values from the command line, "a.b=VALUE", put into a scene's TOML before it is read, each remembering which setting it came from.
#pragma once
#include <string>
#include <vector>

#include "io/scene/diagnostics.hpp"

namespace nanson {

/// One --set: VALUE is TOML, or a bare word that stands for a string.
struct Setting {
  long number = 0;  // from 1, in the order of the command line
  std::string text;
  std::vector<std::string> path;  // {"a", "b"}
  toml::table holder;             // { value = VALUE }
};

/// The settings that can be understood; the others are reported.
std::vector<Setting> parse_settings(const std::vector<std::string>& texts, Diagnostics& d);

/// Replaces or adds the value, making tables on the way. List entries are found by number, or by a face they name.
void apply(toml::table& root, Setting setting, Diagnostics& d);

}  // namespace nanson
