#!/usr/bin/env python3
"""Prints what rounding does to a run as Markdown: precision_table.py DOUBLE RUN...

Folders of one scene in double and in other precisions. A row a quantity: the largest difference from double over all
samples, over the largest value in double.
"""
import csv
import os
import sys

ROWS = (
    ("F_N", "vertical_force [N]"),
    ("F_L", "longitudinal_force [N]"),
    ("largest pressure", "max_pressure [Pa]"),
    ("largest shear stress", "max_shear [Pa]"),
    ("creepage, single samples", "creepage_mean [-]"),
    ("patch area", "patch_area [m2]"),
    ("frictional work", "frictional_work [J]"),
    ("strain energy", "strain_energy [J]"),
)


def read(folder):
    try:
        with open(os.path.join(folder, "histories.csv"), encoding="utf-8", newline="") as file:
            return list(csv.DictReader(line for line in file if not line.startswith("#")))
    except OSError as error:
        sys.exit(f"{error.filename}: {error.strerror}: name the folder of a run")


if len(sys.argv) < 3:
    sys.exit(__doc__)
exact, *rounded = [read(folder) for folder in sys.argv[1:]]
for folder, samples in zip(sys.argv[2:], rounded):
    if [sample["time [s]"] for sample in samples] != [sample["time [s]"] for sample in exact]:
        sys.exit(f"{folder}: its samples are not those of {sys.argv[1]}: run the same scene to the same end")


def column(run, name):
    return [float(sample[name]) for sample in run]


print("| | " + " | ".join(os.path.basename(os.path.normpath(folder)) for folder in sys.argv[2:]) + " |")
print("|---|" + "--:|" * len(rounded))
for name, key in ROWS:
    values = column(exact, key)
    largest = max(map(abs, values))
    if largest == 0:
        continue
    apart = [max(abs(a - b) for a, b in zip(values, column(run, key))) / largest for run in rounded]
    print(f"| {name} | " + " | ".join(f"{value:.1e}" for value in apart) + " |")
creepage = "creepage_mean [-]"
means = [sum(column(run, creepage)) / len(run) for run in (exact, *rounded)]
print("| creepage, mean of all samples | " + " | ".join(f"{abs(mean / means[0] - 1):.1e}" for mean in means[1:]) + " |")
residual = "energy_residual [J]"
print(f"| residual of the energy at the end (double: {float(exact[-1][residual]):.3f} J) | "
      + " | ".join(f"{float(run[-1][residual]):.3f} J" for run in rounded) + " |")
