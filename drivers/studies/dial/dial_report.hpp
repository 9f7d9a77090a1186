#pragma once
// The report of a dial: tables, picture, report.

#include <string>
#include <vector>

#include "drivers/report/provenance.hpp"
#include "drivers/studies/dial/dial_table.hpp"
#include "drivers/studies/study/study_plan.hpp"

namespace tread {

/// Cost and errors [%], a row a run; of the fluctuation behind a stroke.
Table error_table(const DialTable& table);

/// Shifts [mm].
Table shift_table(const DialTable& table);

/// The cheapest run for some errors, in every quantity.
Table advice_table(const DialTable& table, DialCost cost);

/// Error over cost, a panel a quantity, with the fronts.
Scatter dial_picture(const DialTable& table, DialCost cost);

/// A dial as it stands in its folder.
struct DialOutcome {
  DialTable table;
  DialTable effects;  ///< on one mesh, beside the point that single settings are told against; or no rows
  std::vector<FinishedRun> runs;
  DialCost cost = DialCost::element_steps;
};

/// Its tables with their titles, for docs/records/dial.md.
std::string dial_markdown(const DialOutcome& outcome);

Report dial_report(const DialOutcome& outcome, const StudyPlan& plan, const Provenance& provenance);

}  // namespace tread
