#include "drivers/studies/study/finished_run.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "core/error.hpp"
#include "drivers/engine/model/evaluated_stretch.hpp"
#include "drivers/engine/model/sections.hpp"
#include "io/files/hdf5_file.hpp"
#include "io/text/text_file.hpp"

namespace tread {

namespace {

[[noreturn]] void refuse_damaged(const std::filesystem::path& folder, const InputError& error) {
  throw InputError(
      fmt::format("{}; the results of this finished run are damaged: remove {}, and start the run "
                  "or its study again with the same command",
                  error.what(), folder.string()));
}

/// Returns false if the wheel has not come to the corrugation over which the summary is to evaluate the run.
bool has_reached(const FinishedRun& run) {
  const std::optional<double> last = run.number("evaluated_x_m.1");
  const Corrugation corrugation = run.corrugation();
  if (!last || corrugation.smooth() || stands(run.scene)) return true;
  return *last >= evaluated_stretch(run.scene, corrugation).first;
}

/// Returns true for a number of the summary that tells of the evaluated stretch.
bool is_evaluated(const std::string& path) {
  constexpr std::array kEvaluated = {
      "vertical_force_N.",    "longitudinal_force_N.", "lateral_force_N.", "lateral_creepage.",
      "spin_creepage_per_m.", "creepage_max_percent",  "full_slip_share",  "surface.",
      "evaluated_x_m."};
  return std::ranges::any_of(kEvaluated, [&](const char* begin) { return path.starts_with(begin); });
}

}  // namespace

Corrugation FinishedRun::corrugation() const {
  return scene.corrugation ? corrugation_of(*scene.corrugation, 0) : Corrugation();
}

std::optional<double> FinishedRun::result(const std::string& path) const {
  return reached || !is_evaluated(path) ? number(path) : std::nullopt;
}

FinishedRun read_finished_run(const std::filesystem::path& folder, const Scene& scene,
                              const std::string& label) {
  constexpr std::size_t kLargest = 1 << 24;  // [B]
  const std::filesystem::path summary = folder / "summary.json";
  try {
    FinishedRun run{label, folder, scene, parse_json(read_text_file(summary, kLargest), summary.string())};
    run.reached = has_reached(run);
    return run;
  } catch (const InputError& error) {
    refuse_damaged(folder, error);
  }
}

void require_sound_results(const FinishedRun& run) {
  std::vector<std::string> needed = {"elements", "steps", "dt_s"};
  if (run.rolled())
    for (const char* path : {"vertical_force_N.mean", "vertical_force_N.min", "vertical_force_N.max",
                             "longitudinal_force_N.mean", "max_pressure_Pa", "frictional_work_J"})
      needed.emplace_back(path);
  const auto missing = [&](const std::string& path) { return !run.number(path); };
  for (const ResultColumn& column : result_columns())
    if (run.summary.contains(column.path) && !column.truth) needed.push_back(column.path);
  const auto wrong = std::find_if(needed.begin(), needed.end(), missing);
  try {
    if (wrong != needed.end())
      throw InputError(
          fmt::format("{}: '{}' is not a number", (run.folder / "summary.json").string(), *wrong));
    if (run.scene.motion) Hdf5File::open_to_read(run.folder / "run.h5");
  } catch (const InputError& error) {
    refuse_damaged(run.folder, error);
  }
}

std::vector<std::string> warnings_in(const JsonRecord& summary) {
  std::vector<std::string> texts;
  const auto next = [&] { return text_in(summary, fmt::format("warnings.{}", texts.size())); };
  for (std::string text = next(); !text.empty(); text = next()) texts.push_back(std::move(text));
  return texts;
}

void add_warnings(const std::vector<std::string>& texts, const std::string& label,
                  std::vector<SharedWarning>& all) {
  for (const std::string& text : texts) {
    auto known = std::ranges::find(all, text, &SharedWarning::text);
    if (known == all.end()) known = all.insert(known, SharedWarning{text, {}});
    known->labels.push_back(label);
  }
}

std::vector<SharedWarning> shared_warnings(const std::vector<FinishedRun>& runs) {
  std::vector<SharedWarning> all;
  for (const FinishedRun& run : runs) add_warnings(warnings_in(run.summary), run.label, all);
  return all;
}

const FinishedRun* find_run(const std::vector<FinishedRun>& runs, const std::string& label) {
  const auto found =
      std::find_if(runs.begin(), runs.end(), [&](const FinishedRun& run) { return run.label == label; });
  return found == runs.end() ? nullptr : &*found;
}

CurvePoints first_passage(const CurvePoints& points) {
  CurvePoints first;
  for (std::size_t i = 0; i < points.x.size(); ++i)
    if (first.x.empty() || points.x[i] > first.x.back()) {
      first.x.push_back(points.x[i]);
      first.y.push_back(points.y[i]);
    }
  return first;
}

CurvePoints read_curve(const FinishedRun& run, const RunCurve& curve) {
  std::vector<std::vector<double>> columns;
  try {
    columns = read_history(run.folder / curve.file, {curve.x, curve.y});
  } catch (const InputError& error) {
    refuse_damaged(run.folder, error);
  }
  for (double& x : columns[0]) x *= curve.x_scale;
  for (double& y : columns[1]) y *= curve.y_scale;
  return {std::move(columns[0]), std::move(columns[1])};
}

const std::vector<ResultColumn>& result_columns() {
  static const std::vector<ResultColumn> columns = {
      {"static_wheel_load", "N", "static_wheel_load_N", "Static F_N [kN]", 1e-3},
      {"static_max_pressure", "Pa", "static_max_pressure_Pa", "Static pressure [MPa]", 1e-6, 1, true},
      {"static_patch_area", "m2", "static_patch_area_m2", "Static area [mm2]", 1e6, 1, true},
      {"contact_centre_y", "m", "contact_centre_y_m", "Middle across [mm]", 1e3, 1, true},
      {"rail_deflection", "m", "rail_deflection_m", "Rail deflection [mm]", 1e3, 1, true},
      {"wheel_tilt", "rad", "wheel_tilt_rad", "Wheel tilt [mrad]", 1e3, 1, true},
      {"rail_tilt", "rad", "rail_tilt_rad", "Rail tilt [mrad]", 1e3, 1, true},
      {"vertical_force_max", "N", "vertical_force_N.max", "Largest F_N [kN]", 1e-3},
      {"vertical_force_min", "N", "vertical_force_N.min", "Smallest F_N [kN]", 1e-3},
      {"vertical_force_mean", "N", "vertical_force_N.mean", "", 1e-3},
      {"longitudinal_force_max", "N", "longitudinal_force_N.max", "F_L, max [kN]", 1e-3},
      {"longitudinal_force_min", "N", "longitudinal_force_N.min", "F_L, min [kN]", 1e-3},
      {"longitudinal_force_mean", "N", "longitudinal_force_N.mean", "Mean F_L [kN]", 1e-3},
      {"lateral_force_max", "N", "lateral_force_N.max", ""},
      {"lateral_force_min", "N", "lateral_force_N.min", ""},
      {"lateral_force_mean", "N", "lateral_force_N.mean", ""},
      {"lateral_creepage_max", "-", "lateral_creepage.max", ""},
      {"lateral_creepage_min", "-", "lateral_creepage.min", ""},
      {"lateral_creepage_mean", "-", "lateral_creepage.mean", ""},
      {"spin_creepage_max", "1/m", "spin_creepage_per_m.max", ""},
      {"spin_creepage_min", "1/m", "spin_creepage_per_m.min", ""},
      {"spin_creepage_mean", "1/m", "spin_creepage_per_m.mean", ""},
      {"passed", "-", "passed", "Passed", 1, 1, false, true},
      {"traction_steady", "-", "traction_steady", "Steady", 1, 1, false, true},
      {"traction_coefficient_steady", "-", "traction_coefficient", ""},
      {"creepage_steady", "-", "creepage_percent", "Creepage [%]", 100, 1e-2},
      {"creepage_max", "-", "creepage_max_percent", "Largest creepage [%]", 100, 1e-2},
      {"full_slip_share", "-", "full_slip_share", "Full slip [%]", 100},
      {"max_pressure", "Pa", "surface.max_pressure_Pa", "Pressure [MPa]", 1e-6},
      {"max_shear", "Pa", "surface.max_shear_Pa", "Shear [MPa]", 1e-6},
      {"max_von_mises", "Pa", "surface.max_von_mises_Pa", "Von Mises [MPa]", 1e-6},
      {"axis_von_mises_mean", "Pa", "surface.axis_max_von_mises_Pa.mean", ""},
      {"axis_von_mises_max", "Pa", "surface.axis_max_von_mises_Pa.max", ""},
      {"axis_von_mises_min", "Pa", "surface.axis_max_von_mises_Pa.min", ""},
      {"axis_cell_work_mean", "J", "surface.axis_frictional_work_J_in_1.1_mm_cell.mean", "Work, mean [mJ]",
       1e3},
      {"axis_cell_work_max", "J", "surface.axis_frictional_work_J_in_1.1_mm_cell.max", ""},
      {"axis_cell_work_min", "J", "surface.axis_frictional_work_J_in_1.1_mm_cell.min", ""},
      {"axis_cell_work_range", "J", "surface.axis_frictional_work_range_J_in_1.1_mm_cell", "Work, range [mJ]",
       1e3},
      {"evaluated_first", "m", "evaluated_x_m.0", ""},
      {"evaluated_last", "m", "evaluated_x_m.1", ""},
      {"frictional_work", "J", "frictional_work_J", ""},
      {"energy_error", "-", "energy_error", ""},
      {"elements", "-", "elements", ""},
      {"steps", "-", "steps", "Steps"},
      {"dt", "s", "dt_s", ""},
      {"preload_time", "s", "preload_s", ""},
      {"rolling_time", "s", "rolling_s", "Rolling [s]"},
  };
  return columns;
}

std::optional<double> result_of(const FinishedRun& run, const ResultColumn& column) {
  if (column.truth && run.summary.contains(column.path)) return truth_in(run.summary, column.path) ? 1 : 0;
  const std::optional<double> value = run.result(column.path);
  return value ? std::optional(column.si_scale * *value) : std::nullopt;
}

}  // namespace tread
