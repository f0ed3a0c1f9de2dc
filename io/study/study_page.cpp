// One page without anything from outside: what was run, plots, verdicts, table, commands.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "io/study/write_study.hpp"
#include "io/text_file.hpp"

namespace nanson {
namespace {

constexpr const char* style = R"(
:root { color-scheme: light; }
body { font: 16px/1.5 system-ui, "Segoe UI", Helvetica, Arial, sans-serif; color: #1a1a1a; background: #fff; max-width: 60rem; margin: 0 auto; padding: 1rem; overflow-wrap: anywhere; }
h1 { font-size: 1.6rem; line-height: 1.2; margin: 0.5rem 0; }
h2 { font-size: 1.2rem; margin: 2rem 0 0.5rem; border-bottom: 1px solid #ccc; }
nav a { margin-right: 1rem; }
a { color: #004f80; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 0.2rem 1rem; }
dt { color: #555; }
dd { margin: 0; }
figure { margin: 1rem 0 2rem; }
figure svg { width: 100%; min-width: 28rem; max-width: 48rem; height: auto; display: block; }
figcaption { color: #444; font-size: 0.9rem; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: 0.85rem; font-variant-numeric: tabular-nums; }
th, td { padding: 0.2rem 0.6rem; border-bottom: 1px solid #ddd; text-align: right; white-space: nowrap; }
th.word, td.word { text-align: left; }
thead th { border-bottom: 2px solid #888; vertical-align: bottom; }
table { overflow-wrap: normal; }
td.bad { font-weight: 600; }
pre { background: #f4f4f4; padding: 0.7rem; overflow-x: auto; font-size: 0.8rem; line-height: 1.35; overflow-wrap: normal; }
:target { background: #fff3c4; }
@media print { body { max-width: none; font-size: 10pt; } nav { display: none; } .scroll { overflow: visible; } table { font-size: 6.5pt; } th, td { padding: 0.1rem 0.25rem; white-space: normal; } pre { white-space: pre-wrap; overflow-wrap: anywhere; } figure { break-inside: avoid; } }
@media (max-width: 30rem) { dl { grid-template-columns: 1fr; } dd { margin-bottom: 0.4rem; } }
)";

std::string number_text(double v) {
  if (v == std::floor(v) && std::abs(v) < 1e9) return fmt::format("{:.0f}", v);
  return fmt::format("{:.4g}", v);
}

std::string count_of(const StudyResults& all) {
  std::map<std::string_view, int> counts;
  for (const StudyRunResult& r : all.results)
    if (r.made) ++counts[word(r.judgement.verdict)];
  std::string text;
  for (const auto v : words(Verdict{}))
    if (counts.contains(v)) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", counts[v], v);
  return text.empty() ? "none" : text;
}

void add_head(std::string& page, const StudyResults& all, const std::string& title) {
  page +=
      "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n<meta charset=\"utf-8\" "
      "/>\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\" />\n";
  page += fmt::format(
      "<title>{}</title>\n<link rel=\"icon\" href=\"data:,\" />\n<style>{}</style>\n</head>\n<body>\n<h1>{}</h1>\n",
      escaped(title), style, escaped(title));
  if (!all.study->report.text.empty()) page += fmt::format("<p>{}</p>\n", escaped(all.study->report.text));
  page +=
      "<nav><a href=\"#what\">What was run</a> <a href=\"#plots\">Plots</a> <a href=\"#verdicts\">Verdicts</a> <a "
      "href=\"#runs\">Runs</a> <a href=\"#commands\">Commands</a> <a href=\"#study\">Study file</a></nav>\n";
}

void add_what(std::string& page, const StudyResults& all) {
  const Study& s = *all.study;
  const auto line = [&](std::string_view name, const std::string& value) {
    page += fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, escaped(value));
  };
  page += "<h2 id=\"what\">What was run</h2>\n<dl>\n";
  line("study", fmt::format("{} ({}), {}", s.name, word(s.kind), s.file.string()));
  line("runs", fmt::format("{} of {} made: {}", all.done(), all.runs.size(), count_of(all)));
  line("threads", fmt::format("{} in each run, one run after another", s.threads));
  line("machine", fmt::format("{} ({})", all.machine, all.from.host));
  line("program", fmt::format("nanson {}, commit {}, {}, {}", all.from.version, all.from.commit, all.from.compiler,
                              all.from.flags));
  line("page made", all.from.start);
  page += "</dl>\n";
  if (s.report.reference.empty()) return;
  page += "<p>Measured elsewhere, not by this program";
  if (!s.report.reference_note.empty()) page += fmt::format(": {}", escaped(s.report.reference_note));
  page += ".</p>\n";
}

void add_plots(std::string& page, const std::vector<StudyPlot>& plots) {
  page += "<h2 id=\"plots\">Plots</h2>\n";
  if (plots.empty()) page += "<p>No run came to an end with what the plots need.</p>\n";
  for (const StudyPlot& p : plots) {
    const std::string picture = p.svg.empty() ? fmt::format(
                                    "<p>Not drawn: gnuplot was not there or failed. Its script is {}.gnuplot.</p>",
                                    p.name)
                                              : p.svg;
    page += fmt::format(
        "<figure id=\"{}\">\n<div class=\"scroll\">{}</div>\n<figcaption><strong>{}.</strong> "
        "{}</figcaption>\n</figure>\n",
        p.name, picture, escaped(p.title), escaped(p.caption));
  }
}

void add_verdicts(std::string& page, const StudyResults& all) {
  const ReportSpec& r = all.study->report;
  page += "<h2 id=\"verdicts\">Verdicts</h2>\n";
  page += fmt::format(
      "<p>Sound: the run reached its end; at every history row its energy was at most the initial energy and the "
      "external work, within {:g} of them; det F and J stayed positive; no tet "
      "was turned inside out, unless monitor.geometry was \"off\"{}. Verdicts are taken from summary.json and "
      "history.csv.</p>\n",
      r.energy_tolerance,
      r.checkerboard_max > 0
          ? fmt::format("; the checkerboard measure of the pressure was at most {:g}", r.checkerboard_max)
          : "");
  int unknown = 0;
  std::string bad;
  for (std::size_t i = 0; i < all.runs.size(); ++i) {
    const StudyRunResult& run = all.results[i];
    if (!run.made) continue;
    if (run.judgement.verdict == Verdict::sound && !run.judgement.energy_excess) ++unknown;
    if (run.judgement.verdict != Verdict::sound)
      bad += fmt::format("<li><a href=\"#run-{0}\">Run {0}</a>, {1}: <strong>{2}</strong>. {3}</li>\n", i + 1,
                         escaped(all.runs[i].plan.label), escaped(std::string(word(run.judgement.verdict))),
                         escaped(run.judgement.reason));
  }
  if (unknown > 0)
    page += fmt::format(
        "<p>The energy of {} sound runs was not judged: loads or supports do work that only monitor.energy "
        "books.</p>\n",
        unknown);
  page += bad.empty() ? (all.done() > 0 ? "<p>All runs made are sound.</p>\n" : "<p>No run was made.</p>\n")
                      : fmt::format("<ul>\n{}</ul>\n", bad);
}

void add_table(std::string& page, const StudyResults& all) {
  const std::vector<std::string> keys = varied_keys(*all.study);
  std::vector<std::string> columns = quantity_columns(all);
  const auto nobody_has = [&](const std::string& name) {
    return std::none_of(all.results.begin(), all.results.end(),
                        [&](const StudyRunResult& r) { return quantity(r, name).has_value(); });
  };
  std::erase_if(columns, nobody_has);
  const auto& ys = all.study->report.y;
  const bool rates = !all.study->report.rate_over.empty();
  page +=
      "<h2 id=\"runs\">Runs</h2>\n<p>The same numbers with all digits: runs.csv beside this page. Errors of runs that "
      "did not reach their end are not shown.</p>\n<div class=\"scroll\"><table>\n<thead><tr><th>run</th>";
  for (const std::string& key : keys) page += fmt::format("<th class=\"word\">{}</th>", escaped(key));
  page += "<th class=\"word\">verdict</th>";
  for (const std::string& name : columns) {
    page += fmt::format("<th>{}</th>", escaped(name));
    if (rates && std::find(ys.begin(), ys.end(), name) != ys.end()) page += "<th>rate</th>";
  }
  page += "</tr></thead>\n<tbody>\n";
  for (std::size_t i = 0; i < all.runs.size(); ++i) {
    const StudyRunResult& r = all.results[i];
    if (!r.made) continue;
    page += fmt::format("<tr id=\"run-{0}\"><td><a href=\"#command-{0}\">{0}</a></td>", i + 1);
    for (const std::string& key : keys)
      page += fmt::format("<td class=\"word\">{}</td>", escaped(readable(all.runs[i].plan.varied.at(key))));
    page += fmt::format("<td class=\"word{}\">{}</td>", r.judgement.verdict == Verdict::sound ? "" : " bad",
                        escaped(std::string(word(r.judgement.verdict))));
    for (const std::string& name : columns) {
      const auto value = quantity(r, name);
      const bool shown = value && (r.ended() || !name.starts_with("errors."));
      page += fmt::format("<td>{}</td>", shown ? number_text(*value) : "");
      if (rates && std::find(ys.begin(), ys.end(), name) != ys.end())
        page += fmt::format("<td>{}</td>", r.rates.contains(name) ? fmt::format("{:.2f}", r.rates.at(name)) : "");
    }
    page += "</tr>\n";
  }
  page += "</tbody>\n</table></div>\n";
}

void add_commands(std::string& page, const StudyResults& all) {
  page += fmt::format(
      "<h2 id=\"commands\">Commands</h2>\n<p>The whole study (runs that are finished are not made again; remove {} to "
      "start anew):</p>\n<pre>{}</pre>\n<p>Each run:</p>\n<ol>\n",
      escaped((all.folder / "runs").string()), escaped(all.command));
  for (std::size_t i = 0; i < all.runs.size(); ++i) {
    std::string command = "nanson";
    for (const std::string& word : all.runs[i].arguments) command += fmt::format(" {}", shell_quoted(word));
    page += fmt::format("<li id=\"command-{}\"><pre>{}</pre></li>\n", i + 1, escaped(command));
  }
  page += "</ol>\n";
}

}  // namespace

std::string study_page(const StudyResults& all, const std::vector<StudyPlot>& plots) {
  const Study& s = *all.study;
  std::string page, why;
  add_head(page, all, s.report.title.empty() ? s.name : s.report.title);
  add_what(page, all);
  add_plots(page, plots);
  add_verdicts(page, all);
  add_table(page, all);
  add_commands(page, all);
  page += fmt::format("<h2 id=\"study\">Study file</h2>\n<pre>{}</pre>\n</body>\n</html>\n",
                      escaped(read_text_file(s.file, why).value_or(why)));
  return page;
}

}  // namespace nanson
