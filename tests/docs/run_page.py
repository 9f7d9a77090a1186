#!/usr/bin/env python3
"""run_page.py TREAD PAGE: does what a page of the documentation tells its reader, in an empty folder.

Blocks with a NAME behind their language are written to files of that name; blocks ```sh run in order by `bash -eo pipefail`, with TREAD on
the path as `tread`. A block ```text right behind one ```sh shows lines that its commands print, in their order, not all of them: words to
the letter, numbers to 1 %, "..." at the end for the rest of a line. Times, sizes of files and progress ("[roll] ...") are not compared.
Other blocks are only read. Exit status 1: a command of the page failed, or did not print a line that the page shows.
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

BLOCK = re.compile(r"^```(\w+) *(\S*)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
MEASURED = r"\d[\d.e-]* (?:s|min|h|[kMGT]?B)\b"  # a time or the size of a file
NUMBER = re.compile(MEASURED + r"|([-−]?\d+(?: \d{3})*(?:\.\d+)?(?:[eE][-+]?\d+)?)")
TOLERANCE = 0.01


class PageError(Exception):
    pass


def parts(line: str) -> tuple[str, list[float]]:
    """The line without its numbers and spaces between columns, and the numbers."""
    numbers = [float(number.replace(" ", "").replace("−", "-")) for number in NUMBER.findall(line) if number]
    return " ".join(NUMBER.sub(lambda found: "#" if found[1] else "~", line).split()), numbers


def is_shown(shown: str, printed: str) -> bool:
    """True if the page's line `shown` stands for the line `printed`."""
    words, numbers = parts(shown.removesuffix("..."))
    printed_words, printed_numbers = parts(printed)
    if shown.endswith("..."):
        printed_words, printed_numbers = printed_words[:len(words)], printed_numbers[:len(numbers)]
    return words == printed_words and all(
        abs(a - b) <= TOLERANCE * max(abs(a), abs(b)) for a, b in zip(numbers, printed_numbers))


def compare(shown: str, printed: str) -> None:
    """Raises PageError if a line of the page's block is not among the printed ones, behind the line before it."""
    lines = iter(printed.splitlines())
    for line in map(str.strip, shown.splitlines()):
        if line not in ("", "...") and not line.startswith("[") and not any(is_shown(line, other) for other in lines):
            raise PageError(f"this line of the page was not printed, or not in this place:\n{line}")


def follow(page: str, environment: dict[str, str], folder: pathlib.Path) -> int:
    """Returns the number of commands' blocks that ran; raises PageError at the first that does not do what the page says."""
    done, end = 0, 0
    printed = None  # by the block before, if that is one of commands
    for block in BLOCK.finditer(page):
        kind, name, body = block.groups()
        follows, end = page[end:block.start()].isspace(), block.end()
        if kind == "sh":
            ended = subprocess.run(["bash", "-eo", "pipefail", "-c", body], cwd=folder, env=environment, encoding="utf-8",
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
            printed = ended.stdout
            print(printed, end="", flush=True)
            if ended.returncode:
                raise PageError(f"this block fails with {ended.returncode}:\n{body}")
            done += 1
        else:
            if kind == "text" and follows and printed is not None:
                compare(body, printed)
            printed = None
        if name:
            (folder / name).write_text(body, encoding="utf-8")
    return done


def main() -> int:
    if len(sys.argv) != 3:
        print(__doc__, file=sys.stderr)
        return 2
    tread, page = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
    with tempfile.TemporaryDirectory() as folder:
        path = f"{tread.parent}:{pathlib.Path(sys.executable).parent}:{os.environ['PATH']}"
        environment = {**os.environ, "PATH": path, "TREAD_CACHE": f"{folder}/cache"}
        work = pathlib.Path(folder) / "work"
        work.mkdir()
        try:
            done = follow(page.read_text(encoding="utf-8"), environment, work)
        except PageError as error:
            print(f"{page}: {error}", file=sys.stderr)
            return 1
    if not done:
        print(f"{page}: the page has no block of commands", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
