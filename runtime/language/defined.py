"""Parts of expressions, as they are written, that are no finite numbers: simplified formulas may lack them.

`cos(acos(d))` is d, `d/d` is 1; as they are written the one is undefined at d = 2, the other at d = 0.
"""

from __future__ import annotations

import math
from collections.abc import Container, Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from gudgeon.language.functions import names_where
from gudgeon.language.tree import Binary, Call, Expr, Number, Unary, evaluate, functions, names

DEFINED = names_where(lambda f: f.is_total)
DIVIDING = names_where(lambda f: f.divides)


def is_defined_everywhere(expr: Expr) -> bool:
    """Whether nothing in it can be undefined: sums, products, and functions of every number."""
    match expr:
        case Unary(operand=operand):
            return is_defined_everywhere(operand)
        case Binary(operator=operator, left=left, right=right):
            return operator in ("+", "-", "*") and is_defined_everywhere(left) and is_defined_everywhere(right)
        case Call(arguments=arguments):
            return functions(expr) <= DEFINED and all(map(is_defined_everywhere, arguments))
    return True


def undefined_part(expr: Expr, known: Mapping[str, float]) -> float | None:
    """The value of the first part that numbers, by name, alone determine and that is not finite; None: none is."""
    parts = (inner for part in _constant_parts(expr, known) for inner in (part, *_absorbed_parts(part, known)))
    numbers = (float(evaluate(part, known.__getitem__)) for part in parts)
    return next((number for number in numbers if not math.isfinite(number)), None)


def _absorbed_parts(expr: Expr, known: Mapping[str, float]) -> Iterator[Expr]:
    """Yield the parts of a constant whose infinity or NaN its value may lack: arguments, divisors, bases, exponents.

    Of the branch of a `where` that is not picked: those that no parameter could make finite.
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
                chosen, other = (then, otherwise) if is_less else (otherwise, then)
                arguments = (less, more, chosen, *_constant_parts(other, {}))
            yield from arguments
            if function in DIVIDING:
                yield Binary("/", Number(1.0), arguments[-1])
            for argument in arguments:
                yield from _absorbed_parts(argument, known)


def _constant_parts(expr: Expr, known: Container[str]) -> Iterator[Expr]:
    """The largest parts of an expression that parameters alone determine, and 1 over each of them that divides."""
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
    """Where any part that these values, (n,) by name, one at least, alone determine is not finite.

    The branch of a `where` that is not picked included: undefined_part has the last word.
    """
    parts = (inner for part in _constant_parts(expr, known) for inner in (part, *_every_part(part)))
    undefined = np.zeros(next(iter(known.values())).shape, dtype=bool)
    for part in parts:
        undefined |= ~np.isfinite(evaluate(part, known.__getitem__))
    return undefined


def _every_part(expr: Expr) -> Iterator[Expr]:
    """All parts of an expression, and 1 over what divides within functions."""
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
