"""frames.py FOLDER CELLS: opens frames.hdf.series of a run of scenes/tyre.toml with ParaView's reader and compares what
it shows with histories.csv."""

import csv
import json
import math
import os
import sys

from paraview import simple
from paraview.servermanager import Fetch

folder, cells = sys.argv[1:]


def require(condition, text):
    if not condition:
        sys.exit(f"{folder}: {text}")


def near(value, expected, share, text):
    require(abs(value - expected) <= share * abs(expected), f"{text}: {value:g}, expected {expected:g}")


def points_of_blocks(data):
    """Numbers of the points by block."""
    block = data.GetCellData().GetArray("block")
    found = {}
    for i in range(data.GetNumberOfCells()):
        corners = data.GetCell(i).GetPointIds()
        found.setdefault(block.GetValue(i), set()).update(corners.GetId(k) for k in range(corners.GetNumberOfIds()))
    return found


with open(os.path.join(folder, "frames.hdf.series")) as file:
    listed = json.load(file)["files"]
with open(os.path.join(folder, "histories.csv")) as file:
    rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
with open(os.path.join(folder, "summary.json")) as file:
    elements = json.load(file)["elements"]

reader = simple.OpenDataFile(os.path.join(folder, "frames.hdf.series"))
require(reader is not None, "no reader takes frames.hdf.series")
times = list(reader.TimestepValues)
require(len(times) == 5 == len(listed), f"{len(times)} instants, {len(listed)} listed")

for time, entry in zip(times, listed):
    near(time, entry["time"], 1e-12, "time of " + entry["name"])
    reader.UpdatePipeline(time)
    data = Fetch(reader)
    row = min(rows, key=lambda r: abs(r["time [s]"] - time))
    points, values = data.GetPointData(), data.GetCellData()
    expected = {"displacement [m]": 3, "velocity [m s-1]": 3, "contact pressure [Pa]": 1,
                "contact shear stress [Pa]": 3, "slip velocity [m s-1]": 3}
    for name, components in expected.items():
        array = points.GetArray(name)
        require(array is not None, f"no array '{name}'")
        require(array.GetNumberOfComponents() == components, f"components of '{name}'")
        require(all(map(math.isfinite, array.GetRange(-1))), f"'{name}' is not finite")
    require(values.GetArray("von Mises stress [Pa]") is not None, "no stress")
    kind = {data.GetCellType(i) for i in (0, data.GetNumberOfCells() - 1)}
    require(kind == {9 if cells == "faces" else 12}, f"cell types {kind}")
    if cells == "elements":
        require(data.GetNumberOfCells() == elements, f"{data.GetNumberOfCells()} of {elements} elements")

    largest = points.GetArray("contact pressure [Pa]").GetRange()[1]
    near(largest, row["max_pressure [Pa]"], 0.05, f"largest pressure at {time:g} s")
    shear = points.GetArray("contact shear stress [Pa]").GetRange(-1)[1]
    near(shear, row["max_shear [Pa]"], 0.05, f"largest shear stress at {time:g} s")
    stress = values.GetArray("von Mises stress [Pa]").GetRange()
    require(0 <= stress[0] and 1e8 < stress[1] < 2e9, f"stress from {stress[0]:g} to {stress[1]:g} Pa")

    axles = []
    for ids in points_of_blocks(data).values():
        places = [data.GetPoint(i) for i in ids]
        if max(p[2] for p in places) - min(p[2] for p in places) < 0.8:
            continue  # not the wheel
        axles.append((max(p[0] for p in places) + min(p[0] for p in places)) / 2)
        speed = max(math.hypot(*points.GetArray("velocity [m s-1]").GetTuple3(i)) for i in ids)
        near(speed, 2 * row["wheel_speed [m/s]"], 0.02, "speed of the wheel's top")
    require(len(axles) == 1, f"{len(axles)} wheels")
    require(abs(axles[0] - row["wheel_x [m]"]) < 2e-3, f"axle at {axles[0]:g} m, histories: {row['wheel_x [m]']:g} m")
    displacement = points.GetArray("displacement [m]").GetRange(-1)[1]
    require(1e-6 < displacement < 5e-3, f"largest displacement {displacement:g} m")

mesh = simple.OpenDataFile(os.path.join(folder, f"frames/mesh-{cells}.hdf"))
mesh.UpdatePipeline()
require(Fetch(mesh).GetNumberOfCells() == data.GetNumberOfCells(), "cells of the mesh")
print(f"{folder}: ParaView {simple.GetParaViewVersion()} reads {len(times)} frames of {data.GetNumberOfCells()} cells")
