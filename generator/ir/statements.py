"""What functions are made of: lines that know what they read, write and declare, in no language yet."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import ClassVar

import sympy as sp

from gudgeon.generator.ir.signatures import Type
from gudgeon.generator.ir.values import NONE, Names, Test, Value, names_in
from gudgeon.generator.symbols.storage import PARAMETERS, Key, Place


@dataclass(frozen=True)
class Line:
    """Any of them: expressions and other names that it reads, arrays that it writes, the local that it declares."""

    writes: ClassVar[Names] = NONE
    defines: ClassVar[str] = ""

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """Everything of SymPy in it that is read."""
        return ()

    @property
    def names(self) -> Names:
        """What else is read."""
        return NONE

    @cached_property
    def reads(self) -> Names:
        """All names that are read."""
        return self.names.union(*map(names_in, self.expressions))


@dataclass(frozen=True)
class Statement(Line):
    """`target = value`; a target that is no place is a local, which is declared there."""

    target: Key
    value: Value
    comment: str = ""

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """Of the value."""
        return (self.value,) if isinstance(self.value, sp.Basic) else self.value.expressions

    @property
    def names(self) -> Names:
        """Of the value."""
        return NONE if isinstance(self.value, sp.Basic) else self.value.names

    @property
    def writes(self) -> Names:  # type: ignore[override]
        """The array or argument that is stored to."""
        return self.target.names if isinstance(self.target, Place) else NONE

    @property
    def defines(self) -> str:  # type: ignore[override]
        """The local."""
        return self.target if isinstance(self.target, str) else ""


@dataclass(frozen=True)
class Declare(Line):
    """An array of a function's own."""

    type: Type
    name: str
    sizes: tuple[int, ...]

    @property
    def writes(self) -> Names:  # type: ignore[override]
        """Nobody has it from elsewhere."""
        return frozenset([self.name])


@dataclass(frozen=True)
class Call(Line):
    """`function(given, …, results, …)`; structs are handed over by their address."""

    function: str
    given: tuple[sp.Basic | Place, ...]
    results: tuple[Place, ...]

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """Those that are given."""
        return tuple(x for x in self.given if isinstance(x, sp.Basic))

    @property
    def names(self) -> Names:
        """Places that are given."""
        return frozenset(x.base for x in self.given if isinstance(x, Place))

    @property
    def writes(self) -> Names:  # type: ignore[override]
        """What is filled."""
        return frozenset(place.base for place in self.results)


@dataclass(frozen=True)
class Guard(Line):
    """Fails with a number unless the test holds, or a call returns 0; `only`: asked only where this holds.

    To fail is to return the number, or to note it as `pivot` and to jump to what deals with dependent rows.
    """

    test: Test | Call
    number: int
    jumps: bool = False
    only: Test | None = None

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """Of the tests."""
        return (*self.test.expressions, *(self.only.expressions if self.only else ()))

    @property
    def names(self) -> Names:
        """Of a call."""
        return self.test.names | (self.test.writes if isinstance(self.test, Call) else NONE)


@dataclass(frozen=True)
class When(Line):
    """A statement that is made where a test holds."""

    test: Test
    statement: Statement

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """Of both."""
        return (*self.test.expressions, *self.statement.expressions)

    @property
    def writes(self) -> Names:  # type: ignore[override]
        """Of the statement."""
        return self.statement.writes


@dataclass(frozen=True)
class Passed(Line):
    """The status of a part of the function goes to a local, or to `pivot`."""

    call: Call
    status: str

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """Of the call."""
        return self.call.expressions

    @property
    def names(self) -> Names:
        """Of the call."""
        return self.call.names | self.call.writes


@dataclass(frozen=True)
class Ended(Line):
    """Where the status of a part is not 0 this function ends as well."""

    status: str
    jumps: bool


@dataclass(frozen=True)
class Return(Line):
    """With the status: 0, or the pivot that vanished."""

    pivot: bool = False


@dataclass(frozen=True)
class Status(Line):
    """No pivot has vanished yet."""


@dataclass(frozen=True)
class Jump(Line):
    """Over what deals with dependent rows, to the powers."""


@dataclass(frozen=True)
class Rescue(Line):
    """Where a pivot vanished: solved by the rows' own rank; with no forces given, by the absolute formulation."""

    force: tuple[sp.Basic, ...] = ()
    rhs: tuple[sp.Basic, ...] = ()

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """Forces and right-hand sides."""
        return (*self.force, *self.rhs)

    @property
    def names(self) -> Names:
        """What the solution is told."""
        own = () if self.force else ("v",)
        return frozenset(["t", "q", "discrete", PARAMETERS, "a", "rhs", *own])


@dataclass(frozen=True)
class Largest(Line):
    """The largest magnitude of some values; NaN counts as nothing. No corner of the motion."""

    target: str
    values: tuple[sp.Basic, ...]

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """The values."""
        return self.values

    @property
    def writes(self) -> Names:  # type: ignore[override]
        """The result."""
        return frozenset([self.target])


@dataclass(frozen=True)
class LargestRow(Line):
    """The number, from 1, of the value with the largest magnitude, in `row`."""

    values: tuple[sp.Basic, ...]
    writes: ClassVar[Names] = frozenset(["row"])

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """The values."""
        return self.values


@dataclass(frozen=True)
class Unread(Line):
    """A local that is told for its own sake."""

    name: str

    @property
    def names(self) -> Names:
        """It."""
        return frozenset([self.name])


@dataclass(frozen=True)
class Branches(Line):
    """Which sides of corners are held (or none), and where they are told: "" nowhere, "nobody", "rhs"."""

    told: str
    held: bool = True

    @property
    def names(self) -> Names:
        """Where sides are held, and told."""
        told = {"": [], "nobody": ["g"], "rhs": ["g", "rhs"]}[self.told]
        return frozenset(["branch", *told, *(["discrete"] if self.held else [])])


@dataclass(frozen=True)
class RunNumbers(Line):
    """p, read from the linearization."""

    writes: ClassVar[Names] = frozenset([PARAMETERS])

    @property
    def names(self) -> Names:
        """Where it is."""
        return frozenset(["lin"])


@dataclass(frozen=True)
class Sines(Line):
    """Cosines and sines of angles: a vector of four, with `count` so many of them in a loop, or one of each run."""

    angles: tuple[sp.Symbol, ...]
    suffix: str
    count: int = 0
    lanes: bool = field(default=False, kw_only=True)

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """The angles."""
        return self.angles

    @property
    def arrays(self) -> tuple[str, str]:
        """What is filled."""
        return f"sines_{self.suffix}", f"cosines_{self.suffix}"

    @property
    def writes(self) -> Names:  # type: ignore[override]
        """The vectors."""
        return frozenset([f"angles_{self.suffix}", *self.arrays])
