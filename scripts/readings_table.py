#!/usr/bin/env python3
"""Prints the table of several paper sets as Markdown: readings_table.py SET...

One row a set, each a folder of `tread paper` with Figs. 8, 10, 15, 16, 18, 20 to 23, 26 to 28; a row is named after its
folder. Conclusion 4 needs Figs. 24 and 25, too; without them it is left out.
"""
import csv
import pathlib
import re
import sys

SPEEDS = (100, 180, 250, 300, 400, 500)
WAVELENGTHS = (65, 80, 95)
NEEDS_TRACTION = 4  # the conclusion that needs passages at several traction coefficients


def lists(text):
    """Lists of numbers in the words of a conclusion."""
    return [[float(n) for n in found.split(", ")] for found in re.findall(r"\d[\d.]*(?:, \d[\d.]*)+(?= (?:kN|MPa))", text)]


def worst(names, values):
    return names[values.index(max(values))]


def row(folder):
    with open(folder / "numbers.csv", encoding="utf-8", newline="") as file:
        numbers = {line["quantity"]: line["ours"] for line in csv.DictReader(file)}
    conclusions = {}
    for line in (folder / "results.md").read_text(encoding="utf-8").splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if len(cells) == 5 and cells[0].isdigit():
            conclusions[int(cells[0])] = (cells[3], cells[4])
    missing = [n for n in range(1, 8) if conclusions.get(n, ("not run",))[0] == "not run" and n != NEEDS_TRACTION]
    if missing:
        sys.exit(f"{folder}: conclusions {missing} are not decided: run the set to its end first")
    by_wave_n, by_wave_l, by_wave_m, by_speed_n, by_speed_m = lists(conclusions[5][1])
    found = re.search(r"F_N ([\d.]+) kN, without contact over (\d+) mm .* ([\d.]+) kN and (\d+) mm", conclusions[6][1])
    if not found:
        sys.exit(f"{folder}: conclusion 6 has other words than this program's: run the set again")
    transient, lost, multibody, lost_by_multibody = found.groups()
    ours = lambda quantity, scale=1.0: float(numbers[quantity]) * scale
    held = [str(n) for n, (verdict, _) in sorted(conclusions.items()) if verdict == "reproduced"]
    partly = [str(n) for n, (verdict, _) in sorted(conclusions.items()) if verdict == "partly"]
    return [
        folder.name.replace("_", ", "),
        f"{ours('Largest F_N over corrugation D'):.0f} / {ours('Smallest F_N over corrugation D'):.1f}",
        "/".join(str(worst(WAVELENGTHS, values)) for values in (by_wave_n, by_wave_l, by_wave_m)),
        "/".join(str(worst(SPEEDS, values)) for values in (by_speed_n, by_speed_m)),
        " / ".join(f"{ours(f'Range of the frictional work, {wave} mm', 1e3):.0f}" for wave in WAVELENGTHS),
        " / ".join(f"{ours(f'Shift of F_N at the first crest, {speed} km/h'):.2f}" for speed in (100, 500)),
        f"{ours('Oscillation of F_N behind B at 500 km/h'):.1f}",
        f"{float(transient):.0f} / {lost} ({float(multibody):.0f} / {lost_by_multibody})",
        ", ".join(held) + (f" (partly {', '.join(partly)})" if partly else ""),
    ]


if len(sys.argv) < 2:
    sys.exit(__doc__)
print("| | F_N, max / min [kN] | worst wavelength by F_N/F_L/Von Mises [mm] | worst speed by F_N/Von Mises [km/h] "
      "| work, range, 65 / 80 / 95 mm [mJ] | shift, 100 / 500 km/h [pi] | smooth rail, 500 km/h [% of static] "
      "| 500 km/h, 0.18 mm: largest F_N [kN] / way without contact [mm] (multi-body) | conclusions |")
print("|---|---|---|---|---|---|---|---|---|")
for name in sys.argv[1:]:
    print("| " + " | ".join(row(pathlib.Path(name))) + " |")
