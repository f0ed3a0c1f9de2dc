// A table of keys as a JSON Schema (draft 2020-12), with which editors complete, explain and check TOML files.
#pragma once
#include <span>
#include <string>

#include "io/scene/key.hpp"

namespace nanson {

/// `settings` are the keys that the tables of type KeyType::settings may set.
std::string json_schema(std::span<const Key> keys, std::string_view title, std::span<const Key> settings = {});

}  // namespace nanson
