"""Writes the tables of docs/format.md anew, from the declarations of the fields: `make tables`."""

from __future__ import annotations

from pathlib import Path

from gudgeon.generator.targets.format_tables import tables

PAGE = Path(__file__).resolve().parents[1] / "docs" / "format.md"
MARK = "<!-- Below: `make tables`. -->\n"


def page(text: str) -> str:
    """The page with the tables as they are now; what stands above the mark stays."""
    above, mark, _ = text.partition(MARK)
    if not mark:
        raise SystemExit(f"{PAGE} has no line {MARK.strip()}: the tables stand below it")
    return f"{above}{mark}\n{tables()}"


if __name__ == "__main__":
    PAGE.write_text(page(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
