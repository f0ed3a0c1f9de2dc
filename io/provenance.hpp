// Where a program and its results come from: what the build knew (a header written by cmake/provenance.cmake) and where it runs.
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace nanson {

struct Provenance {
  std::string version;   // of the program
  std::string commit;    // git, short; + when files were changed; "unknown" without git
  std::string compiler;  // name and version
  std::string flags;
  std::string cpu;  // what the compiler was told, and what "native" meant
  std::string host;
  std::string start;  // UTC, ISO 8601: when this was asked for
};

Provenance provenance();

/// The attributes of a results file: all of the above, the number of threads and the scene verbatim.
std::vector<std::pair<std::string, std::string>> results_attributes(const Provenance& from, int threads,
                                                                    const std::string& scene_text);

}  // namespace nanson
