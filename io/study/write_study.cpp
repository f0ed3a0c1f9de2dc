// The table of runs, and the order in which the rest is written.
#include "io/study/write_study.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/read_csv.hpp"
#include "io/replace_file.hpp"

namespace nanson {
namespace {

std::string text_of(const StudyRunResult& r, const std::string& key) {
  if (!r.outcome.summary) return "";
  const auto at = r.outcome.summary->texts.find(key);
  return at == r.outcome.summary->texts.end() ? "" : at->second;
}

std::string number_text(std::optional<double> value) { return value ? fmt::format("{}", *value) : ""; }

}  // namespace

std::vector<std::string> quantity_columns(const StudyResults& all) {
  const std::vector<std::string> keys = varied_keys(*all.study);
  std::vector<std::string> columns;
  const auto add = [&](const std::string& name) {
    const bool varied = std::find(keys.begin(), keys.end(), name) != keys.end();
    if (!name.empty() && !varied && std::find(columns.begin(), columns.end(), name) == columns.end())
      columns.push_back(name);
  };
  for (const std::string& y : all.study->report.y) add(y);
  add(all.study->report.x);
  for (const char* name : {"h", "nodes", "tets", "steps", "cpu_s", "wall_s", "process_s", "ns_per_node_step",
                           "bytes_per_node", "energy_excess", "least_detF", "least_tet_ratio", "checkerboard"})
    add(name);
  return columns;
}

std::string study_csv(const StudyResults& all) {
  const std::vector<std::string> keys = varied_keys(*all.study), columns = quantity_columns(all);
  const bool rates = !all.study->report.rate_over.empty();
  std::string csv = "run";
  for (const std::string& key : keys) csv += fmt::format(",{}", csv_text(key));
  csv += ",verdict,reason";
  for (const std::string& name : columns) csv += fmt::format(",{}", csv_text(name));
  if (rates)
    for (const std::string& y : all.study->report.y) csv += fmt::format(",{}", csv_text(fmt::format("rate of {}", y)));
  csv += ",threads,host,commit,folder\n";
  for (std::size_t i = 0; i < all.runs.size(); ++i) {
    const StudyRunResult& r = all.results[i];
    if (!r.made) continue;
    csv += fmt::format("{}", i + 1);
    for (const std::string& key : keys) csv += fmt::format(",{}", csv_text(readable(all.runs[i].plan.varied.at(key))));
    csv += fmt::format(",{},{}", word(r.judgement.verdict), csv_text(r.judgement.reason));
    for (const std::string& name : columns) csv += fmt::format(",{}", number_text(quantity(r, name)));
    if (rates)
      for (const std::string& y : all.study->report.y)
        csv += r.rates.contains(y) ? fmt::format(",{:.4f}", r.rates.at(y)) : ",";
    csv += fmt::format(",{},{},{},runs/{}\n", all.study->threads, csv_text(text_of(r, "provenance.host")),
                       csv_text(text_of(r, "provenance.commit")), all.runs[i].hash);
  }
  return csv;
}

std::string shell_quoted(const std::string& word) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c))
           || std::string_view("_-./=,+:@%").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') out += "&amp;";
    else if (c == '<') out += "&lt;";
    else if (c == '>') out += "&gt;";
    else if (c == '"') out += "&quot;";
    else out += static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' ? ' ' : c;
  }
  return out;
}

std::vector<std::string> write_study(const StudyResults& all) {
  replace_file(all.folder / "runs.csv", study_csv(all));
  std::vector<StudyPlot> plots = study_plots(all);
  std::vector<std::string> lines = draw(plots, all.folder);
  replace_file(all.folder / "report.html", study_page(all, plots));
  lines.push_back(fmt::format("written: {}", (all.folder / "report.html").string()));
  return lines;
}

}  // namespace nanson
