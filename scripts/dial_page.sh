#!/usr/bin/env bash
# scripts/dial_page.sh DIR: takes the results of `tread dial docs/records/dial/corrugation-d.toml -o DIR`: the picture into
# docs/records/dial/, the lines into share/dial/, the tables between the marks of docs/records/dial.md.
set -euo pipefail
root="$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")"
results=${1:?which folder? see the head of this file}

cp "$results/figures/errors.svg" "$root/docs/records/dial/corrugation-d.svg"
cp "$results/dial.jsonl" "$root/share/dial/highspeed-slab-2014.jsonl"
"$root/scripts/put_between_marks.sh" "$root/docs/records/dial.md" 'tread dial' < "$results/results.md"
