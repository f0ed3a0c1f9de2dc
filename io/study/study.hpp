// A study as plain data, and its plan: which runs it consists of, in which order, and what is compared with what.
#pragma once
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/traits.hpp"

namespace nanson {

enum class StudyKind { convergence, stability, compare, sweep };
enum class AxisScale { linear, log };
constexpr auto words(StudyKind) {
  return std::array<std::string_view, 4>{"convergence", "stability", "compare", "sweep"};
}
constexpr auto words(AxisScale) { return std::array<std::string_view, 2>{"linear", "log"}; }

/// One key of a scene and its value as TOML text, with the place in the study file that says it ("file:line:column").
struct StudySetting {
  std::string key, value;
  std::string where;
};

struct StudyAxis {
  std::string key;
  std::vector<StudySetting> values;
};

struct StudyCase {
  std::string name;
  std::filesystem::path scene;  // empty: the study's
  std::vector<StudySetting> settings;
};

/// A measured point from elsewhere, drawn beside our curves: values under the names of report.x and report.y.
struct ReferencePoint {
  std::string label;
  std::map<std::string, double> values;
};

struct ReportSpec {
  std::string title, text;
  std::string x;  // a key of summary.json, a quantity of the study, or a varied key
  std::vector<std::string> y;
  std::vector<std::string> lines;  // varied keys: one curve for each combination of their values
  std::string panels;              // varied key: a plot for each of its values
  std::string rate_over;           // varied key: rates between neighbours along it
  std::string baseline;            // case that the others are compared with
  double max_wall_s = 0;           // [s] 0: no limit
  double energy_tolerance = 1e-6;  // [-] of the initial energy
  double checkerboard_max = 0;     // [-] 0: not judged
  AxisScale x_scale = AxisScale::linear, y_scale = AxisScale::linear;
  std::vector<ReferencePoint> reference;
  std::map<std::string, std::string> where;  // of every quantity that x and y name
  std::string reference_note;                // where they were measured
};

struct Study {
  std::string name;
  StudyKind kind = StudyKind::sweep;
  std::filesystem::path file, scene;
  std::string scene_where;
  int threads = 1;
  std::vector<StudySetting> set;
  std::vector<StudyAxis> vary;
  std::vector<StudyCase> cases;
  ReportSpec report;
};

/// What a study makes of a run, beside the numbers of its summary; the extremes are those that the verdict is taken from.
struct StudyQuantity {
  std::string_view name, unit, sentence;
};
inline constexpr std::array<StudyQuantity, 5> study_quantities{{
    {"h", "m", "mesh size (6 volume / tets)^(1/3), the edge of a cell of six tets"},
    {"process_s", "s", "wall time of the whole process"},
    {"energy_excess", "-", "largest growth of energy over the run, share of the larger of initial energy and work"},
    {"least_detF", "-", "least determinant of F over the run"},
    {"least_tet_ratio", "-", "least deformed over undeformed volume of a tet over the run (monitor.geometry)"},
}};

struct PlannedRun {
  std::string label;  // "mesh.cells = [6, 6, 6], physics.formulation = pF"
  std::filesystem::path scene;
  std::vector<StudySetting> settings;         // [set], then the case's, then the varied ones
  std::map<std::string, std::string> varied;  // key (or "case") to value, for grouping
};

/// Every case with every combination of the varied values; the first varied key changes slowest.
std::vector<PlannedRun> plan(const Study& study);

/// The varied keys in order, "case" first where there are cases.
std::vector<std::string> varied_keys(const Study& study);

/// A value as people read it: strings without their quotes.
std::string readable(const std::string& toml_value);

/// The number in a value, or the first number of a list: 24 of "[24, 24, 24]".
std::optional<double> number_in(const std::string& toml_value);

/// The values of `keys` in this run, joined: the name of a curve.
std::string name_of(const PlannedRun& run, const std::vector<std::string>& keys);

/// For every run the one before it along `key`, all other varied values being the same; -1 for the first.
std::vector<int> predecessors(const std::vector<PlannedRun>& runs, const std::string& key);

/// log(coarse error / fine error) / log(coarse h / fine h); nothing unless all are positive and the h differ.
std::optional<double> observed_rate(double coarse_h, double coarse_error, double fine_h, double fine_error);

/// 16 hexadecimal digits (FNV-1a, 64 bits).
std::string text_hash(std::string_view text);

}  // namespace nanson
