#!/usr/bin/env python3
"""Row of the paper set of docs/records/paper.md, by scripts/readings_table.py."""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


class ReadingsTable(unittest.TestCase):
    def test_a_set_gives_a_row(self):
        with tempfile.TemporaryDirectory() as folder:
            shutil.copy(ROOT / "docs/records/paper.md", pathlib.Path(folder) / "results.md")
            shutil.copy(ROOT / "docs/records/paper/numbers.csv", folder)
            table = subprocess.run([sys.executable, ROOT / "scripts/readings_table.py", folder], capture_output=True,
                                   text=True)
        self.assertEqual(table.returncode, 0, table.stderr)
        # Largest F_N and way without contact, the same by the multi-body approach.
        self.assertRegex(table.stdout.splitlines()[-1], r"\| \d+ / \d+ \(\d+ / \d+\) \| [2-7], ")


if __name__ == "__main__":
    unittest.main()
