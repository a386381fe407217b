"""Writes anew what pages have of declarations, the tables of docs/format.md and docs/laws.md: `make tables`."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from gudgeon.generator.targets.format_tables import tables
from gudgeon.generator.targets.latex.law_page import laws_page

DOCS = Path(__file__).resolve().parents[1] / "docs"
PAGES: dict[str, Callable[[], str]] = {"format.md": tables, "laws.md": laws_page}
MARK = "<!-- Below: `make tables`. -->\n"


def page(text: str, below: str, name: str = "") -> str:
    """The page with what is below the mark as it is now; what stands above stays."""
    above, mark, _ = text.partition(MARK)
    if not mark:
        raise SystemExit(f"{name} has no line {MARK.strip()}: what is written stands below it")
    return f"{above}{mark}\n{below}"


if __name__ == "__main__":
    for own, made in PAGES.items():
        file = DOCS / own
        file.write_text(page(file.read_text(encoding="utf-8"), made(), own), encoding="utf-8")
