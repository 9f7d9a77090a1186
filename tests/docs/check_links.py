#!/usr/bin/env python3
"""check_links.py ROOT: resolves all relative links of the Markdown files and all citations of pages in the sources.

Links: the file exists, and an anchor is a heading of the page both by GitHub's and by Python-Markdown's rule.
Citations: a path such as `docs/reference/scene.md` exists; `[theory.md, Contact]` is a heading and `[theory.md, eq. 10a]` an
equation of the page. Exit status 1: something does not resolve; each is a line of the output.
"""

import pathlib
import re
import sys
import urllib.parse

SKIPPED = {"build", "runs", ".git", "test_check_links.py"}
SOURCES = {".cpp", ".hpp", ".cu", ".py", ".sh", ".txt", ".cmake", ".toml", ".cff", ".md", ".yml", ""}
FENCE = re.compile(r"^( *)(```+|~~~+).*?^\1\2[`~]*\s*?$", re.DOTALL | re.MULTILINE)
INLINE_CODE = re.compile(r"(`+)[^`\n]+?\1(?!`)")
LINK = re.compile(r"\]\(<?([^()\s>]+)>?(?: \"[^\"]*\")?\)")
HEADING = re.compile(r"^#{1,6} +(.*?)(?: +#+)?$", re.MULTILINE)
PATH = re.compile(r"(?<![\w/.-])docs/[\w./-]*\w")
CITATION = re.compile(r"\[(?:docs/(?:[\w-]+/)*)?([\w-]+\.md)(?:, ([^\]]*))?\]")
EQUATION = re.compile(r"\b[A-Z]?\d+[a-z]?\b")


def github_slug(heading: str) -> str:
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def python_markdown_slug(heading: str) -> str:
    return re.sub(r"[-\s]+", "-", re.sub(r"[^\w\s-]", "", heading).strip().lower())


def headings(text: str) -> list[str]:
    """Headings as they are shown: without the marks of code, emphasis and links."""
    shown = [re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", found) for found in HEADING.findall(FENCE.sub("", text))]
    return [re.sub(r"[`*]", "", found).strip() for found in shown]


def anchors(text: str) -> set[str]:
    """Anchors that hold by both rules; a repeated heading has none of its own."""
    found = headings(text)
    return {github_slug(heading) for heading in found
            if github_slug(heading) == python_markdown_slug(heading) and found.count(heading) == 1}


def files(root: pathlib.Path, folder: pathlib.Path | None = None):
    for path in sorted((folder or root).iterdir()):
        if path.name in SKIPPED:
            continue
        if path.is_dir():
            yield from files(root, path)
        elif path.suffix in SOURCES:
            yield path


def dead_links(root: pathlib.Path, page: pathlib.Path, pages: dict[pathlib.Path, str]) -> list[str]:
    dead = []
    for link in LINK.findall(INLINE_CODE.sub("", FENCE.sub("", pages[page]))):
        if re.match(r"[a-z]+:", link):
            continue
        path, _, anchor = urllib.parse.unquote(link).partition("#")
        target = (page.parent / path).resolve() if path else page
        if not target.exists() or not target.is_relative_to(root):
            dead.append(f"{page.relative_to(root)}: there is no file for the link {link}")
        elif anchor and anchor not in anchors(pages.get(target, "")):
            dead.append(f"{page.relative_to(root)}: there is no heading for the link {link}")
    return dead


def dead_citations(root: pathlib.Path, source: pathlib.Path, text: str, pages: dict[pathlib.Path, str]) -> list[str]:
    name = source.relative_to(root)
    dead = [f"{name}: there is no {path}" for path in PATH.findall(LINK.sub("", text)) if not (root / path).exists()]
    if source.suffix == ".md":
        return dead
    for page, place in CITATION.findall(re.sub(r"\s*\n\s*(?://+|#)\s*", " ", text)):
        cited = [content for path, content in pages.items() if path.name == page]
        if len(cited) != 1:
            dead.append(f"{name}: {len(cited)} pages are called {page}")
            continue
        if re.match(r"eqs?\. ", place):
            lost = [number for number in EQUATION.findall(place.split(";")[0]) if f"({number})" not in cited[0]]
        else:
            heading = place.split(";")[0].strip()  # sources of literature may follow
            wanted = [heading] if heading in headings(cited[0]) else heading.split(" and ")
            lost = [part for part in wanted if place and part not in headings(cited[0])]
        dead += [f"{name}: {page} has no {part}" for part in lost]
    return dead


def check(root: pathlib.Path) -> list[str]:
    root = root.resolve()
    texts = {}
    for path in files(root):
        try:
            texts[path] = path.read_text(encoding="utf-8")
        except UnicodeDecodeError:  # a program or a picture
            continue
    pages = {path: text for path, text in texts.items() if path.suffix == ".md"}
    dead = [line for page in pages for line in dead_links(root, page, pages)]
    return dead + [line for path, text in texts.items() for line in dead_citations(root, path, text, pages)]


def main() -> int:
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    dead = check(pathlib.Path(sys.argv[1]))
    for line in dead:
        print(line)
    return 1 if dead else 0


if __name__ == "__main__":
    sys.exit(main())
