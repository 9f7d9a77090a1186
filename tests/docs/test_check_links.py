#!/usr/bin/env python3
"""Dead links and citations that tests/docs/check_links.py has to find."""

import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True

from check_links import check  # noqa: E402

GOOD = {
    "README.md": "# House\n[theory](docs/theory.md), [gap](docs/theory.md#gap-and-pressure), [here](#house)\n",
    "docs/theory.md": "# Theory\n## Gap and pressure\n    p = 0      (9)\n```\n[no link](nowhere.md)\n```\n`[none](x.md)`\n",
    "core/gap.hpp": "// Pressure. [theory.md, Gap and\n// pressure] [theory.md, eq. 9; Johnson 1985] docs/theory.md\n",
}


class CheckLinks(unittest.TestCase):
    def found(self, changes: dict[str, str] = {}) -> list[str]:
        """Faults of a small repository with other contents of some files."""
        with tempfile.TemporaryDirectory() as folder:
            for name, text in {**GOOD, **changes}.items():
                path = pathlib.Path(folder) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            return check(pathlib.Path(folder))

    def test_a_sound_repository_has_no_fault(self):
        self.assertEqual(self.found(), [])

    def test_faults(self):
        for fault in ["[a](docs/other.md)", "[a](docs/theory.md#pressure)", "[a](#theory)", "[a](../outside.md)",
                      "![a](picture.svg)", "docs/other.md"]:
            self.assertEqual(len(self.found({"README.md": f"# House\n{fault}\n"})), 1, fault)
        for fault in ["[theory.md, Friction]", "[theory.md, eq. 8]", "[theory.md, eqs. 9 and 10a]", "[limits.md]",
                      "docs/theory/eq.md"]:
            self.assertEqual(len(self.found({"core/gap.hpp": f"// {fault}\n"})), 1, fault)


if __name__ == "__main__":
    unittest.main()
