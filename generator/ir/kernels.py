"""Kernels: named inputs → named temporaries → named outputs, ready to be printed in any language.

A `KernelBuilder` collects the statements of one function and adds before them what they need: the coordinates and
parameters that they read and the definitions (cosines, arms, drives) that they use. A `Pool` stores values of one
function for others, each once up to its sign.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import sympy as sp

from gudgeon.generator.ir.signatures import Argument
from gudgeon.generator.ir.statements import Branches, Line, Rescue, Statement
from gudgeon.generator.ir.values import Value
from gudgeon.generator.symbols.derivatives import symbols_of
from gudgeon.generator.symbols.storage import PARAMETERS, Key, Place
from gudgeon.generator.symbols.switches import BranchOf, Switches
from gudgeon.generator.symbols.symbols import SymbolInfo, Symbols


@dataclass(frozen=True)
class Section:
    """A titled group of lines of a function."""

    title: str
    statements: tuple[Line, ...]


@dataclass(frozen=True)
class Kernel:
    """One function of straight-line statements; with `status` it returns 0 or the number of what failed."""

    name: str
    doc: tuple[str, ...]
    arguments: tuple[Argument, ...]
    sections: tuple[Section, ...]
    status: bool = False
    inline: bool = False
    attribute: str = ""  # of the compiler: "noinline"
    names: Mapping[Key, Key] = field(default_factory=dict)  # what symbols are called in its text
    first_corner: int | None = None  # switches are counted from the argument `corner`; None: by their own numbers

    @property
    def operations(self) -> int:
        """Return the number of additions, multiplications, divisions and function calls of the statements."""
        return sum(
            count_operations(value)
            for section in self.sections
            for line in section.statements
            if isinstance(line, Rescue) or (isinstance(line, Statement) and isinstance(line.value, sp.Basic))
            for value in line.expressions
        )

    def has(self, function: type[sp.Function]) -> bool:
        """Return whether a statement calls a function."""
        statements = (s for section in self.sections for s in section.statements if isinstance(s, Statement))
        return any(isinstance(s.value, sp.Expr) and s.value.has(function) for s in statements)


def count_operations(expression: sp.Expr) -> int:
    """Return SymPy's operation count, with a negation counted as nothing: it is folded into an addition.

    Sums and products without quotients are most of all and are counted here: SymPy takes ten times as long.
    """
    total, left = 0, [sp.sympify(expression)]
    while left:
        part = left.pop()
        if part.is_Symbol or part.is_Integer:
            continue
        if part.is_Add or _is_plain_product(part):
            parts = [x for x in part.args if x is not sp.S.NegativeOne] if part.is_Mul else part.args
            total += len(parts) - 1
            left += parts
        else:
            total += _counted_by_sympy(part)
    return total


def _is_plain_product(part: sp.Basic) -> bool:
    """Return whether an expression is a product of symbols, integers, sums and positive integer powers."""
    return part.is_Mul and all(
        x.is_Symbol or x.is_Integer or x.is_Add or (x.is_Pow and x.exp.is_Integer and x.exp.is_positive)
        for x in part.args
    )


def _counted_by_sympy(expression: sp.Basic) -> int:
    """Return SymPy's operation count without negations."""
    counts = sp.sympify(sp.count_ops(expression, visual=True)).as_coefficients_dict()
    return sum(int(count) for kind, count in counts.items() if kind.is_Symbol and kind.name != "NEG")


def hold_branches(
    switches: Switches, owner: str, sections: Iterable[Section], only_known: bool = False
) -> list[Section]:
    """Return the sections with every switching function (or only_known ones) replaced by its held branch.

    Each branch is assigned before it is first read.
    """
    known: dict[sp.Symbol, sp.Expr] = {}
    held = []
    for section in sections:
        statements: list[Line] = []
        for statement in section.statements:
            if isinstance(statement, Statement) and isinstance(statement.value, sp.Expr):
                if isinstance(statement.value, BranchOf):  # assigned by the author of the kernel: once is enough
                    if (message := sp.Symbol(statement.defines, real=True)) not in known:
                        known[message] = statement.value
                        statements.append(statement)
                    continue
                before = len(known)
                value = switches.hold(statement.value, owner, known, only_known)
                statements += [Statement(s.name, side) for s, side in list(known.items())[before:]]
                statement = replace(statement, value=value)
            statements.append(statement)
        held.append(Section(section.title, tuple(statements)))
    return held


def without_unread(lines: Sequence[Line], read: set[str]) -> list[Line]:
    """Return the lines without locals that no later line reads.

    `read`: the names that lines after these read; names that these lines read are added to it.
    """
    kept: list[Line] = []
    for line in reversed(lines):
        if line.defines and line.defines not in read:
            continue
        read |= line.reads
        kept.append(line)
    return kept[::-1]


def changed(line: Line, change: Callable[[sp.Basic], Value]) -> Line:
    """Return a statement with its expression changed; other lines as they are."""
    if isinstance(line, Statement) and isinstance(line.value, sp.Basic):
        return replace(line, value=change(line.value))
    return line


LINEARIZATION = "lin"  # the argument that holds the linearized equations of motion
HELD = "branches of switching functions that are held, if any"  # title of the lines from which a kernel reads sides


def declare_branches(kernel: Kernel, message: str = "nobody") -> Kernel:
    """Return the kernel with the line that declares held branches before it, if it reads any.

    told: where the kernel writes its switching functions, see `Branches`.
    """
    if not _reads_sides(kernel):
        return kernel
    return replace(kernel, sections=(Section(HELD, (Branches(message),)), *kernel.sections))


def _reads_sides(kernel: Kernel) -> bool:
    """Return whether a kernel reads the branch of a switching function."""
    lines = (s for section in kernel.sections if section.title != HELD for s in section.statements)
    return any("branch" in line.reads for line in lines)


class KernelBuilder:
    """Collects the statements of one function in sections, then resolves what they read."""

    def __init__(self, symbols: Symbols, name: str, doc: Sequence[str]) -> None:
        """Begin a function with a name and the lines of its comment."""
        self._symbols, self._name, self._doc = symbols, name, tuple(doc)
        self._sections: list[tuple[str, list[Line]]] = []

    @property
    def has_jumps(self) -> bool:
        """Return whether any line so far jumps to the code for a vanishing pivot."""
        return any(getattr(line, "jumps", False) for _, lines in self._sections for line in lines)

    def section(self, title: str) -> None:
        """Begin a section with a title."""
        self._sections.append((title, []))

    def line(self, line: Line) -> None:
        """Append a line; a local that it declares must have an unused name."""
        self._sections[-1][1].append(line)

    def local(self, name: str, value: Value, comment: str = "") -> sp.Symbol:
        """Assign the value to a new local and return its symbol."""
        unique = self._symbols.unique(name)
        self._sections[-1][1].append(Statement(unique, value, comment))
        return sp.Symbol(unique, real=True)

    def out(self, target: Place, value: Value, comment: str = "") -> None:
        """Store the value at a place, with a comment."""
        self._sections[-1][1].append(Statement(target, value, comment))

    def build(
        self,
        arguments: Sequence[Argument],
        status: bool = False,
        inline: bool = False,
        owner: str | None = None,
        prune: bool = False,
        only_known: bool = False,
    ) -> Kernel:
        """Return the kernel, with its inputs and definitions before the collected sections.

        With an `owner` ("": the scene) switching functions, or only_known ones, are replaced by branches: the function
        then
        reads `branch` and writes `g` (symbols/switches.py). `prune`: locals that nothing reads are left out.
        """
        if prune:
            self._sections = _prune_sections(self._sections)
        lines = [s for _, group in self._sections for s in group]
        declared = {line.defines for line in lines if line.defines}
        expressions = [x for line in lines for x in line.expressions]
        definitions, inputs = self._resolve(expressions, declared)
        info = self._symbols.info
        places = [(s.name, place) for s in inputs if (place := info[s].home)]
        structs = (PARAMETERS, LINEARIZATION)
        groups = {of: [Statement(*each) for each in places if each[1].base == of] for of in structs}
        others = [Statement(*each) for each in places if each[1].base not in structs]
        front = [
            Section("coordinates, velocities, time", tuple(others)),
            Section("linearization", tuple(groups[LINEARIZATION])),
            Section("parameters", tuple(groups[PARAMETERS])),
            Section(
                "directions, arms, drives", tuple(Statement(s.name, self._symbols.definitions[s]) for s in definitions)
            ),
        ]
        sections = front + [Section(title, tuple(group)) for title, group in self._sections]
        if owner is not None:
            sections = hold_branches(self._symbols.switches, owner, sections, only_known)
        kept = tuple(section for section in sections if section.statements)
        read = {name for section in kept for line in section.statements for name in line.reads}
        names = self._symbols.shorter(read)
        return Kernel(self._name, self._doc, tuple(arguments), kept, status, inline, names=names)

    def _resolve(self, expressions: Iterable[sp.Expr], declared: set[str]) -> tuple[list[sp.Symbol], list[sp.Symbol]]:
        """Return the definitions to compute, in the order in which they were made, and the inputs to read."""
        info, definitions = self._symbols.info, self._symbols.definitions
        seen: set[sp.Symbol] = set()
        waiting = [s for e in expressions for s in symbols_of(e)]
        while waiting:
            symbol = waiting.pop()
            if symbol in seen or symbol.name in declared or symbol not in info:
                continue
            seen.add(symbol)
            if not info[symbol].home:
                waiting.extend(symbols_of(definitions[symbol]))
        ordered = [symbol for symbol in info if symbol in seen]
        return [s for s in ordered if not info[s].home], [s for s in ordered if info[s].home]


def _prune_sections(sections: Iterable[tuple[str, Sequence[Line]]]) -> list[tuple[str, list[Line]]]:
    """Return the sections without locals that no later line reads."""
    read: set[str] = set()
    return [(title, without_unread(group, read)) for title, group in reversed(list(sections))][::-1]


def without_unused(kernel: Kernel) -> Kernel:
    """Return the kernel without locals that nothing reads, such as pivots of coordinates that no equation contains."""
    pruned = _prune_sections((section.title, section.statements) for section in kernel.sections)
    left = replace(kernel, sections=tuple(Section(title, tuple(group)) for title, group in pruned if group))
    if _reads_sides(left):
        return left
    return replace(left, sections=tuple(section for section in left.sections if section.title != HELD))


class Pool:
    """Values of one function that others read; `keep` stores a value and returns the symbol that reads it."""

    def __init__(self, symbols: Symbols, array: Place) -> None:
        """Begin an empty pool in an array."""
        self._symbols, self.array = symbols, array
        self._kept: dict[sp.Expr, sp.Symbol] = {}
        self._place: dict[sp.Expr, int] = {}
        self.size = 0

    def keep(self, build: KernelBuilder, value: sp.Expr, expected: str) -> sp.Expr:
        """Store a value and return ± the symbol of its place; a number or parameter is returned as it is."""
        for sign in (1, -1):
            if value.is_Number or self._is_parameter(sign * value):
                return value
            if sign * value in self._kept:
                return sign * self._kept[sign * value]
        symbol = self._symbols.new(expected, self.array[self._store(build, value)])
        self._kept[value], self._place[symbol] = symbol, self._place[value]
        return symbol

    def adopt(self, build: KernelBuilder, value: sp.Expr) -> sp.Expr:
        """Store the local of which a value is ±, so that other functions read it under the same name."""
        symbol = next(iter(value.free_symbols), None)
        if symbol is not None and symbol not in self._symbols.info:
            self._symbols.info[symbol] = SymbolInfo(self.array[self._store(build, symbol)], "", "")
        return value

    def place(self, build: KernelBuilder, value: sp.Expr) -> tuple[int, int]:
        """Return (index, sign) of a value that `keep` returned; numbers and parameters are stored for it."""
        for sign in (1, -1):
            if sign * value in self._place:
                return self._place[sign * value], sign
        return self._store(build, value), 1

    def _store(self, build: KernelBuilder, value: sp.Expr) -> int:
        """Store a value at the next index and return that index."""
        build.out(self.array[self.size], value)
        self._place[value] = self.size
        self.size += 1
        return self._place[value]

    def _is_parameter(self, value: sp.Expr) -> bool:
        """Return whether a value is a parameter of the run."""
        return bool(value.is_Symbol and value in self._symbols.info and self._symbols.info[value].is_parameter)
