"""Prints generated functions for interval arithmetic: intervals (bounds and slopes) take the place of numbers.

The operations are in engine/watch/ranges.h.
"""

from __future__ import annotations

from dataclasses import replace

import sympy as sp

from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.ir.readable import make_readable
from gudgeon.generator.ir.signatures import Number, Type
from gudgeon.generator.ir.values import Value
from gudgeon.generator.symbols.curves import CurveOf, CurveOn, KnotsOf, make_curve_name
from gudgeon.generator.symbols.storage import StorageLocation
from gudgeon.generator.targets.c import functions, printer
from gudgeon.generator.targets.cached_printer import order_terms

_TYPES: dict[Type, Type] = {Number.REAL: "Interval", "RhsOutputs": "Interval"}
_NAMES = {"rhs": "out"}
_RANGES = {"q", "v", "t"}  # arguments that are ranges; all others are numbers


class RangesPrinter(printer.CPrinter):
    """Print every operation as a call of interval arithmetic; expressions without symbols stay scalars."""

    def print_storage_location(self, place: StorageLocation) -> str:
        """Return a storage place as C; a parameter becomes an interval of one value."""
        text = super().print_storage_location(place)
        return f"make_interval({text})" if place.is_parameter else text

    def _print_range(self, expr: sp.Expr) -> str:
        """Print an expression as an interval; a constant becomes an interval of one value."""
        text: str = self._print(expr)
        return text if expr.free_symbols else f"make_interval({text})"

    def _print_call(self, function_name: str, *arguments: sp.Expr) -> str:
        """Print a call of a function of intervals; with constant arguments only, the call of the scalar function."""
        if not any(argument.free_symbols for argument in arguments):
            return super()._print_call(function_name, *arguments)
        return f"interval_{function_name}({', '.join(map(self._print_range, arguments))})"

    def _print_chained_calls(self, function_name: str, arguments: tuple[sp.Expr, ...]) -> str:
        """Print nested calls of an operation on two intervals, such as interval_add(interval_add(a, b), c)."""
        text = self._print_range(arguments[0])
        for argument in arguments[1:]:
            text = f"interval_{function_name}({text}, {self._print_range(argument)})"
        return text

    def _print_Add(self, expr: sp.Expr, order: object = None) -> str:
        """Print a sum as nested calls of interval_add in printing order; one without symbols as a scalar.

        `order`: an argument of SymPy, not used.
        """
        if not expr.free_symbols:
            return str(super()._print_Add(expr))
        return self._print_chained_calls("add", order_terms(expr))

    def _print_Mul(self, expr: sp.Expr) -> str:
        """Print a product as nested calls of interval_mul; one without symbols as a scalar.

        A coefficient that is not a normal double is split into two factors, first and last.
        """
        if not expr.free_symbols:
            return str(super()._print_Mul(expr))
        number, other_factors = expr.as_coeff_Mul()
        factors = other_factors.as_ordered_factors()
        if not printer.is_normal(number):
            first, last = printer.split_number(number)
            return self._print_chained_calls("mul", (first, *factors, last))
        return self._print_chained_calls("mul", (number, *factors) if number != 1 else tuple(factors))

    def _print_Pow(self, expr: sp.Pow) -> str:
        """Print a power as a call: exponents −1, 2 and ±1/2 by special functions, others by interval_pow.

        A power without symbols is printed as a scalar.
        """
        if not expr.free_symbols:
            return super()._print_Pow(expr)
        base, exponent = expr.as_base_exp()
        named = {-1: "inverse", 2: "square", sp.Rational(1, 2): "sqrt"}
        if exponent in named:
            return self._print_call(named[exponent], base)
        if exponent == sp.Rational(-1, 2):
            return f"interval_inverse({self._print_call('sqrt', base)})"
        return self._print_call("pow", base, exponent)

    def _print_nested_calls(self, function_name: str, expr: sp.Expr) -> str:
        """Print an associative function, such as a maximum, as nested calls of two intervals; constants come last.

        An expression without symbols is printed as a scalar.
        """
        if not expr.free_symbols:
            return super()._print_nested_calls(function_name, expr)
        return self._print_chained_calls(function_name, tuple(sorted(expr.args, key=lambda a: (a.is_Number, str(a)))))

    def _print_Heaviside(self, expr: sp.Expr) -> str:
        """Print the step function of a range."""
        return self._print_call("heaviside", expr.args[0])

    def _print_BranchOf(self, expr: sp.Expr) -> str:
        """Print the active branch of a switching function over intervals; values of g are not stored."""
        return f"interval_branch(branch, {int(expr.args[0])}, {self._print_range(expr.args[1])})"

    def _print_Slope(self, expr: sp.Expr) -> str:
        """Print a derivative without the difference quotient that replaces it, since for intervals 0 · ∞ is 0."""
        return self._print_range(expr.args[0])

    def _print_Magnitude(self, expr: sp.Expr) -> str:
        """Print the absolute value of a range."""
        return self._print_call("magnitude", expr.args[0])

    def _print_CurveOf(self, expr: CurveOf) -> str:
        """Print the value of a curve, or its derivative, over an interval; at a constant, the scalar call."""
        if not expr.free_symbols:
            return super()._print_CurveOf(expr)
        return f"interval_curve({make_curve_name(expr.name)}, {expr.order}, {self._print_range(expr.args[2])})"

    def _print_CurveOn(self, expr: CurveOn) -> str:
        """Print the value of a curve over an interval, on the piece that its frozen branch selects."""
        x, branch = map(self._print_range, expr.args[2:])
        return f"interval_curve_on({make_curve_name(expr.name)}, {expr.order}, {x}, {branch})"

    def _print_KnotsOf(self, expr: KnotsOf) -> str:
        """Print the event function of a curve's knots over a range."""
        return f"interval_knots({make_curve_name(expr.name)}, {self._print_range(expr.args[1])})"

    def _print_Select(self, expr: sp.Expr) -> str:
        """Print a choice by the sign of a range."""
        return self._print_call("select", *expr.args)


class _RangeLinePrinter(functions.LinePrinter):
    """Print statements whose locals are ranges."""

    printer: RangesPrinter

    def print_expression(self, value: Value) -> str:
        """Return a value as an interval; a value that reads neither t, q nor v becomes an interval of one value."""
        if isinstance(value, sp.Basic):
            return self.printer._print_range(value)
        text = super().print_expression(value)
        return text if value.names & _RANGES else f"make_interval({text})"


def print_interval_kernel(kernel: Kernel) -> str:
    """Return a kernel as a C function of intervals of t, q and v (interval arithmetic); parameters stay scalars.

    The results in RhsOutputs become intervals in the argument `out`. The engine calls the function to bound event
    functions over a step.
    """
    arguments = tuple(
        replace(a, name=_NAMES.get(a.name, a.name), type=_TYPES.get(a.type, a.type)) for a in kernel.arguments
    )
    range_kernel = replace(kernel, arguments=arguments)
    readable_lines = make_readable(range_kernel, name_branches=False)
    return functions.print_function(
        range_kernel,
        _RangeLinePrinter(RangesPrinter(readable_lines), "Interval"),
        readable_lines,
        is_called_by_engine=True,
    )
