"""The tables of a file's curves as C: those that the other texts call, for engine/scene/curves.h."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from gudgeon.generator.symbols.curves import c_name
from gudgeon.generator.targets.c.printer import comment_text
from gudgeon.language.curves import Curve

NAME = "curves.c"


def curves_code(curves: Mapping[str, Curve], texts: Iterable[str]) -> str:
    """The file; "" where nothing calls a curve."""
    called = [curve for curve in curves.values() if any(f"({c_name(curve.name)}," in text for text in texts)]
    if not called:
        return ""
    parts = ['#include "engine/scene/curves.h"\n', *map(_table, called)]
    names = ", ".join(c_name(curve.name) for curve in called)
    entries = [
        f"    {{{len(curve.coefficients)}, {int(curve.repeats)}, knots_of_{curve.name}, pieces_of_{curve.name}}},"
        for curve in called
    ]
    return "\n".join([*parts, f"enum {{ {names} }};", "static const Curve curves[] = {", *entries, "};", ""])


def _table(curve: Curve) -> str:
    """Knots, and the coefficients of the pieces between them."""
    told = comment_text(f"{curve.name}: {curve.told()}")
    knots = [", ".join(map(repr, curve.x[k : k + 4])) for k in range(0, len(curve.x), 4)]
    pieces = [f"    {{{', '.join(map(repr, piece))}}}," for piece in curve.coefficients]
    return "\n".join([
        f"/* {told} */",
        f"static const double knots_of_{curve.name}[] = {{", *(f"    {line}," for line in knots), "};",
        f"static const double pieces_of_{curve.name}[][4] = {{", *pieces, "};", "",
    ])  # fmt: skip
