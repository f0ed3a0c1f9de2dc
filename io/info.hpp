// `nanson info`: what a checkpoint holds, and whether it is whole.
#pragma once
#include <filesystem>

namespace nanson {

/// Of a file, or of every checkpoint in a folder, on the standard output. Exit code: 0 when one of them is valid, otherwise 2.
int print_info(const std::filesystem::path& where);

}  // namespace nanson
