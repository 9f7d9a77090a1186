#include "drivers/studies/study/sweep.hpp"

#include <fmt/core.h>

#include "drivers/studies/study/study_report.hpp"
#include "io/files/output_file.hpp"
#include "io/report/figure_files.hpp"
#include "io/report/plain_text.hpp"

namespace tread {

std::optional<Error> sweep(const SweepOptions& options) {
  Study study = read_study(options.study);
  add_overrides(study, options.common);
  return run_study(study, options.common, [&](const StudyPlan& plan) {
    const std::vector<FinishedRun> runs = finished_runs(plan);
    write_text_file(plan.folder / "sweep.csv", sweep_csv(plan, runs));
    replace_report(plan.folder / "report.html", sweep_report(plan, runs, options.common.origin));
    if (options.common.json)
      fmt::print("{}", sweep_json(plan, runs));
    else
      fmt::print("{}", plain_text(result_table(runs)));
  });
}

}  // namespace tread
