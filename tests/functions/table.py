"""Random arguments and values of the functions that expressions may use, from their table."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sp
from numpy.typing import NDArray

from gudgeon.errors import Location
from gudgeon.generator.symbols.from_expressions import convert_to_sympy
from gudgeon.language.functions import FUNCTIONS, Function
from gudgeon.language.parser import parse
from gudgeon.language.tree import Expr, evaluate

HERE = Location("test", 1, 1)
COUNT = 40  # random arguments of each function
Array = NDArray[np.float64]
every_function = pytest.mark.parametrize("function", FUNCTIONS.values(), ids=lambda f: f.name)


def interval(function: Function) -> tuple[float, float]:
    """Where arguments are drawn from: the part of the domain that is not far from its middle."""
    low, high = function.domain
    return max(low, min(-3.0, high - 3.0)), min(high, max(3.0, low + 3.0))


def draw(function: Function, count: int = COUNT) -> Array:
    """Random arguments, (count, arguments); what divides is positive."""
    low, high = interval(function)
    rng = np.random.default_rng(list(function.name.encode()))
    found = rng.uniform(low + 1e-3, high - 1e-3, (count, len(function.arguments)))
    if function.divides:
        found[:, -1] = rng.uniform(0.5, 2.0, count)
    return found


def names(function: Function) -> list[str]:
    return [f"x{k}" for k in range(len(function.arguments))]


def tree(function: Function) -> Expr:
    return parse(function.format_call(*names(function)), HERE)


def in_sympy(function: Function) -> sp.Expr:
    return convert_to_sympy(tree(function), lambda name: sp.Symbol(name, real=True))


def values(function: Function, arguments: Array) -> Array:
    """By NumPy, of arguments (…, arguments)."""
    known = dict(zip(names(function), np.moveaxis(arguments, -1, 0), strict=True))
    return np.asarray(evaluate(tree(function), known.__getitem__), dtype=np.float64)


def sorted_symbols(function: Function) -> list[sp.Symbol]:
    return [sp.Symbol(name, real=True) for name in names(function)]
