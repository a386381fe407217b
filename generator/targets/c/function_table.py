"""Writes engine/scene/function_table.h: the functions that follow one pattern, from gudgeon.language.functions."""

from __future__ import annotations

import math

import sympy as sp

from gudgeon.generator.symbols.from_expressions import derivative_at
from gudgeon.generator.targets.c import printer
from gudgeon.language.functions import FUNCTIONS, IN_SYMPY, Function

_HEAD = """\
/*
 * Functions of expressions of which C needs nothing but the library's function, its domain and its derivative: written
 * by `make tables` from runtime/language/functions.py.
 */
#ifndef GUDGEON_FUNCTION_TABLE_H
#define GUDGEON_FUNCTION_TABLE_H

/* The library has no vectors of them. */
"""
_RISING = """
/*
 * RISING(name, from, to, extremum, slope): a function that rises from `from` to `to`, with its derivative at x. The
 * derivative rises or falls on each side of `extremum`; NAN: on the whole domain.
 */
"""


def function_table() -> str:
    """Return the text of the header."""
    by_lane = [f for f in IN_SYMPY.values() if not f.has_vector_code]
    calls = [f"{'OF_ONE' if len(f.arguments) == 1 else 'OF_TWO'}({f.in_c})" for f in by_lane]
    rising = [_rising(f) for f in FUNCTIONS.values() if f.bounds]
    return "".join(
        (
            _HEAD,
            _macro("LANE_AFTER_LANE_FUNCTIONS(OF_ONE, OF_TWO)", calls),
            _RISING,
            _macro("RISING_FUNCTIONS(RISING)", rising),
            "\n#endif\n",
        )
    )


def _macro(head: str, calls: list[str]) -> str:
    """Return a macro that lists calls, one a line."""
    return " \\\n".join((f"#define {head}", *(f"    {call}" for call in calls))) + "\n"


def _rising(function: Function) -> str:
    """Return the entry of a rising function: its domain, the extremum of its slope and the slope."""
    assert function.bounds
    x, f = sp.Symbol("x", real=True), sp.Symbol(f"{function.in_c}(x)", real=True)
    slope = function.bounds.slope or printer.expression(derivative_at(function.derivative, x, f))
    places = map(_number, (*function.domain, function.bounds.slope_extremum))
    return f"RISING({function.in_c}, {', '.join(places)}, {slope})"


def _number(value: float) -> str:
    """Return a number as C."""
    if math.isnan(value):
        return "NAN"
    return repr(value) if math.isfinite(value) else "-INFINITY" if value < 0.0 else "INFINITY"
