#!/usr/bin/env python3
"""What is left of the start in F_N on a smooth rail: start_curves.py [--svg FILE] [--mean METRES] LABEL=RUN ...

RUN is a run's folder (histories.csv, summary.json). F_N is averaged over 12 mm of the way (--mean), so that the passing
of single elements does not count; the part that repeats in a fastening span, taken from the last span of the run, is taken
off. Prints, in per cent of the static load, the largest rest of each 0.3 m as a line of docs/records/verification.md, Start.
"""
import argparse
import bisect
import csv
import json
import pathlib

SPAN = 0.65  # [m]
STRETCH = 0.3  # of a column of the table [m]
GRID = 1e-3  # [m]


class Run:
    def __init__(self, folder):
        folder = pathlib.Path(folder)
        with open(folder / "summary.json", encoding="utf-8") as file:
            self.static = json.load(file)["static_wheel_load_N"]
        with open(folder / "histories.csv", encoding="utf-8") as file:
            rows = csv.reader(file)
            names = [name.split(" ")[0] for name in next(rows)]
            place, force = names.index("wheel_x"), names.index("vertical_force")
            self.way = [(float(row[place]), float(row[force])) for row in rows]
        self.x = [x for x, _ in self.way]
        self.sums = [0.0]  # of F_N over the way, by the trapezoidal rule
        for (x0, f0), (x1, f1) in zip(self.way, self.way[1:]):
            self.sums.append(self.sums[-1] + 0.5 * (f0 + f1) * (x1 - x0))

    def integral(self, x):
        i = min(max(bisect.bisect(self.x, x), 1), len(self.x) - 1)
        (x0, f0), (x1, f1) = self.way[i - 1], self.way[i]
        part = x - x0
        return self.sums[i - 1] + part * (f0 + 0.5 * part * (f1 - f0) / (x1 - x0))

    def mean(self, x, width):
        low, high = max(x - width / 2, self.x[0]), min(x + width / 2, self.x[-1])
        return (self.integral(high) - self.integral(low)) / (high - low)

    def rest(self, width):
        """(x, rest in per cent of static) up to the span that the periodic part is taken from."""
        end = self.x[-1] - width / 2
        points = []
        count = int((end - SPAN) / GRID)
        for i in range(count):
            x = i * GRID
            spans = int((end - x) / SPAN)
            repeated = self.mean(x + spans * SPAN, width)
            points.append((x, 100 * (self.mean(x, width) - repeated) / self.static))
        return points


def line(label, points):
    columns = []
    start = 0.0
    while start + STRETCH <= points[-1][0] + GRID:
        part = [abs(rest) for x, rest in points if start <= x < start + STRETCH]
        columns.append(f"{max(part):.1f}")
        start += STRETCH
    return f"| {label} | " + " | ".join(columns) + " |"


def drawing(curves):
    width, panel, left, colours = 900, 120, 60, ["#1f5fa8", "#c4472b", "#2e7d5b", "#7a4fa3", "#a8760f", "#5b6770"]
    far = max(points[-1][0] for _, points in curves)
    height = panel * len(curves) + 40
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" '
           f'font-size="12"><rect width="100%" height="100%" fill="white"/>']
    def at(x):
        return left + x / far * (width - left - 20)
    for k, (label, points) in enumerate(curves):
        top = k * panel + 10
        low, high = top, top + panel - 20
        scale = max(4.0, max(abs(rest) for _, rest in points))
        def level(rest):
            return (low + high) / 2 - rest / scale * (high - low) / 2
        step = 2 if scale < 20 else 50 if scale < 100 else 200
        for mark in (-step, 0, step):
            out.append(f'<line x1="{left}" x2="{width - 20}" y1="{level(mark):.1f}" y2="{level(mark):.1f}" '
                       f'stroke="#ccc"/><text x="{left - 6}" y="{level(mark) + 4:.1f}" text-anchor="end">{mark} %</text>')
        way = " ".join(f"{at(x):.1f},{level(rest):.1f}" for x, rest in points[::2])
        out.append(f'<polyline fill="none" stroke="{colours[k % len(colours)]}" points="{way}"/>')
        out.append(f'<text x="{width - 24}" y="{low + 12}" text-anchor="end">{label}</text>')
    for mark in range(int(far / STRETCH) + 1):
        x = at(mark * STRETCH)
        out.append(f'<text x="{x:.1f}" y="{height - 16}" text-anchor="middle">{mark * STRETCH:.1f}</text>')
    out.append(f'<text x="{width / 2}" y="{height - 2}" text-anchor="middle">Position on the rail [m]; '
               'what is left of F_N [% of static]</text></svg>')
    return "\n".join(out) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--svg")
    parser.add_argument("--mean", type=float, default=0.012)
    parser.add_argument("runs", nargs="+", metavar="LABEL=RUN")
    given = parser.parse_args()
    curves = []
    for item in given.runs:
        label, _, folder = item.partition("=")
        points = Run(folder).rest(given.mean)
        curves.append((label, points))
        print(line(label, points))
    if given.svg:
        with open(given.svg, "w", encoding="utf-8") as file:
            file.write(drawing(curves))


if __name__ == "__main__":
    main()
