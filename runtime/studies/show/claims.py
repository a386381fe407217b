"""What a study's page shows of claims: tables of numbers and trends that others published, beside the study's own."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gudgeon.errors import GudgeonError
from gudgeon.results.web_page import Section, lines, table

if TYPE_CHECKING:
    from gudgeon.studies.ensemble.finished import Study

TABLES = {"numbers": "Published numbers", "trends": "Published trends"}


def claims_sections(study: Study) -> list[Section]:
    """A heading and a table for `study.claims.numbers` and `.trends`, tables as pandas has them, and their source; none
    of a study that claims nothing."""
    try:
        found = getattr(study, "claims", None)
    except GudgeonError:  # its file makes no claims
        return []
    tables = [(heading, _table(getattr(found, name, None))) for name, heading in TABLES.items()]
    shown = [(heading, inside) for heading, inside in tables if inside]
    source = str(getattr(found, "source", ""))
    return [(heading, lines([source] * bool(source), "g-quiet") + inside) for heading, inside in shown]


def _table(found: Any) -> str:
    """Columns in which something is written; nothing of an empty table."""
    columns = {str(name): [_cell(value) for value in found[name]] for name in getattr(found, "columns", ())}
    columns = {name: cells for name, cells in columns.items() if any(cells)}
    return table(list(columns), zip(*columns.values(), strict=True), True) if columns else ""


def _cell(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:.4g}" if value == value else "–"
    return "" if value is None else str(value)
