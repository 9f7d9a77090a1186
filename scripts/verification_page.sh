#!/usr/bin/env bash
# scripts/verification_page.sh [CASE...]: runs `tread verify` as listed below for the named cases (default: all, some
# hours) and puts the pages of docs/records/verification/ between the marks of docs/records/verification.md.
# With --collect nothing is run. The tables of README.md and of docs/explanation/how-accurate.md follow. Exit status 1: a
# run failed, named at the end; a bound that fails stands in the page. `tread verify extremes` runs the other cases.
set -euo pipefail
export LC_ALL=C # numbers with a decimal point
root="$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")"
pages="$root/docs/records/verification"
document="$root/docs/records/verification.md"

# One run a line: the case and its inputs; the order is that of the document.
runs=(
  'hertz_sphere'
  'hertz_sphere --set "element_size=2.2 mm"'
  'hertz_sphere --set "element_size=0.55 mm"' # 12 minutes of a core
  'hertz_ellipse'
  'hertz_ellipse --set "element_size=2.2 mm"'
  'hertz_ellipse --set "element_size=0.55 mm"' # 25 minutes of a core
  'surface_depths'
  'surface_depths --set "element_size=0.7 mm"'
  'profiles_in_contact'
  'profiles_in_contact --set "element_size=2.2 mm"'
  'profiles_in_contact --set "element_size=1.6 mm"'
  'profiles_in_contact --set "element_size=0.55 mm" --set "last=1 mm"'
  'contact_filter'
  'cattaneo_mindlin'
  'cattaneo_mindlin --set "element_size=2.2 mm"'
  'carter'
  'carter --set exploitation=0.2'
  'carter --set "element_size=0.5 mm"'
  'carter --set "element_size=0.5 mm" --set exploitation=0.2'
  'steady_rolling'
  'steady_rolling --set mu=0.1'
  'steady_rolling --set "element_size=2.2 mm"'
  'steady_rolling --set "element_size=0.55 mm"' # 1.6 million elements: 20 minutes of a core
  'steady_rolling --set "element_size=0.55 mm" --set mu=0.1'
  'transient'
  'von_mises'
  'von_mises --set "element_size=2.2 mm"'
  'sliding'
  'rail_on_fastenings'
  'rail_waves'
  'fastening_passing'
  'fastening_passing --set over_pad=0'
  'fastening_passing --set held=0'
  'fastening_passing --set "speed=500 km/h"'
  'fastening_passing --set "damping=50 kN s/m"'
  'wheelset_settling'
  'wheelset_settling --set "stiffness=60 MN/m"'
  'wheelset_settling --set "damping=50 kN s/m"'
  'wheelset_modes'
  'wheel_receptance'
  'ring_modes'
  'moving_frames'
  'moving_frames --set rolling_steps=1e6' # 41 minutes of a core
  'moving_frames --set rolling_steps=1e6 --set damping=0.02'
)

order=$(printf '%s\n' "${runs[@]%% *}" | awk '!seen[$0]++')
for case in "$@"; do
  [[ $case == --collect ]] || grep -qxF -e "$case" <<< "$order" ||
    { echo "scripts/verification_page.sh: no run of '$case' is listed; listed are ${order//$'\n'/, }" >&2; exit 2; }
done

begun=$(mktemp)
trap 'rm -f "$begun"' EXIT
failed=()
for run in "${runs[@]}"; do
  case=${run%% *}
  [[ ${1:-} == --collect ]] && break
  [[ $# -gt 0 && " $* " != *" $case "* ]] && continue
  touch "$begun"
  status=0
  eval "\"$root/build/release/tread\" verify $run -o \"$pages\"" || status=$?
  # 3: a bound fails, which the page shows, or the run stopped and left no page.
  [[ $status == 0 || ($status == 3 && -n $(find "$pages" -name "$case*.md" -exec test ! "$begun" -nt {} \; -print)) ]] ||
    failed+=("$run: exit code $status")
done

for case in $order; do
  printf '### %s\n\n' "$case"
  for page in "$pages/$case".md "$pages/$case"-*.md; do
    [[ -f $page ]] && sed 's#](#](verification/#g' "$page"
  done
  printf '\n'
done | "$root/scripts/put_between_marks.sh" "$document" 'tread verify'
"$root/scripts/accuracy_table.py"
((${#failed[@]} == 0)) || {
  printf 'failed: %s\n' "${failed[@]}" >&2
  exit 1
}
