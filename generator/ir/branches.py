"""Branches of expressions as statements of their own, so that each choice is made once and has a name.

Values stay as they are and keep the order of their terms; a printer writes the name that `Branches` knows for a branch.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import sympy as sp

from gudgeon.generator.ir.statements import Line, Statement
from gudgeon.generator.ir.values import NONE, Names
from gudgeon.generator.symbols.storage import Key, Place
from gudgeon.generator.symbols.switches import BranchOf, Pick


@dataclass(frozen=True)
class JointsAlone(Line):
    """The end of a function if no accelerations are requested: the joints with play have been evaluated."""


@dataclass(frozen=True)
class Branch(Line):
    """A conditional assignment of `then` or `otherwise` by the sign of a switching function.

    `target` is `otherwise` where the function is below zero, else `then`, also at NaN.
    """

    target: Key
    value: sp.Expr  # Pick(side, then, otherwise)
    comment: str = ""

    @property
    def side(self) -> sp.Expr:
        """Return the active branch (sign of the switching function) that decides."""
        return self.value.args[0]

    @property
    def then(self) -> sp.Expr:
        """Return the value on the branch that is not below zero."""
        return self.value.args[1]

    @property
    def otherwise(self) -> sp.Expr:
        """Return the value on the branch below zero."""
        return self.value.args[2]

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """Return the expression that is read."""
        return (self.value,)

    @property
    def writes(self) -> Names:  # type: ignore[override]
        """Return the array or argument that is stored to."""
        return self.target.names if isinstance(self.target, Place) else NONE

    @property
    def defines(self) -> str:  # type: ignore[override]
        """Return the local that is declared, or ""."""
        return self.target if isinstance(self.target, str) else ""


class Branches:
    """Inserts a Branch before the first line that reads it; `names` are the names of branches by expression."""

    def __init__(self, used: Iterable[str]) -> None:
        """Begin without branches; `used`: names in use."""
        self.names: dict[sp.Expr, str] = {}
        self._taken = set(used)
        self._message: dict[sp.Expr, sp.Expr] = {}  # sides, and the difference whose sign each is

    def lines(self, lines: Iterable[Line]) -> list[Line]:
        """Return the same lines with their branches inserted."""
        found: list[Line] = []
        for line in lines:
            if isinstance(line, Statement) and isinstance(line.value, Pick) and self._is_new(line.value):
                for inner in line.value.args:
                    found += self._branches(inner)
                found.append(Branch(line.target, line.value, line.comment))
                if line.defines:
                    self.names[line.value] = line.defines
                continue
            for expression in line.expressions:
                found += self._branches(expression)
            found.append(line)
            if isinstance(line, Statement) and isinstance(line.value, BranchOf):
                self._message[sp.Symbol(line.defines, real=True)] = line.value.args[1]
        return found

    def _branches(self, expression: sp.Basic) -> list[Line]:
        """Return the branches in an expression that have no name yet, inner ones first."""
        if not expression.has(Pick):
            return []
        found: list[Line] = []
        for part in sp.postorder_traversal(expression):
            if isinstance(part, Pick) and self._is_new(part):
                self.names[part] = self._new(part)
                found.append(Branch(self.names[part], part))
        return found

    def _is_new(self, pick: Pick) -> bool:
        """Return whether a branch needs a line; a choice between two numbers does not."""
        return pick not in self.names and not all(argument.is_Number for argument in pick.args[1:])

    def _new(self, pick: Pick) -> str:
        """Return a new name for a branch: "larger", "smaller" or "branch", with a number."""
        side, a, b = pick.args
        difference = self._message.get(side)
        kind = {a - b: "larger", b - a: "smaller"}.get(difference, "branch")
        name = next(name for k in range(1, len(self._taken) + 2) if (name := f"{kind}_{k}") not in self._taken)
        self._taken.add(name)
        return name
