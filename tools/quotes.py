"""Renew the excerpts of files that documentation pages quote (`make tables`).

A block after `<!-- quote: FILE | START | END -->` holds the lines of FILE from the first one that contains START to the
first one after it that contains END.
"""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PAGES = ("docs/reading.md",)
QUOTE = re.compile(r"(<!-- quote: (\S+) \| (.+?) \| (.+?) -->\n+```\w+\n)(.*?)(^```$)", re.DOTALL | re.MULTILINE)


def renew_quotes(page: str) -> str:
    """Return the page with its quotations replaced by the present lines of their files.

    Raises SystemExit if a file has no such lines.
    """
    return QUOTE.sub(lambda found: f"{found[1]}{find_quoted_lines(*found.group(2, 3, 4))}{found[6]}", page)


def find_quoted_lines(file: str, start: str, end: str) -> str:
    """Return the lines of a file from the one that contains `start` to the one that contains `end`."""
    lines = (ROOT / file).read_text(encoding="utf-8").splitlines(keepends=True)
    first = next((k for k, line in enumerate(lines) if start in line), None)
    if first is None:
        raise SystemExit(f"{file} has no line with {start!r}, which a page quotes")
    last = next((k for k, line in enumerate(lines[first:], first) if end in line), None)
    if last is None:
        raise SystemExit(f"{file} has no line with {end!r} after {start!r}, to which a page quotes")
    return "".join(lines[first : last + 1])


if __name__ == "__main__":
    for name in PAGES:
        path = ROOT / name
        path.write_text(renew_quotes(path.read_text(encoding="utf-8")), encoding="utf-8")
