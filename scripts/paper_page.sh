#!/usr/bin/env bash
# scripts/paper_page.sh DIR [NAME]: takes the results of `tread paper -o DIR`: figures as CSV and SVG into
# docs/records/paper/, tables of numbers and conclusions between the marks of docs/records/paper.md.
# NAME stands for another quality: its figures go into a folder of that name; rows without an answer are left out.
set -euo pipefail
root="$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")"
results=${1:?which folder? see the head of this file}
name=${2:-}
figures=paper${name:+/$name}

mkdir -p "$root/docs/records/$figures"
cp "$results"/fig*.csv "$results"/fig*.svg "$results/numbers.csv" "$root/docs/records/$figures/"
{
  if [[ -z $name ]]; then cat "$results/results.md"; else grep -v -e '| – | – |' -e '| not run |' "$results/results.md"; fi
  for picture in "$results"/fig*.svg; do
    figure=$(basename "$picture" .svg)
    printf '\n![Fig. %s](%s/%s.svg)\n' "$(sed 's/^fig0*//' <<< "$figure")" "$figures" "$figure"
  done
} | "$root/scripts/put_between_marks.sh" "$root/docs/records/paper.md" "tread paper${name:+ $name}"
