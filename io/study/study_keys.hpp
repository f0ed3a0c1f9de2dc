// Every key of a study: the one place that names, bounds and explains it. Defaults stand in io/study/study.hpp.
#pragma once
#include "io/scene/key.hpp"
#include "io/study/study.hpp"

namespace nanson {

/// What a study may ask for besides varied keys: numbers of summary.json and its own quantities; probes.*, sweeps.* and setup.* as the runs have them.
// clang-format off
inline constexpr Key study_keys[] = {
    {"study", of<&Study::name>, "",
     "name of the study and of its results' folder: letters, digits, - and _", {.required = true}},
    {"kind", of<&Study::kind>, "",
     "convergence, sweep: curves; stability: a map of which runs are sound; compare: bars, a case each",
     {.required = true}},
    {"scene", {KeyType::text}, "", "the scene that is run, relative to the study's folder; or every [[case]] its own"},
    {"threads", of<&Study::threads>, "-", "of a run", {.range = {.from = 1, .to = 4096}}},
    {"set", {KeyType::settings}, "",
     "keys of the scene, \"section.key\" in quotes, with the values of all runs",
     {.example = "{ \"time.end\" = 0.01 }"}},
    {"vary", {KeyType::variations}, "",
     "keys of the scene with the values that are combined: a list, or { from, to, count, scale }",
     {.example = "{ \"mesh.cells\" = [[4, 4, 4], [8, 8, 8]] }"}},
    {"vary.KEY", {KeyType::table}, "",
     "a range in place of a list of values", {.example = "{ from = 0.1, to = 0.8, count = 8 }"}},
    {"vary.KEY.from", {KeyType::number}, "as the key", "first value of a range", {.required = true}},
    {"vary.KEY.to", {KeyType::number}, "as the key", "last value of a range", {.required = true}},
    {"vary.KEY.count", {KeyType::whole}, "-", "how many values", {.required = true, .range = {.from = 2, .to = 1000}}},
    {"vary.KEY.scale", {KeyType::choice, &key_detail::words_of<AxisScale>, [] { return std::string("\"linear\""); }}, "",
     "evenly spaced, or by equal ratios"},
    {"case", {KeyType::tables}, "",
     "a [[case]] for each variant that several keys make",
     {.example = "[{ name = \"corrected\", set = { \"physics.flux_correction\" = \"full\" } }]"}},
    {"case.name", of<&StudyCase::name>, "", "its name, one of its own", {.required = true}},
    {"case.scene", {KeyType::text}, "", "the scene of this case"},
    {"case.set", {KeyType::settings}, "",
     "keys of the scene and their values in this case", {.example = "{ \"time.end\" = 0.01 }"}},

    {"report", {KeyType::table}, "", "what the page and the tables show", {.example = "{ y = \"energy.closure\" }"}},
    {"report.title", of<&ReportSpec::title>, "", "heading of the page"},
    {"report.text", of<&ReportSpec::text>, "", "what the study is about"},
    {"report.x", {KeyType::text}, "",
     "a varied key or a quantity; h for convergence, else the last varied key",
     {.of = "convergence | sweep | stability"}},
    {"report.y", {KeyType::name_or_names}, "", "quantities: numbers of summary.json, or those of the study"},
    {"report.lines", {KeyType::name_or_names}, "",
     "varied keys: a curve for each combination of their values", {.of = "convergence | sweep"}},
    {"report.panels", {KeyType::text}, "",
     "a varied key: a plot for each of its values", {.of = "convergence | sweep"}},
    {"report.rate_over", {KeyType::text}, "", "a varied key: rates between neighbours along it"},
    {"report.x_scale", of<&ReportSpec::x_scale>, "",
     "of the x axis; log for convergence", {.of = "convergence | sweep"}},
    {"report.y_scale", of<&ReportSpec::y_scale>, "",
     "of the y axes; log for convergence", {.of = "convergence | sweep"}},
    {"report.reference", {KeyType::file_or_tables}, "",
     "points from elsewhere: a CSV file, or tables with label and values under the names of x and y",
     {.of = "convergence | sweep", .example = "[{ label = \"elsewhere\", \"mesh.cells\" = 8, \"energy.closure\" = 1.0e-6 }]"}},
    {"report.reference.label", of<&ReferencePoint::label>, "", "of the point", {.required = true}},
    {"report.reference_note", of<&ReportSpec::reference_note>, "",
     "where they were measured", {.of = "convergence | sweep"}},
    {"report.baseline", of<&ReportSpec::baseline>, "",
     "the case that the others are compared with", {.of = "compare"}},
    {"report.max_wall_s", of<&ReportSpec::max_wall_s>, "s",
     "a run that takes longer is ended: too slow", {.range = {.above = 0}}},
    {"report.energy_tolerance", of<&ReportSpec::energy_tolerance>, "-",
     "growth beyond this share of the initial energy is not sound", {.range = {.from = 0}}},
    {"report.checkerboard_max", of<&ReportSpec::checkerboard_max>, "-",
     "a larger checkerboard of the pressure is not sound", {.range = {.above = 0}}},
};
// clang-format on
static_assert(all_said(study_keys), "a key has no sentence, or a number no unit");

/// The key of that path: does not compile when the table has none.
consteval const Key& study_key(std::string_view path) { return find_key(study_keys, path, {}); }

}  // namespace nanson
