// The [report] section of a study.
#pragma once
#include <filesystem>

#include "io/scene/config_table.hpp"
#include "io/study/study.hpp"

namespace nanson {

/// What is shown when the section does not say: after the kind and what is varied.
void set_report_defaults(Study& study);

/// Files are named from `folder`, the study's. Keys that studies of another kind have are errors.
void read_study_report(Table& report, Study& study, const std::filesystem::path& folder);

}  // namespace nanson
