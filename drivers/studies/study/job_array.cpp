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

constexpr const char* kScript = R"(#!/bin/bash
# Job array of {title}: sbatch {script}. State partition, cores, memory and time by options of sbatch.
# Then `{command}` collects the results.
#SBATCH --array=0-{last}{limit}
#SBATCH --open-mode=append
#SBATCH --requeue
cd {folder} || exit 4
tread=({start} )
case ${{SLURM_ARRAY_TASK_ID:?it is an element of a job array}} in
{elements}*) echo "there is no element $SLURM_ARRAY_TASK_ID" >&2; exit 2 ;;
esac
if ((anew)) && grep -qs '"exit": [23],' "$folder/failed.json"; then
  : # it would come to the same end; queued again, it goes on
elif ls "$folder"/checkpoint/*.h5 >/dev/null 2>&1; then
  words=(resume "$folder" "${{place[@]}}" "${{changed[@]}}")
elif [[ -e $folder/summary.json ]]; then
  words=(resume "$folder" "${{place[@]}}") # says that the run is finished
fi
rm -f "$folder/failed.json"
before=$(cat "$folder/status.json" 2>/dev/null)
"${{tread[@]}}" "${{words[@]}}" &
run=$!
trap 'kill -TERM $run' TERM
while wait $run; code=$?; kill -0 $run 2>/dev/null; do :; done
# A signal ends that wait: bash keeps the code of a run that ends before its life is asked for.
wait $run 2>/dev/null; last=$?; ((last == 127)) || code=$last
# A launcher may have a code of its own for a run that was stopped.
after=$(cat "$folder/status.json" 2>/dev/null)
if ((code)) && [[ $after != "$before" && $after == *'"stage": "stopped"'* ]]; then code=75; fi
case $code in
0 | 124 | 129 | 130 | 143) ;; # done, or a stop of Slurm's
75) scontrol requeue "$SLURM_JOB_ID" ;;
*)
  signal=0 exit=$code anew=false why="exit $code"
  if ((code > 128)); then signal=$((code - 128)) exit=0 why="signal $((code - 128)) ended it"; fi
  if ((code == 2 || code == 3)); then anew=true; fi
  why+=": see the output of job $SLURM_JOB_ID, element $SLURM_ARRAY_TASK_ID"
  mkdir -p "$folder"
  printf '{{\n  "exit": %d,\n  "signal": %d,\n  "why": "%s",\n  "anew": %s\n}}\n' \
    $exit $signal "$why" $anew >"$folder/failed.json.part" &&
    mv "$folder/failed.json.part" "$folder/failed.json"
  ;;
esac
exit $code
)";

std::string shell_words(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += " " + shell_word(word);
  return text;
}

/// An element of the array: the folder of its run, the words after "tread", threads, device and changed
/// values for resuming, and whether a failed run begins anew.
std::string element(const StudyPlan& plan, const PlannedPoint& point, std::size_t number) {
  const bool anew = point.status.state == PointState::failed && point.status.anew;
  return fmt::format(
      "{}) folder={} words=({} ) place=({} ) changed=({} ) anew={} ;;\n", number,
      shell_word(point.folder.string()), shell_words(point_arguments(plan, point, plan.threads)),
      shell_words(place_arguments(plan, plan.threads)), shell_words(changed_arguments(point)), anew ? 1 : 0);
}

/// The command line without --slurm and its file.
std::string without_slurm(std::string command, const std::string& script) {
  for (const std::string& words : {" --slurm " + shell_word(script), " " + shell_word("--slurm=" + script)})
    if (const std::size_t at = command.find(words); at != std::string::npos)
      return command.erase(at, words.size());
  return command;
}

}  // namespace

void write_job_array(const StudyPlan& plan, const std::filesystem::path& script, bool retry,
                     const std::string& command) {
  for (const std::filesystem::path& input : {std::filesystem::path(plan.study.name), plan.study.scene})
    require_other_file(script, input);
  std::string elements;
  std::size_t count = 0;
  for (const PlannedPoint& point : plan.points)
    if (point.to_run(retry)) elements += element(plan, point, count++);
  if (count == 0) throw InputError("--slurm: no point is left to run");
  const auto at_once = static_cast<std::size_t>(plan.jobs);
  std::vector<std::string> start = plan.launcher;
  start.push_back(own_program().string());
  const std::string text = fmt::format(
      kScript, fmt::arg("title", one_line(plan.study.name)),
      fmt::arg("script", one_line(shell_word(script.string()))),
      fmt::arg("command", one_line(without_slurm(command, script.string()))),
      fmt::arg("folder", shell_word(std::filesystem::current_path().string())), fmt::arg("last", count - 1),
      fmt::arg("limit", at_once < count ? fmt::format("%{}", at_once) : ""),
      fmt::arg("start", shell_words(start)), fmt::arg("elements", elements));
  write_named_text(script, text);
}

}  // namespace tread
