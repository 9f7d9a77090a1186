#!/usr/bin/env bash
# Cost of plasticity in the rail's head: rolling time of corrugation D with a head of the law j2 over that with the
# elastic law, by precision. Median, smallest and largest ratio of REPEATS pairs of runs, one after the other.
#
#   perf/plastic_head.sh PROGRAM [REPEATS]     on a quiet machine; two minutes
set -euo pipefail
export LC_ALL=C # numbers with a decimal point

here=$(cd "$(dirname "$0")" && pwd)
program=${1:?which program? see the head of this file}
repeats=${2:-3}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export TREAD_CACHE=$work/cache

head=(--set rail.head_material=head --set "material.head.youngs_modulus=205.9 GPa"
  --set material.head.poissons_ratio=0.3 --set "material.head.density=7790 kg/m3")
yielding=(--set material.head.law=j2 --set "material.head.yield_stress=400 MPa"
  --set "material.head.isotropic_hardening=2 GPa")

# rolling PRECISION OPTION...: seconds
rolling() {
  "$program" run "$here/../scenes/corrugation-d.toml" -o "$work/out" --overwrite --quiet --precision "$1" \
    --set "motion.duration=0.4 ms" --set output.frames=0 "${head[@]}" "${@:2}" 2>"$work/log" ||
    { cat "$work/log" >&2; exit 4; }
  sed -n 's/.*"rolling_s": \([0-9.e+-]*\).*/\1/p' "$work/out/summary.json"
}

echo '| precision | j2 over elastic | smallest | largest |'
echo '|---|---|---|---|'
for precision in double mixed single; do
  rolling "$precision" >/dev/null # preloads, page cache
  for ((i = 0; i < repeats; ++i)); do
    elastic=$(rolling "$precision")
    plastic=$(rolling "$precision" "${yielding[@]}")
    awk -v a="$elastic" -v b="$plastic" 'BEGIN { printf "%.3f\n", b / a }'
  done | sort -n | awk -v precision="$precision" '{ ratio[NR] = $1 }
    END { printf "| %s | %s | %s | %s |\n", precision, ratio[int((NR + 1) / 2)], ratio[1], ratio[NR] }'
done
