#!/usr/bin/env python3
"""Pages that tests/docs/run_page.py has to refuse."""

import contextlib
import io
import os
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True

from run_page import PageError, follow  # noqa: E402


class RunPage(unittest.TestCase):
    def followed(self, commands: str, shown: str = "", between: str = "\n") -> int:
        text = f"```text\n{shown}\n```\n" if shown else ""
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()):
            return follow(f"# Page\n```sh\n{commands}\n```\n{between}{text}", dict(os.environ), pathlib.Path(folder))

    def refused(self, *page: str) -> None:
        with self.assertRaises(PageError, msg=str(page)):
            self.followed(*page)

    def test_a_command_that_fails(self):
        self.assertEqual(self.followed("true | true"), 1)
        for commands in ["false\ntrue", "false | cat"]:
            self.refused(commands)

    def test_lines_that_are_shown(self):
        printed = "echo 'F_N    1 200.4 kN  of study in 3.2 s'; echo '[roll] 5'; echo 'depth -2.5e-3  work'; false || echo \"exit code $?\""
        for shown in ["F_N 1 201 kN  of study in 1.4 min", "F_N  1 200 kN of ...", "depth −0.0025 work", "...\nexit code 1",
                      "F_N ...\n[roll] 7\n...\n\n  depth ...\nexit code 1"]:
            self.assertEqual(self.followed(printed, shown), 1)
        for shown in ["F_N 1 220 kN of study in 3.2 s", "F_N 1 200 N of study in 3.2 s", "F_N 1 200", "depth 0.0025 work", "exit code 2",
                      "exit code 1\ndepth ...", "exit code 1\nexit code 1"]:
            self.refused(printed, shown)

    def test_blocks_that_show_something_else(self):
        self.assertEqual(self.followed("echo a", "b", "Words between.\n"), 1)


if __name__ == "__main__":
    unittest.main()
