#!/usr/bin/env bash
# scripts/put_between_marks.sh DOCUMENT NAME: replaces what stands between <!-- NAME: begin --> and <!-- NAME: end --> by
# the standard input.
set -euo pipefail
document=${1:?which document?}
name=${2:?between which marks?}
for mark in begin end; do
  grep -q "^<!-- $name: $mark -->" "$document" || { echo "$document: no line <!-- $name: $mark -->" >&2; exit 1; }
done
{
  sed "/^<!-- $name: begin -->/q" "$document"
  printf '\n%s\n\n' "$(cat)"
  sed -n "/^<!-- $name: end -->/,\$p" "$document"
} > "$document.new"
mv "$document.new" "$document"
