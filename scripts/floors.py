#!/usr/bin/env python3
"""Draws the floors of the house: scripts/floors.py > docs/floors.svg

Boxes are folders with their number of files and lines; an arrow leads from a floor to each floor that it includes and
that no floor between them includes already. Numbers on boxes count the includes that leave the floor.
"""
import collections
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parent.parent
SUFFIXES = {".cpp", ".hpp", ".cu", ".in"}
# Rows from the ground up, each floor with its column; a floor includes only floors of rows below its own.
# [tests/equivalence/test_layering.cpp]
ROWS = [
    {"core": 1},
    {"kernels": 0, "io": 1, "drivers/process": 2},
    {"drivers/engine": 0},
    {"drivers/results": 1},
    {"drivers/verify": 0, "drivers/report": 1},
    {"drivers/run": 1},
    {"drivers/studies": 1, "drivers/bench": 2},
    {"drivers/cli": 1},
]
COLUMNS = 3
WHAT = {
    "core": "vectors, materials, sections, swept blocks, scene, threads",
    "kernels": "element, materials, contact, connectors, ties, update, solver",
    "io": "scene reader and schema, HDF5, VTK, reports",
    "drivers/engine": "model, preload, start, simulation, beam",
    "drivers/process": "signals, progress, child processes",
    "drivers/results": "histories, patch, surface, frames, summary",
    "drivers/report": "figures and tables of a run",
    "drivers/verify": "cases beside theory",
    "drivers/bench": "kernels, hotspots, scaling",
    "drivers/run": "rolling loop, checkpoints, forks, caches",
    "drivers/studies": "study, dial, develop, paper, multibody, roughness",
    "drivers/cli": "one small file a command",
}
WIDTH, HEIGHT, GAP_X, GAP_Y = 360, 62, 24, 34


def floor_of(path):
    found = [floor for row in ROWS for floor in row if path.startswith(floor + "/")]
    return max(found, key=len, default=None)


def survey():
    """Files and lines by floor, and includes between floors."""
    files, lines, includes = collections.Counter(), collections.Counter(), collections.Counter()
    for top in ("core", "kernels", "io", "drivers"):
        for path in sorted((ROOT / top).rglob("*")):
            if path.suffix not in SUFFIXES:
                continue
            own = floor_of(path.relative_to(ROOT).as_posix())
            text = path.read_text(encoding="utf-8")
            files[own] += 1
            lines[own] += text.count("\n")
            for target in re.findall(r'^#include "([^"]+)"', text, re.M):
                other = floor_of(target)
                if other and other != own:
                    includes[own, other] += 1
    return files, lines, includes


def direct(includes):
    """Pairs of floors without those that a way over another floor implies."""
    below = collections.defaultdict(set)
    for own, other in includes:
        below[own].add(other)

    def reaches(start, end):
        return end in below[start] or any(reaches(via, end) for via in below[start])

    return [(a, b) for a, b in includes if not any(reaches(via, b) for via in below[a] if via != b)]


def main():
    files, lines, includes = survey()
    total = COLUMNS * (WIDTH + GAP_X) + GAP_X
    place = {
        floor: (GAP_X + column * (WIDTH + GAP_X), GAP_Y / 2 + level * (HEIGHT + GAP_Y))
        for level, row in enumerate(reversed(ROWS))
        for floor, column in row.items()
    }
    bottom = len(ROWS) * (HEIGHT + GAP_Y)
    print(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {total} {bottom}" font-family="sans-serif">')
    print('<rect width="100%" height="100%" fill="white"/>')
    print('<defs><marker id="tip" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" orient="auto">'
          '<path d="M0 0 L8 4 L0 8 z" fill="#64748b"/></marker></defs>')
    for a, b in sorted(direct(includes)):
        (xa, ya), (xb, yb) = place[a], place[b]
        print(f'<path d="M{xa + WIDTH / 2:.0f} {ya + HEIGHT:.0f} L{xb + WIDTH / 2:.0f} {yb:.0f}" stroke="#64748b" '
              'fill="none" marker-end="url(#tip)"/>')
    for floor, (x, y) in place.items():
        leaving = sum(count for (own, _), count in includes.items() if own == floor)
        print(f'<rect x="{x:.0f}" y="{y:.0f}" width="{WIDTH}" height="{HEIGHT}" rx="6" fill="#eef2f7" stroke="#334155"/>')
        for dy, size, weight, text in (
            (19, 14, "bold", floor),
            (36, 11, "normal", WHAT[floor]),
            (53, 11, "normal", f"{files[floor]} files, {lines[floor]} lines, {leaving} includes of floors below"),
        ):
            print(f'<text x="{x + 10:.0f}" y="{y + dy:.0f}" font-size="{size}" font-weight="{weight}" '
                  f'fill="#0f172a">{text}</text>')
    print("</svg>")


if __name__ == "__main__":
    main()
