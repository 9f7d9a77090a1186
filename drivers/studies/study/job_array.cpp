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
job=${{SLURM_ARRAY_JOB_ID:?it is an element of a job array}}_$SLURM_ARRAY_TASK_ID
case $SLURM_ARRAY_TASK_ID in
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
show() {{ cat "$folder/status.json" 2>/dev/null; }}
before=$(show) asked=0 own=0
# A request to stop that still lies in the folder of the run is a user's.
note_request() {{
  [[ $(show) == "$before" || $(cat "$folder/request" 2>/dev/null) != stop ]] || asked=1
}}
# A launcher may end a run that it signals before its checkpoint is written: a run that owns its folder reads
# a request there. Another signal, 2 s later or more, ends it at once.
pass_on() {{
  trap '' TERM # bash loses a signal, with an error, while it reads a substitution
  if ((own)); then
    ((SECONDS - since < 2)) || kill -TERM $run
  else
    note_request
    if ((${{#tread[@]}} == 1)) || [[ $(show) == "$before" ]]; then
      kill -TERM $run
    else
      since=$SECONDS own=1
      {{ "${{tread[-1]}}" ctl "$folder" stop --wait 1e6 >/dev/null || kill -TERM $run; }} 2>/dev/null &
    fi
  fi
  trap pass_on TERM
}}
"${{tread[@]}}" "${{words[@]}}" &
run=$!
trap pass_on TERM
while wait $run; code=$?; kill -0 $run 2>/dev/null; do :; done
# A signal ends that wait: bash keeps the code of a run that ends before its life is asked for.
wait $run 2>/dev/null; last=$?; ((last == 127)) || code=$last
trap '' TERM
((own)) || note_request
after=$(show)
# A launcher may have a code of its own for a run that was stopped.
if ((code)) && [[ $after != "$before" && $after == *'"stage": "stopped"'* ]]; then
  code=75
  # By a request, and not by that of this script.
  if ((!own)) && [[ $after == *@(' by tread ctl; '|'"stopped before the first step; ')* ]]; then asked=1; fi
fi
case $code in
0 | 124 | 129 | 130 | 143) ;; # done, or a stop of Slurm's
75)
  if ((asked)); then
    echo "job $job: stopped by tread ctl, not queued again"
  else
    scontrol requeue "$job"
  fi
  ;;
*)
  signal=0 exit=$code anew=false why="exit $code"
  if ((code > 128)); then signal=$((code - 128)) exit=0 why="signal $((code - 128)) ended it"; fi
  if ((code == 2 || code == 3)); then anew=true; fi
  why+=": see the output of job $job, slurm-$job.out unless sbatch states another file"
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
