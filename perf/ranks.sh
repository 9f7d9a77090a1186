#!/usr/bin/env bash
# ranks.sh TREAD SCENE ROUNDS [tread option...]: rolls the scene on one process with two threads, and on two ranks with
# one, in turn, ROUNDS times over; prints times of rolling [s], their ratio and the traffic of a step; checks the state
# hashes. The preload comes from a cache after the first run.
set -euo pipefail
export LC_ALL=C # numbers with a decimal point
[[ $# -ge 3 && $1 != --help ]] || { sed -n '2,/^[^#]/s/^# //p' "$0"; exit; }
tread=$1 scene=$2 rounds=$3
shift 3
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

roll() { # FOLDER [launcher...]
  local folder=$1 launcher=("${@:2}")
  "${launcher[@]}" "$tread" run "$scene" -o "$folder" --cache "$work/cache" --overwrite "${options[@]}" 2>"$folder.log" ||
    { cat "$folder.log" >&2; exit 1; }
}
value() { sed -n "s/^ *\"$2\": \"\{0,1\}\([^\",]*\).*/\1/p" "$1/summary.json" | head -n 1; }

ratios=()
for ((round = 1; round <= rounds; ++round)); do
  options=("$@" -t 2)
  roll "$work/threads"
  options=("$@" -t 1)
  roll "$work/ranks" mpirun -n 2
  [[ $(value "$work/threads" state_hash) == "$(value "$work/ranks" state_hash)" ]] || { echo "the bits differ"; exit 1; }
  a=$(value "$work/threads" rolling_s) b=$(value "$work/ranks" rolling_s)
  ratios+=("$(awk "BEGIN { printf \"%.3f\", $b / $a }")")
  echo "round $round: threads $a s, ranks $b s, ratio ${ratios[-1]}"
done
printf '%s\n' "${ratios[@]}" | sort -n | awk '{ r[NR] = $1 } END { print "ratio: median", r[int((NR + 1) / 2)], "of", r[1], "to", r[NR] }'
grep '^\[ranks\].*in a step' "$work/ranks.log"
