#!/usr/bin/env bash
# kill_runs.sh TREAD SCENE KILLS [--set key=value ...]: runs the scene once through, then again while it is ended at
# random times KILLS times over (by SIGKILL; every third time by SIGTERM) and resumed on one or two threads, and
# compares the files. KILLS_LONGEST: longest time between two kills [s], by default that of the whole run.
set -euo pipefail
export LC_ALL=C # numbers with a decimal point
tread=$1 scene=$2 kills=$3
shift 3
command -v h5diff >/dev/null || { echo "there is no h5diff; the Debian package hdf5-tools has it"; exit 1; }
export OMP_WAIT_POLICY=passive TREAD_CACHE=off
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

started=$(date +%s%N)
"$tread" run "$scene" -t 1 --quiet -o "$work/whole" "$@"
longest=${KILLS_LONGEST:-$(awk "BEGIN { print ($(date +%s%N) - $started) / 1e9 }")}

command=("$tread" run "$scene" -o "$work/killed" "$@" --set "output.checkpoint_interval=100 ms")
done_kills=0 finished=no
while ((done_kills < kills)); do
  if [[ $finished = yes ]]; then  # the kills came too late: once more from the start
    rm -rf "$work/killed"
    command=("$tread" run "$scene" -o "$work/killed" "$@" --set "output.checkpoint_interval=100 ms")
    finished=no
  fi
  "${command[@]}" -t $((1 + done_kills % 2)) --quiet 2>"$work/errors" &
  process=$!
  sleep "$(awk "BEGIN { srand($RANDOM); print rand() * $longest }")"
  signal=KILL
  if ((done_kills % 3 == 2)); then signal=TERM; fi
  kill -s $signal $process 2>/dev/null || true
  code=0
  wait $process 2>/dev/null || code=$?
  case $code in
    0) finished=yes ;;
    75 | 137) done_kills=$((done_kills + 1)) ;;
    *)
      echo "ended by $code: $(cat "$work/errors")"
      exit 1
      ;;
  esac
  # Killed before it had written down what it was asked for: nothing to resume.
  if [[ -e $work/killed/checkpoint/order.h5 ]]; then command=("$tread" resume "$work/killed"); fi
done
if [[ $finished = no ]]; then "${command[@]}" -t 1 --quiet; fi

hash() { sed -n 's/.*"state_hash": "\(.*\)".*/\1/p' "$1/summary.json"; }
for file in histories.csv surface_axis.csv; do
  if [[ -e $work/whole/$file ]]; then cmp "$work/whole/$file" "$work/killed/$file"; fi
done
[[ $(hash "$work/whole") = "$(hash "$work/killed")" ]] || { echo "the state hashes differ"; exit 1; }
for file in run.h5 patch.h5 surface.h5; do
  if [[ -e $work/whole/$file ]]; then h5diff "$work/whole/$file" "$work/killed/$file"; fi
done
echo "$kills kills: the same files, state hash $(hash "$work/killed")"
