// What a study leaves to read: runs.csv, plots as SVG and one page, report.html.
#pragma once
#include <string>
#include <vector>

#include "io/study/study_results.hpp"

namespace nanson {

/// A plot: its gnuplot script, and the SVG once gnuplot has made it.
struct StudyPlot {
  std::string name;  // of the file and of its place in the page: "plot-1"
  std::string title, caption;
  std::string script;
  std::string svg;  // empty: not made
};

/// One row a run: varied keys, verdict, quantities, rates, cost, where it was made.
std::string study_csv(const StudyResults& all);

/// The plots that this kind of study has, those without a point left out.
std::vector<StudyPlot> study_plots(const StudyResults& all);

/// Calls gnuplot on each script, keeps the SVG in the folder and in the plot; returns what to tell the user.
std::vector<std::string> draw(std::vector<StudyPlot>& plots, const std::filesystem::path& folder);

/// The page, with the plots inside it: valid as HTML and as XML.
std::string study_page(const StudyResults& all, const std::vector<StudyPlot>& plots);

/// All of it into the study's folder; returns the lines that say what was written, and what could not be.
std::vector<std::string> write_study(const StudyResults& all);

/// A word as a shell reads it back.
std::string shell_quoted(const std::string& word);

/// Text for HTML and XML; control characters, which XML forbids, become spaces.
std::string escaped(const std::string& text);

/// Columns of the table of runs, the same in runs.csv and on the page.
std::vector<std::string> quantity_columns(const StudyResults& all);

}  // namespace nanson
