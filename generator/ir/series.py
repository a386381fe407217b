"""Taylor-mode automatic differentiation of a straight-line function: coefficients of order 0, then of each order.

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

from gudgeon.generator.ir.branches import ReturnIfOnlyJoints
from gudgeon.generator.ir.kernels import Kernel, Section, change_expression, remove_unused_lines
from gudgeon.generator.ir.series_rules import (
    INVERSE_NEXT_ORDER,
    INVERSE_ORDER,
    ORDER,
    ROW_LENGTH,
    SUMS,
    VALUES,
    Factor,
    NoTaylorSeries,
    OrderPair,
    Product,
    Rules,
    StoreRow,
    make_order_zero_symbol,
)
from gudgeon.generator.ir.signatures import (
    PARAMETERS,
    STATE,
    ZERO,
    Access,
    Argument,
    make_input_argument,
    make_output_argument,
)
from gudgeon.generator.ir.statements import (
    Call,
    Guard,
    Instruction,
    Jump,
    Return,
    SolveDependentRows,
    Statement,
    Status,
)
from gudgeon.generator.symbols.storage import StorageLocation, StoredSymbol, find_value_key

SectionLine = tuple[str, Instruction]  # a line and its section's title


def split_sums_by_depth(lines: Iterable[SectionLine], make_unique_name: Callable[[str], str]) -> list[SectionLine]:
    """Return the lines, as (section title, line), in which sums are split so that late terms are added last.

    This shortens the critical path. A term is computed the later, the more dependent statements precede it. Partial
    sums become locals `<local>_known`; `make_unique_name` returns an unused name. Only sums of locals are split.
    """
    depth_by_local: dict[str, int] = {}

    def find_depth(expression: sp.Expr) -> int:
        """Return the largest depth of the symbols of an expression: how many dependent statements precede its value."""
        return max((depth_by_local.get(s.name, 0) for s in expression.free_symbols), default=0)

    ordered: list[SectionLine] = []
    for title, line in lines:
        if isinstance(line, Statement) and isinstance(line.value, sp.Expr):
            value: sp.Expr = line.value
            parts = sorted(sp.Add.make_args(value), key=find_depth)
            terms = parts[:1]
            for previous, term in itertools.pairwise(parts if line.declared_local else []):
                if find_depth(term) > find_depth(previous) and len(terms) > 1:
                    name = make_unique_name(f"{line.declared_local}_known")
                    ordered.append((title, Statement(name, sp.Add(*terms))))
                    depth_by_local[name] = find_depth(previous)
                    terms = [sp.Symbol(name, real=True)]
                terms.append(term)
            depth_by_local[line.declared_local] = 1 + find_depth(value)
            line = replace(line, value=sp.Add(*terms)) if line.declared_local else line
        ordered.append((title, line))
    return ordered


def find_angle_differences(statements: Iterable[Statement]) -> dict[str, tuple[sp.Expr, str, int]]:
    """Return the locals that are the cosine or sine of a difference a − b, formed from those of a and b.

    The result maps each such local to (a − b, the name of the local of the other function, the sign in its derivative:
    −1 for a cosine, 1 for a sine). A local without the other function is left out.
    """
    values = {
        line.declared_local: line.value
        for line in statements
        if line.declared_local and isinstance(line.value, sp.Expr)
    }
    trigonometric = {name: value for name, value in values.items() if isinstance(value, (sp.cos, sp.sin))}
    functions_by_angle: dict[sp.Expr, dict[type, str]] = {}
    for target, value in values.items():
        if value.is_Add and len(value.args) == 2 and all(s.name in trigonometric for s in value.free_symbols):
            expanded = value.xreplace({s: trigonometric[s.name] for s in value.free_symbols})
            angles = sorted({x.args[0] for x in expanded.atoms(sp.cos, sp.sin)}, key=str)
            for a, b in itertools.permutations(angles) if len(angles) == 2 else ():
                for function in (sp.cos, sp.sin):
                    if expanded == sp.expand_trig(function(a - b)):
                        functions_by_angle.setdefault(a - b, {}).setdefault(function, target)
    result: dict[str, tuple[sp.Expr, str, int]] = {}
    for angle, functions in functions_by_angle.items():
        if sp.cos in functions and sp.sin in functions:
            cosine_name, sine_name = functions[sp.cos], functions[sp.sin]
            result |= {cosine_name: (angle, sine_name, -1), sine_name: (angle, cosine_name, 1)}
    return result


LEFT, RIGHT = "left", "right"  # arguments: the factors of each product
FindPlace = Callable[[StorageLocation], StorageLocation | None]  # place of a result; None: it is not requested
_SKIPPED_LINES = (Status, ReturnIfOnlyJoints, Jump, SolveDependentRows)
_DOC_VALUES = (
    "Accelerations a and powers at a state, order 0 of their series, and the values that higher orders need.",
    "Returns 0, or the number of the pivot that vanished.",
)
_DOC_TERMS = (
    "The same for order k > 0: t, q, v are coefficients of order k, `at` has those of order 0, `sum` what lower orders",
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
    stored_names: tuple[str, ...]
    products: tuple[Product, ...]


@dataclass(frozen=True)
class LinearSystem:
    """A linear system A x = b within a function: A_0 x_k = b_k - A_1 x_{k-1} - ... - A_k x_0, by the factors of A_0.

    `entries` of A by two nodes; `right_hand_sides`: the locals that are b, with their nodes; `unknowns`: the symbols of
    x by node. `title`: the section that factorizes A, of which higher orders need nothing.
    """

    title: str
    entries: Mapping[tuple[int, int], sp.Expr]
    right_hand_sides: Mapping[str, int]
    unknowns: Mapping[int, sp.Symbol]


def derive_taylor_series(
    kernel: Kernel, find_place: FindPlace, name: str, linear: LinearSystem | None = None
) -> Series:
    """Return the functions for the Taylor coefficients of a kernel's results: one of order 0, one of each higher order.

    `find_place(place)`: where the new functions store the result of a storage location, or None if it is not requested.
    `name`: the base of their names. `linear`: a linear system that the kernel solves, or None. Raise NoTaylorSeries for
    operations without a series.
    """
    lines = _find_needed_lines(kernel, find_place)
    builder = _SeriesBuilder(lines, linear)
    for title, line in lines:
        builder.convert_line(title, line)
    return builder.make_series(name)


def _find_needed_lines(kernel: Kernel, find_place: FindPlace) -> list[SectionLine]:
    """Return the lines on which requested results depend, as (section title, line); other stores become locals.

    `find_place(place)` is the new storage location of a requested result, or None. Lines that handle singular equations
    are dropped.
    """
    lines: list[SectionLine] = []
    symbol_of_place: dict[sp.Basic, sp.Basic] = {}
    for section in kernel.sections:
        for line in section.statements:
            line = _replace_places(line, symbol_of_place)
            if isinstance(line, Statement) and isinstance(stored_place := line.target, StorageLocation):
                name = "".join(
                    character if character.isalnum() else "_" for character in str(stored_place).replace(".", "__")
                ).strip("_")
                symbol_of_place[StoredSymbol(stored_place)] = sp.Symbol(name, real=True)
                line = replace(line, target=name)
                if place := find_place(stored_place):
                    lines.append((section.title, line))
                    line = replace(line, target=place, value=sp.Symbol(name, real=True))
            if not isinstance(line, _SKIPPED_LINES):
                lines.append((section.title, line))
    return _prune_lines(lines)


def _replace_places(line: Instruction, local: Mapping[sp.Basic, sp.Basic]) -> Instruction:
    """Return a line in whose expression the symbols of places are replaced by those of locals."""
    return change_expression(line, lambda value: value.xreplace(local))


class _SeriesBuilder(Rules):
    """Builder of both functions, line by line: lines of order 0 and of order k."""

    def __init__(self, lines: Sequence[SectionLine], linear: LinearSystem | None) -> None:
        """Begin with no converted lines.

        `lines`: all titled lines of the kernel, whose names are used and whose functions keep their names. `linear`:
        the linear system of the kernel or None.
        """
        statements = [line for _, line in lines if isinstance(line, Statement)]
        super().__init__({line.declared_local for line in statements})
        self._values: list[SectionLine] = []
        self._terms: list[SectionLine] = []
        self._angle_differences = find_angle_differences(statements)
        self._name_of_function = {
            line.value: line.declared_local for line in statements if isinstance(line.value, sp.Function)
        }
        self._title, self._linear = "", linear

    def convert_line(self, title: str, line: Instruction) -> None:
        """Convert the next line of the kernel and append it to both functions, of order 0 and of order k.

        The test of a pivot is appended to order 0 alone, and a return is skipped. Raise NoTaylorSeries for other lines
        that are not assignments. `title`: that of the section.
        """
        self._title = title
        match line:
            case Statement(value=StorageLocation() as place):
                self._add_input_line(line, place)
            case Statement(value=sp.Expr() as value):
                self._add_assignment(line, value)
            case Guard(test=test) if not isinstance(test, Call):
                self._values.append((title, replace(line, jumps=False)))
            case Return():
                pass
            case _:
                raise NoTaylorSeries(f"a {type(line).__name__.lower()} of the right-hand side is not an expression")

    def _add_input_line(self, line: Statement, place: StorageLocation) -> None:
        """Append a line that reads time, state or a parameter at the storage location `place` to both functions.

        The local is recorded as a parameter or as varying. Raise NoTaylorSeries for other places.
        """
        if not line.declared_local or place.base not in ("t", "q", "v", "p"):
            raise NoTaylorSeries(f"{place} is not a function of time and state")
        self._values.append((self._title, line))
        self._terms.append((self._title, line))
        (self.parameters if place.base == "p" else self.varying).add(line.declared_local)

    def _add_assignment(self, line: Statement, value: sp.Expr) -> None:
        """Append the assignment `line` of an expression `value` to both functions, of order 0 and of order k.

        A stored result of order k is multiplied by 1/(k + 1). Lines that factorize the linear system are appended to
        order 0 alone. The sine or cosine that its partner has defined already is skipped.
        """
        if not line.declared_local:
            self._values.append((self._title, line))
            order_k = ZERO if self.is_constant_in_time(value) else value * INVERSE_NEXT_ORDER
            self._terms.append((self._title, replace(line, value=order_k, comment="")))
        elif self._linear and self._title == self._linear.title:
            self._values.append((self._title, line))
        elif line.declared_local not in self.varying:  # else the partner function has defined it already
            self.define_local(line.declared_local, value)

    def define_local(self, target: str, value: sp.Expr, as_series: bool = False) -> sp.Symbol:
        """Append the local `target` = `value` to both functions and return its symbol.

        A constant is appended to order 0 alone, unless `as_series`; any other local is recorded as varying with time.
        If the local is a right-hand side of the linear system A x = b, its order k is b_k minus Σ A_j x_{k-j}, j = 1 …
        k. A value that equals that of an earlier local is expanded as this local. The definitions in `pending` are
        appended after it.
        """
        symbol = sp.Symbol(target, real=True)
        right_hand_sides = self._linear.right_hand_sides if self._linear else {}
        if self.is_constant_in_time(value) and not (as_series or target in right_hand_sides):
            self._values.append((self._title, Statement(target, value)))
            return symbol
        if target not in right_hand_sides:  # which are equal at order 0 alone
            value, definition = self.symbol_by_value.get(value, value), value
            self.symbol_by_value.setdefault(definition, symbol)
        order_zero, order_k = self._expand_angle_difference(value, symbol) or self.expand_orders(value, symbol)
        if self._linear and target in right_hand_sides:
            order_k -= self._sum_lower_orders(self._linear, right_hand_sides[target])
        self.varying.add(target)
        self._values.append((self._title, Statement(target, order_zero)))
        self._terms.append((self._title, Statement(target, order_k)))
        pending, self.pending = self.pending, []
        for name, expression in pending:
            self.define_local(name, expression)
        return symbol

    def _sum_lower_orders(self, linear: LinearSystem, row: int) -> sp.Expr:
        """Return Σ A_j x_{k-j}, j = 1 … k, of equation `row` of the linear system A x = b.

        Entries of A that are constant in time add nothing.
        """
        terms = []
        for column, x in linear.unknowns.items():
            entry = linear.entries.get((row, column), linear.entries.get((column, row), ZERO))
            if not self.is_constant_in_time(entry):
                time_factor = sp.Mul(*(a for a in sp.Mul.make_args(entry) if not self.is_constant_in_time(a)))
                factor = self.define_value(time_factor)
                product = make_order_zero_symbol(x) * factor + self.add_convolution(Factor(factor.name), Factor(x.name))
                terms.append(self.express_at_order_zero(entry / time_factor) * product)
        return sp.Add(*terms)

    def _expand_angle_difference(self, value: sp.Expr, symbol: sp.Symbol) -> OrderPair | None:
        """Return orders 0 and k of a local that is the cosine or sine of a difference of angles; None for other locals.

        `value`, `symbol`: its definition and symbol. Order k follows from the rate of the difference, without four
        products.
        """
        if symbol.name not in self._angle_differences:
            return None
        angle, partner_name, sign = self._angle_differences[symbol.name]
        return value, sign * self.integrate_product(self.define_value(angle), sp.Symbol(partner_name, real=True))

    def define_auxiliary_function(self, value: sp.Expr) -> sp.Symbol:
        """Return the symbol of `value`, an auxiliary function in the derivative of another, such as cos u for sin u.

        It is defined at the first use, under its name in the kernel if it has one.
        """
        if value in self.symbol_by_value:
            return self.symbol_by_value[value]
        return self.define_local(
            self._name_of_function.get(value) or self.make_unique_name(type(value).__name__), value
        )

    def make_series(self, name: str) -> Series:
        """Return the functions of order 0 and of order k, and what order k reads: values of order 0 and sums S_k.

        Locals that nothing reads are left out. `name`: base of the functions' names. Called once, after all lines have
        been converted.
        """
        products, n_products = list[Product](), -1
        while n_products < len(products):  # a sum that is read needs its factors, and they need other sums
            n_products = len(products)
            terms = _prune_lines([*self._terms, *_make_convolution_operand_stores(products)])
            read_keys = {
                find_value_key(s)
                for _, line in terms
                for expression in line.expressions
                for s in expression.free_symbols
            }
            products = [
                product for product in self.products.values() if StorageLocation(SUMS)[product.name] in read_keys
            ]
        stored_names = tuple(
            sorted(name_.member for name_ in read_keys if isinstance(name_, StorageLocation) and name_.base == VALUES)
        )
        inverses = {name: 1 / b for name, b in self.inverses.items()}
        storing_lines = [
            (
                "values that higher orders read",
                Statement(StorageLocation(VALUES)[name_], inverses.get(name_, sp.Symbol(name_, real=True))),
            )
            for name_ in stored_names
        ]
        values = _prune_lines([*self._values, *storing_lines])
        arguments_of_values, arguments_of_terms = _make_series_arguments()
        values_kernel = Kernel(
            f"{name}_values", _DOC_VALUES, arguments_of_values, _group_sections([*values, ("", Return())]), status=True
        )
        term_sections = _group_sections(split_sums_by_depth(terms, self.make_unique_name))
        return Series(
            values_kernel,
            Kernel(f"{name}_terms", _DOC_TERMS, arguments_of_terms, term_sections),
            stored_names,
            tuple(products),
        )


def _make_series_arguments() -> tuple[tuple[Argument, ...], tuple[Argument, ...]]:
    """Return (arguments of the function for order 0, arguments of that for order k > 0)."""
    rates = (make_output_argument("a"), make_output_argument("power"))
    factors = (make_output_argument(LEFT, "Wide"), make_output_argument(RIGHT, "Wide"))
    order = tuple(
        Argument(symbol.name, access=Access.CONSTANT) for symbol in (ORDER, INVERSE_ORDER, INVERSE_NEXT_ORDER)
    )
    lower_orders = (make_input_argument(VALUES, "TaylorValues"), make_input_argument(SUMS, "TaylorFactors"))
    values = (*STATE, PARAMETERS, make_output_argument(VALUES, "TaylorValues"), *rates)
    return values, (*order, *STATE, PARAMETERS, *lower_orders, *rates, *factors)


def _make_convolution_operand_stores(products: Sequence[Product]) -> list[SectionLine]:
    """Return the lines, with their title, that store the factors of all sums S_k for higher orders.

    S_k is a convolution of two series. The left factors of all sums fill rows of ROW_LENGTH elements of one array, the
    right factors those of another; the last row may be shorter. Stored is the coefficient of order k of a factor; for a
    rate it is multiplied by k.
    """

    def make_coefficient(factor: Factor) -> sp.Expr:
        """Return the coefficient of order k of a factor; of a rate, k times the coefficient."""
        symbol = sp.Symbol(factor.name, real=True)
        return ORDER * symbol if factor.rate else symbol

    title, lines = "factors of the sums of higher orders", list[SectionLine]()
    for row, start in enumerate(range(0, len(products), ROW_LENGTH)):
        group = products[start : start + ROW_LENGTH]
        lines.append((title, StoreRow(LEFT, row, tuple(make_coefficient(product.left) for product in group))))
        lines.append((title, StoreRow(RIGHT, row, tuple(make_coefficient(product.right) for product in group))))
    return lines


def _prune_lines(lines: list[SectionLine]) -> list[SectionLine]:
    """Return the pairs (section title, line) without lines that define a local which no later line reads."""
    used_ids = {id(line) for line in remove_unused_lines([line for _, line in lines], set())}
    return [(title, line) for title, line in lines if id(line) in used_ids]


def _group_sections(lines: Iterable[SectionLine]) -> tuple[Section, ...]:
    """Return pairs (section title, line) as sections; successive lines with the same title form one section."""
    sections: list[tuple[str, list[Instruction]]] = []
    for title, line in lines:
        if not sections or sections[-1][0] != title:
            sections.append((title, []))
        sections[-1][1].append(line)
    return tuple(Section(title, tuple(lines_)) for title, lines_ in sections)
