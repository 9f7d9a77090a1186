#!/usr/bin/env python3
"""Presses the measured flat of CONTACT's example `wheelflat` on its rail:
measured_flat.py EXAMPLES TREAD FOLDER [ANGLE ...] [--size MM]

EXAMPLES is CONTACT's folder of examples (S1002_flat.slcw, S1002_flat/, wheelflat.ref_out). For each angle [deg] of the wheel
(default: seven of the example's) the program TREAD finds the static state of a half wheelset under 125 kN on elements of
MM (default 1.1 mm). Prints largest pressures and areas by CONTACT, by half-spaces with the gap of the same map, and by TREAD
as Markdown. The slices are smoothed as in the example: smoothing splines across, and cubic B-splines with the slices as
coefficients around. Half-spaces do not bend: in TREAD's scene the rail's head stands on a stiff web and foot, and two coarse
runs find by how much the load turns wheel and head, so that the last one begins where it ends in the example's place.
Needs numpy.
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
OFFSET = 7.44  # y of the rail's middle on the wheel: by the gauge face, 14 mm below the top, and the wheels' distance
SMOOTHING = 5.0  # the example's, of the integral of the squared second derivative against the sum of squared misfits [mm3]
STEP = 0.25  # of the map
COARSE = 2.2  # elements on which the tilts are found [mm]
FLAT = (0.40, 0.90)  # angles about the flat [rad]
FIRST_ANGLE = 25  # of the example [deg]


def smoothed(s, values, at):
    """Natural cubic smoothing spline of columns of values at s; its values at `at`."""
    h = np.diff(s)
    n = len(h) - 1
    bend, mass = np.zeros((n + 2, n)), np.diag((h[:-1] + h[1:]) / 3) + np.diag(h[1:-1] / 6, 1) + np.diag(h[1:-1] / 6, -1)
    for i in range(n):
        bend[i : i + 3, i] = 1 / h[i], -1 / h[i] - 1 / h[i + 1], 1 / h[i + 1]
    second = np.linalg.solve(mass + SMOOTHING * bend.T @ bend, bend.T @ values)
    fitted = values - SMOOTHING * bend @ second
    second = np.pad(second, ((1, 1), (0, 0)))
    i = np.clip(np.searchsorted(s, at) - 1, 0, n)
    b = ((at - s[i]) / h[i])[:, None]
    a = 1 - b
    return a * fitted[i] + b * fitted[i + 1] + ((a**3 - a) * second[i] + (b**3 - b) * second[i + 1]) * h[i, None] ** 2 / 6


def around(angle, z, at):
    """z at angles of cubic B-splines with the slices' angles as knots and the slices as coefficients."""
    before, after = np.arange(-2, 0) * (angle[1] - angle[0]), np.arange(1, 3) * (angle[-1] - angle[-2])
    t, at = np.concatenate([angle[0] + before, angle, angle[-1] + after]), at[:, None]
    basis = ((t[:-1] <= at) & (at < t[1:])).astype(float)
    for k in (1, 2, 3):
        rise = (at - t[:-k]) / (t[k:] - t[:-k])
        basis = rise[:, :-1] * basis[:, :-1] + (1 - rise[:, 1:]) * basis[:, 1:]
    return basis @ z


def slices(examples):
    """Angles, y (STEP apart) and z (down) of the wheel's slices, smoothed."""
    listed = re.findall(r"^\s*(-?\d+\.\d+)\s+'(.*?)'", (examples / "S1002_flat.slcw").read_text(), re.M)
    y = np.arange(-28, 40 + STEP / 2, STEP)
    z = []
    for _, name in listed:
        points = np.loadtxt(examples / name)[::-1]
        s = np.append(0, np.hypot(*np.diff(points, axis=0).T).cumsum())
        fine = smoothed(s, points, np.arange(0, s[-1], 0.1))
        tread = fine[np.argmax(fine[:, 0] > -32) :]  # its y grows
        z.append(np.interp(y, tread[:, 0], tread[:, 1]))
    return np.array([float(a) for a, _ in listed]), y, np.array(z)


def depth_map(examples):
    """x (STEP apart, from FLAT's begin), y, depth(x, y) and the round wheel's z(y)."""
    angle, y, z = slices(examples)
    beside = ((angle > FLAT[0]) & (angle < 0.48)) | ((angle > 0.82) & (angle < FLAT[1]))
    round_z = z[beside].mean(axis=0)
    x = np.arange(0, (FLAT[1] - FLAT[0]) * RADIUS, STEP)
    ends = np.clip(np.minimum(x, x[-1] - x) / 15, 0, 1)
    return x, y, (round_z - around(angle, z, FLAT[0] + x / RADIUS)) * ends[:, None], round_z


def rail_head():
    """y and z (up) of arcs of 300 mm, 16 mm long, and 60 mm, and of one that becomes upright at 36 mm. The example's third arc
    begins later, beside the contact, and makes a head wider than the section's."""
    points, begin = [(0.0, 0.0)], 0.0
    for radius, length in ((300.0, 16.0), (60.0, 13.0), (None, 0.0)):
        y0, z0 = points[-1]
        radius = radius or (36 - y0) / (1 - np.sin(begin))
        end = begin + length / radius if length else 0.985 * np.pi / 2
        for a in np.linspace(begin, end, 81)[1:]:
            points.append((y0 + radius * (np.sin(a) - np.sin(begin)), z0 - radius * (np.cos(begin) - np.cos(a))))
        begin = end
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


def half_spaces(angle, x, y, depth, round_z, head, place):
    """Largest pressure, area and middle across, from the rail's middle, at an angle [rad], by elements of 0.4 mm of which one
    has its middle at `place` (along; across, from the wheel's y = 0)."""
    step = 0.4
    mesh = (np.arange(120) - 60) * step
    gx, gy = np.meshgrid(mesh + place[0] % step, mesh + 12 + (place[1] - 12) % step, indexing="ij")
    along, across = ((angle - FLAT[0]) * RADIUS + gx - x[0]) / (x[1] - x[0]), (gy - y[0]) / (y[1] - y[0])
    i = np.clip(np.floor(along).astype(int), 0, len(x) - 2)
    j = np.clip(np.floor(across).astype(int), 0, len(y) - 2)
    a, b = np.clip(along - i, 0, 1), across - j
    z = round_z - depth
    z = (1 - a) * ((1 - b) * z[i, j] + b * z[i, j + 1]) + a * ((1 - b) * z[i + 1, j] + b * z[i + 1, j + 1])
    wheel = np.sqrt((RADIUS + z) ** 2 - gx**2)
    cosine, sine = np.cos(CANT), np.sin(CANT)
    rail_y = head[:, 0] * cosine - head[:, 1] * sine + OFFSET
    rail_z = head[:, 1] * cosine + head[:, 0] * sine
    p = press(-np.interp(gy, rail_y, rail_z) - wheel, step)
    return p.max(), (p > 0).sum() * step**2, (p * gy).sum() / p.sum() - OFFSET


def by_contact(examples):
    """Largest pressure, area and place (middle of an element) by angle, as wheelflat.ref_out has them."""
    lines = (examples / "wheelflat.ref_out").read_text().splitlines()
    after = {key: [lines[i + 1].split() for i, line in enumerate(lines) if key in line] for key in ("PMAX", "NPOT", "XCP(TR)")}
    return {FIRST_ANGLE + k: (float(p[-1]), 0.16 * int(n[1]), (float(c[0]), float(c[1]) - 750))
            for k, (p, n, c) in enumerate(zip(after["PMAX"], after["NPOT"], after["XCP(TR)"]))}


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
        ours = half_spaces(np.radians(angle), x, y, depth, round_z, head, contact[angle][2])
        pressure, area = 1e-6 * run["static_max_pressure_Pa"], 1e6 * run["static_patch_area_m2"]
        print(f"| {angle} | {contact[angle][0]:.0f}, {contact[angle][1]:.0f} | {ours[0]:.0f}, {ours[1]:.0f} | {ours[2]:.1f} | "
              f"{pressure:.0f}, {area:.0f} | {1e3 * run['contact_centre_y_m']:.1f} |", flush=True)


if __name__ == "__main__":
    main()
