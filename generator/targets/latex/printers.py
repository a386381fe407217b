"""Prints SymPy expressions as LaTeX and plain text; terms of a sum follow the order of the bodies."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from decimal import Decimal
from functools import lru_cache
from typing import Any

import sympy as sp
from sympy.printing.latex import LatexPrinter
from sympy.printing.precedence import PRECEDENCE
from sympy.printing.str import StrPrinter

from gudgeon.generator.symbols.curves import ContourOf, CurveOf
from gudgeon.generator.symbols.symbols import get_document_name
from gudgeon.generator.targets.latex.letters import Formula
from gudgeon.language.functions import IN_SYMPY, Function

MAX_UNBREAKABLE_LENGTH = 70  # characters of plain text of a term without line breaks
_AFTER_ALL_BODIES = 1 << 30  # sort key of terms without coordinates
_PRIME = "'"  # marks a derivative


class _BodyOrder:
    """Order the terms of sums by body, coordinates before rotating arms; other sums begin with a plus."""

    _order: Mapping[sp.Symbol, int]

    def _as_ordered_terms(self, expr: sp.Expr, order: str | None = None) -> list[sp.Expr]:
        """Return the terms of a sum sorted by `_get_sort_key`, else in SymPy's order, which `order` selects."""
        terms = super()._as_ordered_terms(expr, order=order)  # type: ignore[misc]
        return sorted(terms, key=self._get_sort_key)

    def _get_sort_key(self, term: sp.Expr) -> tuple[int, bool]:
        """Return the sort key of a term: the minimum index of a body among its symbols, then False for a single symbol.

        Terms without coordinates are sorted last, those with a minus sign after the others.
        """
        body_indices = [self._order[s] for s in term.free_symbols if s in self._order]
        if body_indices:
            return min(body_indices), not term.as_coeff_Mul()[1].is_Symbol
        return _AFTER_ALL_BODIES, term.could_extract_minus_sign()


class TextPrinter(_BodyOrder, StrPrinter):
    """Print one line of plain text: a·b, a^b, √(a), |a|, names in Unicode."""

    def __init__(self, names: Mapping[sp.Symbol, str], order: Mapping[sp.Symbol, int]) -> None:
        super().__init__()
        self._names, self._order = names, order

    def doprint(self, expr: sp.Expr) -> str:
        """Return an expression as text."""
        return str(super().doprint(expr)).replace("*", "·")

    def split_signed_terms(self, expr: sp.Expr) -> list[tuple[str, sp.Expr]]:
        """Return (sign, term) of each term of a sum; "{} " in a sign is LaTeX's empty left operand.

        The first term has the sign "". An expression that is not a sum is its only term.
        """
        first_term, *further_terms = self._as_ordered_terms(expr) if expr.is_Add else [expr]
        return [("", first_term)] + [
            ("{} - ", -term) if term.could_extract_minus_sign() else ("{} + ", term) for term in further_terms
        ]

    def _print_Symbol(self, expr: sp.Symbol) -> str:
        """Print the name of a symbol."""
        return self._names.get(expr, get_document_name(expr))

    def _print_Float(self, expr: sp.Float) -> str:
        """Print a number: as an angle if `format_angle` finds one, else in decimal."""
        angle = format_angle(float(expr))
        return angle.text if angle else format_number(float(expr))

    def parenthesize(self, item: sp.Expr, level: int, strict: bool = False) -> str:
        """Print an operand, in brackets if its precedence is lower than `level`.

        A number that is printed as a fraction of π, such as π/2, gets them in products, too.
        """
        text = str(super().parenthesize(item, level, strict))
        return f"({text})" if item.is_Float and "/" in text and level >= PRECEDENCE["Mul"] else text

    def _print_Pi(self, expr: sp.Expr) -> str:
        """Print π."""
        return "π"

    def _print_Pow(self, expr: sp.Pow, rational: bool = False) -> str:
        """Print a power as √(…), 1/… for a negative rational exponent, or base^exponent."""
        base, exponent = expr.base, expr.exp
        if exponent == sp.Rational(1, 2):
            return f"√({self._print(base)})"
        if exponent.is_Rational and exponent < 0:
            denominator = base if exponent == -1 else sp.Pow(base, -exponent, evaluate=False)
            return f"1/{self.parenthesize(denominator, PRECEDENCE['Mul'], strict=True)}"
        return f"{self.parenthesize(base, PRECEDENCE['Pow'])}^{self.parenthesize(exponent, PRECEDENCE['Pow'])}"

    def _print_Abs(self, expr: sp.Expr) -> str:
        """Print an absolute value."""
        return f"|{self._print(expr.args[0])}|"

    def _print_Unevaluated(self, expr: sp.Expr) -> str:
        """Print an unevaluated operand in brackets."""
        return f"({self._print(expr.args[0])})"

    _print_UnevaluatedQuotient = _print_Unevaluated

    def _print_ContourOf(self, expr: ContourOf) -> str:
        """Print the depth d of a contour or its derivative."""
        return f"d{_PRIME * expr.order}({self._print(expr.args[3])})"

    def _print_CurveOf(self, expr: CurveOf) -> str:
        """Print a curve or its derivative."""
        return f"{expr.name}{_PRIME * expr.order}({self._print(expr.args[2])})"

    def _print_ModOf(self, expr: sp.Expr) -> str:
        """Print a remainder."""
        return f"mod({self._print(expr.args[0])}, {self._print(expr.args[1])})"

    def _print_Heaviside(self, expr: sp.Expr) -> str:
        """Print a step function."""
        return f"H({self._print(expr.args[0])})"

    def _print_Select(self, expr: sp.Expr) -> str:
        """Print a Select as the function of the file's expressions: where(left < right, first, second)."""
        left, right, if_less, otherwise = map(self._print, split_where_condition(expr))
        return f"where({left} < {right}, {if_less}, {otherwise})"


class TexPrinter(_BodyOrder, LatexPrinter):
    """Print LaTeX for amsmath. `print_breakable_formula` lets long terms break at their signs."""

    def __init__(
        self, names: Mapping[sp.Symbol, Formula], order: Mapping[sp.Symbol, int], is_breakable: bool = False
    ) -> None:
        settings: dict[str, Any] = {
            "symbol_names": {symbol: name.latex for symbol, name in names.items()},
            "fold_func_brackets": True,
            "inv_trig_style": "full",
            "root_notation": not is_breakable,
            "mul_symbol": r" \, ",
        }
        super().__init__(settings)
        self._order, self._breakable, self._names = order, is_breakable, names
        self._text = TextPrinter({symbol: "x" * name.width for symbol, name in names.items()}, order)

    def print_breakable_formula(self, expr: sp.Expr) -> str:
        """Return an expression in LaTeX, in breakable form if its plain text exceeds MAX_UNBREAKABLE_LENGTH characters.

        A line may break within the breakable form. It has brackets of fixed size, fractions with slashes and no roots
        with a bar.
        """
        if len(self._text.doprint(expr)) <= MAX_UNBREAKABLE_LENGTH:
            return str(self.doprint(expr))
        breakable_text = str(TexPrinter(self._names, self._order, True).doprint(expr))
        return (
            breakable_text.replace(r"\left(", r"\bigl(").replace(r"\right)", r"\bigr)").replace(", ", r", \allowbreak ")
        )

    def _print_Mul(self, expr: sp.Expr) -> str:
        r"""Print a product; a rational coefficient precedes it as a \tfrac.

        In the breakable form, a quotient is written with a slash unless its denominator is a number.
        """
        coefficient, others = expr.as_coeff_Mul()
        numerator, denominator = sp.fraction(expr)
        if coefficient.is_Rational and coefficient.q != 1 and sp.fraction(others)[1] == 1:
            sign = "- " if coefficient.p < 0 else ""
            printed_others = self.parenthesize(others, PRECEDENCE["Mul"], strict=True)
            return rf"{sign}{self._print(abs(coefficient))} \, {printed_others}"
        if not self._breakable or denominator.is_Number:
            return str(super()._print_Mul(expr))
        if numerator.could_extract_minus_sign():
            return f"- {self._print(-expr)}"
        printed_denominator = self.parenthesize(denominator, PRECEDENCE["Mul"], strict=False)
        return f"{self.parenthesize(numerator, PRECEDENCE['Mul'])} / {printed_denominator}"

    def _print_Pow(self, expr: sp.Pow) -> str:
        r"""Print a power; in the breakable form, a square root is written as \surd before brackets."""
        if self._breakable and expr.exp == sp.S.Half:
            return rf"\surd \left({self._print(expr.base)}\right)"
        return str(super()._print_Pow(expr))

    def _print_Rational(self, expr: sp.Rational) -> str:
        """Print a rational number: a whole number as it is, others as a small fraction."""
        if expr.q == 1:
            return str(expr.p)
        return rf"{'- ' if expr.p < 0 else ''}\tfrac{{{abs(expr.p)}}}{{{expr.q}}}"

    def _print_Float(self, expr: sp.Float) -> str:
        """Print a number: as an angle if `format_angle` finds one, else in decimal with a power of ten."""
        if angle := format_angle(float(expr)):
            return angle.latex
        mantissa, _, exponent = format_number(float(expr)).partition("e")
        if not exponent:
            return mantissa
        power = f"10^{{{int(exponent)}}}"
        return power if mantissa == "1" else rf"{mantissa} \cdot {power}"

    def _print_ContourOf(self, expr: ContourOf, exp: str | None = None) -> str:
        """Print the depth d of a contour or its derivative."""
        text = rf"d{_PRIME * expr.order}\left({self._print(expr.args[3])}\right)"
        return rf"\left({text}\right)^{{{exp}}}" if exp else text

    def _print_CurveOf(self, expr: CurveOf, exp: str | None = None) -> str:
        r"""Print a curve of the file or its derivative, with primes for the order: \mathrm{cam}''(x).

        `exp`: an exponent that is printed after it, or None; SymPy passes it.
        """
        name = expr.name.replace("_", r"\_")
        text = rf"\mathrm{{{name}}}{_PRIME * expr.order}\left({self._print(expr.args[2])}\right)"
        return rf"\left({text}\right)^{{{exp}}}" if exp else text

    def _print_ModOf(self, expr: sp.Expr, exp: str | None = None) -> str:
        """Print a remainder."""
        return self._print_function_call(r"\operatorname{mod}", expr, exp)

    def _print_Heaviside(self, expr: sp.Expr, exp: str | None = None) -> str:
        """Print a step function."""
        return self._print_function_call("H", expr, exp)

    def _print_Select(self, expr: sp.Expr, exp: str | None = None) -> str:
        """Print a Select as a brace with two cases; in the breakable form as where(…).

        `exp`: an exponent that is printed after it, or None; SymPy passes it.
        """
        left, right, if_less, otherwise = map(self._print, split_where_condition(expr))
        if self._breakable:  # a line cannot break between the cases of a brace
            text = rf"\operatorname{{where}}\left({left} < {right}, {if_less}, {otherwise}\right)"
            return rf"{text}^{{{exp}}}" if exp else text
        cases = rf"{if_less} & {left} < {right} \\ {otherwise} & \text{{else}}"
        text = rf"\begin{{cases}} {cases} \end{{cases}}"
        return rf"\left({text}\right)^{{{exp}}}" if exp else text

    def _print_Unevaluated(self, expr: sp.Expr, exp: str | None = None) -> str:
        """Print an unevaluated operand in brackets."""
        return self._print_function_call("", expr, None) + (f"^{{{exp}}}" if exp else "")

    _print_UnevaluatedQuotient = _print_Unevaluated

    def _print_function_call(self, name: str, expr: sp.Expr, exp: str | None) -> str:
        """Print a call of a function with its arguments in brackets, and the exponent `exp` after the name."""
        printed_arguments = ", ".join(self._print(argument) for argument in sort_arguments(expr))
        return rf"{name}{f'^{{{exp}}}' if exp else ''}\left({printed_arguments}\right)"


def _add_print_methods(class_name: str, function: Function) -> None:
    """Add print methods for a function of the table of functions to the classes TextPrinter and TexPrinter.

    class_name: the SymPy class of the function. A function without a text or LaTeX form keeps SymPy's own method there.
    """

    def print_text(printer: TextPrinter, expr: sp.Expr) -> str:
        """Print a function as text."""
        return f"{function.text}({printer.stringify(sort_arguments(expr), ', ')})"

    def print_latex(printer: TexPrinter, expr: sp.Expr, exp: str | None = None) -> str:
        """Print a function as LaTeX."""
        return printer._print_function_call(function.latex, expr, exp)

    if function.text:
        setattr(TextPrinter, f"_print_{class_name}", print_text)
    if function.latex:
        setattr(TexPrinter, f"_print_{class_name}", print_latex)


for _name, _function in IN_SYMPY.items():
    _add_print_methods(_name, _function)

_DENOMINATORS_OF_PI = (1, 2, 3, 4, 6)  # of angles that are written as fractions of π
_MIN_ANGLE_DIGITS = 9  # digits of repr() of a number that is written as an angle


@lru_cache(4096)
def format_angle(value: float) -> Formula | None:
    """Return a number in rad as an angle: a fraction of π (`find_fraction_of_pi`) or degrees, such as π/2 or 39.52°.

    Degrees have six digits and must be exact within two units in the last place. None is returned otherwise, and for a
    number with fewer than _MIN_ANGLE_DIGITS digits. Results are cached.
    """
    if sum(map(str.isdigit, repr(value))) < _MIN_ANGLE_DIGITS:
        return None
    if fraction := find_fraction_of_pi(value):
        numerator, denominator = fraction
        sign, pi_factor = "-" * (numerator < 0), f"{abs(numerator) if abs(numerator) > 1 else ''}"
        if denominator == 1:
            return Formula(rf"{sign}{pi_factor}\pi", f"{sign}{pi_factor}π")
        return Formula(rf"{sign}\tfrac{{{pi_factor}\pi}}{{{denominator}}}", f"{sign}{pi_factor}π/{denominator}")
    degrees = f"{math.degrees(value):.6g}"
    if abs(math.radians(float(degrees)) - value) <= 2 * math.ulp(value):
        return Formula(rf"{degrees}^{{\circ}}", f"{degrees}°")
    return None


def find_fraction_of_pi(value: float) -> tuple[int, int] | None:
    """Return (k, n) if a number is k π/n within one unit in the last place; None otherwise.

    n is in _DENOMINATORS_OF_PI, and |k| from 1 to 12.
    """
    for denominator in _DENOMINATORS_OF_PI:
        numerator = round(value * denominator / math.pi)
        if 0 < abs(numerator) <= 12 and abs(numerator * math.pi / denominator - value) <= math.ulp(value):
            return numerator, denominator
    return None


def format_number(value: float) -> str:
    """Return a number as text: "0.0003", "7e10".

    It has 12 significant digits if they are exact within two units in the last place, else all digits. From 10⁶ on,
    the number has an exponent.
    """
    rounded = float(f"{value:.12g}")
    text = repr(rounded if abs(rounded - value) <= 2 * math.ulp(value) else value).removesuffix(".0")
    if "e" not in text and abs(value) >= 1e6:
        text = f"{Decimal(text).normalize():e}".replace("e+", "e")
    return text


def split_where_condition(select: sp.Expr) -> tuple[sp.Expr, sp.Expr, sp.Expr, sp.Expr]:
    """Return (left, right, value if left < right, other value) of a Select, as in where(left < right, …) of the file.

    The condition is left − right < 0: its terms with a minus sign are put on the right side.
    """
    condition, otherwise, if_less = select.args
    difference = condition.args[0] if isinstance(condition, sp.sign) else condition
    terms = sp.Add.make_args(difference)
    right = [-term for term in terms if term.could_extract_minus_sign()]
    if len(right) == len(terms):
        return sp.Integer(0), sp.Add(*right), if_less, otherwise
    return sp.Add(*(term for term in terms if -term not in right)), sp.Add(*right), if_less, otherwise


def sort_arguments(expr: sp.Expr) -> Sequence[sp.Expr]:
    """Return the arguments of a function in printing order: numbers last for a minimum or maximum.

    For a step function (Heaviside), only the first argument is returned.
    """
    if isinstance(expr, (sp.Max, sp.Min)):
        return sorted(expr.args, key=lambda argument: (bool(argument.is_Number), str(argument)))
    return expr.args[:1] if isinstance(expr, sp.Heaviside) else expr.args
