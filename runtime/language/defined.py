"""Find parts of expressions, as they are written, that are not finite numbers; simplified formulas may lack them.

Examples: `cos(acos(d))` simplifies to d, and `d/d` to 1. As written, they are undefined at d = 2 and at d = 0.
"""

from __future__ import annotations

import math
from collections.abc import Container, Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from gudgeon.language.functions import names_where
from gudgeon.language.tree import Binary, Call, Expr, Number, Unary, evaluate, functions, names

DEFINED = names_where(lambda f: f.is_total)  # functions that are finite for all numbers
DIVIDING = names_where(lambda f: f.divides)  # functions that divide by their last argument


def is_total_expression(expr: Expr) -> bool:
    """Return whether no part can be undefined: only sums, products, and functions of every number."""
    match expr:
        case Unary(operand=operand):
            return is_total_expression(operand)
        case Binary(operator=operator, left=left, right=right):
            return operator in ("+", "-", "*") and is_total_expression(left) and is_total_expression(right)
        case Call(arguments=arguments):
            return functions(expr) <= DEFINED and all(map(is_total_expression, arguments))
    return True


def find_undefined_part(expr: Expr, known: Mapping[str, float]) -> float | None:
    """Return the value of the first part that is not finite and depends on the `known` names alone; else None."""
    parts = (inner for part in _constant_parts(expr, known) for inner in (part, *_absorbed_parts(part, known)))
    numbers = (float(evaluate(part, known.__getitem__)) for part in parts)
    return next((number for number in numbers if not math.isfinite(number)), None)


def _absorbed_parts(expr: Expr, known: Mapping[str, float]) -> Iterator[Expr]:
    """Yield the parts of a constant whose infinity or NaN its value may lack: arguments, divisors, exponents.

    Of the inactive branch of a `where`, only parts without any parameter are included.
    """
    match expr:
        case Unary(operand=operand):
            yield from _absorbed_parts(operand, known)
        case Binary(operator=operator, left=left, right=right):
            yield from {"/": (right,), "**": (left, right)}.get(operator, ())
            yield from _absorbed_parts(left, known)
            yield from _absorbed_parts(right, known)
        case Call(function=function, arguments=arguments):
            if function == "where":
                less, more, then, otherwise = arguments
                is_less = evaluate(less, known.__getitem__) < evaluate(more, known.__getitem__)
                selected, other = (then, otherwise) if is_less else (otherwise, then)
                arguments = (less, more, selected, *_constant_parts(other, {}))
            yield from arguments
            if function in DIVIDING:
                yield Binary("/", Number(1.0), arguments[-1])
            for argument in arguments:
                yield from _absorbed_parts(argument, known)


def _constant_parts(expr: Expr, known: Container[str]) -> Iterator[Expr]:
    """Yield the largest parts that depend on `known` names alone, and 1 over each of them that divides."""
    if all(name.path in known for name in names(expr)):
        yield expr
        return
    match expr:
        case Unary(operand=operand):
            yield from _constant_parts(operand, known)
        case Binary(operator=operator, left=left, right=right):
            yield from _constant_parts(left, known)
            for part in _constant_parts(right, known):
                yield Binary("/", Number(1.0), part) if operator == "/" and part is right else part
        case Call(function=function, arguments=arguments):
            divides = arguments[-1] if function in DIVIDING else None
            for argument in arguments:
                for part in _constant_parts(argument, known):
                    yield Binary("/", Number(1.0), part) if part is divides else part


def may_be_undefined(expr: Expr, known: Mapping[str, NDArray[np.float64]]) -> NDArray[np.bool_]:
    """Return a mask (n,) of the cases in which a part of the expression may not be finite.

    `known`: values (n,) by name. The inactive branch of a `where` is included, so that undefined_part decides.
    """
    parts = (inner for part in _constant_parts(expr, known) for inner in (part, *_every_part(part)))
    undefined = np.zeros(next(iter(known.values())).shape, dtype=bool)
    for part in parts:
        undefined |= ~np.isfinite(evaluate(part, known.__getitem__))
    return undefined


def _every_part(expr: Expr) -> Iterator[Expr]:
    """Yield all parts of an expression, and 1 over the divisors within functions."""
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
        yield from _every_part(part)
