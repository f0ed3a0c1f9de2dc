// A study file, read into a Study; every error with its place.
#pragma once
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <toml++/toml.h>

#include "io/study/study.hpp"

namespace nanson {

struct Key;

struct StudyResult {
  Study study;
  std::vector<std::string>
      errors;                  // "file:line:column: key = found: why", sorted; the study is valid when there are none
  std::set<const Key*> asked;  // keys of the table that the reader asked for
};

/// Scenes that the study names are not read here: io/study_scenes checks them with the settings of every run.
StudyResult read_study(const std::filesystem::path& file);

/// A value on one line, as --set takes it.
std::string toml_text(const toml::node& value);

}  // namespace nanson
