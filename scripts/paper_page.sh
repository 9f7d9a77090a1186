#!/usr/bin/env bash
# scripts/paper_page.sh DIR: takes what `tread paper -o DIR` has left: figures as CSV and SVG into docs/paper/, the tables
# of numbers and conclusions between the marks of docs/paper.md.
set -euo pipefail
root="$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")"
results=${1:?which folder? see the head of this file}

mkdir -p "$root/docs/paper"
cp "$results"/fig*.csv "$results"/fig*.svg "$results/numbers.csv" "$root/docs/paper/"
{
  cat "$results/results.md"
  for picture in "$results"/fig*.svg; do
    name=$(basename "$picture" .svg)
    printf '\n![Fig. %s](paper/%s.svg)\n' "$(sed 's/^fig0*//' <<< "$name")" "$name"
  done
} | "$root/scripts/put_between_marks.sh" "$root/docs/paper.md" 'tread paper'
