#!/usr/bin/env bash
# Compares the bits of two builds: state hashes of short runs, portable lanes.
#
#   perf/state_hashes.sh PROGRAM [OTHER]      PROGRAM: for example build/release/tread, OTHER: that of another build
#
# Scenes: a wave in a bar, a tyre on a block, a hammer blow, corrugation D, short and on coarse elements; each in three
# precisions. Prints a table; exits 3 where the programs differ. TREAD_HASH_SCENES, names separated by spaces, chooses.
set -euo pipefail

here=$(cd "$(dirname "$0")" && pwd)
programs=("${@:?which program? see the head of this file}")
scenes=${TREAD_HASH_SCENES:-bar-wave tyre hammer corrugation-d}
export TREAD_INSTRUCTION_SET=${TREAD_INSTRUCTION_SET:-baseline} TREAD_CACHE=off OMP_WAIT_POLICY=passive
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# hash_of PROGRAM SCENE PRECISION
hash_of() {
  local options=()
  case $2 in
    corrugation-d) options=(--set "scene.element_size=8 mm" --set "motion.duration=3 ms") ;;
    tyre) options=(--set "scene.element_size=6 mm" --set "motion.duration=2 ms") ;;
    hammer) options=(--set "scene.element_size=8 mm" --set "motion.duration=2 ms") ;;
  esac
  "$1" run "$here/../scenes/$2.toml" -o "$work/out" --overwrite --quiet --precision "$3" \
    --set output.frames=0 "${options[@]}" 2>"$work/log" || { cat "$work/log" >&2; exit 4; }
  sed -n 's/.*"state_hash": "\([0-9a-f]*\)".*/\1/p' "$work/out/summary.json"
}

differing=0
printf '| scene | precision |'
printf ' %s |' "${programs[@]}"
printf '\n|---|---|'
printf -- '---|%.0s' "${programs[@]}"
printf '\n'
for scene in $scenes; do
  for precision in double mixed single; do
    first=
    row="| $scene | $precision |"
    for program in "${programs[@]}"; do
      hash=$(hash_of "$program" "$scene" "$precision")
      row+=" $hash |"
      [[ ${first:=$hash} == "$hash" ]] || differing=3
    done
    echo "$row"
  done
done
exit "$differing"
