"""Kernels: generated functions with named inputs, temporaries and outputs, which can be printed in any language.

A `KernelBuilder` collects the statements of one function and adds before them what they need: the coordinates and
parameters that they read and the definitions (cosines, arms, drives) that they use. A `ValuePool` stores values of one
function for others, each once up to its sign.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import sympy as sp

from gudgeon.generator.ir.expression_structure import find_expression_structure
from gudgeon.generator.ir.signatures import Argument
from gudgeon.generator.ir.statements import DeclareBranches, Instruction, SolveDependentRows, Statement
from gudgeon.generator.ir.values import Value
from gudgeon.generator.symbols.derivatives import find_operation_classes, find_symbols
from gudgeon.generator.symbols.storage import PARAMETERS, Key, StorageLocation, make_real_symbol
from gudgeon.generator.symbols.switches import BranchOf, Switches
from gudgeon.generator.symbols.symbols import SymbolInfo, Symbols

_COUNTS: dict[int, int] = {}  # number of the structure of an expression -> operations


@dataclass(frozen=True)
class Section:
    """A titled group of lines of a function."""

    title: str
    statements: tuple[Instruction, ...]


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
    names: Mapping[Key, Key] = field(default_factory=dict)  # names of symbols in the printed text
    first_switch: int | None = None  # switches are counted from the argument `first_switch`; None: by their own numbers

    @property
    def n_operations(self) -> int:
        """Return the number of additions, multiplications, divisions and function calls of the statements.

        Lines that are neither an assignment of an expression nor a `SolveDependentRows` are not counted.
        """
        return sum(
            count_operations(value)
            for section in self.sections
            for line in section.statements
            if isinstance(line, SolveDependentRows)
            or (isinstance(line, Statement) and isinstance(line.value, sp.Basic))
            for value in line.expressions
        )

    def contains_function(self, function: type[sp.Function]) -> bool:
        """Return whether the value of any statement contains a SymPy function of the class `function`."""
        statements = (s for section in self.sections for s in section.statements if isinstance(s, Statement))
        return any(isinstance(s.value, sp.Expr) and function in find_operation_classes(s.value) for s in statements)


def count_operations(expression: sp.Expr) -> int:
    """Return the number of operations of an expression as SymPy counts them, but without negations.

    These are folded into additions. Reciprocals of symbols, and sums and products without quotients are counted here,
    because SymPy takes ten times as long; other parts by SymPy. Expressions of equal structure are counted once.
    """
    expression = sp.sympify(expression)
    if (found := find_expression_structure(expression)) is None:
        return _count_each_operation(expression)
    if (n_operations := _COUNTS.get(found[0])) is None:
        n_operations = _COUNTS[found[0]] = _count_each_operation(expression)
    return n_operations


def _count_each_operation(expression: sp.Basic) -> int:
    """Return `count_operations` of an expression, whose parts are counted one by one."""
    n_operations, pending = 0, [expression]
    while pending:
        expression_ = pending.pop()
        if expression_.is_Symbol or expression_.is_Integer:
            continue
        if expression_.is_Pow and expression_.exp is sp.S.NegativeOne and expression_.base.is_Symbol:
            n_operations += 1
            continue
        if expression_.is_Add or _is_plain_product(expression_):
            parts = (
                [factor for factor in expression_.args if factor is not sp.S.NegativeOne]
                if expression_.is_Mul
                else expression_.args
            )
            n_operations += len(parts) - 1
            pending += parts
        else:
            n_operations += _count_by_sympy(expression_)
    return n_operations


def _is_plain_product(expression: sp.Basic) -> bool:
    """Return whether an expression is a product of symbols, integers, sums and positive integer powers."""
    return expression.is_Mul and all(
        factor.is_Symbol
        or factor.is_Integer
        or factor.is_Add
        or (factor.is_Pow and factor.exp.is_Integer and factor.exp.is_positive)
        for factor in expression.args
    )


def _count_by_sympy(expression: sp.Basic) -> int:
    """Return SymPy's operation count of an expression without negations."""
    counts = sp.sympify(sp.count_ops(expression, visual=True)).as_coefficients_dict()
    return sum(int(count) for kind, count in counts.items() if kind.is_Symbol and kind.name != "NEG")


def freeze_branches(
    switches: Switches, owner: str, sections: Iterable[Section], registered_only: bool = False
) -> list[Section]:
    """Return the sections with min, max, abs and similar functions on branches that are frozen over a step.

    Each branch, the sign of a switching function, is assigned once, before the first statement that reads it. `owner`:
    the joint with play whose switches are meant; "" is the scene. `registered_only`: switching functions that the table
    `switches` lacks stay as they are.
    """
    branches: dict[sp.Symbol, sp.Expr] = {}
    result = []
    for section in sections:
        statements: list[Instruction] = []
        for statement in section.statements:
            if isinstance(statement, Statement) and isinstance(statement.value, sp.Expr):
                if isinstance(statement.value, BranchOf):  # assigned by the author of the kernel: once is enough
                    if (branch_symbol := make_real_symbol(statement.declared_local)) not in branches:
                        branches[branch_symbol] = statement.value
                        statements.append(statement)
                    continue
                n_known = len(branches)
                value = switches.freeze_branches(statement.value, owner, branches, registered_only)
                statements += [Statement(s.name, branch) for s, branch in list(branches.items())[n_known:]]
                statement = statement if value is statement.value else replace(statement, value=value)
            statements.append(statement)
        result.append(Section(section.title, tuple(statements)))
    return result


def remove_unused_lines(lines: Sequence[Instruction], read_names: set[str]) -> list[Instruction]:
    """Return the lines, in order, without those that define a local which no later line reads (dead-code elimination).

    `read_names` is changed in place: on entry the names that lines after these read, on return also those that these
    lines read.
    """
    result: list[Instruction] = []
    for line in reversed(lines):
        if line.declared_local and line.declared_local not in read_names:
            continue
        read_names |= line.reads
        result.append(line)
    return result[::-1]


def change_expression(line: Instruction, change: Callable[[sp.Basic], Value]) -> Instruction:
    """Return a line with `change(expression)` in place of its expression, if it is a statement with one.

    Other lines are returned unchanged.
    """
    if not (isinstance(line, Statement) and isinstance(line.value, sp.Basic)):
        return line
    value = change(line.value)
    return line if value is line.value else replace(line, value=value)


LINEARIZATION = "lin"  # the argument that holds the linearized equations of motion
FROZEN_BRANCHES_TITLE = (
    "branches of switching functions that are held, if any"  # title of the lines from which a kernel reads branches
)


def declare_branches(kernel: Kernel, output_target: str = "local") -> Kernel:
    """Return the kernel with a first section that declares the branches of switching functions (frozen signs).

    A kernel that reads no branch is returned unchanged. `output_target`: where the kernel writes the values of its
    switching functions: "" nowhere, "local" to a local array g that is not read later, "rhs" to the array g of `rhs`.
    """
    if not _has_branch_reads(kernel):
        return kernel
    return replace(
        kernel, sections=(Section(FROZEN_BRANCHES_TITLE, (DeclareBranches(output_target),)), *kernel.sections)
    )


def _has_branch_reads(kernel: Kernel) -> bool:
    """Return whether a line of a kernel reads the argument `branch`, outside the section that declares branches."""
    lines = (s for section in kernel.sections if section.title != FROZEN_BRANCHES_TITLE for s in section.statements)
    return any("branch" in line.reads for line in lines)


class KernelBuilder:
    """Builder of one kernel: collects statements in sections, then adds the definitions and inputs that they read."""

    def __init__(self, symbols: Symbols, name: str, doc: Sequence[str]) -> None:
        """Begin a function with a name and the lines of its comment."""
        self._symbols, self._name, self._doc = symbols, name, tuple(doc)
        self._sections: list[tuple[str, list[Instruction]]] = []

    @property
    def has_jumps(self) -> bool:
        """Return whether any line so far may jump to the code for a vanishing pivot."""
        return any(getattr(line, "jumps", False) for _, lines in self._sections for line in lines)

    def begin_section(self, title: str) -> None:
        """Begin a section with a title."""
        self._sections.append((title, []))

    def append_instruction(self, line: Instruction) -> None:
        """Append a line to the current section; a local that it declares must have an unused name."""
        self._sections[-1][1].append(line)

    def append_local(self, name: str, value: Value, comment: str = "") -> sp.Symbol:
        """Append the assignment of a value to a new local and return the local's symbol.

        The local is called `name` with an underscore, and a number if that is used already. `comment` is printed.
        """
        unique = self._symbols.make_unique_name(name)
        self._sections[-1][1].append(Statement(unique, value, comment))
        return make_real_symbol(unique)

    def append_store(self, target: StorageLocation, value: Value, comment: str = "") -> None:
        """Append a statement that stores a value at a place of an argument or array."""
        self._sections[-1][1].append(Statement(target, value, comment))

    def build_kernel(
        self,
        arguments: Sequence[Argument],
        status: bool = False,
        inline: bool = False,
        owner: str | None = None,
        prune: bool = False,
        registered_only: bool = False,
    ) -> Kernel:
        """Return the kernel: inputs and definitions that the collected lines read, then the collected sections.

        `status`: the function returns 0 or the number of a failure. With an `owner` (a joint with play; "": the scene)
        min, max and similar functions use frozen branches: the function reads `branch` and writes `g`.
        `registered_only`: only functions that have a switch already do. `prune`: locals that nothing reads are removed.
        Empty sections are left out.
        """
        if prune:
            self._sections = _prune_sections(self._sections)
        lines = [s for _, group in self._sections for s in group]
        declared = {line.declared_local for line in lines if line.declared_local}
        expressions = [x for line in lines for x in line.expressions]
        definitions, inputs = self._list_definitions_and_inputs(expressions, declared)
        symbol_info = self._symbols.info
        inputs_with_places = [(s.name, place) for s in inputs if (place := symbol_info[s].storage_location)]
        structs = (PARAMETERS, LINEARIZATION)
        groups = {
            struct: [
                Statement(*symbol_and_place)
                for symbol_and_place in inputs_with_places
                if symbol_and_place[1].base == struct
            ]
            for struct in structs
        }
        others = [
            Statement(*symbol_and_place)
            for symbol_and_place in inputs_with_places
            if symbol_and_place[1].base not in structs
        ]
        input_sections = [
            Section("coordinates, velocities, time", tuple(others)),
            Section("linearization", tuple(groups[LINEARIZATION])),
            Section("parameters", tuple(groups[PARAMETERS])),
            Section(
                "directions, arms, drives", tuple(Statement(s.name, self._symbols.definitions[s]) for s in definitions)
            ),
        ]
        sections = input_sections + [Section(title, tuple(group)) for title, group in self._sections]
        if owner is not None:
            sections = freeze_branches(self._symbols.switches, owner, sections, registered_only)
        nonempty = tuple(section for section in sections if section.statements)
        read_names = {name for section in nonempty for line in section.statements for name in line.reads}
        names = self._symbols.find_shorter_names(read_names)
        return Kernel(self._name, self._doc, tuple(arguments), nonempty, status, inline, names=names)

    def _list_definitions_and_inputs(
        self, expressions: Iterable[sp.Expr], declared_names: set[str]
    ) -> tuple[list[sp.Symbol], list[sp.Symbol]]:
        """Return (definitions, inputs): symbols to compute from their definitions, and symbols to read from arguments.

        Both are the symbols on which the expressions depend, directly or through definitions, in the order in which
        they were made. Those in `declared_names`, which the function's own lines define, are left out.
        """
        info, definitions = self._symbols.info, self._symbols.definitions
        found: set[sp.Symbol] = set()
        pending = [s for expression in expressions for s in find_symbols(expression)]
        while pending:
            symbol = pending.pop()
            if symbol in found or symbol.name in declared_names or symbol not in info:
                continue
            found.add(symbol)
            if not info[symbol].storage_location:
                pending.extend(find_symbols(definitions[symbol]))
        ordered = [symbol for symbol in info if symbol in found]
        return [s for s in ordered if not info[s].storage_location], [s for s in ordered if info[s].storage_location]


def _prune_sections(sections: Iterable[tuple[str, Sequence[Instruction]]]) -> list[tuple[str, list[Instruction]]]:
    """Return the sections, as pairs of title and lines, without locals that no later line reads; titles stay."""
    read_names: set[str] = set()
    return [(title, remove_unused_lines(lines, read_names)) for title, lines in reversed(list(sections))][::-1]


def remove_unused_locals(kernel: Kernel) -> Kernel:
    """Return the kernel without locals that nothing reads, directly or not (dead-code elimination).

    An example is the pivot of a coordinate that no equation contains. Empty sections are removed, and the declaration
    of branches if no line reads a branch any more.
    """
    pruned = _prune_sections((section.title, section.statements) for section in kernel.sections)
    result = replace(kernel, sections=tuple(Section(title, tuple(lines)) for title, lines in pruned if lines))
    if _has_branch_reads(result):
        return result
    return replace(
        result, sections=tuple(section for section in result.sections if section.title != FROZEN_BRANCHES_TITLE)
    )


class ValuePool:
    """Values of one function that others read; `store_value` stores a value and returns the symbol that reads it."""

    def __init__(self, symbols: Symbols, array: StorageLocation) -> None:
        """Begin an empty pool whose values are stored in consecutive elements of `array`."""
        self._symbols, self.array = symbols, array
        self._symbols_by_value: dict[sp.Expr, sp.Symbol] = {}
        self._index_by_value: dict[sp.Expr, int] = {}
        self.size = 0

    def store_value(self, builder: KernelBuilder, value: sp.Expr, name: str) -> sp.Expr:
        """Store a value in the next element of the pool and return the symbol of that element.

        `name` is the base of its name. A number or ± a parameter is returned unchanged. For a value that is stored
        already, or its negative, ± the symbol of that element is returned.
        """
        if value.is_Number or self._is_parameter(value):
            return value
        if value in self._symbols_by_value:
            return self._symbols_by_value[value]
        if self._is_parameter(negative := -value):
            return value
        if negative in self._symbols_by_value:
            return -self._symbols_by_value[negative]
        symbol = self._symbols.add_symbol(name, self.array[self._append_value(builder, value)])
        self._symbols_by_value[value], self._index_by_value[symbol] = symbol, self._index_by_value[value]
        return symbol

    def store_local(self, builder: KernelBuilder, value: sp.Expr) -> sp.Expr:
        """Store the local in `value`, which is ± that local, under its own name for other functions; return the value.

        Nothing is stored if the value has no symbol or its symbol is known already, for example as a parameter.
        """
        symbol = next(iter(value.free_symbols), None)
        if symbol is not None and symbol not in self._symbols.info:
            self._symbols.info[symbol] = SymbolInfo(self.array[self._append_value(builder, symbol)], "", "")
        return value

    def find_index_and_sign(self, builder: KernelBuilder, value: sp.Expr) -> tuple[int, int]:
        """Return (index, sign) of a value in the pool: the value is sign times the element.

        A value that is not stored yet, such as a number or parameter, is stored first.
        """
        if value in self._index_by_value:
            return self._index_by_value[value], 1
        if (negative := -value) in self._index_by_value:
            return self._index_by_value[negative], -1
        return self._append_value(builder, value), 1

    def _append_value(self, builder: KernelBuilder, value: sp.Expr) -> int:
        """Append a statement that stores a value at the next free index, and return that index."""
        builder.append_store(self.array[self.size], value)
        self._index_by_value[value] = self.size
        self.size += 1
        return self._index_by_value[value]

    def _is_parameter(self, value: sp.Expr) -> bool:
        """Return whether a value is the symbol of a parameter."""
        return bool(value.is_Symbol and value in self._symbols.info and self._symbols.info[value].is_parameter)
