#!/usr/bin/env python3
"""Rows of `tread bench kernels --json` with the dumps of callgrind, by perf/add_counts.py."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path(__file__).resolve().parents[2] / "perf/add_counts.py"


def row(kernel: str, elements: int, **more) -> dict:
    return {"kernel": kernel, "path": "p", "precision": "double", "backend": "openmp", "lanes": "avx2", "threads": 1,
            "elements": elements, "unit": "element", "bytes_per_element_step": 24, "flops_per_element_step": 0,
            "element_steps_per_s": 1e6, "spread": 0.1, **more}


ROWS = [row("triad", 1), row("update", 10, counted_calls=2), row("search", 4, counted_calls=3)]


class AddCounts(unittest.TestCase):
    def add(self, counts: list[int]) -> subprocess.CompletedProcess:
        """What the program makes of ROWS and of one dump for each count, and the dump at the program's end."""
        with tempfile.TemporaryDirectory() as folder:
            rows = pathlib.Path(folder) / "rows"
            rows.write_text("".join(json.dumps(line) + "\n" for line in ROWS), encoding="utf-8")
            for name, total in [("dump", 0), *((f"dump.{i}", n) for i, n in enumerate(counts, 1))]:
                (rows.parent / name).write_text(f"events: Ir\nsummary: {total}\n\nfn=(1)\n0 5\n\ntotals: {total}\n")
            return subprocess.run([sys.executable, PROGRAM, rows, rows.parent / "dump"], capture_output=True, text=True)

    def test_each_row_takes_the_mean_of_its_calls(self):
        lines = [json.loads(line) for line in self.add([100, 102, 7, 8, 9]).stdout.splitlines()]
        self.assertEqual([(line["kernel"], line["instructions_per_element_step"]) for line in lines],
                         [("update", 10.1), ("search", 2)])

    def test_rates_of_callgrind_are_left_out(self):
        line = json.loads(self.add([100, 102, 7, 8, 9]).stdout.splitlines()[0])
        self.assertFalse({"element_steps_per_s", "spread"} & line.keys())
        self.assertEqual((line["elements"], line["counted_by"]), (10, "callgrind"))

    def test_dumps_of_other_calls_are_refused(self):
        for counts in [[], [100, 102, 7, 8], [100, 102, 7, 8, 9, 10]]:
            self.assertEqual(self.add(counts).returncode, 3, counts)


if __name__ == "__main__":
    unittest.main()
