#!/usr/bin/env bash
# scripts/paper_page.sh DIR [NAME]: takes what `tread paper -o DIR` has left: figures as CSV and SVG into docs/paper/ (of
# another quality: docs/paper/NAME/, and what these figures do not answer is left out), the tables of numbers and
# conclusions between the marks of docs/paper.md.
set -euo pipefail
root="$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")"
results=${1:?which folder? see the head of this file}
name=${2:-}
figures=paper${name:+/$name}

mkdir -p "$root/docs/$figures"
cp "$results"/fig*.csv "$results"/fig*.svg "$results/numbers.csv" "$root/docs/$figures/"
{
  if [[ -z $name ]]; then cat "$results/results.md"; else grep -v -e '| – | – |' -e '| not run |' "$results/results.md"; fi
  for picture in "$results"/fig*.svg; do
    figure=$(basename "$picture" .svg)
    printf '\n![Fig. %s](%s/%s.svg)\n' "$(sed 's/^fig0*//' <<< "$figure")" "$figures" "$figure"
  done
} | "$root/scripts/put_between_marks.sh" "$root/docs/paper.md" "tread paper${name:+ $name}"
