// Gnuplot as a program: SVG that any page can hold.
#include <fmt/format.h>

#include <unistd.h>

#include <cstdlib>

#include "io/child_process.hpp"
#include "io/replace_file.hpp"
#include "io/study/study_plots.hpp"
#include "io/text_file.hpp"

namespace nanson {
namespace {

namespace fs = std::filesystem;

fs::path find_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  for (std::string rest = path ? path : ""; !rest.empty();) {
    const std::size_t colon = rest.find(':');
    const fs::path candidate = fs::path(rest.substr(0, colon)) / name;
    if (::access(candidate.c_str(), X_OK) == 0 && fs::is_regular_file(candidate)) return candidate;
    rest = colon == std::string::npos ? "" : rest.substr(colon + 1);
  }
  return {};
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

/// The <svg> element alone, its ids made unlike those of other plots on the page, named by its title for those who cannot see it.
std::string inline_svg(std::string svg, const StudyPlot& plot) {
  const std::size_t begin = svg.find("<svg"), end = svg.rfind("</svg>");
  if (begin == std::string::npos || end == std::string::npos) return "";
  svg = svg.substr(begin, end + 6 - begin);
  const std::string mark = plot.name + "-";
  for (const char* quote : {"'", "\""}) {
    replace_all(svg, fmt::format(" id={}", quote), fmt::format(" id={}{}", quote, mark));
    replace_all(svg, fmt::format("xlink:href={}#", quote), fmt::format("xlink:href={}#{}", quote, mark));
  }
  replace_all(svg, "url(#", fmt::format("url(#{}", mark));
  replace_all(svg, "<title>Gnuplot</title>", fmt::format("<title>{}</title>", escaped(plot.title)));
  replace_all(svg, "<desc>Produced by GNUPLOT", "<desc>Made by GNUPLOT");
  return svg;
}

}  // namespace

std::vector<std::string> draw(std::vector<StudyPlot>& plots, const fs::path& folder) {
  std::vector<std::string> lines;
  if (plots.empty()) return lines;
  const fs::path gnuplot = find_program("gnuplot");
  if (gnuplot.empty())
    lines.emplace_back(
        "gnuplot is not installed (apt-get install gnuplot-nox): the plots are left as scripts plot-N.gnuplot, table "
        "and page are written");
  for (StudyPlot& plot : plots) {
    const fs::path script = folder / (plot.name + ".gnuplot"), svg = folder / (plot.name + ".svg"),
                   log = folder / (plot.name + ".log");
    replace_file(script, fmt::format("# {}: gnuplot {}.gnuplot > {}.svg\n{}", gnuplot_text(plot.title), plot.name,
                                     plot.name, plot.script));
    fs::remove(svg);
    if (gnuplot.empty()) continue;
    const fs::path here = fs::absolute(folder);  // gnuplot takes a name that begins with < or | for a command
    const fs::path raw = here / (plot.name + ".tmp.svg"), run = here / (plot.name + ".tmp.gnuplot");
    replace_file(run, fmt::format("set output {}\n", gnuplot_text(raw.string())) + plot.script);
    const ChildEnd end = run_child({gnuplot.string(), run.string()}, log, {60, 5}, [] { return 0; });
    std::string why;
    const auto text = read_text_file(raw, why);
    if (end.code == 0 && text) plot.svg = inline_svg(*text, plot);
    if (plot.svg.empty()) {
      lines.push_back(fmt::format("gnuplot could not draw {}: see {}", plot.name, log.string()));
    } else {
      replace_file(svg, fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{}\n", plot.svg));
      fs::remove(log);
    }
    fs::remove(raw);
    fs::remove(run);
  }
  return lines;
}

}  // namespace nanson
