"""Write tables of docs/format.md, laws.md, notation.md, map.md and a header of C from declarations (`make tables`)."""

from __future__ import annotations

import runpy
from collections.abc import Callable
from pathlib import Path

from gudgeon.generator.targets.c.function_table import print_function_table
from gudgeon.generator.targets.format_tables import print_format_tables
from gudgeon.generator.targets.latex.law_page import print_laws_page

ROOT = Path(__file__).resolve().parents[1]
DOCS, HEADER = ROOT / "docs", ROOT / "engine" / "scene" / "function_table.h"
PAGES: dict[str, Callable[[], str]] = {"format.md": print_format_tables, "laws.md": print_laws_page}
MARK = "<!-- Below: `make tables`. -->\n"


def replace_generated_part(text: str, below: str, name: str = "") -> str:
    """Return a page with the text below the line MARK replaced. Raises SystemExit if it has no such line."""
    above, mark, _ = text.partition(MARK)
    if not mark:
        raise SystemExit(f"{name} has no line {MARK.strip()}, below which the tables are written")
    return f"{above}{mark}\n{below}"


if __name__ == "__main__":
    HEADER.write_text(print_function_table(), encoding="utf-8")
    for own, made in PAGES.items():
        file = DOCS / own
        file.write_text(replace_generated_part(file.read_text(encoding="utf-8"), made(), own), encoding="utf-8")
    for tool in ("notation", "file_map", "quotes"):
        runpy.run_path(str(ROOT / "tools" / f"{tool}.py"), run_name="__main__")
