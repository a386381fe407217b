"""Why an expression of the file is no number: the smallest part of it that is none, and who of those by name has it."""

from __future__ import annotations

import json
import math
from collections.abc import Callable

from gudgeon.contract.kernel_source import KernelSource, WrittenInfo
from gudgeon.language.tree import Binary, Call, CurveCall, Expr, Number, Unary, evaluate, from_json, names, replaced

Values = Callable[[str], float]


def culprit(source: KernelSource, tree: Expr, values: Values) -> str:
    """The smallest part of an expression that is not finite while what it is made of is, in words."""
    way = _way(tree, values)
    called = _written_out(source)
    within = next((one for part in way[::-1] for one, whole in called if whole == part), None)
    place = f"in {within.address} (line {within.line}, column {within.column}), " if within else ""
    return place + _words(way[-1], values)


def _written_out(source: KernelSource) -> list[tuple[WrittenInfo, Expr]]:
    """The file's expressions by name, with the trees of others in place of their names."""
    written = {one.address.partition(".")[2]: from_json(json.loads(one.tree)) for one in source.expressions}
    known: dict[str, Expr] = {}

    def whole(name: str) -> Expr:
        if name not in known:
            used = {used.path for used in names(written[name])} & written.keys()
            known[name] = replaced(written[name], {other: whole(other) for other in used})
        return known[name]

    return [(one, whole(name)) for name, one in zip(written, source.expressions, strict=True)]


def _way(tree: Expr, values: Values) -> list[Expr]:
    """From an expression to that part."""
    for part in _parts(tree, values):
        if not isinstance(part, Number) and not math.isfinite(evaluate(part, values)):
            return [tree, *_way(part, values)]
    return [tree]


def _parts(tree: Expr, values: Values) -> tuple[Expr, ...]:
    """What the value of an expression is made of."""
    match tree:
        case Unary(operand=operand):
            return (operand,)
        case Binary(left=left, right=right):
            return left, right
        case Call(function="where", arguments=(left, right, then, otherwise)):
            return left, right, then if evaluate(left, values) < evaluate(right, values) else otherwise
        case Call(arguments=parts):
            return parts
    return ()


def _words(tree: Expr, values: Values) -> str:
    numbers = [float(evaluate(part, values)) for part in _parts(tree, values)]
    told = [f"{number:.12g}" for number in numbers]
    match tree:
        case Binary(operator="/"):
            return f"{told[0]} divided by {told[1]}"
        case Binary(operator="**"):
            return f"the power {told[1]} of {told[0]}"
        case Binary(operator=operator):
            return f"{told[0]} {operator} {told[1]}"
        case CurveCall(function=function, curve=curve):
            return f"curve {function} {curve.outside(numbers[0])}"
        case Call(function=function):
            return f"{function} of {', '.join(told)}"
    return "a number that is not finite"
