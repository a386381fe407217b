"""Writes the tables of a file's curves as C, for engine/scene/curves.h; only curves that other files call."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from gudgeon.generator.symbols.curves import c_name
from gudgeon.generator.targets.c.printer import comment_text
from gudgeon.language.curves import Curve

NAME = "curves.c"


def curves_code(curves: Mapping[str, Curve], texts: Iterable[str]) -> str:
    """Return the text of curves.c; "" if no text calls a curve."""
    called = [curve for curve in curves.values() if any(f"({c_name(curve.name)}," in text for text in texts)]
    if not called:
        return ""
    parts = ['#include "engine/scene/curves.h"\n', *map(_table, called)]
    names = ", ".join(c_name(curve.name) for curve in called)
    entries = [
        f"    {{{len(curve.coefficients)}, {int(curve.repeats)}, "
        f"knots_of_{curve.name}{numbers}, pieces_of_{curve.name}{numbers}}},"
        for curve, numbers in ((curve, ".numbers" * curve.is_long) for curve in called)
    ]
    return "\n".join([*parts, f"enum {{ {names} }};", "static const Curve curves[] = {", *entries, "};", ""])


def _table(curve: Curve) -> str:
    """Return the C tables of one curve: knots, and the coefficients of the pieces between them."""
    description = comment_text(f"{curve.name}: {curve.message()}")
    if curve.is_long:
        tables = _byte_table("knots", curve.name, curve.x) + _byte_table("pieces", curve.name, curve.coefficients)
        return "\n".join([f"/* {description} */", _LITTLE_ENDIAN, *tables, ""])
    knots = [", ".join(map(repr, curve.x[k : k + 4])) for k in range(0, len(curve.x), 4)]
    pieces = [f"    {{{', '.join(map(repr, piece))}}}," for piece in curve.coefficients]
    return "\n".join(
        [
            f"/* {description} */",
            f"static const double knots_of_{curve.name}[] = {{",
            *(f"    {line}," for line in knots),
            "};",
            f"static const double pieces_of_{curve.name}[][4] = {{",
            *pieces,
            "};",
            "",
        ]
    )


def _byte_table(what: str, name: str, table: Any) -> list[str]:
    """Return a long table as the bytes of its numbers, which a compiler reads much faster than numbers."""
    data = np.asarray(table, "<f8")
    shape = "".join(f"[{n}]" for n in data.shape)
    octal = np.array([f"\\{k:03o}".encode() for k in range(256)])[np.frombuffer(data.tobytes(), np.uint8)]
    text = octal.tobytes().decode("ascii")
    rows = [f'"{text[k : k + 4 * _ROW]}"' for k in range(0, len(text), 4 * _ROW)]
    union = f"union {{ unsigned char bytes[{data.nbytes}]; double numbers{shape}; }}"
    return [f"static const {union} {what}_of_{name} = {{", *rows, "};"]


_ROW = 256  # bytes
_LITTLE_ENDIAN = """\
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "the tables of long curves are little-endian"
#endif"""
