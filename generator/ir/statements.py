"""Statements of generated functions in no particular language; each knows what it reads, writes and declares."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import ClassVar

import sympy as sp

from gudgeon.generator.ir.signatures import Type
from gudgeon.generator.ir.values import NO_NAMES, Names, Test, Value, find_read_names
from gudgeon.generator.symbols.storage import PARAMETERS, Key, StorageLocation


@dataclass(frozen=True)
class Instruction:
    """An instruction of a function, printed as one or more lines; base of all kinds, such as `Statement`.

    It knows the expressions and names that it reads, the arrays that it writes and the local that it declares.
    """

    writes: ClassVar[Names] = NO_NAMES
    declared_local: ClassVar[str] = ""

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """Return all SymPy expressions that the line reads, in a tuple; empty for lines without any."""
        return ()

    @property
    def names(self) -> Names:
        """Return the names of locals and arguments that the line reads in addition to those in its expressions."""
        return NO_NAMES

    @cached_property
    def reads(self) -> Names:
        """Return the names of all locals and arguments that the line reads: in expressions and elsewhere."""
        return self.names.union(*map(find_read_names, self.expressions))


@dataclass(frozen=True)
class Statement(Instruction):
    """An assignment `target = value`; a target that is a string is a local, which is declared here."""

    target: Key
    value: Value
    comment: str = ""

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """Return the SymPy expressions in the assigned value, in a tuple; empty for a storage location."""
        return (self.value,) if isinstance(self.value, sp.Basic) else self.value.expressions

    @property
    def names(self) -> Names:
        """Return the names that the assigned value reads in addition to those in its expressions."""
        return NO_NAMES if isinstance(self.value, sp.Basic) else self.value.names

    @cached_property
    def reads(self) -> Names:
        """Return all names that the value reads."""
        return find_read_names(self.value) if isinstance(self.value, sp.Basic) else super().reads

    @property
    def writes(self) -> Names:  # type: ignore[override]
        """Return the name of the array or argument to which the value is stored, in a set; empty for a local."""
        return self.target.names if isinstance(self.target, StorageLocation) else NO_NAMES

    @property
    def declared_local(self) -> str:  # type: ignore[override]
        """Return the name of the local that the statement declares, or "" if it stores to an array or argument."""
        return self.target if isinstance(self.target, str) else ""


@dataclass(frozen=True)
class Declare(Instruction):
    """The declaration of a local array."""

    type: Type
    name: str
    sizes: tuple[int, ...]

    @property
    def writes(self) -> Names:  # type: ignore[override]
        """Return the name of the array, which is local to the function."""
        return frozenset([self.name])


@dataclass(frozen=True)
class Call(Instruction):
    """A call `function(inputs, …, results, …)`; structs are passed by their address."""

    function: str
    inputs: tuple[sp.Basic | StorageLocation, ...]
    results: tuple[StorageLocation, ...]

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """Return the expressions that are passed."""
        return tuple(x for x in self.inputs if isinstance(x, sp.Basic))

    @property
    def names(self) -> Names:
        """Return the arguments and arrays that are passed."""
        return frozenset(x.base for x in self.inputs if isinstance(x, StorageLocation))

    @property
    def writes(self) -> Names:  # type: ignore[override]
        """Return the arguments and arrays that the call fills."""
        return frozenset(place.base for place in self.results)


@dataclass(frozen=True)
class Guard(Instruction):
    """A test, or a call that must return 0; if it fails, the function ends with a status number.

    Without `jumps` it returns the number. With `jumps` it stores the number as `pivot` and jumps to the code for
    dependent equations. With `condition` the test is made only where that holds.
    """

    test: Test | Call
    number: int
    jumps: bool = False
    condition: Test | None = None

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """Return the expressions in the test or call, and those of the condition `condition` if there is one."""
        return (*self.test.expressions, *(self.condition.expressions if self.condition else ()))

    @property
    def names(self) -> Names:
        """Return the names that the test or the call reads and, for a call, also those that it writes."""
        return self.test.names | (self.test.writes if isinstance(self.test, Call) else NO_NAMES)


@dataclass(frozen=True)
class When(Instruction):
    """A statement that is executed only if a test holds."""

    test: Test
    statement: Statement

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """Return the expressions in the test and in the statement."""
        return (*self.test.expressions, *self.statement.expressions)

    @property
    def writes(self) -> Names:  # type: ignore[override]
        """Return what the statement writes."""
        return self.statement.writes


@dataclass(frozen=True)
class AssignStatus(Instruction):
    """The call of a part of the function, whose status is assigned to a local or to `pivot`."""

    call: Call
    status: str

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """Return the expressions that are passed."""
        return self.call.expressions

    @property
    def names(self) -> Names:
        """Return the names that the call reads and writes."""
        return self.call.names | self.call.writes


@dataclass(frozen=True)
class ReturnIfFailed(Instruction):
    """The end of this function if the status of a part is not 0."""

    status: str
    jumps: bool


@dataclass(frozen=True)
class Return(Instruction):
    """The return with the status: 0, or the number of the pivot that vanished."""

    pivot: bool = False


@dataclass(frozen=True)
class Status(Instruction):
    """The declaration of the status: no pivot has vanished yet."""


@dataclass(frozen=True)
class Jump(Instruction):
    """The jump to the powers, over the code for dependent equations."""


@dataclass(frozen=True)
class SolveDependentRows(Instruction):
    """The code for a vanished pivot, which finds the dependent equations.

    It solves by the rank of the equations or, without forces, in absolute coordinates.
    """

    force: tuple[sp.Basic, ...] = ()
    rhs: tuple[sp.Basic, ...] = ()
    call: Call | None = None  # the function that computes the forces and right-hand sides, if they are not here

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """Return the forces and right-hand sides."""
        return (*self.force, *self.rhs)

    @property
    def names(self) -> Names:
        """Return the names of the arguments that the solution of the dependent equations reads.

        Without `force` (the solution in absolute coordinates) it also reads the velocities `v`.
        """
        velocities = () if self.force else ("v",)
        return frozenset(["t", "q", "discrete", PARAMETERS, "a", "rhs", *velocities])


@dataclass(frozen=True)
class MaxMagnitude(Instruction):
    """The largest magnitude of some values, ignoring NaN; it is not a switching point of the motion."""

    target: str
    values: tuple[sp.Basic, ...]

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """Return the values."""
        return self.values

    @property
    def writes(self) -> Names:  # type: ignore[override]
        """Return the name of the result."""
        return frozenset([self.target])


@dataclass(frozen=True)
class MaxMagnitudeRow(Instruction):
    """The number, from 1, of the value with the largest magnitude, stored in the local `row`."""

    values: tuple[sp.Basic, ...]
    writes: ClassVar[Names] = frozenset(["row"])

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """Return the values."""
        return self.values


@dataclass(frozen=True)
class MarkUnused(Instruction):
    """A mark that a local is deliberately not read: C casts it to void."""

    name: str

    @property
    def names(self) -> Names:
        """Return the local."""
        return frozenset([self.name])


@dataclass(frozen=True)
class DeclareBranches(Instruction):
    """The declaration of frozen branches, and of where switching functions are written: `output_target`.

    It is "" (nowhere), "local" (a local array g that is not read later) or "rhs" (the array g of `rhs`).
    """

    output_target: str
    may_be_frozen: bool = True

    @property
    def names(self) -> Names:
        """Return the names that the declaration declares or reads.

        These are `branch`, the outputs for switching functions by `output_target`, and `discrete` if branches are held.
        """
        outputs = {"": [], "local": ["g"], "rhs": ["g", "rhs"]}[self.output_target]
        return frozenset(["branch", *outputs, *(["discrete"] if self.may_be_frozen else [])])


@dataclass(frozen=True)
class DeclareParameters(Instruction):
    """The declaration of p, read from the linearization."""

    writes: ClassVar[Names] = frozenset([PARAMETERS])

    @property
    def names(self) -> Names:
        """Return the name of the linearization."""
        return frozenset(["lin"])


@dataclass(frozen=True)
class Sines(Instruction):
    """Cosines and sines of angles: a vector of four, `count` vectors in a loop, or one angle of each lane."""

    angles: tuple[sp.Symbol, ...]
    suffix: str
    count: int = 0
    lanes: bool = field(default=False, kw_only=True)

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """Return the angles."""
        return self.angles

    @property
    def arrays(self) -> tuple[str, str]:
        """Return the names of the arrays of sines and of cosines, in this order."""
        return f"sines_{self.suffix}", f"cosines_{self.suffix}"

    @property
    def writes(self) -> Names:  # type: ignore[override]
        """Return the names of the arrays of angles, sines and cosines."""
        return frozenset([f"angles_{self.suffix}", *self.arrays])
