#pragma once
// Curves and trends of several runs in one figure.

#include <string>
#include <vector>

#include "drivers/studies/study/finished_run.hpp"
#include "io/report/report.hpp"

namespace tread {

/// As many curves as a panel has colours.
inline constexpr std::size_t kMostCurves = 6;

/// What a panel shows of every run.
struct CurvePanel {
  std::string y_label;  ///< with unit
  RunCurve curve;
  std::string prefix = {};  ///< of the curves' labels, "F_L, "
  double height = 240;
  bool limit = false;  ///< with f F_N, dashed, beside it
};

struct CurvesSpec {
  std::string title;
  std::string x_label = "Position of the wheel [m]";
  std::vector<CurvePanel> panels;
  bool whole_way = false;   ///< from the start; else the corrugation or the solution zone
  bool on_the_rail = true;  ///< lengths on the abscissa are places on the rail, not distances
};

/// The runs' curves overlaid; with the corrugation and the fastenings where all runs have the same. Runs that
/// have not rolled are left out. InputError where a table does not read.
Figure curves_figure(const CurvesSpec& spec, const std::vector<FinishedRun>& runs);

/// A result over the runs.
struct TrendPanel {
  std::string y_label;
  std::vector<std::pair<std::string, std::string>> curves;  ///< label, path in the summary
  double scale = 1;
};

/// A run at its place on the abscissa of a trend; runs of one `group` make one curve.
struct TrendRun {
  const FinishedRun* run;
  double x;
  std::string group = {};
};

/// Mean, largest and smallest values and the like against a quantity that the runs differ in.
Figure trend_figure(std::string title, std::string x_label, const std::vector<TrendPanel>& panels,
                    const std::vector<TrendRun>& runs);

/// Forces, Von Mises stress and frictional work with their fluctuation over the evaluated stretch.
std::vector<TrendPanel> fluctuation_panels();

/// A cell of a CSV file, quoted where it must be.
std::string csv_cell(const std::string& text);

/// The figure's curves as columns over one abscissa: where they have not all the same, over 1000 places at
/// most, with values between samples interpolated.
std::string figure_csv(const Figure& figure);

}  // namespace tread
