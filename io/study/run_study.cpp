// Each run is this program as a child: times are those of a run alone, and a run that dies is a result.
#include "io/study/run_study.hpp"

#include <fmt/format.h>
#include <omp.h>
#include <toml++/toml.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "io/child_process.hpp"
#include "io/print.hpp"
#include "io/progress.hpp"
#include "io/replace_file.hpp"
#include "io/results/checkpoint.hpp"
#include "io/results/read_summary.hpp"
#include "io/results/results_folder.hpp"
#include "io/signals.hpp"
#include "io/study/read_study.hpp"
#include "io/study/write_study.hpp"
#include "io/text_file.hpp"

namespace nanson {
namespace {

namespace fs = std::filesystem;

constexpr const char* record_name = "run.toml";  // written last: a folder with it holds a finished run

/// What a finished run must have been made by to stand: a build from changed files is known by its content only.
std::string program_identity(const Provenance& from) {
  const bool clean = from.commit != "unknown" && !from.commit.ends_with('+');
  std::string why;
  return fmt::format("{} {}{}", from.version, from.commit,
                     clean ? "" : fmt::format(" {}", text_hash(read_text_file(own_program, why).value_or(""))));
}

std::string machine_name() {
  std::ifstream in("/proc/cpuinfo");
  std::string line, model = "processor unknown";
  while (std::getline(in, line))
    if (line.starts_with("model name") && line.find(": ") != std::string::npos) {
      model = line.substr(line.find(": ") + 2);
      break;
    }
  return fmt::format("{}, {} cores", model, omp_get_num_procs());
}

std::string end_of_log(const fs::path& file) {
  std::string why, text = read_text_file(file, why).value_or("");
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const std::size_t line = text.rfind('\n');
  return line == std::string::npos ? text : text.substr(line + 1);
}

RunOutcome outcome_in(const fs::path& folder, int code, bool too_slow, double wall_s) {
  RunOutcome o;
  o.exit_code = code;
  o.too_slow = too_slow;
  o.wall_s = wall_s;
  o.summary = read_summary(folder / "summary.json");
  o.history = read_history(folder / "history.csv");
  if (!o.summary) o.last_words = end_of_log(folder / "log.txt");
  return o;
}

void write_record(const fs::path& folder, const StudyRun& run, const ChildEnd& end, const std::string& program,
                  double max_wall_s) {
  const toml::table record{{"hash", run.hash},         {"program", program},       {"exit_code", end.code},
                           {"too_slow", end.too_slow}, {"max_wall_s", max_wall_s}, {"wall_s", end.wall_s}};
  std::ostringstream text;
  text << "# A finished run of a study: it is made again when this file goes, or the program changes.\n"
       << record << '\n';
  replace_file(folder / record_name, text.str());
}

/// The outcome of a finished run, if there is one that still stands: same scene, same program, and not one that was ended for a shorter time than it has now.
std::optional<RunOutcome> finished(const fs::path& folder, const StudyRun& run, const std::string& program,
                                   double max_wall_s) {
  std::string why;
  const auto text = read_text_file(folder / record_name, why);
  if (!text) return std::nullopt;
  try {
    const toml::table record = toml::parse(*text);
    const double wall_s = record["wall_s"].value_or(0.0), had_s = record["max_wall_s"].value_or(0.0);
    const bool ended_for_time = record["too_slow"].value_or(false);
    if (record["hash"].value_or("") != run.hash || record["program"].value_or("") != program) return std::nullopt;
    if (ended_for_time && (max_wall_s == 0 || max_wall_s > had_s)) return std::nullopt;
    RunOutcome o = outcome_in(folder, record["exit_code"].value_or(0),
                              ended_for_time || (max_wall_s > 0 && wall_s > max_wall_s), wall_s);
    if (!o.summary && !o.too_slow) return std::nullopt;
    return o;
  } catch (const toml::parse_error&) {
    return std::nullopt;
  }
}

/// Says so when table and page in the folder were made from another study file: they are made anew, its runs stay.
void keep_study_text(const fs::path& folder, const fs::path& file) {
  const fs::path kept = folder / "study.toml";
  std::string why;
  const std::string now = read_text_file(file, why).value_or("");
  const auto before = read_text_file(kept, why);
  if (before && *before != now)
    print(stderr, "the study file has changed since {} and report.html were made: both are made anew, runs stay\n",
          (folder / "runs.csv").string());
  replace_file(kept, now);
}

/// Seconds to go, when the runs so far took as long for their cost as the rest will.
std::string time_left(const StudyResults& all, std::size_t next) {
  double cost = 0, seconds = 0, left = 0;
  for (std::size_t i = 0; i < all.runs.size(); ++i) {
    if (i >= next) left += all.runs[i].cost;
    else {
      cost += all.runs[i].cost;
      seconds += all.results[i].outcome.wall_s;
    }
  }
  return cost > 0 ? duration_text(seconds / cost * left) : "--";
}

/// The table has the whole reason.
void print_result(const StudyRunResult& r) {
  const Judgement& j = r.judgement;
  const bool cut = j.reason.size() > 160;
  print(stderr, "{}{}{}{}{}", r.reused ? "made before, " : "", word(j.verdict), j.reason.empty() ? "" : ": ",
        j.reason.substr(0, 160), cut ? " ..." : "");
}

/// 0, or the signal that ended the study.
int make_runs(StudyResults& all, const std::string& program) {
  const double max_wall_s = all.study->report.max_wall_s;
  for (std::size_t i = 0; i < all.runs.size(); ++i) {
    const StudyRun& run = all.runs[i];
    const fs::path folder = all.folder / "runs" / run.hash;
    print(stderr, "[{}/{}] {}: ", i + 1, all.runs.size(), run.plan.label);
    if (auto before = finished(folder, run, program, max_wall_s)) {
      all.results[i] = assess(run, std::move(*before));
      all.results[i].reused = true;
    } else {
      fs::create_directories(folder);
      if (fs::exists(folder / "summary.json")) print(stderr, "made again: ");
      fs::remove(folder / record_name);
      fs::remove(folder / "summary.json");  // a child that dies early must not inherit them
      fs::remove(folder / "history.csv");
      std::vector<std::string> command{own_program};
      command.insert(command.end(), run.arguments.begin(), run.arguments.end());
      command.insert(command.end(), {"--quiet", "--force", "--out", folder.string()});
      const ChildEnd end = run_child(command, folder / "log.txt", {max_wall_s, 30}, stop_signal);
      if (end.stopped != 0 || stop_signal() != 0) {
        print(stderr, "stopped\n");
        return stop_signal();
      }
      all.results[i] = assess(run, outcome_in(folder, end.code, end.too_slow, end.wall_s));
      if (end.code == 0 || end.code == 3 || end.too_slow) {
        write_record(folder, run, end, program, max_wall_s);
        for (const char* name : checkpoint_names) fs::remove(folder / name);  // nobody goes on from them
      }
    }
    print_result(all.results[i]);
    print(stderr, "; {}, ETA {}\n", duration_text(all.results[i].outcome.wall_s), time_left(all, i + 1));
    find_rates(all);
    replace_file(all.folder / "runs.csv", study_csv(all));
    if (stop_signal() != 0) return stop_signal();
  }
  return 0;
}

}  // namespace

int run_study(const fs::path& file, const std::optional<fs::path>& out, std::vector<std::string>& errors) {
  StudyResult read = read_study(file);
  errors = read.errors;
  if (!errors.empty()) return 2;
  StudyResults all;
  all.study = &read.study;
  all.runs = prepare(read.study, errors);
  if (!errors.empty()) return 2;
  all.results.resize(all.runs.size());
  const ResultsFolder folder(read.study.name, out);  // held: a second study into it is refused
  all.folder = folder.path();
  all.from = provenance();
  all.machine = machine_name();
  all.command = fmt::format("nanson study {}{}", shell_quoted(file.string()),
                            out ? fmt::format(" --out {}", shell_quoted(out->string())) : "");
  // Of the children, as in the launcher: their threads spin for a short time, then sleep.
  if (std::getenv("OMP_WAIT_POLICY") == nullptr) ::setenv("GOMP_SPINCOUNT", "1000", 0);
  ::setenv("OMP_WAIT_POLICY", "passive", 0);
  print(stderr, "{}: {} runs, {} thread{} each, results: {}\n", read.study.name, all.runs.size(), read.study.threads,
        read.study.threads == 1 ? "" : "s", all.folder.string());
  keep_study_text(all.folder, file);
  catch_stop_signals();
  const int stopped = make_runs(all, program_identity(all.from));
  find_rates(all);
  for (const std::string& line : write_study(all)) print(stderr, "{}\n", line);
  if (stopped != 0)
    print(stderr, "{} of {} runs done; the same command goes on from there\n", all.done(), all.runs.size());
  return stopped != 0 ? 128 + stopped : 0;
}

}  // namespace nanson
