"""Branches of expressions as lines of their own: what is picked is picked once, and has a name.

Values stay as they are and keep the order of their terms; a printer writes the name that `Branches` knows for a branch.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import sympy as sp

from gudgeon.generator.ir.statements import Line, Statement
from gudgeon.generator.ir.values import NONE, Names
from gudgeon.generator.symbols.corners import BranchOf, Pick
from gudgeon.generator.symbols.storage import Key, Place


@dataclass(frozen=True)
class JointsAlone(Line):
    """Where no accelerations are asked for a function ends here: joints with play are evaluated."""


@dataclass(frozen=True)
class Branch(Line):
    """`target` is `otherwise` where the side is below zero, else `then` (a NaN stays in it)."""

    target: Key
    value: sp.Expr  # Pick(side, then, otherwise)
    comment: str = ""

    @property
    def side(self) -> sp.Expr:
        """By which it is decided."""
        return self.value.args[0]

    @property
    def then(self) -> sp.Expr:
        """Not below zero."""
        return self.value.args[1]

    @property
    def otherwise(self) -> sp.Expr:
        """Below zero."""
        return self.value.args[2]

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """All of them."""
        return (self.value,)

    @property
    def writes(self) -> Names:  # type: ignore[override]
        """The array or argument that is stored to."""
        return self.target.names if isinstance(self.target, Place) else NONE

    @property
    def defines(self) -> str:  # type: ignore[override]
        """The local."""
        return self.target if isinstance(self.target, str) else ""


class Branches:
    """`lines` puts a branch in front of the first line that reads it; `names` are what they are called."""

    def __init__(self, taken: Iterable[str]) -> None:
        self.names: dict[sp.Expr, str] = {}
        self._taken = set(taken)
        self._told: dict[sp.Expr, sp.Expr] = {}  # sides, and the difference whose sign each is

    def lines(self, lines: Iterable[Line]) -> list[Line]:
        """The same lines with their branches."""
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
                self._told[sp.Symbol(line.defines, real=True)] = line.value.args[1]
        return found

    def _branches(self, expression: sp.Basic) -> list[Line]:
        """Those in it that have no name yet, inner ones first."""
        if not expression.has(Pick):
            return []
        found: list[Line] = []
        for part in sp.postorder_traversal(expression):
            if isinstance(part, Pick) and self._is_new(part):
                self.names[part] = self._new(part)
                found.append(Branch(self.names[part], part))
        return found

    def _is_new(self, pick: Pick) -> bool:
        """One number or another is worth no line."""
        return pick not in self.names and not all(argument.is_Number for argument in pick.args[1:])

    def _new(self, pick: Pick) -> str:
        """What a branch is called: after the larger or the smaller of two, where it is that."""
        side, a, b = pick.args
        difference = self._told.get(side)
        kind = {a - b: "larger", b - a: "smaller"}.get(difference, "branch")
        name = next(name for k in range(1, len(self._taken) + 2) if (name := f"{kind}_{k}") not in self._taken)
        self._taken.add(name)
        return name
