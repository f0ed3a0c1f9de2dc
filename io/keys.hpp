// nanson keys: what scenes and studies may say and what runs write, from the tables that readers and writers use.
#pragma once
#include <string>

namespace nanson {

struct KeysOptions {
  std::string name;  // a section, a path or a last name; empty: all
  bool study = false;
  bool markdown = false, json = false, settings = false;
};

/// The exit code; text goes to stdout.
int print_keys(const KeysOptions& options);

/// The reference part of configs/README.md.
std::string reference_markdown();

/// Schemas for editors: configs/scene.schema.json and configs/study.schema.json.
std::string scene_schema();
std::string study_schema();

/// The list of completions in completions/nanson.
std::string completions();

}  // namespace nanson
