#pragma once
// Curves and trends of several runs in one figure.

#include <string>
#include <vector>

#include "drivers/studies/study/finished_run.hpp"
#include "io/report/report.hpp"

namespace tread {

/// Number of curves for which a panel has colours.
inline constexpr std::size_t kMostCurves = 6;

/// Curve that a panel shows of every run.
struct CurvePanel {
  std::string y_label;  ///< label with unit
  RunCurve curve;
  std::string prefix = {};  ///< prefix of the curves' labels, such as "F_L, "
  double height = 240;
  bool limit = false;  ///< true with f F_N, dashed, beside it
};

/// The panel over time [ms].
inline CurvePanel over_time(CurvePanel panel) {
  panel.curve.x = {"time", "s"};
  panel.curve.x_scale = 1e3;
  return panel;
}

struct CurvesSpec {
  std::string title;
  std::string x_label = "Position of the wheel [m]";
  std::vector<CurvePanel> panels;
  bool whole_way = false;   ///< true: from the start; false: the corrugation or the solution zone
  bool on_the_rail = true;  ///< true if lengths on the abscissa are places on the rail, not distances
  std::string name = {};    ///< name of the figure's files; empty: it has none
};

/// Overlays the runs' curves, with the corrugation and the fastenings if these are common to all runs. Runs
/// that have not rolled are left out. Throws InputError if a table cannot be read.
Figure curves_figure(const CurvesSpec& spec, const std::vector<FinishedRun>& runs);

/// A result over the runs.
struct TrendPanel {
  std::string y_label;
  std::vector<std::pair<std::string, std::string>> curves;  ///< pairs of label and path in the summary
  double scale = 1;
};

/// A run at its place on the abscissa of a trend. Runs of one `group` make one curve.
struct TrendRun {
  const FinishedRun* run;
  double x;
  std::string group = {};
};

/// Results such as mean, largest and smallest values against a quantity in which the runs differ: a colour a
/// group, a stroke a result.
Figure trend_figure(std::string title, std::string x_label, const std::vector<TrendPanel>& panels,
                    const std::vector<TrendRun>& runs);

/// Forces, Von Mises stress and frictional work with their fluctuation over the evaluated stretch.
std::vector<TrendPanel> fluctuation_panels();

/// The figure's curves, the first_passage() of each, as columns over one abscissa. If the curves have
/// different abscissae, at most 1000 places are written, with values interpolated between samples.
std::string figure_csv(const Figure& figure);

}  // namespace tread
