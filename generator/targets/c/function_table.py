"""Writes engine/scene/function_table.h: functions of expressions that C takes from its library."""

from __future__ import annotations

import math

import sympy as sp

from gudgeon.generator.symbols.from_expressions import convert_derivative
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


def print_function_table() -> str:
    """Return the text of engine/scene/function_table.h: X-macros that list functions of expressions by their C name.

    The first macro lists functions without vector code, the second monotonic functions with their derivatives. Called
    by `make tables`.
    """
    by_lane = [f for f in IN_SYMPY.values() if not f.has_vector_code]
    calls = [f"{'OF_ONE' if len(f.arguments) == 1 else 'OF_TWO'}({f.in_c})" for f in by_lane]
    entries = [_print_monotonic_entry(f) for f in FUNCTIONS.values() if f.bounds]
    return "".join(
        (
            _HEAD,
            _print_macro("LANE_AFTER_LANE_FUNCTIONS(OF_ONE, OF_TWO)", calls),
            _RISING,
            _print_macro("RISING_FUNCTIONS(RISING)", entries),
            "\n#endif\n",
        )
    )


def _print_macro(signature: str, calls: list[str]) -> str:
    """Return a #define of the macro `signature`, whose replacement is a list of calls, one per line."""
    return " \\\n".join((f"#define {signature}", *(f"    {call}" for call in calls))) + "\n"


def _print_monotonic_entry(function: Function) -> str:
    """Return the RISING entry of a monotonic function in C: domain, extremum of the derivative and the derivative.

    Example: "RISING(sinh, -INFINITY, INFINITY, 0.0, cosh(x))". The derivative is the one that the function specifies,
    else it is derived with SymPy. `function.bounds` must not be None.
    """
    assert function.bounds
    x, f = sp.Symbol("x", real=True), sp.Symbol(f"{function.in_c}(x)", real=True)
    slope = function.bounds.slope or printer.print_expression(convert_derivative(function.derivative, x, f))
    limits = map(_print_number, (*function.domain, function.bounds.slope_extremum))
    return f"RISING({function.in_c}, {', '.join(limits)}, {slope})"


def _print_number(value: float) -> str:
    """Return a number as C: NAN, INFINITY or -INFINITY if it is not finite."""
    if math.isnan(value):
        return "NAN"
    return repr(value) if math.isfinite(value) else "-INFINITY" if value < 0.0 else "INFINITY"
