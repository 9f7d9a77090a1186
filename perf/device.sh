#!/usr/bin/env bash
# Checks and measures a card.
#
#   perf/device.sh BUILD OUT [PART...]      BUILD: made with -D TREAD_CUDA=ON; OUT gets a file for each measurement
#
# Parts: tests, kernels, hotspots, sanitizer, passages; all by default, a quarter of an hour on an H200 with 16 cores.
set -euo pipefail
build=$1
out=$2
shift 2
parts=("${@:-tests kernels hotspots sanitizer passages}")
mkdir -p "$out"
tread=$build/tread

card() {
  nvidia-smi --query-gpu=name,driver_version,memory.total --format=csv | tee "$out/card.csv"
  "$tread" version >"$out/version.txt"
}

tests() {
  "$build/tests/test_gpu" >"$out/tests.txt" || { tail -20 "$out/tests.txt"; return 1; }
  grep -E 'differ by|OK' "$out/tests.txt"
}

kernels() { "$tread" bench kernels --device gpu --elements 1460000 | tee "$out/kernels.txt"; }

# In the run-up, and where the solution zone begins: there the patch has three times as many points. The first
# precision solves the preload, the others find it in the cache.
hotspots() {
  local quality precision start
  for quality in draft paper; do
    for precision in double mixed single; do
      for start in 2.5m 0.02m; do
        echo "$quality $precision, $start before the zone"
        "$tread" bench hotspots corrugation-d -q "$quality" --device gpu --set "scene.precision=$precision" \
          --set "motion.run_up=$start" --steps 400 --repetitions 3 --quiet |
          tee "$out/hotspots-$quality-$precision-$start.txt"
      done
    done
  done
}

sanitizer() {
  local tool
  for tool in memcheck racecheck; do
    compute-sanitizer --tool "$tool" --error-exitcode 1 "$tread" bench hotspots tyre --device gpu --steps 3 \
      --repetitions 1 >"$out/$tool.txt" 2>&1 || { tail -20 "$out/$tool.txt"; return 1; }
    tail -1 "$out/$tool.txt"
  done
}

passages() {
  local quality precision start
  for quality in draft paper; do
    for precision in mixed double; do
      start=$(date +%s)
      "$tread" run corrugation-d -q "$quality" --device gpu --set "scene.precision=$precision" \
        -o "$out/run-$quality-$precision" --overwrite --quiet
      echo "$quality $precision: $(($(date +%s) - start)) s from scene to report" | tee -a "$out/passages.txt"
    done
  done
}

card
# shellcheck disable=SC2068 # names, split at blanks
for part in ${parts[@]}; do "$part"; done
