// The map of the program: command line, then load, then run or check; a study starts this program again for each of its runs.
#include <fmt/format.h>
#include <omp.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstring>

#include "engine/input_error.hpp"
#include "io/check.hpp"
#include "io/info.hpp"
#include "io/keys.hpp"
#include "io/new_scene.hpp"
#include "io/print.hpp"
#include "io/provenance.hpp"
#include "io/results/results_folder.hpp"
#include "io/run.hpp"
#include "io/scene/words.hpp"
#include "io/study/run_study.hpp"

namespace {

std::string version_text() {
  const nanson::Provenance p = nanson::provenance();
  return fmt::format("nanson {} ({})\n{}, {}\ncpu: {}", p.version, p.commit, p.compiler, p.flags, p.cpu);
}

int list_errors(const std::vector<std::string>& errors) {
  for (const std::string& e : errors) nanson::print(stderr, "{}\n", e);
  nanson::print(stderr, "{} error{}: nothing was run or written (nanson keys tells what may be)\n", errors.size(),
                errors.size() == 1 ? "" : "s");
  return 2;
}

/// The exit code of a verb whose result is its text.
int told(int code) {
  if (const int lost = nanson::lost_output(); lost != 0)
    throw std::runtime_error(fmt::format("the standard output could not be written: {}", std::strerror(lost)));
  return code;
}

/// False, and said, when the first word is no verb: CLI11 would only ask for a subcommand.
bool is_known_verb(const CLI::App& app, std::string_view word) {
  std::vector<std::string> verbs;
  for (const CLI::App* verb : app.get_subcommands({})) verbs.push_back(verb->get_name());
  if (word.starts_with('-') || std::find(verbs.begin(), verbs.end(), word) != verbs.end()) return true;
  nanson::print(stderr, "{}: {}\n", word, nanson::unknown_word("verb", word, verbs));
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  nanson::open_standard_streams();
  CLI::App app{"nanson: fast large-strain solid dynamics on tetrahedra"};
  app.set_version_flag("--version", version_text());
  app.footer(
      "A first scene: nanson new NAME, then nanson run NAME.toml. In a source folder also ./nanson test, ./nanson "
      "bench.");
  app.require_subcommand(1);
  std::string scene;
  std::vector<std::string> settings;
  nanson::RunOptions options;
  options.threads = omp_get_num_procs();
  std::string out;
  const auto common = [&](CLI::App* c) {
    c->add_option("SCENE", scene, "scene file (TOML)")->required();
    c->add_option("--threads", options.threads, "threads; results do not depend on it")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str();
    c->add_option("--set", settings, "KEY=VALUE: overrides a key of the scene, e.g. --set time.end=0.01")->take_all();
    return c;
  };
  CLI::App* run = common(app.add_subcommand("run", "run a scene; results in results/SCENE/ or in --out DIR"));
  run->add_option("--out", out, "folder for the results");
  run->add_flag("--force", options.force, "replace earlier results, which otherwise move to DIR.1, DIR.2, ...");
  run->add_flag("--quiet", options.quiet, "only errors and warnings");
  std::string restart;
  run->add_option("--restart", restart,
                  "go on from the newest checkpoint of the scene's results, or of the folder or file given here")
      ->expected(0, 1)
      ->type_name("[DIR]");
  run->get_option("SCENE")->required(false);  // --restart takes the word after it, which may be the scene
  CLI::App* study = app.add_subcommand("study",
                                       "run all scenes of a study, one after another; goes on where it stopped; "
                                       "results in results/STUDY/ or in --out DIR");
  study->add_option("STUDY", scene, "study file (TOML)")->required();
  study->add_option("--out", out, "folder for the results");
  CLI::App* check = common(
      app.add_subcommand("check", "mesh quality, step, memory and estimated time; writes nothing"));
  CLI::App* info = app.add_subcommand("info", "what a checkpoint holds, and whether it is whole");
  info->add_option("PATH", scene, "checkpoint, or folder of results")->required();
  CLI::App* keys = app.add_subcommand("keys", "what scenes and studies may say and what runs write");
  nanson::KeysOptions asked;
  keys->add_option("NAME", asked.name, "a section or a key, e.g. boundary, material.density, output; all without it");
  keys->add_flag("--study", asked.study, "the keys of a study");
  keys->add_flag("--markdown", asked.markdown, "the reference of configs/README.md");
  keys->add_flag("--json", asked.json, "a JSON Schema for editors");
  keys->add_flag("--settings", asked.settings, "what --set can be completed to");
  CLI::App* new_scene = app.add_subcommand("new", "write NAME.toml, a small commented scene to start from");
  new_scene->add_option("NAME", scene, "name of the scene")->required();
  if (argc == 1) {
    nanson::print(stderr, "{}", app.help());
    return 2;
  }
  if (!is_known_verb(app, argv[1])) return 2;
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
  try {
    std::vector<std::string> errors;
    if (keys->parsed()) return told(nanson::print_keys(asked));
    if (new_scene->parsed()) return nanson::write_new_scene(scene);
    if ((study->parsed() ? study : run)->count("--out") > 0) options.out = out;
    if (scene.empty() && std::filesystem::path(restart).extension() == ".toml") std::swap(scene, restart);
    if (scene.empty()) return list_errors({"SCENE is required"});
    if (run->count("--restart") > 0) options.restart = restart;
    if (info->parsed()) return nanson::print_info(scene);
    if (study->parsed()) {
      const int code = nanson::run_study(scene, options.out, errors);
      return errors.empty() ? code : list_errors(errors);
    }
    const auto loaded = nanson::load(scene, settings, errors);
    if (!loaded) return list_errors(errors);
    if (!check->parsed()) return nanson::run_scene(*loaded, options);
    return told(nanson::check_scene(*loaded, options.threads));
  } catch (const nanson::FolderError& e) {
    nanson::print(stderr, "{}\n", e.what());
    return 2;
  } catch (const nanson::InputError& e) {
    nanson::print(stderr, "{}: {}\n", scene, e.what());
    return 2;
  } catch (const std::exception& e) {
    nanson::print(stderr, "nanson: {}\n", e.what());
    return 1;
  }
}
