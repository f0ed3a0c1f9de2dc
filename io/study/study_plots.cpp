// Gnuplot scripts with their data inside, so that each can be run again and edited by hand: maps of verdicts and bars; curves stand in study_curves.cpp.
#include <fmt/format.h>

#include <algorithm>

#include "io/study/study_plots.hpp"

namespace nanson {
namespace {

/// One mark and one colour for each verdict, in the order of words(Verdict).
constexpr PlotStyle verdict_styles[] = {{"#009e73", 7, 1}, {"#d55e00", 2, 1}, {"#000000", 1, 1},  {"#000000", 3, 1},
                                        {"#cc79a7", 8, 1}, {"#e69f00", 5, 1}, {"#56b4e9", 10, 1}, {"#0072b2", 6, 1},
                                        {"#787878", 4, 1}, {"#787878", 12, 1}};
static_assert(std::size(verdict_styles) == words(Verdict{}).size());

/// Rows: all varied keys but x; columns: the values of x.
void add_map(const StudyResults& all, std::vector<StudyPlot>& plots) {
  const std::string& x = all.study->report.x;
  std::vector<std::string> keys = varied_keys(*all.study), columns, rows;
  std::erase(keys, x);
  const auto index = [](std::vector<std::string>& list, const std::string& name) {
    const auto at = std::find(list.begin(), list.end(), name);
    if (at != list.end()) return at - list.begin();
    list.push_back(name);
    return static_cast<std::ptrdiff_t>(list.size()) - 1;
  };
  std::vector<std::string> data(words(Verdict{}).size());
  for (std::size_t i = 0; i < all.runs.size(); ++i) {
    const PlannedRun& run = all.runs[i].plan;
    const auto column = index(columns, readable(run.varied.contains(x) ? run.varied.at(x) : "")),
               row = index(rows, name_of(run, keys));
    if (all.results[i].made)
      data[static_cast<std::size_t>(all.results[i].judgement.verdict)] += fmt::format("{} {}\n", column, row);
  }
  if (all.done() == 0) return;
  const auto tics = [](const std::vector<std::string>& names) {
    std::string list;
    for (std::size_t i = 0; i < names.size(); ++i)
      list += fmt::format("{}{} {}", i ? ", " : "", gnuplot_text(names[i]), i);
    return list;
  };
  std::size_t longest = 0, widest = 0;
  for (const std::string& row : rows) longest = std::max(longest, row.size());
  for (const std::string& column : columns) widest = std::max(widest, column.size());
  const bool turned = widest * columns.size() > 45;
  std::string script = terminal(640, static_cast<int>(150 + 34 * rows.size() + (turned ? 8 * widest : 0)));
  script += fmt::format(
      "set key below maxcols 4 left Left reverse samplen 1\nset border lc \"#444444\"\nset xlabel {} offset 0,0.9\nset "
      "xtics ({}){}\nset ytics ({})\nset lmargin {}\n",
      gnuplot_text(x), tics(columns), turned ? " rotate by 45 right" : "", tics(rows), longest + 3);
  script += fmt::format("set xrange [-0.6:{}.6]\nset yrange [{}.6:-0.6]\nset grid lc \"#eeeeee\" lt 1\n",
                        columns.size() - 1, rows.size() - 1);
  std::string plot;
  for (std::size_t v = 0; v < data.size(); ++v) {
    if (data[v].empty()) continue;
    script += fmt::format("$verdict{} << EOD\n{}EOD\n", v, data[v]);
    plot += fmt::format("  $verdict{} using 1:2 with points lc \"{}\" pt {} ps 1.6 lw 2.5 title {}, \\\n", v,
                        verdict_styles[v].colour, verdict_styles[v].marker,
                        gnuplot_text(std::string(words(Verdict{})[v])));
  }
  plots.push_back({"", "Stability map", "Each mark is a run; its shape and colour are the verdict.",
                   script + "plot \\\n" + plot.substr(0, plot.size() - 4) + "\n", ""});
}

/// Horizontal bars, one a run, with their values at the end.
void add_bars(const StudyResults& all, std::vector<StudyPlot>& plots) {
  const std::vector<std::string> keys = varied_keys(*all.study);
  const std::string& baseline = all.study->report.baseline;
  for (const std::string& y : all.study->report.y) {
    std::optional<double> base;
    std::string data, names, values;
    std::size_t longest = 0, count = 0;
    double largest = 0;
    for (std::size_t i = 0; i < all.runs.size() && !baseline.empty(); ++i)
      if (all.runs[i].plan.varied.at("case") == baseline && !base) base = quantity(all.results[i], y);
    for (std::size_t i = 0; i < all.runs.size(); ++i) {
      const auto value = quantity(all.results[i], y);
      if (!all.results[i].ended() || !value) continue;
      const std::string name = name_of(all.runs[i].plan, keys);
      const std::string ratio = base && *base != 0 ? fmt::format("  ({:.2f})", *value / *base) : "";
      data += fmt::format("{} {:.10g}\n", count, *value);
      names += fmt::format("{}{} {}", count ? ", " : "", gnuplot_text(name), count);
      values += fmt::format("set label {} at {:.10g},{} left offset 0.7,0\n",
                            gnuplot_text(fmt::format("{:.4g}{}", *value, ratio)), *value, count++);
      longest = std::max(longest, name.size());
      largest = std::max(largest, *value);
    }
    if (count == 0) continue;
    std::string script = terminal(640, static_cast<int>(110 + 34 * count));
    script += fmt::format(
        "unset key\nset border 3 lc \"#444444\"\nset xlabel {}\nset lmargin {:.1f}\nset xrange [0:{:.6g}]\nset yrange "
        "[{}.6:-0.6]\nset style fill solid 0.6 border lc \"#0072b2\"\n",
        gnuplot_text(axis_name(y)), 0.8 * static_cast<double>(longest) + 3,
        largest > 0 ? (base ? 1.6 : 1.3) * largest : 1, count - 1);
    script += fmt::format("set xtics nomirror\nset ytics nomirror scale 0 ({})\n{}$bars << EOD\n{}EOD\n", names, values,
                          data);
    script += "plot $bars using ($2/2):1:($2/2):(0.32) with boxxyerror lc \"#0072b2\"\n";
    plots.push_back(
        {"", headline(axis_name(y)), base ? fmt::format("In brackets: times \"{}\".", baseline) : "", script, ""});
  }
}

}  // namespace

std::string gnuplot_text(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? "''" : std::string(1, static_cast<unsigned char>(c) < 0x20 ? ' ' : c);
  return out + "'";
}

std::string terminal(int width, int height) {
  return fmt::format(
      "set encoding utf8\nset terminal svg size {},{} dynamic noenhanced font \"Helvetica,15\" background \"white\"\n",
      width, height);
}

std::string headline(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z' && text.find('_') > text.find(' '))
    text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

std::string axis_name(const std::string& name) {
  if (name == "h") return "h, edge of a cell [m]";
  if (name == "cpu_s") return "processor seconds of the time loop";
  if (name == "wall_s") return "seconds of the time loop";
  if (name.starts_with("errors.")) return "relative error " + name.substr(7);
  return name;
}

std::vector<StudyPlot> study_plots(const StudyResults& all) {
  std::vector<StudyPlot> plots;
  const ReportSpec& report = all.study->report;
  if (all.study->kind == StudyKind::stability) add_map(all, plots);
  else if (all.study->kind == StudyKind::compare) add_bars(all, plots);
  else add_curves(all, report.x, plots);
  if (all.study->kind == StudyKind::convergence && report.x != "h" && !report.rate_over.empty())
    add_curves(all, "h", plots);
  for (std::size_t i = 0; i < plots.size(); ++i) plots[i].name = fmt::format("plot-{}", i + 1);
  return plots;
}

}  // namespace nanson
