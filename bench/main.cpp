// The benches: own flags, the table of ratios, and kept results.
//   nanson_bench [--cells=N] [--large] [--keep] [flags of Google Benchmark]
// --cells   cells a side of the cube, 48 unless said; the other scenes and the bandwidth's arrays follow
// --large   set-up of 8 times the cells too (912,673 nodes)
// --keep    writes bench/results/<cpu>-<date>.json below the current folder; later runs on such a CPU are compared with it
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>

#include "bench/bench.hpp"

namespace nanson {

BenchOptions& options() {
  static BenchOptions o;
  return o;
}

std::vector<StepRatio>& step_ratios() {
  static std::vector<StepRatio> all;
  return all;
}

double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double median(std::vector<double> x) {
  std::sort(x.begin(), x.end());
  const std::size_t n = x.size();
  return n == 0 ? 0 : 0.5 * (x[(n - 1) / 2] + x[n / 2]);
}

void set_columns(benchmark::State& state, double seconds, double nodes, const Work& work, int threads) {
  state.counters["ns"] = 1e9 * seconds / nodes;
  state.counters["GB/s"] = 1e-9 * work.bytes / seconds;
  state.counters["share"] = work.bytes / seconds / update_bandwidth(threads);
  state.counters["GF/s"] = 1e-9 * work.flops / seconds;
}

Mesh box_mesh(const MeshSpec& spec) {
  std::vector<std::string> errors;
  return finish_mesh(make_box(spec), errors);
}

namespace {

constexpr double worse = 1.15;  // a ratio that many times smaller than the kept one is reported

std::string cpu_model() {
  std::ifstream in("/proc/cpuinfo");
  std::string line;
  while (std::getline(in, line))
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown cpu";
}

std::string file_name_of(const std::string& cpu) {
  std::string out;
  for (char c : cpu) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c));
    if (plain) out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!out.empty() && out.back() != '-') out += '-';
  }
  return out;
}

const std::filesystem::path results = "bench/results";

std::string today() {
  char text[16] = {};
  const time_t now = time(nullptr);
  tm parts{};
  localtime_r(&now, &parts);
  strftime(text, sizeof text, "%Y-%m-%d", &parts);
  return text;
}

/// The newest kept result of this CPU.
std::optional<std::filesystem::path> kept_result() {
  const std::string prefix = file_name_of(cpu_model()) + "-2";  // the date follows
  std::optional<std::filesystem::path> newest;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(results, none)) {
    const std::string name = entry.path().filename();
    if (name.rfind(prefix, 0) == 0 && entry.path().extension() == ".json" && (!newest || name > newest->filename()))
      newest = entry.path();
  }
  return newest;
}

/// Ratio of a scene to the plain loop in a kept file, as Google Benchmark writes it.
std::optional<double> kept_ratio(const std::filesystem::path& file, const std::string& scene) {
  std::ifstream in(file);
  std::string line;
  bool inside = false;
  while (std::getline(in, line)) {
    if (line.find("\"name\": ") != std::string::npos)
      inside = line.find("\"step/" + scene + "/threads:1") != std::string::npos;
    const auto at = line.find("\"to_naive\": ");
    if (inside && at != std::string::npos) return std::stod(line.substr(at + std::strlen("\"to_naive\": ")));
  }
  return {};
}

/// ns per node-step = in-cache time/cores + DRAM bytes/bandwidth + barriers/nodes: checked on one and two threads, and told for a node with many cores.
void print_model() {
  constexpr int many = 64, sweeps = 4;                        // two sweeps a stage, two stages
  constexpr double many_bandwidth = 400e9, many_nodes = 1e6;  // [bytes/s], [-]
  fmt::print("\nmodel: in-cache time/cores + bytes/bandwidth + {} barriers (ns per node-step; measured beside it)\n",
             sweeps);
  fmt::print("{:8} {:>9} {:>7} {:>20} {:>20} {:>42}\n", "scene", "in cache", "bytes", "1 thr.", "2 thr.",
             "64 cores, 400 GB/s, 1M nodes");
  for (const StepRatio& r : step_ratios()) {
    const auto told = [&](double cores, double bandwidth, double nodes, double barrier) {
      return r.in_cache / cores + 1e9 * r.bytes / bandwidth + 1e9 * sweeps * barrier / nodes;
    };
    const double forecast = told(many, many_bandwidth, many_nodes, 5 * r.barrier);
    fmt::print("{:8} {:9.1f} {:7.0f} {:>20} {:>20} {:>42}\n", r.scene, r.in_cache, r.bytes,
               fmt::format("{:.0f} ({:.0f})", told(1, update_bandwidth(1), r.nodes, 0), r.one),
               fmt::format("{:.0f} ({:.0f})", told(2, update_bandwidth(2), r.nodes, r.barrier), r.two),
               fmt::format("{:.1f}, barriers {:.2f} of it (5 times the {:.1f} us here)", forecast,
                           5e9 * sweeps * r.barrier / many_nodes, 1e6 * r.barrier));
  }
}

void print_table(const std::optional<std::filesystem::path>& kept) {
  if (step_ratios().empty()) return;
  fmt::print("\n{:8} {:>8} {:>26} {:>24} {:>10} {:>12}\n", "", "", "ns a node-step", "plain to one thread", "two",
             "one to two");
  fmt::print("{:8} {:>8} {:>8} {:>8} {:>8} {:>24} {:>10} {:>12}\n", "scene", "nodes", "plain", "1 thr.", "2 thr.",
             "median (least to most)", "to plain", "threads");
  for (const StepRatio& r : step_ratios())
    fmt::print("{:8} {:8.0f} {:8.1f} {:8.1f} {:8.1f} {:>24} {:10.2f} {:12.2f}\n", r.scene, r.nodes, r.naive, r.one,
               r.two, fmt::format("{:.2f} ({:.2f} to {:.2f})", r.ratio, r.ratio_least, r.ratio_most), r.naive / r.two,
               r.speedup);
  const double one = update_bandwidth(1), two = update_bandwidth(2);
  fmt::print("update bandwidth: {:.1f} GB/s on one thread, {:.1f} on two{}\n", 1e-9 * one, 1e-9 * two,
             two < 1.5 * one ? ": less than 1.5 times, so one to two threads is not measurable in this run" : "");
  print_model();
  if (!kept || options().cells != full_cells) return;
  for (const StepRatio& r : step_ratios()) {
    const std::optional<double> before = kept_ratio(*kept, r.scene);
    if (before && r.ratio * worse < *before)
      fmt::print("{}: the ratio to the plain loop is {:.2f}, more than 15 % worse than the {:.2f} of {}\n", r.scene,
                 r.ratio, *before, kept->string());
  }
}

/// Takes our own flags out of the arguments.
std::vector<std::string> own_flags(int argc, char** argv) {
  std::vector<std::string> rest{argv[0], "--benchmark_counters_tabular=true", "--benchmark_min_time=0.15"};
  for (int i = 1; i < argc; ++i) {
    const std::string flag = argv[i];
    if (flag == "--keep") options().keep = true;
    else if (flag == "--large") options().large = true;
    else if (flag.rfind("--cells=", 0) == 0)
      options().cells = std::max(2, std::atoi(flag.c_str() + std::strlen("--cells=")));
    else rest.push_back(flag);
  }
  return rest;
}

}  // namespace
}  // namespace nanson

int main(int argc, char** argv) {
  using namespace nanson;
  std::vector<std::string> flags = own_flags(argc, argv);
  const auto kept = kept_result();
  if (options().keep) {
    std::filesystem::create_directories(results);
    flags.push_back("--benchmark_out=" + (results / (file_name_of(cpu_model()) + "-" + today() + ".json")).string());
    flags.push_back("--benchmark_out_format=json");
  }
  std::vector<char*> raw;
  for (std::string& f : flags) raw.push_back(f.data());
  int count = static_cast<int>(raw.size());
  benchmark::Initialize(&count, raw.data());
  if (benchmark::ReportUnrecognizedArguments(count, raw.data())) return 2;
  benchmark::AddCustomContext("cpu", cpu_model());
  benchmark::AddCustomContext("compiler", NANSON_COMPILER);
  benchmark::AddCustomContext("flags", NANSON_FLAGS);
  benchmark::AddCustomContext("cells", std::to_string(options().cells));
  register_bandwidth();
  register_sweeps();
  register_steps();
  register_variants();
  register_step_options();
  register_setup();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  print_table(kept);
}
