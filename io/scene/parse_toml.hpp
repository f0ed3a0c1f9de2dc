// toml++ behind a guard: what its parser cannot stand (a crash or a failed assertion, not an error) is refused before it sees it.
#pragma once
#include <string_view>

#include <toml++/toml.h>

namespace nanson {

/// As toml::parse; also throws toml::parse_error for keys of more than 64 parts, over which the parser recurses until the stack ends, and for characters
/// outside of strings and comments that no TOML has there.
toml::table parse_toml(std::string_view text, std::string_view source = {});

}  // namespace nanson
