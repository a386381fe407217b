"""Represent the expressions of a mechanism file as trees of numbers, names, operators and functions, and walk them.

The parser (runtime/language/parser.py) makes the trees. They hold SI numbers only, and are never evaluated by Python's
or C's own parsers. They belong to the runtime, so that a compiled model computes its `outputs` without the generator.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from gudgeon.language.functions import FUNCTIONS

if TYPE_CHECKING:
    from gudgeon.language.curves import Curve


@dataclass(frozen=True)
class Number:
    """A number in SI; `text` is that of the file ("80 mm"), `has_unit` whether a unit was given."""

    value: float
    text: str = ""
    has_unit: bool = False
    offset: int = 0


@dataclass(frozen=True)
class Name:
    """A name: a parameter, `t`, or the dotted name of a result ("S9.y", "A.F")."""

    path: str
    offset: int = 0


@dataclass(frozen=True)
class Unary:
    """A negated expression."""

    operator: str  # "-" (a leading "+" is dropped by the parser)
    operand: Expr
    offset: int = 0


@dataclass(frozen=True)
class Binary:
    """A binary operation: two operands with the operator between them."""

    operator: str  # + - * / **
    left: Expr
    right: Expr
    offset: int = 0


@dataclass(frozen=True)
class Call:
    """The call of a function."""

    function: str
    arguments: tuple[Expr, ...]
    offset: int = 0


@dataclass(frozen=True)
class CurveCall(Call):
    """The call of a curve of the file with its one argument; `function` is the curve's name."""

    curve: Curve = field(kw_only=True)


Expr: TypeAlias = Number | Name | Unary | Binary | Call  # an expression tree


# NumPy's functions of the operators
_OPERATORS: Mapping[str, Callable[[Any, Any], Any]] = {
    "+": np.add,
    "-": np.subtract,
    "*": np.multiply,
    "/": np.true_divide,
    "**": np.power,
}

_CURVE = "curve"  # first item of a curve in a stored tree: no function has this name


def evaluate(expr: Expr, get_value: Callable[[str], Any]) -> Any:
    """Return the value of an expression, a number or an array; `get_value(path)` returns the value of a name.

    Undefined operations give NaN or infinity without a warning. Raises TypeError for another object.
    """
    with np.errstate(all="ignore"):
        return _evaluate(expr, get_value)


def _evaluate(expr: Expr, get_value: Callable[[str], Any]) -> Any:
    """Return the value of an expression recursively for `evaluate`, with the current error state of NumPy.

    get_value(path): value of a name, a number or an array. Numbers are np.float64, so that 1/0 gives infinity.
    """
    match expr:
        case Number(value=value):
            return np.float64(value)
        case Name(path=path):
            return get_value(path)
        case Unary(operand=operand):
            return -_evaluate(operand, get_value)
        case Binary(operator=operator, left=left, right=right):
            return _OPERATORS[operator](_evaluate(left, get_value), _evaluate(right, get_value))
        case CurveCall(arguments=(argument,), curve=curve):
            return curve.evaluate(_evaluate(argument, get_value))
        case Call(function=function, arguments=arguments):
            return FUNCTIONS[function].evaluate(*(_evaluate(a, get_value) for a in arguments))
    raise TypeError(f"not an expression: {expr!r}")


def iterate_names(expr: Expr) -> Iterator[Name]:
    """Yield every Name in an expression, left to right, with repetitions; those in arguments of curves, too."""
    match expr:
        case Name():
            yield expr
        case Unary(operand=operand):
            yield from iterate_names(operand)
        case Binary(left=left, right=right):
            yield from iterate_names(left)
            yield from iterate_names(right)
        case Call(arguments=arguments):
            for argument in arguments:
                yield from iterate_names(argument)


def iterate_units(expr: Expr) -> Iterator[str]:
    """Yield the unit of every number in an expression that has one, as it is written."""
    match expr:
        case Number(text=text, has_unit=True):
            yield text.partition(" ")[2]
        case Unary(operand=operand):
            yield from iterate_units(operand)
        case Binary(left=left, right=right):
            yield from iterate_units(left)
            yield from iterate_units(right)
        case Call(arguments=arguments):
            for argument in arguments:
                yield from iterate_units(argument)


def replace_names(expr: Expr, replacements: Mapping[str, Expr]) -> Expr:
    """Return a copy of an expression in which the names in `replacements` are replaced by their trees.

    Other names and numbers remain. All occurrences of a name share one tree object.
    """
    match expr:
        case Name():
            return replacements.get(expr.path, expr)
        case Unary(operand=operand):
            return replace(expr, operand=replace_names(operand, replacements))
        case Binary(left=left, right=right):
            return replace(expr, left=replace_names(left, replacements), right=replace_names(right, replacements))
        case Call(arguments=arguments):
            return replace(expr, arguments=tuple(replace_names(argument, replacements) for argument in arguments))
    return expr


def iterate_calls(expr: Expr, function: str = "") -> Iterator[Call]:
    """Yield every call in an expression, or only the calls of one function; a call precedes those in its arguments.

    Calls of curves count, by the name of the curve. All branches of a `where` are searched.
    """
    match expr:
        case Unary(operand=operand):
            yield from iterate_calls(operand, function)
        case Binary(left=left, right=right):
            yield from iterate_calls(left, function)
            yield from iterate_calls(right, function)
        case Call(arguments=arguments):
            if function in ("", expr.function):
                yield expr
            for argument in arguments:
                yield from iterate_calls(argument, function)


def iterate_active_calls(expr: Expr, function: str, get_value: Callable[[str], Any]) -> Iterator[Call]:
    """Yield the calls of one function on which the current value of an expression depends.

    Only the active branch of each `where` is searched, both at equality. get_value(path): value of a name.
    """
    match expr:
        case Unary(operand=operand):
            yield from iterate_active_calls(operand, function, get_value)
        case Binary(left=left, right=right):
            yield from iterate_active_calls(left, function, get_value)
            yield from iterate_active_calls(right, function, get_value)
        case Call(arguments=arguments):
            if function == expr.function:
                yield expr
            if expr.function == "where":
                left, right, then, otherwise = arguments
                gap = evaluate(left, get_value) - evaluate(right, get_value)
                arguments = (left, right, *(then,) * bool(gap <= 0.0), *(otherwise,) * bool(gap >= 0.0))
            for argument in arguments:
                yield from iterate_active_calls(argument, function, get_value)


def iterate_curve_calls(expr: Expr) -> Iterator[CurveCall]:
    """Return an iterator over the curve calls in an expression."""
    return (call for call in iterate_calls(expr) if isinstance(call, CurveCall))


def list_functions(expr: Expr) -> set[str]:
    """Return the set of names of the functions that an expression calls.

    A curve does not count; an extrapolated curve counts as calls of min and max. Arguments are searched too.
    """
    match expr:
        case Unary(operand=operand):
            return list_functions(operand)
        case Binary(left=left, right=right):
            return list_functions(left) | list_functions(right)
        case CurveCall(arguments=arguments, curve=curve):
            curve_functions = {"min", "max"} if curve.is_extrapolated else set()
            return curve_functions.union(*map(list_functions, arguments))
        case Call(function=function, arguments=arguments):
            return {function}.union(*map(list_functions, arguments))
    return set()


def to_json(expr: Expr) -> Any:
    """Return an expression as nested lists for JSON, which `from_json` reads: ["+", "c", ["sin", "t"]] for c + sin(t).

    Units and texts of numbers are dropped.
    """
    match expr:
        case Number(value=value):
            return float(value)
        case Name(path=path):
            return path
        case Unary(operand=operand):
            return ["-", to_json(operand)]
        case Binary(operator=operator, left=left, right=right):
            return [operator, to_json(left), to_json(right)]
        case CurveCall(arguments=(argument,), curve=curve):
            return [_CURVE, curve.to_data(), to_json(argument)]
        case Call(function=function, arguments=arguments):
            return [function, *map(to_json, arguments)]


def from_json(data: Any) -> Expr:
    """Return the expression from the nested lists that `to_json` wrote.

    Texts and units of numbers and offsets of nodes are not restored.
    """
    if isinstance(data, (int, float)):
        return Number(float(data))
    if isinstance(data, str):
        return Name(data)
    head, *rest = data
    if head == "-" and len(rest) == 1:
        return Unary("-", from_json(rest[0]))
    if head == _CURVE:
        from gudgeon.language.curves import Curve

        curve = Curve.from_data(rest[0])
        return CurveCall(curve.name, (from_json(rest[1]),), curve=curve)
    if head in _OPERATORS:
        return Binary(head, from_json(rest[0]), from_json(rest[1]))
    return Call(head, tuple(map(from_json, rest)))
