#!/usr/bin/env python3
"""scripts/compile_times.py [--every N] [BUILD]: prints the processor time that compiling the program takes, by library, as
a Markdown table.

BUILD: a configured and built folder (default: build/release). Every N-th source or folder of a library
(default: 1) is compiled, without a compiler cache and one at a time; the others count as much as the mean of these.
Nothing in the build folder changes.
"""

import argparse
import collections
import os
import resource
import shlex
import subprocess
import tempfile

SHOWN = 9  # libraries; the rest is summed


def commands_of(build: str) -> dict[str, list[list[str]]]:
    """Compile commands by library, without their output files."""
    listed = subprocess.run(["ninja", "-C", build, "-t", "commands", "tread"], check=True, capture_output=True, text=True)
    libraries = collections.defaultdict(list)
    for line in listed.stdout.splitlines():
        words = shlex.split(line.split(" && ")[0] if " -c " in line else "")
        if "-c" not in words:
            continue
        if os.path.basename(words[0]) == "ccache":
            words = words[1:]
        library = words[words.index("-o") + 1].split("CMakeFiles/")[1].split(".dir")[0]
        for option in ("-MT", "-MF", "-o"):
            at = words.index(option)
            del words[at:at + 2]
        words.remove("-MD")
        libraries[library].append(words)
    return libraries


def seconds_of(command: list[str], build: str) -> float:
    """Processor time of one compilation [s]."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    with tempfile.NamedTemporaryFile() as made:  # headers that are compiled once need a file
        subprocess.run([*command, "-o", made.name], check=True, cwd=build)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("build", nargs="?", default="build/release")
    given = parser.parse_args()
    rows = []
    for library, commands in commands_of(given.build).items():
        times = [(seconds_of(c, given.build), os.path.basename(c[c.index("-c") + 1])) for c in commands[::given.every]]
        total = sum(seconds for seconds, _ in times) * len(commands) / len(times)
        rows.append((total, library, len(commands), max(times)))
    rows.sort(reverse=True)
    everything = sum(row[0] for row in rows)
    print("| library | sources or folders | processor time | share | longest of those compiled |\n|---|--:|--:|--:|---|")
    for total, library, count, (longest, source) in rows[:SHOWN]:
        print(f"| `{library}` | {count} | {total:.0f} s | {100 * total / everything:.0f} % | `{source}`, {longest:.1f} s |")
    rest = rows[SHOWN:]
    if rest:
        print(f"| others | {sum(r[2] for r in rest)} | {sum(r[0] for r in rest):.0f} s | {100 * sum(r[0] for r in rest) / everything:.0f} % | |")
    print(f"| all | {sum(r[2] for r in rows)} | {everything:.0f} s | 100 % | |")


main()
