"""Conditional expressions as separate named statements, so that each condition is evaluated once.

Values stay as they are and keep the order of their terms; a printer writes the name that `Branches` knows for a branch.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import sympy as sp

from gudgeon.generator.ir.statements import Instruction, Statement
from gudgeon.generator.ir.values import NO_NAMES, Names
from gudgeon.generator.symbols.derivatives import find_operation_classes
from gudgeon.generator.symbols.storage import Key, StorageLocation
from gudgeon.generator.symbols.switches import BranchOf, Select


@dataclass(frozen=True)
class ReturnIfOnlyJoints(Instruction):
    """The end of a function if no accelerations are requested: the joints with play have been evaluated."""


@dataclass(frozen=True)
class Branch(Instruction):
    """A conditional assignment of `then` or `otherwise` by the sign of a switching function.

    `target` is `otherwise` where the function is below zero, else `then`, also at NaN.
    """

    target: Key
    value: sp.Expr  # Select(branch, then, otherwise)
    comment: str = ""

    @property
    def active_branch(self) -> sp.Expr:
        """Return the symbol of the active branch: the sign of the switching function, frozen over a step.

        It selects `value_above` (sign not negative) or `value_below` (negative). It is the first argument of the
        `Select` in `value`.
        """
        return self.value.args[0]

    @property
    def value_above(self) -> sp.Expr:
        """Return the value where the switching function is not below zero, also where it is NaN."""
        return self.value.args[1]

    @property
    def value_below(self) -> sp.Expr:
        """Return the value where the switching function is below zero."""
        return self.value.args[2]

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """Return the expression that the line reads, in a tuple of one."""
        return (self.value,)

    @property
    def writes(self) -> Names:  # type: ignore[override]
        """Return the name of the array or argument to which the value is stored, in a set; empty for a local."""
        return self.target.names if isinstance(self.target, StorageLocation) else NO_NAMES

    @property
    def declared_local(self) -> str:  # type: ignore[override]
        """Return the name of the local that the line declares, or "" if it stores to an array or argument."""
        return self.target if isinstance(self.target, str) else ""


class Branches:
    """Names of conditional values; `insert_branches` adds a `Branch` line before the first line that reads one.

    `names`: the name of each conditional value (`Select`), by expression.
    """

    def __init__(self, used_names: Iterable[str]) -> None:
        """Begin without branches.

        `used_names`: names that the function uses already, which branches must not get.
        """
        self.names: dict[sp.Expr, str] = {}
        self._used_names = set(used_names)
        self._switching_functions: dict[sp.Expr, sp.Expr] = {}  # branches, and the difference whose sign each is

    def insert_branches(self, lines: Iterable[Instruction]) -> list[Instruction]:
        """Return the lines of a section with a `Branch` line before the first line that reads each conditional value.

        A conditional value is a `Select`, one of two expressions by the sign of a switching function. An assignment
        whose value is itself a `Select` becomes a `Branch` line. The names of the results are added to `names`. The
        switching function of each local that is assigned a frozen branch (`BranchOf`) is recorded. Called once per
        section, in order.
        """
        result: list[Instruction] = []
        for line in lines:
            if isinstance(line, Statement) and isinstance(line.value, Select) and self._needs_branch_line(line.value):
                for argument in line.value.args:
                    result += self._make_branch_lines(argument)
                result.append(Branch(line.target, line.value, line.comment))
                if line.declared_local:
                    self.names[line.value] = line.declared_local
                continue
            for expression in line.expressions:
                result += self._make_branch_lines(expression)
            result.append(line)
            if isinstance(line, Statement) and isinstance(line.value, BranchOf):
                self._switching_functions[sp.Symbol(line.declared_local, real=True)] = line.value.args[1]
        return result

    def _make_branch_lines(self, expression: sp.Basic) -> list[Instruction]:
        """Return a `Branch` line for each `Select` (conditional value) without a name, inner ones first.

        The new names are added to `names`; a `Select` between two numbers gets none.
        """
        if Select not in find_operation_classes(expression):
            return []
        result: list[Instruction] = []
        for part in sp.postorder_traversal(expression):
            if isinstance(part, Select) and self._needs_branch_line(part):
                self.names[part] = self._make_branch_name(part)
                result.append(Branch(self.names[part], part))
        return result

    def _needs_branch_line(self, selection: Select) -> bool:
        """Return whether a `Select` (conditional value) has no name yet and its two values are not both numbers."""
        return selection not in self.names and not all(argument.is_Number for argument in selection.args[1:])

    def _make_branch_name(self, selection: Select) -> str:
        """Return an unused name for the result of a `Select` and mark it as used.

        It is "larger_k" for a maximum and "smaller_k" for a minimum, whose switching function is the difference of both
        values, else "branch_k"; k = 1, 2, ….
        """
        branch, a, b = selection.args
        difference = self._switching_functions.get(branch)
        prefix = {a - b: "larger", b - a: "smaller"}.get(difference, "branch")
        name = next(
            name for k in range(1, len(self._used_names) + 2) if (name := f"{prefix}_{k}") not in self._used_names
        )
        self._used_names.add(name)
        return name
