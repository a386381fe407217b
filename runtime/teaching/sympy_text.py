"""Print expressions of a model as Python code for SymPy, with variable names that do not collide in a notebook."""

from __future__ import annotations

import builtins
from collections.abc import Mapping
from typing import Any

import sympy as sp
from sympy.printing.precedence import PRECEDENCE
from sympy.printing.str import StrPrinter

from gudgeon.errors import GudgeonError
from gudgeon.generator.equations.model import Model
from gudgeon.generator.ir.finite_slopes import remove_numerical_forms
from gudgeon.generator.symbols.symbols import get_document_name
from gudgeon.generator.targets.latex.printers import find_fraction_of_pi
from gudgeon.language.functions import IN_SYMPY

# names that the notebook uses
USED_NAMES = frozenset(
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
USED_PREFIXES = ("Phi_", "first_", "second_")
_SYMPY_FUNCTIONS = frozenset((*IN_SYMPY, "Heaviside"))


class Printer(StrPrinter):
    """Print SymPy expressions as Python text, with functions after `sp.`."""

    def __init__(self, names: Mapping[sp.Symbol, str]) -> None:
        """Use `names` for symbols."""
        super().__init__()
        self._names = names

    def _print_Symbol(self, expr: sp.Symbol) -> str:
        """Return the name of a symbol."""
        return self._names.get(expr, get_document_name(expr))

    def _print_Float(self, expr: sp.Float) -> str:
        """Return a number; simple fractions of π as such."""
        return format_number(float(expr))

    def parenthesize(self, item: sp.Expr, level: int, strict: bool = False) -> str:
        """Return the text of an item, in parentheses too if it is a fraction of π in a product."""
        text = str(super().parenthesize(item, level, strict))
        return f"({text})" if item.is_Float and "sp.pi" in text and level >= PRECEDENCE["Mul"] else text

    def _print_Rational(self, expr: sp.Rational) -> str:
        """Return a rational number."""
        return f"sp.Rational({expr.p}, {expr.q})"

    _print_Half = _print_Rational

    def _print_Pi(self, expr: sp.Expr) -> str:
        """Return π."""
        return "sp.pi"

    def _print_Pow(self, expr: sp.Pow, rational: bool = False) -> str:
        """Return a power; exponent 1/2 as a square root."""
        if expr.exp == sp.Rational(1, 2):
            return f"sp.sqrt({self._print(expr.base)})"
        return str(super()._print_Pow(expr, rational=True))

    def _print_Function(self, expr: sp.Expr) -> str:
        """Return a function call as Python text. Raise GudgeonError for functions that SymPy does not have."""
        name = type(expr).__name__
        if name not in _SYMPY_FUNCTIONS:
            raise GudgeonError(
                f"a notebook cannot contain {name}: SymPy has no such function\n  write a .tex, .txt or .html"
            )
        return f"sp.{name}({self.stringify(expr.args, ', ')})"

    _print_ExpBase = _print_Max = _print_Min = _print_Abs = _print_sign = _print_Heaviside = _print_Function

    def _print_Unevaluated(self, expr: sp.Expr) -> str:
        """Return an unevaluated product or fraction in parentheses."""
        return f"({self._print(expr.args[0])})"

    _print_UnevaluatedQuotient = _print_Unevaluated

    def _print_ModOf(self, expr: sp.Expr) -> str:
        """Return a remainder."""
        return f"sp.Mod({self.stringify(expr.args[:2], ', ')})"

    def _print_Select(self, expr: sp.Expr) -> str:
        """Return a conditional value as `sp.Piecewise`."""
        branch, otherwise, below = expr.args
        difference = self._print(branch.args[0] if isinstance(branch, sp.sign) else branch)
        return f"sp.Piecewise(({self._print(below)}, {difference} < 0), ({self._print(otherwise)}, True))"

    def _print_CurveOf(self, expr: sp.Expr) -> Any:
        """Raise GudgeonError, since a notebook cannot contain curves."""
        message = f"a notebook cannot contain curves, and this scene has {expr.name}"
        raise GudgeonError(f"{message}\n  write a .tex, .txt or .html")


def format_number(value: float) -> str:
    """Return a number as Python text that is read back exactly; simple fractions of π as such ("sp.pi/2")."""
    pi_fraction = find_fraction_of_pi(value)
    if pi_fraction is None:
        return repr(value).removesuffix(".0")
    count, denominator = pi_fraction
    numerator = {1: "sp.pi", -1: "-sp.pi"}.get(count, f"{count}*sp.pi")
    return numerator if denominator == 1 else f"{numerator}/{denominator}"


def assign_python_names(model: Model) -> dict[sp.Symbol, str]:
    """Return a unique Python name for each symbol of the model: t, coordinates, velocities and parameters.

    Names that the notebook uses otherwise get the prefix "its_".
    """
    symbols = (model.t, *model.q, *model.v, *(entry.symbol for entry in model.parameter_table.entries.values()))
    names: dict[sp.Symbol, str] = {}
    for symbol in symbols:
        name = "t" if symbol == model.t else get_document_name(symbol)
        while symbol != model.t and (name in USED_NAMES or name.startswith(USED_PREFIXES) or name in names.values()):
            name = f"its_{name}"
        names[symbol] = name
    return names


def format_expression(expression: sp.Expr, model: Model, names: Mapping[sp.Symbol, str]) -> str:
    """Return an expression in q, q̇, t and parameters as Python. Raises GudgeonError if plain SymPy lacks a
    function."""
    return str(Printer(names).doprint(remove_numerical_forms(model.symbols.expand_definitions(sp.sympify(expression)))))
