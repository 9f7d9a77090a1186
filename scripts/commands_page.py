#!/usr/bin/env python3
"""scripts/commands_page.py TREAD [--check PAGE]: prints the commands and their options as Markdown, from the program's own help.

    scripts/commands_page.py build/release/tread | scripts/put_between_marks.sh docs/reference/commands.md 'tread --help'

--check PAGE: exit status 1 where the page holds other text between its marks.
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys

MARKS = re.compile(r"^<!-- tread --help: begin -->\n(.*)^<!-- tread --help: end -->", re.DOTALL | re.MULTILINE)
KINDS = {"TEXT": "text", "INT": "integer", "FLOAT": "number"}


class Help:
    """The help of a command: purpose, usage, and the rows (name, text) of each of its sections."""

    def __init__(self, tread: str, *command: str):
        run = subprocess.run([tread, *command, "--help"], check=True, capture_output=True, text=True,
                             env={**os.environ, "COLUMNS": "1000"})
        lines = run.stdout.splitlines()
        self.purpose = lines[0]
        self.usage = next(re.sub(r"^Usage: \S+", "tread", line) for line in lines if line.startswith("Usage:"))
        self.sections: dict[str, list[list[str]]] = {}
        rows: list[list[str]] = []
        for line in lines:
            if re.fullmatch(r"[A-Z]\w+:", line):
                rows = self.sections.setdefault(line[:-1], [])
            elif re.match(r"  \S", line):
                rows.append((re.split(r" {2,}", line.strip(), maxsplit=1) + [""])[:2])
            elif line.startswith("   ") and rows:
                rows[-1][1] = f"{rows[-1][1]} {line.strip()}".strip()


def argument_of(words: str) -> str:
    """The argument of an option in words: `INT:INT in [1 - 9999]` is `integer, 1 to 9999`."""
    required = words.endswith("REQUIRED")
    words = words.removesuffix("REQUIRED").strip()
    several = " x 2" if words.endswith(" x 2") else ", several" if words.endswith(" ...") else ""
    words = re.sub(r"( x 2| \.\.\.)$", "", words)
    typed = re.fullmatch(r"([A-Z]+)(?::(.*))?", words)
    kind, limits = typed.groups("") if typed else (words, "")
    # A bar would end the table's cell.
    text = ", ".join(f"`{choice}`" for choice in kind.split("|")) if "|" in kind else KINDS.get(kind, kind)
    if choices := re.fullmatch(r"\{(.*)\}", limits):
        text = ", ".join(f"`{choice}`" for choice in choices[1].split(","))
    elif bounds := re.fullmatch(r"\w+ in \[(\S+) - (\S+)\]", limits):
        text += f", {bounds[1]} to {bounds[2]}"
    elif least := re.fullmatch(r">= (\S+)", limits):
        text += f", at least {least[1]}"
    return text + several + (", required" if required else "")


def rows_of(sections: dict[str, list[list[str]]]) -> str:
    text = ""
    for name, meaning in sections.get("Positionals", []) + sections.get("Options", []):
        flags, _, argument = name.partition(" ")
        needs = re.search(r" ?Needs: (\S+)", argument)
        argument = argument.replace(needs[0], "") if needs else argument
        if flags == "-h,--help":
            continue
        meaning += f"; only with `{needs[1]}`" if needs else ""
        text += f"| `{flags.replace(',', ', ')}` | {argument_of(argument)} | {meaning} |\n"
    return text and f"\n| option | argument | meaning |\n|---|---|---|\n{text}"


def section(tread: str, *command: str) -> str:
    help_text = Help(tread, *command)
    text = f"\n### tread {' '.join(command)}\n\n{help_text.purpose[0].upper()}{help_text.purpose[1:]}.\n"
    text += f"\n    {help_text.usage}\n" + rows_of(help_text.sections)
    for name, _ in help_text.sections.get("Subcommands", []):
        text += section(tread, *command, name)
    return text


def page(tread: str) -> str:
    program = Help(tread)
    text = "\n| command | purpose |\n|---|---|\n"
    for name, purpose in program.sections["Subcommands"]:
        text += f"| [`{name}`](#tread-{name}) | {purpose} |\n"
    for name, _ in program.sections["Subcommands"]:
        text += section(tread, name)
    return text


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tread", type=pathlib.Path)
    parser.add_argument("--check", type=pathlib.Path, metavar="PAGE")
    options = parser.parse_args()
    wanted = page(str(options.tread.resolve()))
    if not options.check:
        print(wanted.strip())
        return 0
    found = MARKS.search(options.check.read_text(encoding="utf-8"))
    if found and found[1].strip() == wanted.strip():
        return 0
    print(f"{options.check} differs from `tread --help`; write it anew:\n{__doc__}", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
