#!/usr/bin/env python3
"""Presses the measured flat of CONTACT's example `wheelflat` on its rail:
measured_flat.py EXAMPLES TREAD FOLDER [ANGLE ...] [--size MM]

EXAMPLES is CONTACT's folder of examples (S1002_flat.slcw, S1002_flat/, wheelflat.ref_out). For each angle [deg] of the wheel
(default: seven of the example's) the program TREAD finds the static state of a half wheelset under 125 kN on elements of
MM (default 1.1 mm). Prints largest pressures and areas by CONTACT, by half-spaces with the gap of the same map, and by TREAD
as Markdown. The slices are smoothed as in the example: a smoothing spline of parameter 5 mm^4 across, and cubic B-splines
with the slices as coefficients around. The rail has the example's radii of 300 and 60 mm, and sides 72 mm apart. Needs numpy.
"""
import argparse
import json
import pathlib
import re
import subprocess

import numpy as np

RADIUS = 490.0  # [mm], as all lengths here
LOAD = 125e3  # [N]
SHEAR, POISSON = 82e3, 0.28  # [N/mm2]
CANT = 0.02  # of the rail
OFFSET = 7.4  # y of the rail's middle on the wheel, by the example's contact place on the round wheel
COARSE = 2.2  # elements on which the tilts are found [mm]
FLAT = (0.40, 0.90)  # angles about the flat [rad]
FIRST_ANGLE = 25  # of the example [deg]


def slices(examples):
    """Angles, y (1 mm apart) and z (down) of the wheel's slices."""
    listed = re.findall(r"^\s*(-?\d+\.\d+)\s+'(.*?)'", (examples / "S1002_flat.slcw").read_text(), re.M)
    angle = np.array([float(a) for a, _ in listed])
    y = np.arange(-40, 52.5)  # wider than wanted: splines bend at their ends
    z = []
    for _, name in listed:
        points = np.loadtxt(examples / name)[::-1]
        z.append(np.interp(y, points[:, 0], points[:, 1]))
    second = np.diff(np.eye(len(y)), 2, axis=0)
    wanted = (y >= -28) & (y <= 40)
    y, z = y[wanted], np.linalg.solve(np.eye(len(y)) + 5 * second.T @ second, np.array(z).T).T[:, wanted]
    spline = z.copy()
    spline[1:-1] = (z[:-2] + 4 * z[1:-1] + z[2:]) / 6
    return angle, y, spline


def depth_map(examples):
    """x (1 mm apart, from FLAT's begin), y, depth(x, y) and the round wheel's z(y)."""
    angle, y, z = slices(examples)
    beside = ((angle > FLAT[0]) & (angle < 0.48)) | ((angle > 0.82) & (angle < FLAT[1]))
    round_z = z[beside].mean(axis=0)
    x = np.arange(0, (FLAT[1] - FLAT[0]) * RADIUS)
    ends = np.clip(np.minimum(x, x[-1] - x) / 15, 0, 1)
    depth = np.array([np.interp(FLAT[0] + x / RADIUS, angle, column) for column in (round_z - z).T]).T
    return x, y, depth * ends[:, None], round_z


def rail_head():
    """y and z (up) of arcs of 300 and 60 mm and of one that becomes upright at 36 mm."""
    points, slope = [(0.0, 0.0)], 0.0
    for radius, end in ((300.0, 8.0), (60.0, 24.0), (None, 36.0)):
        y0, z0 = points[-1]
        radius = radius or (end - y0) / (1 - slope)
        last = min(slope + (end - y0) / radius, np.sin(0.985 * np.pi / 2))
        for sine in slope + (last - slope) * np.linspace(0, 1, 81)[1:]:
            points.append((y0 + radius * (sine - slope), z0 - radius * (np.sqrt(1 - slope**2) - np.sqrt(1 - sine**2))))
        slope = last
    right = np.array(points)
    return np.vstack([right[:0:-1] * [-1, 1], right])


def press(gap, step):
    """Pressures of two half-spaces with a gap on a grid [Polonsky and Keer 1999]."""
    nx, ny = gap.shape
    x, y = np.meshgrid((np.arange(2 * nx) - nx) * step, (np.arange(2 * ny) - ny) * step, indexing="ij")

    def corner(a, b):
        r = np.hypot(a, b)
        return a * np.log(b + r) + b * np.log(a + r)

    h = step / 2
    kernel = corner(x + h, y + h) - corner(x - h, y + h) - corner(x + h, y - h) + corner(x - h, y - h)
    transform = np.fft.rfft2(np.fft.ifftshift(kernel * (1 - POISSON) / (np.pi * SHEAR)))

    def deflection(p):
        padded = np.zeros((2 * nx, 2 * ny))
        padded[:nx, :ny] = p
        return np.fft.irfft2(np.fft.rfft2(padded) * transform, s=padded.shape)[:nx, :ny]

    gap = gap - gap.min()
    p = (gap < 0.05) * LOAD / ((gap < 0.05).sum() * step**2)
    direction, before, keep = np.zeros_like(p), 1.0, 0
    for _ in range(500):
        touching = p > 0
        w = deflection(p) + gap
        w -= w[touching].mean()
        square = (w[touching] ** 2).sum()
        direction = np.where(touching, w + keep * square / before * direction, 0)
        before = square
        r = deflection(direction)
        r -= r[touching].mean()
        length = (w[touching] * direction[touching]).sum() / (r[touching] * direction[touching]).sum()
        former, p = p, np.maximum(p - length * direction, 0)
        fresh = (p == 0) & (w < 0)
        keep = 0 if fresh.any() else 1
        p[fresh] -= length * w[fresh]
        p *= LOAD / (p.sum() * step**2)
        if np.abs(p - former).sum() < 1e-6 * p.sum():
            break
    return p


def half_spaces(angle, x, y, depth, round_z, head):
    """Largest pressure, area and middle across, from the rail's middle, at an angle [rad]."""
    step = 0.4
    gx, gy = np.meshgrid(np.arange(-24, 24, step) + step / 2, np.arange(-12, 36, step) + step / 2, indexing="ij")
    along = (angle - FLAT[0]) * RADIUS + gx
    i = np.clip(np.floor(along).astype(int), 0, len(x) - 2)
    j = np.clip(np.floor(gy - y[0]).astype(int), 0, len(y) - 2)
    a, b = np.clip(along - x[i], 0, 1), gy - y[j]
    z = round_z - depth
    z = (1 - a) * ((1 - b) * z[i, j] + b * z[i, j + 1]) + a * ((1 - b) * z[i + 1, j] + b * z[i + 1, j + 1])
    wheel = np.sqrt((RADIUS + z) ** 2 - gx**2)
    cosine, sine = np.cos(CANT), np.sin(CANT)
    rail_y = head[:, 0] * cosine - head[:, 1] * sine + OFFSET
    rail_z = head[:, 1] * cosine + head[:, 0] * sine
    p = press(-np.interp(gy, rail_y, rail_z) - wheel, step)
    return p.max(), (p > 0).sum() * step**2, (p * gy).sum() / p.sum() - OFFSET


def by_contact(examples):
    """Largest pressure and area by angle, as wheelflat.ref_out has them."""
    lines = (examples / "wheelflat.ref_out").read_text().splitlines()
    after = {key: [lines[i + 1].split() for i, line in enumerate(lines) if key in line] for key in ("PMAX", "NPOT")}
    return {FIRST_ANGLE + k: (float(p[-1]), 0.16 * int(n[1])) for k, (p, n) in enumerate(zip(after["PMAX"], after["NPOT"]))}


def tread_run(options, angle, size, wheel_tilt, rail_tilt):
    """Summary of the static state on elements of `size` [mm], with rail and wheel placed so that they stand as in the example
    once the load has turned them by these tilts [rad]."""
    offset = OFFSET + wheel_tilt * RADIUS
    scene = options.folder / f"{angle}.toml"
    scene.write_text(f"""[scene]
based_on = "ballasted-60e1"
element_size = "{size} mm"
gravity = "0 m/s2"
[load]
wheel_load = "{LOAD:g} N"
[rail]
profile = "rail.txt"
section = "60E1"
material = "stiff"
head_material = "steel"
support = "rigid"
length = "0.6 m"
origin = "0.3 m"
inclination = {CANT + wheel_tilt - rail_tilt:g}
[material.steel]
youngs_modulus = "{2e-3 * SHEAR * (1 + POISSON):g} GPa"
poissons_ratio = {POISSON}
[material.stiff]
youngs_modulus = "{2e-2 * SHEAR * (1 + POISSON):g} GPa"
poissons_ratio = {POISSON}
density = "7850 kg/m3"
[wheel]
diameter = "{2 * RADIUS:g} mm"
lateral_offset = "{offset:g} mm"
[solution_zone]
start = "-25 mm"
length = "50 mm"
[surface.flat]
kind = "map"
on = "wheel"
at = "{-(np.radians(angle) - FLAT[0]) * RADIUS:.4f} mm"
file = "map.csv"
centre = "{-offset:g} mm"
""" + "".join(f"[{table}]\npresent = false\n" for table in ("motion", "vehicle", "fastenings", "sleepers", "material.concrete")),
                     encoding="utf-8")
    out = options.folder / f"{angle}"
    subprocess.run([options.tread, "run", str(scene), "-o", str(out), "--overwrite", "--quiet"], check=True)
    return json.loads((out / "summary.json").read_text(encoding="utf-8"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("examples", type=pathlib.Path)
    parser.add_argument("tread")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--size", default="1.1")
    parser.add_argument("angles", nargs="*", type=int, default=[25, 28, 33, 36, 37, 38, 41])
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    x, y, depth, round_z = depth_map(options.examples)
    head = rail_head()
    with open(options.folder / "map.csv", "w", encoding="utf-8") as file:
        print("# x [mm], y [mm], d [um]", file=file)
        for i, along in enumerate(x):
            for j, across in enumerate(y):
                print(f"{along:g},{across:g},{1e3 * depth[i, j]:.2f}", file=file)
    with open(options.folder / "rail.txt", "w", encoding="utf-8") as file:
        print("# y [mm] z [mm]", *(f"{a:.6f} {b:.6f}" for a, b in head), sep="\n", file=file)
    contact = by_contact(options.examples)
    print("| angle | CONTACT: MPa, mm2 | half-spaces of the map: MPa, mm2 | its middle [mm] | tread: MPa, mm2 | its middle [mm] |")
    print("|--:|--:|--:|--:|--:|--:|")
    for angle in options.angles:
        tilts = (0.0, 0.0)
        for size in (COARSE, COARSE, options.size):
            run = tread_run(options, angle, size, *tilts)
            tilts = (run["wheel_tilt_rad"], run["rail_tilt_rad"])
        ours = half_spaces(np.radians(angle), x, y, depth, round_z, head)
        pressure, area = 1e-6 * run["static_max_pressure_Pa"], 1e6 * run["static_patch_area_m2"]
        print(f"| {angle} | {contact[angle][0]:.0f}, {contact[angle][1]:.0f} | {ours[0]:.0f}, {ours[1]:.0f} | {ours[2]:.1f} | "
              f"{pressure:.0f}, {area:.0f} | {1e3 * run['contact_centre_y_m']:.1f} |", flush=True)


if __name__ == "__main__":
    main()
