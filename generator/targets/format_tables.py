"""Writes the tables of docs/format.md: every key that a file may have, from the reader's declarations."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from gudgeon.generator.field import (
    BODY,
    CORNERS,
    DEPTHS,
    FLAG,
    KINDS,
    LAW,
    MAPPING,
    NAME,
    NUMBER,
    PLACE,
    POINTS,
    RECORD,
    RESULTS,
    VECTOR,
    WORD,
    Field,
    Kind,
)
from gudgeon.generator.format.sections import FILE
from gudgeon.language.functions import FUNCTIONS, Function
from gudgeon.language.units import Dimension, si_unit

Row = tuple[str, ...]
_HEAD = ("key", "holds", "without it", "condition", "meaning")


def tables() -> str:
    """Return all tables as Markdown with headings."""
    return "\n".join((*_of_functions(), *_of_record("The file", FILE, "", set())))


def _of_functions() -> Iterator[str]:
    """Yield the lines of the table of functions that expressions may call."""
    rows = [(f"`{f.call(*f.arguments)}`", f.meaning, f.units.value, _domain(f)) for f in FUNCTIONS.values()]
    head = ("function", "value", "dimensions", "defined for")
    yield from _table("Functions", "what expressions may call", head, rows)


def _domain(function: Function) -> str:
    """Return the domain of a function as text; "" for all numbers."""
    low, high = function.domain
    if math.isinf(low) and math.isinf(high):
        return ""
    return f"x ≥ {low:g}" if math.isinf(high) else f"{low:g} ≤ x ≤ {high:g}".replace("-", "−")


def _of_record(heading: str, of: Field, path: str, seen: set[str]) -> Iterator[str]:
    """Yield the table of a mapping with known keys, then the tables of mappings inside it."""
    seen.add(of.name)
    yield from _table(heading, of.meaning, _HEAD, [_row(field) for field in of.fields])
    for field in of.fields:
        inner, place = field, f"{path}{field.name}"
        if field.kind == MAPPING and field.entry is not None:
            inner, place = field.entry, f"{place}.NAME"
        if inner.kind == RECORD and inner.name not in seen:
            yield from _of_record(f"`{place}`", inner, f"{place}.", seen)
        elif inner.kinds is not None:
            yield from _of_kinds(f"`{place}`", inner)


def _of_kinds(heading: str, of: Field) -> Iterator[str]:
    """Yield the table of an entry that is one of several kinds: a row for each kind, then one for each of its keys."""
    rows: list[Row] = []
    for name, kind in of.kinds().items() if of.kinds else ():
        itself = ("`law`", f"`{name}`") if of.kind == LAW else (f"`{name}`", _targets(kind))
        if kind.like:
            needed = " and ".join(f"`{field.name}`" for field in kind.fields if field.required)
            rows.append((f"`{name}`", *itself, "needed", "", f"{kind.title}: has its other keys, {needed} is needed"))
            continue
        rows.append((f"`{name}`", *itself, "needed", "", kind.title))
        rows += [("", *_row(field)) for field in kind.fields]
    yield from _table(heading, of.meaning, ("kind", *_HEAD), rows)


def _table(heading: str, meaning: str, head: Row, rows: Sequence[Row]) -> Iterator[str]:
    """Yield the lines of a table with heading and meaning."""
    yield from (f"## {heading}", "", f"{meaning[0].upper()}{meaning[1:]}.", "")
    yield from (_line(head), "|" + "---|" * len(head), *map(_line, rows), "")


def _line(cells: Row) -> str:
    """Return a row of a Markdown table."""
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def _row(field: Field) -> Row:
    """Return the cells of a field: key, values, default, condition, meaning."""
    return f"`{field.name}`", _holds(field), _without(field), condition(field), field.meaning


def _holds(field: Field) -> str:
    """Return the cell that says what a field holds."""
    if field.kind == NUMBER:
        words = "".join(f" or `{word}`" for word in field.words)
        return f"number, {_unit(field.dimension)}{words}" + (f"; of {field.varies}" if field.varies else "")
    if field.kind == VECTOR:
        return f"[x, y], {_unit(field.dimension)}" + (f"; of {field.varies}" if field.varies else "")
    if field.kind in (WORD, FLAG):
        return " or ".join(f"`{_word(value)}`" for value in field.values)
    if field.kind == POINTS:
        return "[[x, y], …], numbers"
    if field.kind == DEPTHS:
        return f"[number, …], {_unit(field.dimension)}; or how many"
    if field.kind == RESULTS:
        return "[NAME, …], names of results"
    if field.kind == NAME:
        return f"name in `{field.names}`" if field.names else "name"
    if field.kind == MAPPING:
        entry = field.entry.kind if field.entry else ""
        if field.keys:
            points = "; `BODY.POINT`, [x, y], m" if field.entry and field.entry.kind == PLACE else ""
            return "numbers: " + ", ".join(f"`BODY.{key}`, {_unit(of)}" for key, of in field.keys.items()) + points
        if field.addresses and field.entry:
            return f"{', '.join(f'`{address}`' for address in field.addresses)}: {_holds(field.entry)}"
        return f"names: {_holds(field.entry) if field.entry and entry in (NUMBER, VECTOR) else 'mappings'}"
    if field.kind == CORNERS:
        return "[POINT, POINT, POINT]"
    return {RECORD: "mapping", KINDS: "mapping", LAW: "mapping", BODY: "body or `ground`"}.get(field.kind, field.kind)


def _unit(of: Dimension | None) -> str:
    """Return the cell of a unit."""
    if of is None:
        return "any unit"
    return si_unit(of) or "no unit or an angle"


def _targets(kind: Kind) -> str:
    """Return the form of a kind's targets."""
    one = {"points": "BODY.POINT", "bodies": "BODY", "coordinates": "BODY.x, .y or .theta"}[kind.targets]
    return " or ".join(one if count == 1 else f"[{', '.join([one] * count)}]" for count in kind.counts)


def _without(field: Field) -> str:
    """Return what applies if a key is missing."""
    if field.required:
        return "needed"
    if field.default is not None:
        return f"`{_word(field.default)}`"
    return field.otherwise


def _word(value: float | str | bool) -> str:
    """Return a value as a file writes it."""
    return str(value).lower() if isinstance(value, bool) else f"{value:g}" if isinstance(value, float) else value


def condition(field: Field) -> str:
    """Return the bounds of a field as text, and whether it is whole."""
    limits = (f"`{limit}`" if isinstance(limit, str) else f"{limit:g}" for _, limit, _ in field.bounds)
    found = [f"{bound.relation} {limit}" for bound, limit in zip(field.bounds, limits, strict=True)]
    return ", ".join([*found, *(["not both 0"] if field.nonzero else []), *(["whole"] if field.whole else [])])
