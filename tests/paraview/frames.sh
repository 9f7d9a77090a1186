#!/usr/bin/env bash
# frames.sh TREAD SCENE [--set key=value ...]: runs the scene and opens its frames with ParaView's own reader. Exit
# status 77: ParaView is not installed (Debian: paraview python3-paraview).
set -euo pipefail
tread=$1 scene=$2
shift 2
export OMP_WAIT_POLICY=passive
if ! command -v pvpython >/dev/null; then
  echo "skipped: there is no pvpython; the Debian packages paraview and python3-paraview have it"
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for cells in faces elements; do
  "$tread" run "$scene" -t 1 --quiet -o "$work/$cells" "$@" --set output.frames=5 --set output.frame_cells=$cells
  QT_QPA_PLATFORM=offscreen pvpython "$(dirname "$0")/frames.py" "$work/$cells" "$cells"
done
