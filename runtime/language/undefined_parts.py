"""Find parts of a file's expressions that are undefined at given values, such as 0/0, as written in the file.

Examples: `cos(acos(d))` simplifies to d, and `d/d` to 1. As written, they are undefined at d = 2 and at d = 0.
"""

from __future__ import annotations

import math
from collections.abc import Container, Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from gudgeon.language.functions import select_function_names
from gudgeon.language.tree import Binary, Call, Expr, Number, Unary, evaluate, iterate_names, list_functions

DEFINED = select_function_names(lambda f: f.is_total)  # functions that are finite for all numbers
DIVIDING = select_function_names(lambda f: f.divides)  # functions that divide by their last argument


def is_defined_everywhere(expr: Expr) -> bool:
    """Return whether no part of an expression can be undefined: it has only sums, products and total functions."""
    match expr:
        case Unary(operand=operand):
            return is_defined_everywhere(operand)
        case Binary(operator=operator, left=left, right=right):
            return operator in ("+", "-", "*") and is_defined_everywhere(left) and is_defined_everywhere(right)
        case Call(arguments=arguments):
            return list_functions(expr) <= DEFINED and all(map(is_defined_everywhere, arguments))
    return True


def find_undefined_part(expr: Expr, known_values: Mapping[str, float]) -> float | None:
    """Return the value (NaN or infinite) of the first non-finite part of an expression that needs only known names.

    None if all such parts are finite. Parts of inactive branches of `where` with parameters are not checked.
    known_values: values by name.
    """
    parts = (
        inner
        for part in _iterate_constant_parts(expr, known_values)
        for inner in (part, *_iterate_masked_parts(part, known_values))
    )
    numbers = (float(evaluate(part, known_values.__getitem__)) for part in parts)
    return next((number for number in numbers if not math.isfinite(number)), None)


def _iterate_masked_parts(expr: Expr, known_values: Mapping[str, float]) -> Iterator[Expr]:
    """Yield the parts of a constant expression whose infinity or NaN may not show in its value.

    They are divisors, bases, exponents and arguments; the divisor of a function is yielded as 1 over it. Of the
    inactive branch of a `where`, only parts without any parameter are included.
    """
    match expr:
        case Unary(operand=operand):
            yield from _iterate_masked_parts(operand, known_values)
        case Binary(operator=operator, left=left, right=right):
            yield from {"/": (right,), "**": (left, right)}.get(operator, ())
            yield from _iterate_masked_parts(left, known_values)
            yield from _iterate_masked_parts(right, known_values)
        case Call(function=function, arguments=arguments):
            if function == "where":
                lower, greater, then, otherwise = arguments
                is_less = evaluate(lower, known_values.__getitem__) < evaluate(greater, known_values.__getitem__)
                selected, other = (then, otherwise) if is_less else (otherwise, then)
                arguments = (lower, greater, selected, *_iterate_constant_parts(other, {}))
            yield from arguments
            if function in DIVIDING:
                yield Binary("/", Number(1.0), arguments[-1])
            for argument in arguments:
                yield from _iterate_masked_parts(argument, known_values)


def _iterate_constant_parts(expr: Expr, known_names: Container[str]) -> Iterator[Expr]:
    """Yield the maximal parts of an expression that depend only on `known_names`.

    A part that divides, as a divisor or the last argument of a function in DIVIDING, is yielded as 1 over it.
    """
    if all(name.path in known_names for name in iterate_names(expr)):
        yield expr
        return
    match expr:
        case Unary(operand=operand):
            yield from _iterate_constant_parts(operand, known_names)
        case Binary(operator=operator, left=left, right=right):
            yield from _iterate_constant_parts(left, known_names)
            for part in _iterate_constant_parts(right, known_names):
                yield Binary("/", Number(1.0), part) if operator == "/" and part is right else part
        case Call(function=function, arguments=arguments):
            divides = arguments[-1] if function in DIVIDING else None
            for argument in arguments:
                for part in _iterate_constant_parts(argument, known_names):
                    yield Binary("/", Number(1.0), part) if part is divides else part


def find_possibly_undefined_cases(expr: Expr, known_values: Mapping[str, NDArray[np.float64]]) -> NDArray[np.bool_]:
    """Return for each of n cases whether a part of the expression may be NaN or infinite, (n,).

    known_values: values (n,) by name. It is a fast necessary condition: inactive branches of `where` are included, so
    that `find_undefined_part` must decide.
    """
    parts = (inner for part in _iterate_constant_parts(expr, known_values) for inner in (part, *_iterate_parts(part)))
    undefined = np.zeros(next(iter(known_values.values())).shape, dtype=bool)
    for part in parts:
        undefined |= ~np.isfinite(evaluate(part, known_values.__getitem__))
    return undefined


def _iterate_parts(expr: Expr) -> Iterator[Expr]:
    """Yield all operands and arguments in an expression, at every depth; the expression itself is not included.

    For functions in DIVIDING, 1 over their last argument is yielded too.
    """
    match expr:
        case Unary(operand=operand):
            parts: tuple[Expr, ...] = (operand,)
        case Binary(left=left, right=right):
            parts = (left, right)
        case Call(function=function, arguments=arguments):
            parts = arguments
            if function in DIVIDING:
                yield Binary("/", Number(1.0), arguments[-1])
        case _:
            return
    for part in parts:
        yield part
        yield from _iterate_parts(part)
