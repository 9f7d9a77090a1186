#!/usr/bin/env python3
"""perf/add_counts.py ROWS DUMP: prints the rows of `tread bench kernels --json` with callgrind's instructions in place of rates.

callgrind wrote DUMP.1, DUMP.2, ... after each counted call, in the order of the rows [perf/count_instructions.sh]. A row
takes as many dumps as its `counted_calls` say. Exit code 3 where rows and dumps do not fit.
"""

import json
import pathlib
import re
import sys

KEPT = ["kernel", "path", "precision", "backend", "lanes", "threads", "elements",  # the key of a row
        "unit", "bytes_per_element_step", "flops_per_element_step"]
TOTAL = re.compile(r"^totals: (\d+)$", re.MULTILINE)


def totals(dump: pathlib.Path):
    """Instructions of the counted calls; the dump at the program's end has no number."""
    number = 1
    while (part := dump.with_name(f"{dump.name}.{number}")).exists():
        yield int(TOTAL.search(part.read_text())[1])
        number += 1


def counted(rows: list[dict], counts: list[int]) -> list[dict]:
    """Rows with the mean of their calls; rows without counted calls are left out."""
    rows = [row for row in rows if row.get("counted_calls")]
    wanted = sum(row["counted_calls"] for row in rows)
    if not rows or wanted != len(counts):
        raise ValueError(f"{len(rows)} rows have {wanted} counted calls, and callgrind wrote {len(counts)} dumps")
    result = []
    for row in rows:
        calls, counts = counts[: row["counted_calls"]], counts[row["counted_calls"]:]
        each = sum(calls) / len(calls) / row["elements"]
        result.append({key: row[key] for key in KEPT}
                      | {"instructions_per_element_step": float(f"{each:.6g}"), "counted_by": "callgrind"})
    return result


def main() -> int:
    rows, dump = map(pathlib.Path, sys.argv[1:])
    try:
        for row in counted([json.loads(line) for line in rows.read_text().splitlines()], list(totals(dump))):
            print(json.dumps(row))
    except ValueError as error:
        print(f"{rows}: {error}", file=sys.stderr)
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main())
