#pragma once
// What a finished run left, read back for comparison with others.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/corrugation.hpp"
#include "core/scene.hpp"
#include "io/files/history_reader.hpp"
#include "io/text/json_reader.hpp"

namespace tread {

struct FinishedRun {
  std::string label;  ///< in figures
  std::filesystem::path folder;
  Scene scene;
  JsonRecord summary;  ///< summary.json

  /// Of the summary, by path: "vertical_force_N.max".
  std::optional<double> number(const std::string& path) const { return number_in(summary, path); }
  /// Its centre, which no figure along the rail depends on, is y = 0.
  Corrugation corrugation() const;
  /// Whether a wheel has rolled: histories and the surface are there.
  bool rolled() const { return scene.wheel && scene.motion; }
};

/// InputError where the summary does not read.
FinishedRun read_finished_run(const std::filesystem::path& folder, const Scene& scene,
                              const std::string& label);

/// The first of that label; nullptr: none.
const FinishedRun* find_run(const std::vector<FinishedRun>& runs, const std::string& label);

/// A curve of a run: one column of a table against another.
struct RunCurve {
  std::string file = "histories.csv";  ///< or surface_axis.csv, deflection.csv
  HistoryColumn x = {"wheel_x", "m"};
  double x_scale = 1;
  HistoryColumn y;
  double y_scale = 1;
};

struct CurvePoints {
  std::vector<double> x, y;  ///< x increasing
};

/// Both columns, scaled. InputError.
CurvePoints read_curve(const FinishedRun& run, const RunCurve& curve);

/// A result that the summary states.
struct ResultColumn {
  std::string name;     ///< in CSV, with `unit`
  std::string unit;     ///< SI
  std::string path;     ///< in the summary
  std::string title;    ///< for readers, with their unit; empty: in CSV alone
  double scale = 1;     ///< to the readers' unit
  double si_scale = 1;  ///< from the summary to SI
};

/// Headline results of a run, in the order of tables.
const std::vector<ResultColumn>& result_columns();

/// In SI; nothing where the run has no such result.
std::optional<double> result_of(const FinishedRun& run, const ResultColumn& column);

}  // namespace tread
