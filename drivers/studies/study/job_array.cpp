#include "drivers/studies/study/job_array.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "core/error.hpp"
#include "drivers/process/child_process.hpp"
#include "drivers/studies/study/study_runner.hpp"
#include "io/files/named_output.hpp"
#include "io/text/text.hpp"

namespace tread {

namespace {

std::string shell_words(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += " " + shell_word(word);
  return text;
}

/// An element of the array: the folder of its run, the words after "tread", threads and device for resuming,
/// and whether a failed run begins anew.
std::string element(const StudyPlan& plan, const PlannedPoint& point, std::size_t number) {
  const bool anew = point.status.state == PointState::failed && point.status.anew;
  return fmt::format("{}) folder={} words=({} ) place=({} ) anew={} ;;\n", number,
                     shell_word(point.folder.string()),
                     shell_words(point_arguments(plan, point, plan.threads)),
                     shell_words(place_arguments(plan, plan.threads)), anew ? 1 : 0);
}

}  // namespace

void write_job_array(const StudyPlan& plan, const std::filesystem::path& script, bool retry,
                     const std::string& command) {
  std::string elements;
  std::size_t count = 0;
  for (const PlannedPoint& point : plan.points)
    if (point.to_run(retry)) elements += element(plan, point, count++);
  if (count == 0) throw InputError("--slurm: no point is left to run");
  const std::string text = fmt::format(
      R"(#!/bin/bash
# Job array of {title}: sbatch {script}. State partition, cores, memory and time by options of sbatch.
# Then `{command}` without --slurm collects the results.
#SBATCH --array=0-{last}
#SBATCH --open-mode=append
#SBATCH --requeue
tread={program}
case ${{SLURM_ARRAY_TASK_ID:?it is an element of a job array}} in
{elements}*) echo "there is no element $SLURM_ARRAY_TASK_ID" >&2; exit 2 ;;
esac
if ((anew)) && [[ -e $folder/failed.json ]]; then
  : # queued again, it goes on
elif [[ -d $folder/checkpoint || -e $folder/summary.json ]]; then # of a finished run it says so
  words=(resume "$folder" "${{place[@]}}")
fi
rm -f "$folder/failed.json"
"$tread" "${{words[@]}}" &
run=$!
trap 'kill -TERM $run' TERM
while :; do
  wait $run; code=$?
  kill -0 $run 2>/dev/null || break
done
if ((code == 75)); then
  scontrol requeue "$SLURM_JOB_ID"
fi
exit $code
)",
      fmt::arg("title", plan.study.name), fmt::arg("script", script.string()), fmt::arg("command", command),
      fmt::arg("last", count - 1), fmt::arg("program", shell_word(own_program().string())),
      fmt::arg("elements", elements));
  write_named_text(script, text);
}

}  // namespace tread
