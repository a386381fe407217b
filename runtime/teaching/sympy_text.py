"""Expressions of a model as Python that SymPy alone reads, under names that a notebook has for nothing else."""

from __future__ import annotations

import builtins
from collections.abc import Mapping
from typing import Any

import sympy as sp
from sympy.printing.precedence import PRECEDENCE
from sympy.printing.str import StrPrinter

from gudgeon.errors import GudgeonError
from gudgeon.generator.equations.model import Model
from gudgeon.generator.ir.finite_slopes import for_readers
from gudgeon.generator.symbols.symbols import plain_name
from gudgeon.generator.targets.latex.printers import share_of_pi
from gudgeon.language.functions import IN_SYMPY

# what a notebook calls so itself
TAKEN = frozenset(
    (*dir(builtins), "sp", "np", "gudgeon", "numbers", "q", "v", "t", "nu", "gamma", "M", "g", "a", "p")
    + (
        "run",
        "simulation",
        "start",
        "end",
        "function",
        "derived",
        "in_numpy",
        "rows",
        "name",
        "ours",
        "theirs",
        "entries",
        "right",
    )
    + ("mass", "forces", "system", "solved", "Phi")
)
TAKEN_HEADS = ("Phi_", "first_", "second_")
_PLAIN = frozenset((*IN_SYMPY, "Heaviside"))


class Printer(StrPrinter):
    """SymPy's own text, functions behind `sp.`."""

    def __init__(self, names: Mapping[sp.Symbol, str]) -> None:
        super().__init__()
        self._names = names

    def _print_Symbol(self, expr: sp.Symbol) -> str:
        return self._names.get(expr, plain_name(expr))

    def _print_Float(self, expr: sp.Float) -> str:
        return number_of_code(float(expr))

    def parenthesize(self, item: sp.Expr, level: int, strict: bool = False) -> str:
        """A share of π in a product is one number."""
        text = str(super().parenthesize(item, level, strict))
        return f"({text})" if item.is_Float and "sp.pi" in text and level >= PRECEDENCE["Mul"] else text

    def _print_Rational(self, expr: sp.Rational) -> str:
        return f"sp.Rational({expr.p}, {expr.q})"

    _print_Half = _print_Rational

    def _print_Pi(self, expr: sp.Expr) -> str:
        return "sp.pi"

    def _print_Pow(self, expr: sp.Pow, rational: bool = False) -> str:
        if expr.exp == sp.Rational(1, 2):
            return f"sp.sqrt({self._print(expr.base)})"
        return str(super()._print_Pow(expr, rational=True))

    def _print_Function(self, expr: sp.Expr) -> str:
        name = type(expr).__name__
        if name not in _PLAIN:
            raise GudgeonError(f"a notebook has no word for {name}\n  write a .tex, .txt or .html")
        return f"sp.{name}({self.stringify(expr.args, ', ')})"

    _print_ExpBase = _print_Max = _print_Min = _print_Abs = _print_sign = _print_Heaviside = _print_Function

    def _print_Whole(self, expr: sp.Expr) -> str:
        return f"({self._print(expr.args[0])})"

    _print_Share = _print_Whole

    def _print_ModOf(self, expr: sp.Expr) -> str:
        return f"sp.Mod({self.stringify(expr.args[:2], ', ')})"

    def _print_Pick(self, expr: sp.Expr) -> str:
        side, otherwise, below = expr.args
        gap = self._print(side.args[0] if isinstance(side, sp.sign) else side)
        return f"sp.Piecewise(({self._print(below)}, {gap} < 0), ({self._print(otherwise)}, True))"

    def _print_CurveOf(self, expr: sp.Expr) -> Any:
        told = f"a notebook holds no curves, and this scene has {expr.name}"
        raise GudgeonError(f"{told}\n  write a .tex, .txt or .html")


def number_of_code(value: float) -> str:
    """A number as Python: shares of π as such, others so that they are read back."""
    share = share_of_pi(value)
    if share is None:
        return repr(value).removesuffix(".0")
    count, of = share
    above = {1: "sp.pi", -1: "-sp.pi"}.get(count, f"{count}*sp.pi")
    return above if of == 1 else f"{above}/{of}"


def names_of(model: Model) -> dict[sp.Symbol, str]:
    """What each symbol of the rows, masses and forces is called in Python."""
    symbols = (model.t, *model.q, *model.v, *(entry.symbol for entry in model.slots.entries.values()))
    names: dict[sp.Symbol, str] = {}
    for symbol in symbols:
        name = "t" if symbol == model.t else plain_name(symbol)
        while symbol != model.t and (name in TAKEN or name.startswith(TAKEN_HEADS) or name in names.values()):
            name = f"its_{name}"
        names[symbol] = name
    return names


def text_of(expression: sp.Expr, model: Model, names: Mapping[sp.Symbol, str]) -> str:
    """An expression in q, q̇, t and the file's numbers. Raises GudgeonError for what plain SymPy has no word for."""
    return str(Printer(names).doprint(for_readers(model.symbols.explicit(sp.sympify(expression)))))
