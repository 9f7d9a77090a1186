#pragma once
// Results of a finished run, read back for comparison with others.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/corrugation.hpp"
#include "core/scene.hpp"
#include "io/files/history_reader.hpp"
#include "io/text/json.hpp"

namespace tread {

struct FinishedRun {
  std::string label;  ///< label in figures
  std::filesystem::path folder;
  Scene scene;
  JsonRecord summary;   ///< content of summary.json
  bool reached = true;  ///< false if the wheel has not come to the corrugation of the scene

  /// The number of the summary at the path, "vertical_force_N.max".
  std::optional<double> number(const std::string& path) const { return number_in(summary, path); }
  /// The same without numbers of a corrugation that the wheel has not reached.
  std::optional<double> result(const std::string& path) const;
  /// Corrugation with its centre at y = 0, on which no figure along the rail depends.
  Corrugation corrugation() const;
  /// Returns true if a wheel has rolled over a rail: forces and surface exist.
  bool rolled() const { return scene.contact && scene.motion; }
};

/// Reads the results in a folder. Throws InputError if the summary cannot be read.
FinishedRun read_finished_run(const std::filesystem::path& folder, const Scene& scene,
                              const std::string& label);

/// Throws InputError where the summary lacks a number that every run has, or states another thing in the
/// place of one, or where the run's histories do not open.
void require_sound_results(const FinishedRun& run);

/// Warnings that a summary states.
std::vector<std::string> warnings_in(const JsonRecord& summary);

/// A warning, and the runs that have it.
struct SharedWarning {
  std::string text;
  std::vector<std::string> labels;
};

/// Adds the texts of `label`, each text once, to `all`.
void add_warnings(const std::vector<std::string>& texts, const std::string& label,
                  std::vector<SharedWarning>& all);

/// Distinct warnings of the runs in order of appearance.
std::vector<SharedWarning> shared_warnings(const std::vector<FinishedRun>& runs);

/// First run of that label; nullptr if there is none.
const FinishedRun* find_run(const std::vector<FinishedRun>& runs, const std::string& label);

/// A curve of a run: one column of a table against another.
struct RunCurve {
  std::string file = "histories.csv";  ///< file: also surface_axis.csv, deflection.csv
  HistoryColumn x = {"wheel_x", "m"};
  double x_scale = 1;
  HistoryColumn y;
  double y_scale = 1;
};

struct CurvePoints {
  std::vector<double> x, y;  ///< points in the order of the file
};

/// The points by increasing x: without those that are not beyond all before. Of a wheel that turns back, its
/// first passage over every place.
CurvePoints first_passage(const CurvePoints& points);

/// Both columns, scaled. Throws InputError if the file cannot be read.
CurvePoints read_curve(const FinishedRun& run, const RunCurve& curve);

/// A result that the summary states.
struct ResultColumn {
  std::string name;      ///< name in CSV, with `unit`
  std::string unit;      ///< SI unit
  std::string path;      ///< path in the summary
  std::string title;     ///< title for readers, with their unit; empty: in CSV alone
  double scale = 1;      ///< factor to the readers' unit
  double si_scale = 1;   ///< factor from the summary to SI
  bool at_rest = false;  ///< shown to readers only where no run rolls
  bool truth = false;    ///< true or false in the summary, 1 or 0 in CSV
};

/// Headline results of a run, in the order of tables.
const std::vector<ResultColumn>& result_columns();

/// Result in SI; nullopt if the run has no such result.
std::optional<double> result_of(const FinishedRun& run, const ResultColumn& column);

}  // namespace tread
