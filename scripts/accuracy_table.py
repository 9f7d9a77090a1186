#!/usr/bin/env python3
"""scripts/accuracy_table.py [--check]: writes the tables of docs/explanation/how-accurate.md and of README.md, between their marks,
from the pages that `tread verify -o docs/records/verification` has left.

--check: writes nothing; exit status 1 where a page holds another table, or where docs/records/verification.md, which collects
those pages, holds another text of one.
"""

import argparse
import decimal
import pathlib
import re
import sys
from typing import NamedTuple

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGES = ROOT / "docs" / "records" / "verification"
COLLECTED = ROOT / "docs" / "records" / "verification.md"  # by scripts/verification_page.sh


class Row(NamedTuple):
    name: str
    case: str
    quantity: str  # as the case's page calls it
    theory: str


TEN = [
    Row("largest contact pressure", "hertz_ellipse", "largest pressure, nodal average", "Hertz"),
    Row("area of the contact patch", "hertz_ellipse", "patch area", "Hertz"),
    Row("work of a tangential loop", "cattaneo_mindlin", "work of the loop", "Mindlin"),
    Row("creepage, plane strain", "carter", "creepage less free rolling", "Carter"),
    Row("creepage", "steady_rolling", "creepage less free rolling", "half-space"),
    Row("largest surface shear stress", "steady_rolling", "largest shear on the axis", "half-space"),
    Row("frictional work per area", "steady_rolling", "frictional work on the axis", "half-space"),
    Row("Von Mises stress of the surface elements", "steady_rolling", "Von Mises stress of the surface elements", "half-space"),
    Row("contact filter, waves of 80 mm", "contact_filter", "gain at 80 mm", "half-space"),
    Row("pinned-pinned frequency of the rail", "rail_on_fastenings", "pinned-pinned frequency, beam on the same fastenings",
        "Timoshenko beam"),
]
SIX = [TEN[0], TEN[3], TEN[4], TEN[6], TEN[7], TEN[9]]
BY_SIZE = [TEN[0], TEN[4], TEN[5], TEN[6], TEN[7]]
SIZES = {"2.2 mm": "-element_size-2.2mm", "1.1 mm": "", "0.55 mm": "-element_size-0.55mm"}


def finding(case: str, quantity: str) -> list[str]:
    """Cells of a quantity of a case: ours, reference, unit, error, bound, ok."""
    page = PAGES / f"{case}.md"
    for line in page.read_text(encoding="utf-8").splitlines():
        cells = [cell.strip() for cell in line.strip("| ").split(" | ")]
        if cells[0] == quantity:
            return cells[1:]
    raise SystemExit(f"{page}: there is no row '{quantity}'")


def percent(error: str) -> str:
    """An error as the page states it, with one digit behind the point where it is a percentage."""
    if error.endswith("%"):
        stated = decimal.Decimal(error.removesuffix("%").strip())
        return f"{stated.quantize(decimal.Decimal('0.1'), decimal.ROUND_HALF_UP):+} %"
    mantissa, _, exponent = error.replace("−", "-").replace("×10", "e").partition("e")
    power = exponent.translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")) or "0"
    return format(decimal.Decimal(mantissa).scaleb(int(power)), "+f")


def comparison(rows: list[Row]) -> str:
    text = "| quantity | tread | theory | difference | theory by | `tread verify ...` |\n|---|--:|--:|--:|---|---|\n"
    for row in rows:
        ours, reference, unit, error = finding(row.case, row.quantity)[:4]
        unit = "" if unit == "-" else f" {unit}"
        text += f"| {row.name} | {ours}{unit} | {reference}{unit} | {percent(error)} | {row.theory} | `{row.case}` |\n"
    return text


def refinement() -> str:
    text = "| difference on elements of | " + " | ".join(SIZES) + " |\n|---|" + "--:|" * len(SIZES) + "\n"
    for row in BY_SIZE:
        errors = [percent(finding(row.case + size, row.quantity)[3]) for size in SIZES.values()]
        text += f"| {row.name} | {' | '.join(errors)} |\n"
    return text


def failures() -> str:
    text = "| `tread verify ...` | quantity | difference | bound |\n|---|---|--:|--:|\n"
    for page in sorted(PAGES.glob("*.md")):
        lines = page.read_text(encoding="utf-8").splitlines()
        command = re.search(r"`tread verify ([^`]*)`", lines[0])[1]
        for cells in ([cell.strip() for cell in line.strip("| ").split(" | ")] for line in lines if line.startswith("| ")):
            if cells[-1] == "FAILS":
                text += f"| `{command}` | {cells[0]} | {percent(cells[4])} | {cells[5]} |\n"
    return text


def not_collected() -> list[pathlib.Path]:
    """Pages whose text the collected page lacks."""
    collected = COLLECTED.read_text(encoding="utf-8")
    return [page for page in sorted(PAGES.glob("*.md"))
            if page.read_text(encoding="utf-8").replace("](", "](verification/") not in collected]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    check = parser.parse_args().check
    page = ROOT / "docs" / "explanation" / "how-accurate.md"
    tables = [(page, "ten numbers", comparison(TEN)), (page, "element sizes", refinement()), (page, "failing bounds", failures()),
              (ROOT / "README.md", "six numbers", comparison(SIX))]
    differs = False
    for path, mark, table in tables:
        text = path.read_text(encoding="utf-8")
        between = re.compile(rf"(^<!-- {mark}: begin -->\n).*(^<!-- {mark}: end -->)", re.DOTALL | re.MULTILINE)
        written, places = between.subn(lambda found: f"{found[1]}\n{table}\n{found[2]}", text)
        if places != 1:
            raise SystemExit(f"{path}: there are no marks <!-- {mark}: begin --> and its end")
        if written == text:
            continue
        if check:
            print(f"{path}: the table '{mark}' differs from docs/records/verification; run scripts/accuracy_table.py", file=sys.stderr)
            differs = True
        else:
            path.write_text(written, encoding="utf-8")
    for page in not_collected() if check else []:
        print(f"{page}: {COLLECTED} holds another text of it; run scripts/verification_page.sh --collect", file=sys.stderr)
        differs = True
    return 1 if differs else 0


if __name__ == "__main__":
    sys.exit(main())
