#!/usr/bin/env python3
"""Rows of a study's table, by scripts/study_table.py."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
COLUMNS = ["vertical_force_max [N]", "vertical_force_min [N]", "longitudinal_force_max [N]",
           "longitudinal_force_min [N]", "creepage_steady [-]", "axis_cell_work_range [J]",
           "axis_von_mises_max [Pa]", "axis_von_mises_min [Pa]"]


class StudyTable(unittest.TestCase):
    def test_a_wheel_that_has_not_reached_the_corrugation_has_dashes(self):
        with tempfile.TemporaryDirectory() as folder:
            results = pathlib.Path(folder) / "sweep.csv"
            results.write_text(",".join(["point", "state", *COLUMNS]) + "\n"
                               "nan-far,done,2e3,1e3,200,100,0.002,0.003,2e6,1e6\n"
                               "near,done,,,,,0.002,,,\n", encoding="utf-8")
            table = subprocess.run([sys.executable, ROOT / "scripts/study_table.py", results], capture_output=True,
                                   encoding="utf-8", env={**os.environ, "PYTHONIOENCODING": "utf-8"})
        self.assertEqual(table.returncode, 0, table.stderr)
        self.assertEqual(table.stdout.splitlines()[2:], ["| nan far | 2.0 / 1.0 | 0.2 / 0.1 | 0.200 | 3.0 | 1 |",
                                                         "| near | – | – | 0.200 | – | – |"])


if __name__ == "__main__":
    unittest.main()
