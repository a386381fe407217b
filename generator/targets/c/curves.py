"""Writes the tables of a file's curves as C, for engine/scene/curves.h; only of curves that the scene's C calls."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from gudgeon.generator.symbols.curves import make_curve_name
from gudgeon.generator.targets.c.printer import sanitize_comment
from gudgeon.language.curves import Curve

NAME = "curves.c"


def print_curve_tables(curves: Mapping[str, Curve], texts: Iterable[str]) -> str:
    """Return the text of curves.c with the tables of the curves that the C texts call; "" if none calls a curve.

    curves: all curves of the file by name. texts: the printed C of the scene. Curves without a call are left out.
    """
    called = [curve for curve in curves.values() if any(f"({make_curve_name(curve.name)}," in text for text in texts)]
    if not called:
        return ""
    tables = ['#include "engine/scene/curves.h"\n', *map(_print_curve_table, called)]
    constants = ", ".join(make_curve_name(curve.name) for curve in called)
    struct_entries = [
        f"    {{{len(curve.coefficients)}, {int(curve.is_periodic)}, "
        f"knots_of_{curve.name}{member}, pieces_of_{curve.name}{member}}},"
        for curve, member in ((curve, ".numbers" * curve.is_long) for curve in called)
    ]
    return "\n".join(
        [*tables, f"enum {{ {constants} }};", "static const Curve curves[] = {", *struct_entries, "};", ""]
    )


def _print_curve_table(curve: Curve) -> str:
    """Return the C arrays of one curve: its knots, and the four coefficients of each piece between them.

    A long curve (`Curve.is_long`) is written as little-endian bytes (`_print_byte_table`), a short one as numbers.
    """
    description = sanitize_comment(f"{curve.name}: {curve.describe()}")
    if curve.is_long:
        byte_tables = _print_byte_table("knots", curve.name, curve.x) + _print_byte_table(
            "pieces", curve.name, curve.coefficients
        )
        return "\n".join([f"/* {description} */", _LITTLE_ENDIAN, *byte_tables, ""])
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


def _print_byte_table(prefix: str, name: str, table: Any) -> list[str]:
    """Return the C definition of the union `prefix`_of_`name`, an array of doubles stored as string literals of bytes.

    Used for long tables, since a compiler reads strings much faster than many numbers.
    """
    data = np.asarray(table, "<f8")
    shape = "".join(f"[{n}]" for n in data.shape)
    octal_escapes = np.array([f"\\{k:03o}".encode() for k in range(256)])[np.frombuffer(data.tobytes(), np.uint8)]
    text = octal_escapes.tobytes().decode("ascii")
    strings = [f'"{text[k : k + 4 * _ROW_BYTES]}"' for k in range(0, len(text), 4 * _ROW_BYTES)]
    union = f"union {{ unsigned char bytes[{data.nbytes}]; double numbers{shape}; }}"
    return [f"static const {union} {prefix}_of_{name} = {{", *strings, "};"]


_ROW_BYTES = 256  # of one string literal
_LITTLE_ENDIAN = """\
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "the tables of long curves are little-endian"
#endif"""
