#!/usr/bin/env python3
"""Prints the table of docs/records/run-up.md: runs of `tread sweep run_up` against the longest run-up of their speed.

    scripts/run_up_table.py STUDY...       folders of studies whose points are named SPEED-km-h-RUN_UP-m[-MORE]
"""
import json
import pathlib
import re
import sys

NAME = re.compile(r"(\d+)-km-h-([\d.]+)-m(.*)")
QUANTITIES = [
    ("largest F_N [kN]", lambda s: 1e-3 * s["vertical_force_N"]["max"], 1),
    ("smallest F_N [kN]", lambda s: 1e-3 * s["vertical_force_N"]["min"], 1),
    ("F_L / F_N before it", lambda s: s["traction_coefficient"], 3),
    ("creepage [%]", lambda s: s["creepage_percent"], 4),
    ("largest shear [MPa]", lambda s: 1e-6 * s["surface"]["max_shear_Pa"], 0),
    ("work's range [mJ]", lambda s: 1e3 * s["surface"]["axis_frictional_work_range_J_in_1.1_mm_cell"], 2),
]


def points(folder):
    """Speed [km/h], run-up [m], rest of the name and summary of each finished point."""
    for path in sorted(pathlib.Path(folder).glob("*/summary.json")):
        name = NAME.fullmatch(path.parent.name)
        if name:
            yield int(name[1]), float(name[2]), name[3].strip("-"), json.loads(path.read_text())


def change(here, there):
    return f"{100 * (here / there - 1):+.1f}" if there else "-"


def main(folders):
    print("| km/h | run-up [m] | start | " + " | ".join(name for name, _, _ in QUANTITIES) + " | element-steps |")
    print("|--:|--:|---|" + "--:|" * (len(QUANTITIES) + 1))
    runs = sorted((p for folder in folders for p in points(folder)), key=lambda p: (p[0], -p[1], p[2]))
    longest = {}
    for speed, run_up, start, summary in runs:
        base = longest.setdefault(speed, summary)
        cells = [str(speed), f"{run_up:g}", start or "ramp"]
        for name, value, digits in QUANTITIES:
            text = f"{value(summary):.{digits}f}"
            cells.append(text if base is summary or "F_L" in name else f"{text} ({change(value(summary), value(base))} %)")
        work = summary["elements"] * summary["steps"] / (base["elements"] * base["steps"])
        print("| " + " | ".join(cells) + f" | {work:.2f} |")


if __name__ == "__main__":
    main(sys.argv[1:])
