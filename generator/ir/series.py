"""Taylor series of a straight-line function: its statements at order 0, and the rest of them at each higher order.

Where arguments are series in time every local is one too, and its coefficient of order k follows from those of its
operands (A. Jorba, M. Zou, A software package for the numerical integration of ODEs by means of high-order Taylor
methods, Experimental Mathematics 14, 2005, section 2.1). For c = a b it is c_k = a_0 b_k + b_0 a_k + S_k with the sum
S_k = a_1 b_{k-1} + ... + a_{k-1} b_1; quotients, roots, powers, sines and similar functions are products too, of
series and of their rates (series_rules.py). So a function becomes two: `values` at order 0, and `terms`, the same
lines at every order k > 0, linear in coefficients of order k, with coefficients of order 0 and the sums S_k as
numbers. The sums read lower orders alone: all of them are known before a line of order k is computed.
A linear system is solved by lines as well, so that closed loops need nothing more: at order k the lines of its
factors and substitutions solve for the coefficients of order k.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import sympy as sp

from gudgeon.generator.ir.branches import JointsAlone
from gudgeon.generator.ir.kernels import Kernel, Section, changed, without_unread
from gudgeon.generator.ir.series_rules import (
    NEXT,
    ORDER,
    SHARE,
    SUMS,
    VALUES,
    WIDE,
    Factor,
    Gathered,
    Lowered,
    NoSeries,
    Product,
    Rules,
    at,
)
from gudgeon.generator.ir.signatures import PARAMETERS, STATE, ZERO, Access, Argument, result, source
from gudgeon.generator.ir.statements import Call, Guard, Jump, Line, Rescue, Return, Statement, Status
from gudgeon.generator.symbols.storage import Place, PlaceSymbol, key_of

Titled = tuple[str, Line]  # a line and its section's title


def split_late_sums(lines: Iterable[Titled], unique: Callable[[str], str]) -> list[Titled]:
    """Return the lines with sums split so that the terms that are known last are added last.

    `unique` returns an unused name. No line then waits longer than it must.
    """
    depth: dict[str, int] = {}

    def late(value: sp.Expr) -> int:
        """Return the length of the longest chain of such splits that an expression depends on."""
        return max((depth.get(s.name, 0) for s in value.free_symbols), default=0)

    ordered: list[Titled] = []
    for title, line in lines:
        if isinstance(line, Statement) and isinstance(line.value, sp.Expr):
            value: sp.Expr = line.value
            parts = sorted(sp.Add.make_args(value), key=late)
            known = parts[:1]
            for before, part in itertools.pairwise(parts if line.defines else []):
                if late(part) > late(before) and len(known) > 1:
                    name = unique(f"{line.defines}_known")
                    ordered.append((title, Statement(name, sp.Add(*known))))
                    depth[name] = late(before)
                    known = [sp.Symbol(name, real=True)]
                known.append(part)
            depth[line.defines] = 1 + late(value)
            line = replace(line, value=sp.Add(*known)) if line.defines else line
        ordered.append((title, line))
    return ordered


def differences(statements: Iterable[Statement]) -> dict[str, tuple[sp.Expr, str, int]]:
    """Return the cosines and sines of differences a − b that are formed from those of a and b, by local.

    For each: the angle a − b, the local of the other function, and the sign in its derivative.
    """
    values = {line.defines: line.value for line in statements if line.defines and isinstance(line.value, sp.Expr)}
    turned = {name: value for name, value in values.items() if isinstance(value, (sp.cos, sp.sin))}
    found: dict[sp.Expr, dict[type, str]] = {}
    for target, value in values.items():
        if value.is_Add and len(value.args) == 2 and all(s.name in turned for s in value.free_symbols):
            whole = value.xreplace({s: turned[s.name] for s in value.free_symbols})
            angles = sorted({x.args[0] for x in whole.atoms(sp.cos, sp.sin)}, key=str)
            for one, other in itertools.permutations(angles) if len(angles) == 2 else ():
                for function in (sp.cos, sp.sin):
                    if whole == sp.expand_trig(function(one - other)):
                        found.setdefault(one - other, {}).setdefault(function, target)
    pairs: dict[str, tuple[sp.Expr, str, int]] = {}
    for angle, both in found.items():
        if sp.cos in both and sp.sin in both:
            cosine, sine = both[sp.cos], both[sp.sin]
            pairs |= {cosine: (angle, sine, -1), sine: (angle, cosine, 1)}
    return pairs


LEFT, RIGHT = "left", "right"  # arguments: the factors of each product
Expected = Callable[[Place], Place | None]  # place of a result; None: it is not requested
_DROPPED = (Status, JointsAlone, Jump, Rescue)
_DOC_VALUES = (
    "Accelerations a and powers at a state, order 0 of their series, and what higher orders read of it.",
    "Returns 0, or the number of the pivot that vanished.",
)
_DOC_TERMS = (
    "Order k > 0 of the same: t, q, v are coefficients of order k, `at` has those of order 0, `sum` what lower orders",
    "add to each product; share = 1/k, next = 1/(k + 1). Results: coefficients of order k + 1 of a and power (those of",
    "q are v next), and the factors of the sums of higher orders.",
)


@dataclass(frozen=True)
class Series:
    """Both functions of a Taylor series, the values that `values` keeps for `terms`, and the sums S_k of each order.

    Cosines and sines of `values` are not paired in vectors yet.
    """

    values: Kernel
    terms: Kernel
    kept: tuple[str, ...]
    products: tuple[Product, ...]


@dataclass(frozen=True)
class Linear:
    """A linear system A x = b within a function: A_0 x_k = b_k - A_1 x_{k-1} - ... - A_k x_0, by the factors of A_0.

    `entries` of A by two nodes, the locals `loads` that are b and `unknowns` that are x by node; `title`: the section
    that
    factorizes A, of which higher orders need nothing.
    """

    title: str
    entries: Mapping[tuple[int, int], sp.Expr]
    loads: Mapping[str, int]
    unknowns: Mapping[int, sp.Symbol]


def series_of(kernel: Kernel, expected: Expected, name: str, linear: Linear | None = None) -> Series:
    """Return the Taylor series of a function's results; `expected` gives the place of each result. Raises NoSeries."""
    lines = _lines(kernel, expected)
    made = _Series(lines, linear)
    for title, line in lines:
        made.line(title, line)
    return made.finished(name)


def _lines(kernel: Kernel, expected: Expected) -> list[Titled]:
    """Return the lines that lead to requested results; other stored values become locals."""
    lines: list[Titled] = []
    local: dict[sp.Basic, sp.Basic] = {}
    for section in kernel.sections:
        for line in section.statements:
            line = _with_locals(line, local)
            if isinstance(line, Statement) and isinstance(stored := line.target, Place):
                name = "".join(c if c.isalnum() else "_" for c in str(stored).replace(".", "__")).strip("_")
                local[PlaceSymbol(stored)] = sp.Symbol(name, real=True)
                line = replace(line, target=name)
                if place := expected(stored):
                    lines.append((section.title, line))
                    line = replace(line, target=place, value=sp.Symbol(name, real=True))
            if not isinstance(line, _DROPPED):
                lines.append((section.title, line))
    return _prune_lines(lines)


def _with_locals(line: Line, local: Mapping[sp.Basic, sp.Basic]) -> Line:
    """Return a line with places replaced by locals."""
    return changed(line, lambda value: value.xreplace(local))


class _Series(Rules):
    """Builder of both functions, line by line: lines of order 0 and of order k."""

    def __init__(self, lines: Sequence[Titled], linear: Linear | None) -> None:
        """Begin without lines, with the names and cosines of all statements known."""
        statements = [line for _, line in lines if isinstance(line, Statement)]
        super().__init__({line.defines for line in statements})
        self._values: list[Titled] = []
        self._terms: list[Titled] = []
        self._turned = differences(statements)
        self._own = {line.value: line.defines for line in statements if isinstance(line.value, sp.Function)}
        self._title, self._linear = "", linear

    def line(self, title: str, line: Line) -> None:
        """Add the next line of the function to both."""
        self._title = title
        match line:
            case Statement(value=Place() as place):
                self._read(line, place)
            case Statement(value=sp.Expr() as value):
                self._assign(line, value)
            case Guard(test=test) if not isinstance(test, Call):
                self._values.append((title, replace(line, jumps=False)))
            case Return():
                pass
            case _:
                raise NoSeries(f"a {type(line).__name__.lower()} of the right-hand side is no expression")

    def _read(self, line: Statement, place: Place) -> None:
        """Add a line that reads time, state or a parameter."""
        if not line.defines or place.base not in ("t", "q", "v", "p"):
            raise NoSeries(f"{place} is no function of time and state")
        self._values.append((self._title, line))
        self._terms.append((self._title, line))
        (self.numbers if place.base == "p" else self.moving).add(line.defines)

    def _assign(self, line: Statement, value: sp.Expr) -> None:
        """Add an assignment of an expression."""
        if not line.defines:
            self._values.append((self._title, line))
            result = ZERO if self.is_fixed(value) else value * NEXT
            self._terms.append((self._title, replace(line, value=result, comment="")))
        elif self._linear and self._title == self._linear.title:
            self._values.append((self._title, line))
        elif line.defines not in self.moving:  # else the partner function has defined it already
            self.define(line.defines, value)

    def define(self, target: str, value: sp.Expr, moving: bool = False) -> sp.Symbol:
        """Add a local to both functions, or to order 0 alone if it is constant; return its symbol."""
        symbol = sp.Symbol(target, real=True)
        loads = self._linear.loads if self._linear else {}
        if self.is_fixed(value) and not (moving or target in loads):
            self._values.append((self._title, Statement(target, value)))
            return symbol
        if target not in loads:  # which are equal at order 0 alone
            value, whole = self.known.get(value, value), value
            self.known.setdefault(whole, symbol)
        named, term = self._of_difference(value, symbol) or self.lower(value, symbol)
        if self._linear and target in loads:
            term -= self._carried(self._linear, loads[target])
        self.moving.add(target)
        self._values.append((self._title, Statement(target, named)))
        self._terms.append((self._title, Statement(target, term)))
        later, self.later = self.later, []
        for name, expression in later:
            self.define(name, expression)
        return symbol

    def _carried(self, linear: Linear, row: int) -> sp.Expr:
        """Return A_1 x_{k-1} + ... + A_k x_0 of one equation of the linear system."""
        parts = []
        for column, x in linear.unknowns.items():
            entry = linear.entries.get((row, column), linear.entries.get((column, row), ZERO))
            if not self.is_fixed(entry):
                moving = sp.Mul(*(a for a in sp.Mul.make_args(entry) if not self.is_fixed(a)))
                name = self.atom(moving)
                product = at(x) * name + self.sum(Factor(name.name), Factor(x.name))
                parts.append(self.fixed(entry / moving) * product)
        return sp.Add(*parts)

    def _of_difference(self, value: sp.Expr, symbol: sp.Symbol) -> Lowered | None:
        """Return the cosine or sine of a difference of angles, by its rate instead of four products.

        None if the local is not one.
        """
        if symbol.name not in self._turned:
            return None
        angle, partner, sign = self._turned[symbol.name]
        return value, sign * self.by_rate(self.atom(angle), sp.Symbol(partner, real=True))

    def beside(self, value: sp.Expr) -> sp.Symbol:
        """Return the symbol of another function of the same argument; the function's own name is used if it has one."""
        if value in self.known:
            return self.known[value]
        return self.define(self._own.get(value) or self.unique(type(value).__name__), value)

    def finished(self, name: str) -> Series:
        """Return both functions, without lines that nothing reads."""
        products, known = list[Product](), -1
        while known < len(products):  # a sum that is read asks for its factors, and they for other sums
            known = len(products)
            terms = _prune_lines([*self._terms, *_stores(products)])
            read = {key_of(s) for _, line in terms for e in line.expressions for s in e.free_symbols}
            products = [product for product in self.products.values() if Place(SUMS)[product.name] in read]
        kept = tuple(sorted(x.member for x in read if isinstance(x, Place) and x.base == VALUES))
        inverses = {name: 1 / b for name, b in self.inverses.items()}
        keeps = [
            ("values that higher orders read", Statement(Place(VALUES)[x], inverses.get(x, sp.Symbol(x, real=True))))
            for x in kept
        ]
        values = _prune_lines([*self._values, *keeps])
        of_values, of_terms = _arguments()
        of_zero = Kernel(f"{name}_values", _DOC_VALUES, of_values, _sections([*values, ("", Return())]), status=True)
        later = _sections(split_late_sums(terms, self.unique))
        return Series(of_zero, Kernel(f"{name}_terms", _DOC_TERMS, of_terms, later), kept, tuple(products))


def _arguments() -> tuple[tuple[Argument, ...], tuple[Argument, ...]]:
    """Return the arguments of both functions."""
    rates = (result("a"), result("power"))
    factors = (result(LEFT, "Wide"), result(RIGHT, "Wide"))
    order = tuple(Argument(symbol.name, access=Access.CONSTANT) for symbol in (ORDER, SHARE, NEXT))
    given = (source(VALUES, "TaylorValues"), source(SUMS, "TaylorFactors"))
    values = (*STATE, PARAMETERS, result(VALUES, "TaylorValues"), *rates)
    return values, (*order, *STATE, PARAMETERS, *given, *rates, *factors)


def _stores(products: Sequence[Product]) -> list[Titled]:
    """Return the lines that store the factors for the sums of higher orders."""

    def value(factor: Factor) -> sp.Expr:
        """Return the coefficient of a factor; of a rate, times its order."""
        symbol = sp.Symbol(factor.name, real=True)
        return ORDER * symbol if factor.rate else symbol

    title, lines = "factors of the sums of higher orders", list[Titled]()
    for row, first in enumerate(range(0, len(products), WIDE)):
        some = products[first : first + WIDE]
        lines.append((title, Gathered(LEFT, row, tuple(value(x.left) for x in some))))
        lines.append((title, Gathered(RIGHT, row, tuple(value(x.right) for x in some))))
    return lines


def _prune_lines(lines: list[Titled]) -> list[Titled]:
    """Return the lines without locals that nothing reads."""
    left = {id(line) for line in without_unread([line for _, line in lines], set())}
    return [item for item in lines if id(item[1]) in left]


def _sections(lines: Iterable[Titled]) -> tuple[Section, ...]:
    """Return the titled lines grouped into sections."""
    sections: list[tuple[str, list[Line]]] = []
    for title, line in lines:
        if not sections or sections[-1][0] != title:
            sections.append((title, []))
        sections[-1][1].append(line)
    return tuple(Section(title, tuple(group)) for title, group in sections)
