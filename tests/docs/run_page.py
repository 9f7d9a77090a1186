#!/usr/bin/env python3
"""run_page.py TREAD PAGE: does what a page of the documentation tells its reader, in an empty folder.

Blocks with a NAME behind their language are written to files of that name; blocks ```sh run in order by `bash -e`, with TREAD on the path
as `tread`. Other blocks are only read. Exit status 1: a command of the page failed.
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

BLOCK = re.compile(r"^```(\w+) *(\S*)\n(.*?)^```$", re.DOTALL | re.MULTILINE)


def follow(page: str, environment: dict[str, str], folder: pathlib.Path) -> int:
    """Returns the number of commands' blocks that ran; raises CalledProcessError at the first that fails."""
    done = 0
    for kind, name, body in BLOCK.findall(page):
        if kind == "sh":
            subprocess.run(["bash", "-e", "-c", body], cwd=folder, env=environment, check=True)
            done += 1
        elif name:
            (folder / name).write_text(body, encoding="utf-8")
    return done


def main() -> int:
    if len(sys.argv) != 3:
        print(__doc__, file=sys.stderr)
        return 2
    tread, page = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "PATH": f"{tread.parent}:{os.environ['PATH']}",
                       "TREAD_CACHE": f"{folder}/cache"}
        work = pathlib.Path(folder) / "work"
        work.mkdir()
        try:
            done = follow(page.read_text(encoding="utf-8"), environment, work)
        except subprocess.CalledProcessError as error:
            print(f"{page}: this block fails with {error.returncode}:\n{error.cmd[-1]}", file=sys.stderr)
            return 1
    if not done:
        print(f"{page}: the page has no block of commands", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
