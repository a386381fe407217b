"""Kernels: named inputs → named temporaries → named outputs, ready to be printed in any language.

A `KernelBuilder` takes the statements of one function and adds in front what they need: the
coordinates and parameters that they read and the definitions (cosines, arms, drives) that they use.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import sympy as sp

from gudgeon.generator.symbols.corners import SideOf, Switches
from gudgeon.generator.symbols.symbols import Symbols


@dataclass(frozen=True)
class Statement:
    """`target = value`; a `local` is declared there. `value` is SymPy, or text of the target language."""

    target: str
    value: sp.Expr | str
    local: bool = True
    comment: str = ""


class Guard(str):
    """A line of the target language that goes another way unless `condition` holds."""

    condition: str

    def __new__(cls, condition: str, otherwise: str) -> Guard:
        line = super().__new__(cls, f"if (!({condition})) {otherwise};")
        line.condition = condition
        return line


@dataclass(frozen=True)
class Section:
    title: str
    statements: tuple[Statement | str, ...]  # a str is a line of the target language


@dataclass(frozen=True)
class Argument:
    type: str  # "const double *"
    name: str


@dataclass(frozen=True)
class Kernel:
    """One function: `returns` is its C type."""

    name: str
    doc: tuple[str, ...]
    arguments: tuple[Argument, ...]
    sections: tuple[Section, ...]
    returns: str = "void"
    inline: bool = False
    attribute: str = ""  # of the compiler: "noinline"

    @property
    def operations(self) -> int:
        """Additions, multiplications, divisions and function calls that the statements perform."""
        return sum(
            count_operations(s.value)
            for section in self.sections
            for s in section.statements
            if isinstance(s, Statement) and isinstance(s.value, sp.Expr)
        )


    def has(self, function: type[sp.Function]) -> bool:
        """Whether a statement calls it."""
        statements = (s for section in self.sections for s in section.statements if isinstance(s, Statement))
        return any(isinstance(s.value, sp.Expr) and s.value.has(function) for s in statements)


def count_operations(expression: sp.Expr) -> int:
    """SymPy's count, with a negation counted as nothing: it is folded into an addition."""
    counts = sp.sympify(sp.count_ops(expression, visual=True)).as_coefficients_dict()
    return sum(int(count) for kind, count in counts.items() if kind.is_Symbol and kind.name != "NEG")


def hold_sides(switches: Switches, owner: str, sections: Iterable[Section], only_known: bool = False) -> list[Section]:
    """The sections with every corner (or only_known) as the side of its switch; told before it is first read."""
    known: dict[sp.Symbol, sp.Expr] = {}
    held = []
    for section in sections:
        statements: list[Statement | str] = []
        for statement in section.statements:
            if isinstance(statement, Statement) and isinstance(statement.value, sp.Expr):
                if isinstance(statement.value, SideOf):  # told by the author of the kernel: once is enough
                    if (told := sp.Symbol(statement.target, real=True)) not in known:
                        known[told] = statement.value
                        statements.append(statement)
                    continue
                before = len(known)
                value = switches.hold(statement.value, owner, known, only_known)
                statements += [Statement(s.name, side) for s, side in list(known.items())[before:]]
                statement = replace(statement, value=value)
            statements.append(statement)
        held.append(Section(section.title, tuple(statements)))
    return held


HELD = "corners: the sides that are held, if any"  # title of the lines from which a kernel reads sides


def with_sides(kernel: Kernel, held: Sequence[str]) -> Kernel:
    """The kernel behind the lines that say which sides are held and where the others are told, if it reads any."""
    return replace(kernel, sections=(Section(HELD, tuple(held)), *kernel.sections)) if _reads_sides(kernel) else kernel


def _reads_sides(kernel: Kernel) -> bool:
    statements = [s for section in kernel.sections if section.title != HELD for s in section.statements]
    texts = [s if isinstance(s, str) else s.value for s in statements]
    return any(re.search(r"\bside\b", x) if isinstance(x, str) else x.has(SideOf) for x in texts)


def without_unread(sections: Iterable[tuple[str, list[Statement | str]]]) -> list[tuple[str, list[Statement | str]]]:
    """The sections without locals that nothing behind them reads."""
    read: set[str] = set()
    kept = []
    for title, group in reversed(list(sections)):
        statements: list[Statement | str] = []
        for item in reversed(group):
            if isinstance(item, Statement) and item.local and item.target not in read:
                continue
            value = item if isinstance(item, str) else item.value
            read |= set(re.findall(r"\w+", value)) if isinstance(value, str) else {s.name for s in value.free_symbols}
            statements.append(item)
        kept.append((title, statements[::-1]))
    return kept[::-1]


class KernelBuilder:
    """Collects statements in sections, then resolves what they read."""

    def __init__(self, symbols: Symbols, name: str, doc: Sequence[str]) -> None:
        self._symbols, self._name, self._doc = symbols, name, tuple(doc)
        self._sections: list[tuple[str, list[Statement | str]]] = []
        self._needed: list[sp.Expr] = []

    def section(self, title: str) -> None:
        self._sections.append((title, []))

    def line(self, text: str, reads: Iterable[sp.Expr] = ()) -> None:
        """A line of C; `reads` are the symbols in it."""
        self._sections[-1][1].append(text)
        self._needed.extend(reads)

    def local(self, name: str, value: sp.Expr | str, comment: str = "") -> sp.Symbol:
        """`const double name = value;` and its symbol."""
        unique = self._symbols.unique(name)
        self._sections[-1][1].append(Statement(unique, value, True, comment))
        return sp.Symbol(unique, real=True)

    def line_statement(self, statement: Statement) -> None:
        """A statement whose name is already known to be free."""
        self._sections[-1][1].append(statement)

    def out(self, target: str, value: sp.Expr | str, comment: str = "") -> None:
        """`target = value;`"""
        self._sections[-1][1].append(Statement(target, value, False, comment))

    def build(
        self, arguments: Sequence[Argument], returns: str = "void", inline: bool = False, owner: str | None = None,
        prune: bool = False, only_known: bool = False,
    ) -> Kernel:  # fmt: skip
        """The kernel, with its inputs and definitions in front.

        With an `owner` ("": the scene) corners are sides of switches, or only_known ones: the function then reads
        `side` and writes `g` (switches.py). `prune`: locals that nothing reads are left out.
        """
        if prune:
            self._sections = without_unread(self._sections)
        statements = [s for _, group in self._sections for s in group if isinstance(s, Statement)]
        declared = {s.target for s in statements if s.local}
        expressions = [s.value for s in statements if isinstance(s.value, sp.Expr)] + self._needed
        definitions, inputs = self._resolve(expressions, declared)
        info = self._symbols.info
        groups: dict[str, list[Statement | str]] = {"p->": [], "lin->": [], "": []}  # by the struct that holds them
        for s in inputs:
            group = next(start for start in groups if info[s].home.startswith(start))
            groups[group].append(Statement(s.name, info[s].home))
        front = [
            Section("coordinates, velocities, time", tuple(groups[""])),
            Section("linearization", tuple(groups["lin->"])),
            Section("parameters", tuple(groups["p->"])),
            Section(
                "directions, arms, drives", tuple(Statement(s.name, self._symbols.definitions[s]) for s in definitions)
            ),
        ]
        sections = front + [Section(title, tuple(group)) for title, group in self._sections]
        if owner is not None:
            sections = hold_sides(self._symbols.switches, owner, sections, only_known)
        kept = tuple(section for section in sections if section.statements)
        return Kernel(self._name, self._doc, tuple(arguments), kept, returns, inline)

    def _resolve(self, expressions: Iterable[sp.Expr], declared: set[str]) -> tuple[list[sp.Symbol], list[sp.Symbol]]:
        """Definitions to compute (in the order in which they were made) and inputs to read."""
        info, definitions = self._symbols.info, self._symbols.definitions
        seen: set[sp.Symbol] = set()
        waiting = [s for e in expressions for s in e.free_symbols]
        while waiting:
            symbol = waiting.pop()
            if symbol in seen or symbol.name in declared or symbol not in info:
                continue
            seen.add(symbol)
            if not info[symbol].home:
                waiting.extend(definitions[symbol].free_symbols)
        ordered = [symbol for symbol in info if symbol in seen]
        return [s for s in ordered if not info[s].home], [s for s in ordered if info[s].home]


def without_unused(kernel: Kernel) -> Kernel:
    """The kernel without locals that nothing reads, such as pivots of coordinates that no row touches."""
    used: set[str] = set()
    sections: list[Section] = []
    for section in reversed(kernel.sections):
        kept: list[Statement | str] = []
        for statement in reversed(section.statements):
            if isinstance(statement, str):
                used |= set(re.findall(r"\w+", statement))
            elif statement.local and statement.target not in used:
                continue
            elif isinstance(statement.value, str):
                used |= set(re.findall(r"\w+", statement.value))
            else:
                used |= {symbol.name for symbol in statement.value.free_symbols}
            kept.append(statement)
        if kept:
            sections.append(Section(section.title, tuple(reversed(kept))))
    left = replace(kernel, sections=tuple(reversed(sections)))
    if _reads_sides(left):
        return left
    return replace(left, sections=tuple(section for section in left.sections if section.title != HELD))
