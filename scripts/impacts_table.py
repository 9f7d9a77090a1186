#!/usr/bin/env python3
"""Prints forces at flats and welds beside the multi-body approach as Markdown: impacts_table.py STUDY TREAD

STUDY is a folder of `tread sweep` whose points have a table [surface.flat] or [surface.weld]; TREAD is the program, which
rolls each point's scene over a beam (Timoshenko, spread) too. A weld has P1, the largest force within 1.5 ms behind the
joint, and P2, the largest mean over 3 ms from 3 to 25 ms behind it; Jenkins' P2 stands beside it [Jenkins et al. 1974], with
stiffness, damping and mass of the track as those of a beam on an elastic foundation.
"""
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import tomllib

if len(sys.argv) != 3:
    sys.exit(__doc__)
study, program = pathlib.Path(sys.argv[1]), sys.argv[2]


def number(text):
    """The number before the unit."""
    return float(str(text).split()[0])


def rows(path, columns):
    with open(path, encoding="utf-8", newline="") as file:
        return [tuple(float(row[c]) for c in columns) for row in csv.DictReader(file)]


CURVE = ("time [s]", "wheel_x [m]", "vertical_force [N]")


def beam(folder):
    with tempfile.TemporaryDirectory() as place:
        subprocess.run([program, "multibody", str(folder / "scene.resolved.toml"), "--beam", "spread", "-o", place, "--quiet"],
                       check=True, stdout=subprocess.DEVNULL)
        summary = json.loads((pathlib.Path(place) / "summary.json").read_text(encoding="utf-8"))
        curve = rows(pathlib.Path(place) / "multibody.csv", CURVE)
    return curve, summary


def extremes(curve, first, last):
    forces = [f for _, x, f in curve if first <= x <= last]
    return f"{max(forces) / 1e3:.1f} / {abs(min(forces)) / 1e3:.1f}"


def p1_p2(curve, joint):
    start = next(t for t, x, _ in curve if x >= joint)
    first = max(f for t, _, f in curve if start <= t <= start + 1.5e-3)
    later = [(t, f) for t, _, f in curve if start + 1.5e-3 <= t <= start + 26.5e-3]
    means, low, total = [], 0, 0.0
    for i, (t, f) in enumerate(later):
        total += f
        while later[low][0] < t - 3e-3:
            total -= later[low][1]
            low += 1
        if t > start + 4.5e-3:
            means.append(total / (i - low + 1))
    return first, max(means)


def jenkins_p2(scene, summary, angle):
    f, s = scene["fastenings"], scene["sleepers"]
    spacing = number(f["spacing"])
    pad, bed = number(f["stiffness"]), number(s["stiffness"])
    k = pad * bed / (pad + bed) / spacing
    concrete = scene["material"][s["material"]]
    sleeper = number(s["width"]) * number(s["length"]) * number(s["height"]) * number(concrete["density"])
    m = summary["rail_mass_kg_per_m"] + sleeper / spacing
    c = number(s["damping"]) / spacing
    decay = (k / (4 * summary["bending_stiffness_N_m2"])) ** 0.25
    stiffness, mass, damping = 2 * k / decay, 1.5 * m / decay, 1.5 * c / decay
    unsprung = summary["unsprung_mass_kg"]
    loss = 1 - damping * math.pi / (4 * math.sqrt(stiffness * (unsprung + mass)))
    speed = summary["speed_m_per_s"]
    return (summary["static_wheel_load_N"] + angle * speed * math.sqrt(unsprung / (unsprung + mass)) * loss *
            math.sqrt(stiffness * unsprung))


with open(study / "sweep.csv", encoding="utf-8", newline="") as file:
    folders = [study / row["point"] for row in csv.DictReader(file)]
welds = any("weld" in tomllib.loads((p / "scene.resolved.toml").read_text(encoding="utf-8")).get("surface", {}) for p in folders)
print("| | P1 [kN] | beam | P2 [kN] | beam | Jenkins |\n|---|--:|--:|--:|--:|--:|" if welds else
      "| | F_N, max / min [kN] | beam | largest pressure [MPa] |\n|---|--:|--:|--:|")
for folder in folders:
    scene = tomllib.loads((folder / "scene.resolved.toml").read_text(encoding="utf-8"))
    name = folder.name.replace("-", " ").replace("km_h", "km/h")
    ours = rows(folder / "histories.csv", CURVE)
    theirs, summary = beam(folder)
    if welds:
        weld = scene["surface"]["weld"]
        joint = number(weld["at"])
        angle = 8 * number(weld["depth"]) / number(weld["length"])
        cells = [p1_p2(ours, joint), p1_p2(theirs, joint)]
        text = [cells[0][0], cells[1][0], cells[0][1], cells[1][1], jenkins_p2(scene, summary, angle)]
        print(f"| {name} | " + " | ".join(f"{v / 1e3:.1f}" for v in text) + " |")
    else:
        flat = scene["surface"]["flat"]
        at, length = number(flat["at"]), number(flat["length"])
        span = (at - length, at + 3 * length)
        pressure = max(p for x, p in rows(folder / "histories.csv", ("wheel_x [m]", "max_pressure [Pa]")) if span[0] <= x <= span[1])
        print(f"| {name} | {extremes(ours, *span)} | {extremes(theirs, *span)} | {pressure / 1e6:.0f} |")
