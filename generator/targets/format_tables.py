"""Writes the tables of docs/format.md: every key of a mechanism file, from the declarations of the reader."""

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
from gudgeon.generator.format.sections import MECHANISM_FILE
from gudgeon.generator.marked_text import get_markdown
from gudgeon.language.functions import FUNCTIONS, Function
from gudgeon.language.units import Dimension, find_si_unit

Row = tuple[str, ...]
_HEADER = ("key", "holds", "without it", "condition", "meaning")


def print_format_tables() -> str:
    """Return all tables of docs/format.md as Markdown with headings: functions, then the keys of each mapping.

    Called by `make tables`.
    """
    return "\n".join((*_print_functions_table(), *_print_mapping_tables("The file", MECHANISM_FILE, "", set())))


def _print_functions_table() -> Iterator[str]:
    """Yield the lines of the table of functions that expressions may call."""
    rows = [
        (f"`{f.format_call(*f.arguments)}`", f.meaning, f.units.value, _format_domain(f)) for f in FUNCTIONS.values()
    ]
    head = ("function", "value", "dimensions", "defined for")
    yield from _print_table("Functions", "functions that expressions may call", head, rows)


def _format_domain(function: Function) -> str:
    """Return the domain of a function as text, "x ≥ 0" or "−1 ≤ x ≤ 1"; "" for all numbers."""
    low, high = function.domain
    if math.isinf(low) and math.isinf(high):
        return ""
    bounds = (f"{bound:g}".replace("-", "−") for bound in (low, high))
    lower, upper = ("" if math.isinf(bound) else text for bound, text in zip((low, high), bounds, strict=True))
    if not upper:
        return f"x ≥ {lower}"
    return f"{lower} ≤ x ≤ {upper}" if lower else f"x ≤ {upper}"


def _print_mapping_tables(heading: str, mapping: Field, path: str, printed_names: set[str]) -> Iterator[str]:
    """Yield the lines of the Markdown table of a mapping with known keys, then those of the mappings inside it.

    path: the address before its keys, such as "bodies.NAME.". printed_names: names of mappings that already have a
    table and are skipped; the printed ones are added.
    """
    printed_names.add(mapping.name)
    yield from _print_table(heading, mapping.meaning, _HEADER, [_list_field_cells(field) for field in mapping.fields])
    for field in mapping.fields:
        inner, inner_path = field, f"{path}{field.name}"
        if field.kind == MAPPING and field.entry is not None:
            inner, inner_path = field.entry, f"{inner_path}.NAME"
        if inner.kind == RECORD and inner.name not in printed_names:
            yield from _print_mapping_tables(f"`{inner_path}`", inner, f"{inner_path}.", printed_names)
        elif inner.kinds is not None:
            yield from _print_kinds_table(f"`{inner_path}`", inner)


def _print_kinds_table(heading: str, entry: Field) -> Iterator[str]:
    """Yield the lines of the table of an entry of several kinds: a row for each kind, then one for each of its keys.

    A kind that is declared `like` another one has one row, which refers to that kind instead of repeating its keys.
    """
    rows: list[Row] = []
    for name, kind in entry.kinds().items() if entry.kinds else ():
        key_and_values = ("`law`", f"`{name}`") if entry.kind == LAW else (f"`{name}`", _describe_targets(kind))
        if kind.like:
            required_keys = " and ".join(f"`{field.name}`" for field in kind.fields if field.required)
            rows.append(
                (
                    f"`{name}`",
                    *key_and_values,
                    "needed",
                    "",
                    f"the law {kind.title}; the other keys of `{kind.like}` apply, and {required_keys} is required",
                )
            )
            continue
        rows.append((f"`{name}`", *key_and_values, "needed", "", kind.title))
        rows += [("", *_list_field_cells(field)) for field in kind.fields]
    yield from _print_table(heading, entry.meaning, ("kind", *_HEADER), rows)


def _print_table(heading: str, meaning: str, header: Row, rows: Sequence[Row]) -> Iterator[str]:
    """Yield the lines of a section: heading, `meaning` as a sentence, and a Markdown table."""
    yield from (f"## {heading}", "", f"{meaning[0].upper()}{meaning[1:]}.", "")
    yield from (_print_table_row(header), "|" + "---|" * len(header), *map(_print_table_row, rows), "")


def _print_table_row(cells: Row) -> str:
    """Return a row of a Markdown table."""
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def _list_field_cells(field: Field) -> Row:
    """Return the cells of a field: key, values, default, condition, meaning."""
    return (
        f"`{field.name}`",
        _describe_values(field),
        _describe_default(field),
        describe_condition(field),
        get_markdown(field.meaning),
    )


def _describe_values(field: Field) -> str:
    """Return the cell with the values that a field accepts, such as "number, kg or `auto`" or "[x, y], m".

    A mapping with known keys or addresses lists them. Other kinds of fields are named by a word, such as "mapping".
    """
    if field.kind == NUMBER:
        alternatives = "".join(f" or `{word}`" for word in field.words)
        unit = f"N/m$^n$ with the number n of the key `{field.per}`" if field.per else _describe_unit(field.dimension)
        return f"number, {unit}{alternatives}" + (f"; of {field.varies}" if field.varies else "")
    if field.kind == VECTOR:
        return f"[x, y], {_describe_unit(field.dimension)}" + (f"; of {field.varies}" if field.varies else "")
    if field.kind in (WORD, FLAG):
        return " or ".join(f"`{_format_value(value)}`" for value in field.values)
    if field.kind == POINTS:
        return "[[x, y], …], numbers"
    if field.kind == DEPTHS:
        return f"[number, …], {_describe_unit(field.dimension)}; or how many"
    if field.kind == RESULTS:
        return "[NAME, …], names of results"
    if field.kind == NAME:
        return f"name in `{field.section}`" if field.section else "name"
    if field.kind == MAPPING:
        entry_kind = field.entry.kind if field.entry else ""
        if field.keys:
            points = "; `BODY.POINT`, [x, y], m" if field.entry and field.entry.kind == PLACE else ""
            return (
                "numbers: "
                + ", ".join(f"`BODY.{key}`, {_describe_unit(dimension)}" for key, dimension in field.keys.items())
                + points
            )
        if field.addresses and field.entry:
            return f"{', '.join(f'`{address}`' for address in field.addresses)}: {_describe_values(field.entry)}"
        return (
            f"names: {_describe_values(field.entry) if field.entry and entry_kind in (NUMBER, VECTOR) else 'mappings'}"
        )
    if field.kind == CORNERS:
        return "[POINT, POINT, POINT]"
    return {RECORD: "mapping", KINDS: "mapping", LAW: "mapping", BODY: "body or `ground`"}.get(field.kind, field.kind)


def _describe_unit(dimension: Dimension | None) -> str:
    """Return the unit of a number for its cell: the SI unit, "any unit" for None, or "no unit or an angle"."""
    if dimension is None:
        return "any unit"
    return find_si_unit(dimension) or "no unit or an angle"


def _describe_targets(kind: Kind) -> str:
    """Return the form of the targets of a kind: "BODY.POINT", "BODY" or a coordinate; "[BODY, BODY]" for two.

    Forms for different numbers of targets are joined by "or".
    """
    target = {"points": "BODY.POINT", "bodies": "BODY", "coordinates": "BODY.x, .y or .theta"}[kind.targets]
    return " or ".join(target if count == 1 else f"[{', '.join([target] * count)}]" for count in kind.counts)


def _describe_default(field: Field) -> str:
    """Return the cell that says what applies without the key: "needed", the default value, or `field.otherwise`."""
    if field.required:
        return "needed"
    if field.default is not None:
        return f"`{_format_value(field.default)}`"
    return field.otherwise


def _format_value(value: float | str | bool) -> str:
    """Return a value in the syntax of the file: "true", "0.5", a word unchanged."""
    return str(value).lower() if isinstance(value, bool) else f"{value:g}" if isinstance(value, float) else value


def describe_condition(field: Field) -> str:
    """Return the conditions on a field as text, such as "> 0, <= `radius`, whole"; "" without conditions.

    The bounds come first, then "not both 0" for vectors and "whole" for integers.
    """
    limits = (f"`{limit}`" if isinstance(limit, str) else f"{limit:g}" for _, limit, _ in field.bounds)
    conditions = [f"{bound.relation} {limit}" for bound, limit in zip(field.bounds, limits, strict=True)]
    return ", ".join([*conditions, *(["not both 0"] if field.nonzero else []), *(["whole"] if field.whole else [])])
