// What the plots of a study have in common, as gnuplot text.
#pragma once
#include "io/study/write_study.hpp"

namespace nanson {

/// A curve's or a mark's look.
struct PlotStyle {
  const char* colour;
  int marker, dash;
};

/// A single-quoted gnuplot string on one line: gnuplot runs what stands between backquotes in a double-quoted one.
std::string gnuplot_text(const std::string& text);

std::string terminal(int width, int height);
std::string headline(std::string text);
std::string axis_name(const std::string& quantity);

/// Every y of the report over x: all in one plot, or a plot for each value of report.panels.
void add_curves(const StudyResults& all, const std::string& x, std::vector<StudyPlot>& plots);

}  // namespace nanson
