"""Formulas of force laws as plain text, for the comments above their functions: `F_n = K*delta^exponent*max(…)`."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Mapping

import sympy as sp
from sympy.printing.str import StrPrinter

from gudgeon.generator.equations.play import LawEquations
from gudgeon.generator.symbols.symbols import get_document_name

_WIDTH = 110
_MEANINGS = {
    "delta": "penetration",
    "ratio": "deltadot/deltadot_minus",
    "F_n": "normal force",
    "v_t": "slip velocity",
    "epsilon": "eccentricity ratio e/c",
    "w_n": "radial squeeze velocity over c",
    "w_t": "tangential squeeze velocity over c",
}


class _PlainTextPrinter(StrPrinter):
    """Printer of expressions in the notation of comments: min, max, abs, branches as `where(g < 0, a, b)`."""

    def _print_Max(self, e: sp.Expr) -> str:
        return f"max({', '.join(sorted(map(self._print, e.args)))})"

    def _print_Min(self, e: sp.Expr) -> str:
        return f"min({', '.join(sorted(map(self._print, e.args)))})"

    def _print_Abs(self, e: sp.Expr) -> str:
        return f"abs({self._print(e.args[0])})"

    def _print_Select(self, e: sp.Expr) -> str:
        side, then, otherwise = e.args
        g = side.args[0] if isinstance(side, sp.sign) else side
        return f"where({self._print(g)} < 0, {self._print(otherwise)}, {self._print(then)})"

    def _print_Unevaluated(self, e: sp.Expr) -> str:
        return f"({self._print(e.args[0])})"


def format_formulas(law: LawEquations, names: Mapping[sp.Symbol, str]) -> list[str]:
    """Return the equations of a law as lines such as "F_n = K*delta^exponent", then the meanings of its variables.

    `names`: names of parameters in the law's function, by symbol; others keep the names of the file. Lines are wrapped
    at `_WIDTH` characters.
    """
    name_of_symbol = {
        **{s: get_document_name(s) for e in law.equations_by_name.values() for s in sp.sympify(e).free_symbols},
        **names,
    }
    variables = {symbol.name for symbol in law.variables}
    symbol_map = {
        s: sp.Symbol(name, real=True)
        for s, name in name_of_symbol.items()
        if s.name not in {*variables, *law.equations_by_name}
    }
    printer = _PlainTextPrinter({"full_prec": False, "sympy_integers": False})
    lines: list[str] = []
    for name, step in law.equations_by_name.items():
        text = printer.doprint(sp.sympify(step).xreplace(symbol_map)).replace("**", "^")
        lines += textwrap.wrap(f"{name} = {text}", _WIDTH, subsequent_indent="    ", break_long_words=False)
    return [*lines, *_describe_variables(law)]


def _describe_variables(law: LawEquations) -> Iterator[str]:
    """Yield one line with the meanings of the law's variables; nothing if none of them has a meaning in `_MEANINGS`."""
    meanings = [f"{symbol.name}: {_MEANINGS[symbol.name]}" for symbol in law.variables if symbol.name in _MEANINGS]
    if meanings:
        yield f"{'; '.join(meanings)}."
