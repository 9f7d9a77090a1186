#!/usr/bin/env bash
# scripts/keep_passage.sh RUN DIR: keeps of the finished run RUN what `tread dial --reference DIR` and a reader want: summary,
# scene, the main columns of its histories and the patch's axis on the rail, to seven digits.
set -euo pipefail
export LC_ALL=C # numbers with a decimal point
root="$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")"
run=${1:?which run? see the head of this file}
kept=${2:?which folder? see the head of this file}
columns='time wheel_x vertical_force longitudinal_force patch_area slip_area max_pressure max_shear creepage_mean frictional_work energy_residual'

# table FILE [NAME...]: its named columns, or all.
table() {
  awk -F, -v OFS=, -v names="${*:2}" '
    NR == 1 {
      for (i = 1; i <= NF; ++i) {
        name = $i
        sub(/ \[.*/, "", name)
        at[name] = i
        if (names == "") place[++count] = i
      }
      asked = split(names, wanted, " ")
      for (k = 1; k <= asked; ++k) {
        if (!(wanted[k] in at)) { print FILENAME ": no column " wanted[k] > "/dev/stderr"; exit 1 }
        place[++count] = at[wanted[k]]
      }
    }
    {
      for (k = 1; k <= count; ++k) {
        value = $place[k]
        if (NR > 1 && value != "") value = sprintf("%.7g", value)
        printf "%s%s", value, k < count ? OFS : "\n"
      }
    }' "$1"
}

mkdir -p "$kept"
cp "$run/summary.json" "$kept/"
sed "s#$root/##" "$run/scene.resolved.toml" > "$kept/scene.resolved.toml"
# shellcheck disable=SC2086
table "$run/histories.csv" $columns > "$kept/histories.csv"
table "$run/surface_axis.csv" > "$kept/surface_axis.csv"
