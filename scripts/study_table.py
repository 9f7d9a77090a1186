#!/usr/bin/env python3
"""Prints the table of a study of corrugations as Markdown: study_table.py STUDY/sweep.csv

One row a point: extremes of the forces, creepage before the corrugation, ranges on the patch's axis, as docs/records/paper.md
defines them. `tread sweep` writes the file.
"""
import csv
import sys

if len(sys.argv) != 2:
    sys.exit(__doc__)
with open(sys.argv[1], encoding="utf-8", newline="") as file:
    points = list(csv.DictReader(file))

print("| | F_N, max / min [kN] | F_L, max / min [kN] | creepage before it [%] | work, range on the axis [mJ] | Von Mises, range on the axis [MPa] |")
print("|---|---|---|---|---|---|")
for point in points:
    if point["state"] != "done":
        sys.exit(f"{sys.argv[1]}: {point['point']} is {point['state']}: run the study to its end first")

    def value(column):
        return float(point[column] or "nan") + 0.0  # without contact: 0, not -0

    name = point["point"]
    cells = [
        f"{value('vertical_force_max [N]') / 1e3:.1f} / {value('vertical_force_min [N]') / 1e3:.1f}",
        f"{value('longitudinal_force_max [N]') / 1e3:.1f} / {value('longitudinal_force_min [N]') / 1e3:.1f}",
        f"{value('creepage_steady [-]') * 100:.3f}",
        f"{value('axis_cell_work_range [J]') * 1e3:.1f}",
        f"{(value('axis_von_mises_max [Pa]') - value('axis_von_mises_min [Pa]')) / 1e6:.0f}",
    ]
    cells = ["–" if "nan" in cell else cell for cell in cells]  # the wheel has not reached the corrugation
    print("| " + " | ".join([name if "=" in name else name.replace("-", " "), *cells]) + " |")
