#!/usr/bin/env bash
# Checks and measures a card: perf/device.sh BUILD OUT. BUILD was made with -D TREAD_CUDA=ON; OUT gets a file for
# each measurement. Ten minutes on an H200 with 16 cores; the shortest come first.
set -euo pipefail
build=$1
out=$2
mkdir -p "$out"
nvidia-smi --query-gpu=name,driver_version,memory.total --format=csv >"$out/card.csv"
"$build/tread" version >"$out/version.txt"
"$build/tests/test_gpu" >"$out/tests.txt" || { tail -20 "$out/tests.txt"; exit 1; }
"$build/tread" bench kernels --device gpu --elements 1460000 --json >"$out/kernels.json"
for quality in draft paper; do
  for precision in double mixed single; do
    "$build/tread" bench hotspots corrugation-d -q "$quality" --device gpu --set "scene.precision=$precision" \
      --steps 400 --repetitions 3 --quiet >"$out/hotspots-$quality-$precision.txt"
    tail -3 "$out/hotspots-$quality-$precision.txt"
  done
done
if command -v compute-sanitizer >/dev/null; then
  for tool in memcheck racecheck; do
    compute-sanitizer --tool "$tool" "$build/tread" bench hotspots tyre --device gpu --steps 3 --repetitions 1 \
      >"$out/$tool.txt" 2>&1 || true
    tail -1 "$out/$tool.txt"
  done
fi
for quality in draft paper; do
  for precision in mixed double; do
    /usr/bin/time -f "$quality $precision %e s" "$build/tread" run corrugation-d -q "$quality" --device gpu \
      --set "scene.precision=$precision" -o "$out/run-$quality-$precision" --quiet 2>>"$out/passages.txt"
    tail -1 "$out/passages.txt"
  done
done
