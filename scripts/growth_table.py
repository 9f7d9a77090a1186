#!/usr/bin/env python3
"""Prints growth per millimetre of even wear by wavelength as Markdown: growth_table.py FOLDER...

One column a folder of `tread develop`, named after it; bands whose growth tells something (growth.csv, telling).
"""
import csv
import json
import pathlib
import sys

if len(sys.argv) < 2:
    sys.exit(__doc__)
folders = [pathlib.Path(name) for name in sys.argv[1:]]
growth = {}
for folder in folders:
    with open(folder / "growth.csv", encoding="utf-8", newline="") as file:
        for band in csv.DictReader(file):
            if band["telling"] == "1":
                per_mm = float(band["growth_per_even_wear [1/m]"]) * 1e-3
                growth.setdefault(float(band["wavelength [m]"]), {})[folder] = f"{per_mm:.1f}"

print("| one-third octave [mm] | " + " | ".join(folder.name for folder in folders) + " |")
print("|---" * (len(folders) + 1) + "|")
for wavelength in sorted(growth, reverse=True):
    cells = [growth[wavelength].get(folder, "") for folder in folders]
    print(f"| {wavelength * 1e3:g} | " + " | ".join(cells) + " |")
even = [json.loads((folder / "development.json").read_text())["even_wear_m_per_passage"] * 1e9 for folder in folders]
print("| even wear of a million passages [mm] | " + " | ".join(f"{wear:.2f}" for wear in even) + " |")
