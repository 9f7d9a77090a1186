#!/usr/bin/env bash
# scripts/work_factors.sh DIR: runs scenes/studies/wavelengths.toml once as it stands and once with each factor changed,
# and prints the ranges of the frictional work as Markdown. Called again it goes on where it was stopped.
set -euo pipefail
root="$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")"
results=${1:?which folder? see the head of this file}
mkdir -p "$results"

# Name of the factor and its key, one a line.
factors='as it stands |
elements of 4 mm | scene.element_size=4 mm
penalty for 0.5 % of the approach | contact.penetration_ratio=0.005
penalty for 8 % of the approach | contact.penetration_ratio=0.08
T1 = 0.1 ms | motion.traction.ramp=0.1 ms
T1 = 10 ms | motion.traction.ramp=10 ms
sprung mass free along x | vehicle.longitudinal=free
wheel with brake rings | wheel.brake_rings=true
axle with a bore of 110 mm | wheel.axle_bore=110 mm
fastenings of 200 kN s/m | fastenings.damping=200 kN s/m
fastenings of 50 kN s/m | fastenings.damping=50 kN s/m
A at 5.975 m | rail.origin=5.975 m
A at 6.1 m | rail.origin=6.1 m
A at 6.3 m | rail.origin=6.3 m
foot free along x | fastenings.along=free
lateral offset of 2.85 mm | wheel.lateral_offset=2.85 mm'

folder_of() { tr -c 'A-Za-z0-9.\n' _ <<< "$1"; }
while IFS='|' read -r name key; do
  name=${name% }
  "$root/build/release/tread" sweep "$root/scenes/studies/wavelengths.toml" ${key:+--set "${key# }"} \
    -o "$results/$(folder_of "$name")" >&2 < /dev/null
done <<< "$factors"

printf '| | work, range, 65 / 80 / 95 mm [mJ] | 95 over 80 mm | largest F_N, 65 / 80 / 95 mm [kN] | largest F_L, 65 / 80 / 95 mm [kN] |\n'
printf '|---|---|---|---|---|\n'
while IFS='|' read -r name _; do
  name=${name% }
  python3 - "$name" "$results/$(folder_of "$name")/sweep.csv" << 'PYTHON'
import csv
import sys

with open(sys.argv[2], encoding="utf-8", newline="") as file:
    points = list(csv.DictReader(file))
column = lambda name, scale, digits: " / ".join(f"{float(p[name]) * scale:.{digits}f}" for p in points)
work = [float(p["axis_cell_work_range [J]"]) for p in points]
cells = [sys.argv[1], column("axis_cell_work_range [J]", 1e3, 1), f"{work[2] / work[1]:.2f}",
         column("vertical_force_max [N]", 1e-3, 0), column("longitudinal_force_max [N]", 1e-3, 0)]
print("| " + " | ".join(cells) + " |")
PYTHON
done <<< "$factors"
