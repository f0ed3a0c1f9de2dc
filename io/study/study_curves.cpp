// Curves over a quantity: ours by the varied keys, points measured elsewhere as letters, slopes and rates where there is an order to see.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/study/study_plots.hpp"

namespace nanson {
namespace {

/// Told apart without colour too: every curve has its own marker and dash.
constexpr const char* colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00",
                                   "#56b4e9", "#000000", "#7f5539", "#787878"};
constexpr int markers[] = {7, 5,  9,  11, 13, 6, 4,
                           8, 10, 12, 2,  1,  3};  // 13 and 9 have no common factor: no two of 117 curves look alike
PlotStyle curve_style(std::size_t i) {
  return {colours[i % std::size(colours)], markers[i % std::size(markers)], static_cast<int>(1 + i % 5)};
}

struct Curve {
  std::string name;
  std::vector<std::pair<double, double>> points;
  std::optional<double> last_rate;
};

std::vector<std::string> line_keys(const StudyResults& all) {
  const ReportSpec& r = all.study->report;
  std::vector<std::string> keys = r.lines.empty() ? varied_keys(*all.study) : r.lines;
  std::erase_if(keys, [&](const std::string& key) { return key == r.rate_over || key == r.x || key == r.panels; });
  return keys;
}

/// Curves in the order of the runs; a study that is varied in more than `lines` has several points at one x.
std::vector<Curve> curves(const StudyResults& all, const std::string& panel, const std::string& x,
                          const std::string& y) {
  std::vector<Curve> curves;
  const std::vector<std::string> keys = line_keys(all);
  for (std::size_t i = 0; i < all.runs.size(); ++i) {
    const StudyRunResult& r = all.results[i];
    const auto at_x = quantity(r, x), at_y = quantity(r, y);
    const ReportSpec& report = all.study->report;
    if (!panel.empty() && all.runs[i].plan.varied.at(report.panels) != panel) continue;
    if (!r.ended() || !at_x || !at_y || (report.x_scale == AxisScale::log && *at_x <= 0)
        || (report.y_scale == AxisScale::log && *at_y <= 0))
      continue;
    const std::string name = name_of(all.runs[i].plan, keys);
    auto curve = std::find_if(curves.begin(), curves.end(), [&](const Curve& c) { return c.name == name; });
    if (curve == curves.end()) curve = curves.insert(curves.end(), Curve{name, {}, {}});
    curve->points.emplace_back(*at_x, *at_y);
    if (r.rates.contains(y)) curve->last_rate = r.rates.at(y);
  }
  if (all.study->report.rate_over.empty())  // else the sequence of meshes is the curve
    for (Curve& c : curves)
      std::stable_sort(c.points.begin(), c.points.end(),
                       [](const auto& a, const auto& b) { return a.first < b.first; });
  return curves;
}

std::vector<Curve> reference_curves(const ReportSpec& report, const std::string& x, const std::string& y) {
  std::vector<Curve> curves;
  for (const ReferencePoint& p : report.reference) {
    if (!p.values.contains(x) || !p.values.contains(y)) continue;
    auto curve = std::find_if(curves.begin(), curves.end(), [&](const Curve& c) { return c.name == p.label; });
    if (curve == curves.end()) curve = curves.insert(curves.end(), Curve{p.label, {}, {}});
    if ((report.x_scale == AxisScale::log && p.values.at(x) <= 0)
        || (report.y_scale == AxisScale::log && p.values.at(y) <= 0))
      continue;
    curve->points.emplace_back(p.values.at(x), p.values.at(y));
  }
  return curves;
}

/// Range and tics of a logarithmic axis: a little beyond the data, finer ones where little is shown. gnuplot's own would go to whole decades.
std::string log_axis(char axis, double low, double high) {
  low /= 1.25;
  high *= 1.25;
  std::string tics;
  const double ratio = high / low;
  const std::vector<double> mantissas = ratio > 200 ? std::vector<double>{1}
                                        : ratio > 8 ? std::vector<double>{1, 2, 5}
                                                    : std::vector<double>{1, 1.5, 2, 3, 4, 5, 6, 8};
  for (int k = static_cast<int>(std::floor(std::log10(low))); std::pow(10.0, k) <= high; ++k)
    for (const double m : mantissas) {
      const double at = m * std::pow(10.0, k);
      if (at < low || at > high) continue;
      tics += fmt::format("{}\"{:g}\" {:.6g}", tics.empty() ? "" : ", ", at, at);
    }
  return fmt::format("set logscale {0}\nset {0}range [{1:.6g}:{2:.6g}]\nset {0}tics ({3})\n", axis, low, high, tics);
}

/// Smallest and largest of one coordinate over all curves.
std::pair<double, double> span_of(const std::vector<Curve>& ours, const std::vector<Curve>& theirs,
                                  double std::pair<double, double>::*coordinate) {
  std::pair<double, double> span{1e300, -1e300};
  for (const auto* list : {&ours, &theirs})
    for (const Curve& c : *list)
      for (const auto& point : c.points)
        span = {std::min(span.first, point.*coordinate), std::max(span.second, point.*coordinate)};
  return span;
}

/// Slopes of order 1, 2 and 3 through the lower left corner of the data, as thin grey lines.
std::string slope_lines(const std::vector<Curve>& curves) {
  const double left = span_of(curves, {}, &std::pair<double, double>::first).first,
               bottom = span_of(curves, {}, &std::pair<double, double>::second).first;
  std::string plots;
  for (const int order : {1, 2, 3})
    plots += fmt::format("  {:.8g} * (x/{:.8g})**{} with lines lc \"#aaaaaa\" dt {} lw 1 title \"order {}\", \\\n",
                         bottom, left, order, order + 1, order);
  return plots;
}

/// Data blocks and the plot command for curves of ours and of others.
std::string curve_script(const ReportSpec& report, const std::vector<Curve>& ours, const std::vector<Curve>& theirs,
                         const std::string& x, const std::string& y, bool slopes) {
  const int entries = static_cast<int>(ours.size() + theirs.size() + (slopes ? 3 : 0));
  std::size_t longest = 0;
  for (const auto* list : {&ours, &theirs})
    for (const Curve& c : *list) longest = std::max(longest, c.name.size() + (c.last_rate ? 12 : 0));
  const int columns = longest > 30 ? 1 : longest > 18 ? 2 : 3;
  const int lines = (entries + columns - 1) / columns;
  std::string script = terminal(640, 430 + 20 * lines) + fmt::format("set bmargin {:.1f}\n", 3.6 + 0.88 * lines);
  script += fmt::format(
      "set key below maxcols {} left Left reverse samplen 2.5 width -3 font \",13\"\nset grid lc \"#dddddd\" lt 1\nset "
      "border lc \"#444444\"\nset xlabel {} offset 0,0.3\nset ylabel {}\n",
      columns, gnuplot_text(axis_name(x)), gnuplot_text(axis_name(y)));
  const auto [x_low, x_high] = span_of(ours, theirs, &std::pair<double, double>::first);
  const auto [y_low, y_high] = span_of(ours, theirs, &std::pair<double, double>::second);
  script += "set offsets graph 0.04, graph 0.04, graph 0.06, graph 0.06\n";
  if (report.x_scale == AxisScale::log) script += log_axis('x', x_low, x_high);
  if (report.y_scale == AxisScale::log) script += log_axis('y', y_low, y_high);
  std::string plots = slopes ? slope_lines(ours) : "";
  std::size_t n = 0;
  const auto add = [&](const Curve& c, const char* what, const std::string& title) {
    script += fmt::format("$data{} << EOD\n", n);
    for (const auto& [px, py] : c.points) script += fmt::format("{:.10g} {:.10g}\n", px, py);
    script += "EOD\n";
    plots += fmt::format("  $data{} using 1:2 with {} title {}, \\\n", n++, what, gnuplot_text(title));
  };
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const PlotStyle s = curve_style(i);
    std::string title = ours[i].name.empty() ? "nanson" : ours[i].name;
    if (ours[i].last_rate && slopes) title += fmt::format(" (rate {:.2f})", *ours[i].last_rate);
    add(ours[i], fmt::format("linespoints lc \"{}\" pt {} dt {} lw 2 ps 0.9", s.colour, s.marker, s.dash).c_str(),
        title);
  }
  for (std::size_t i = 0; i < theirs.size(); ++i)
    add(theirs[i],
        fmt::format("points pt \"{}\" font \",15\" tc rgb \"#000000\"", static_cast<char>('A' + i % 26)).c_str(),
        theirs[i].name);
  return script + "plot \\\n" + plots.substr(0, plots.size() - 4) + "\n";
}

void add_panel(const StudyResults& all, const std::string& panel, const std::string& x, std::vector<StudyPlot>& plots) {
  const ReportSpec& report = all.study->report;
  for (const std::string& y : report.y) {
    const std::vector<Curve> ours = curves(all, panel, x, y), theirs = reference_curves(report, x, y);
    if (ours.empty()) continue;
    const bool slopes = x == "h" && report.x_scale == AxisScale::log && report.y_scale == AxisScale::log;
    StudyPlot p;
    p.title = headline(fmt::format("{} over {}{}", axis_name(y), axis_name(x),
                                   panel.empty() ? "" : fmt::format(": {}", readable(panel))));
    p.caption = slopes
                    ? "Grey: slopes of order 1, 2 and 3. Rates: between the two finest meshes that came to their end."
                    : "";
    if (!theirs.empty())
      p.caption += fmt::format("{}Letters: measured elsewhere, as the head of this page says.",
                               p.caption.empty() ? "" : " ");
    p.script = curve_script(report, ours, theirs, x, y, slopes);
    plots.push_back(std::move(p));
  }
}

}  // namespace

void add_curves(const StudyResults& all, const std::string& x, std::vector<StudyPlot>& plots) {
  std::vector<std::string> panels{""};
  for (const StudyAxis& axis : all.study->vary)
    if (axis.key == all.study->report.panels) {
      panels.clear();
      for (const StudySetting& value : axis.values) panels.push_back(value.value);
    }
  if (all.study->report.panels == "case") {
    panels.clear();
    for (const StudyCase& c : all.study->cases) panels.push_back(c.name);
  }
  for (const std::string& panel : panels) add_panel(all, panel, x, plots);
}

}  // namespace nanson
