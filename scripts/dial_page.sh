#!/usr/bin/env bash
# scripts/dial_page.sh DIR: takes what `tread dial docs/dial/corrugation-d.toml -o DIR` has left: the picture into
# docs/dial/, the lines into share/dial/, the tables between the marks of docs/dial.md.
set -euo pipefail
root="$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")"
results=${1:?which folder? see the head of this file}

cp "$results/dial.svg" "$root/docs/dial/corrugation-d.svg"
cp "$results/dial.jsonl" "$root/share/dial/highspeed-slab-2014.jsonl"
"$root/scripts/put_between_marks.sh" "$root/docs/dial.md" 'tread dial' < "$results/results.md"
