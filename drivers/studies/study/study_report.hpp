#pragma once
// Files of a study: sweep.csv and report.html.

#include <string>
#include <vector>

#include "drivers/report/provenance.hpp"
#include "drivers/studies/study/finished_run.hpp"
#include "drivers/studies/study/study_plan.hpp"

namespace tread {

/// Runs of the points that are done, in their order. InputError where a summary does not read.
std::vector<FinishedRun> finished_runs(const StudyPlan& plan);

/// The key's value in a point's scene in the key's unit of documentation, such as "300", with twelve digits:
/// they tell values apart and hide the rounding of units. A text unchanged.
std::string value_text(const PlannedPoint& point, const std::string& key);

/// Keys that any point varies, in order of appearance.
std::vector<std::string> varied_keys(const StudyPlan& plan);

/// Table with a row per point: name, state, varied keys in their units, results in SI. The results of points
/// that are not done are empty.
std::string sweep_csv(const StudyPlan& plan, const std::vector<FinishedRun>& runs);

/// The table of sweep_csv() as JSON. "varied" of a point: by key "value" and "unit", a pure number's "-".
std::string sweep_json(const StudyPlan& plan, const std::vector<FinishedRun>& runs);

/// Distinct warnings of the runs, with the points that have them.
Table warning_table(const std::vector<FinishedRun>& runs);

/// Headline results of the runs for readers.
Table result_table(const std::vector<FinishedRun>& runs);

/// Forces, creepage, Von Mises stress and frictional work of runs that have rolled, over one another: over
/// time if all wheels stand, else without those that stand.
Chapter curve_chapter(std::vector<FinishedRun> rolled);

/// State and values of the points.
Table point_table(const StudyPlan& plan);

Report sweep_report(const StudyPlan& plan, const std::vector<FinishedRun>& runs,
                    const Provenance& provenance);

}  // namespace tread
