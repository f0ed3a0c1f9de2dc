// What only the running program can say: the host and the time.
#include "io/provenance.hpp"

#include <unistd.h>

#include <array>
#include <ctime>

#include "nanson_build.hpp"

namespace nanson {
namespace {

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text.data();
}

}  // namespace

Provenance provenance() {
  return {build::version, build::commit, build::compiler, build::flags, build::cpu, host_name(), utc_now()};
}

std::vector<std::pair<std::string, std::string>> results_attributes(const Provenance& from, int threads,
                                                                    const std::string& scene_text) {
  return {
      {"generator", "nanson"}, {"version", from.version}, {"commit", from.commit}, {"compiler", from.compiler},
      {"flags", from.flags},   {"cpu", from.cpu},         {"host", from.host},     {"threads", std::to_string(threads)},
      {"start", from.start},   {"scene", scene_text}};
}

}  // namespace nanson
