"""Values that statements assign: SymPy expressions, and the few forms that SymPy does not have.

Names are those of locals and arguments; a symbol may also stand for a place, and then reads the argument that contains
it. Each form has `expressions`, its SymPy parts, and `names`, the names that it reads in addition to theirs.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import ClassVar, TypeAlias

import sympy as sp

from gudgeon.generator.symbols.derivatives import find_operation_classes, find_symbols
from gudgeon.generator.symbols.storage import StorageLocation, StoredSymbol
from gudgeon.generator.symbols.switches import BranchOf, ComparedMagnitude

Names = frozenset[str]
NO_NAMES: Names = frozenset()


@lru_cache(1_000_000)
def find_read_names(value: sp.Basic) -> Names:
    """Return the names that an expression reads: locals and arguments; with a `BranchOf` also `branch` and `g`.

    A symbol of a place counts as the argument that contains it. Results are cached.
    """
    names = frozenset(s.storage_location.base if isinstance(s, StoredSymbol) else s.name for s in find_symbols(value))
    return names | ({"branch", "g"} if BranchOf in find_operation_classes(value) else NO_NAMES)


class Threshold(float):
    """A number in a bound, with the name under which every target writes it.

    C may read the number from `storage_location` instead.
    """

    name: str
    storage_location: StorageLocation | None

    def __new__(cls, name: str, value: float, storage_location: StorageLocation | None = None) -> Threshold:
        """Return the number `value`, named `name` in the text of every target, and its `storage_location` for C."""
        threshold = super().__new__(cls, value)
        threshold.name, threshold.storage_location = name, storage_location
        return threshold


@dataclass(frozen=True)
class Test:
    """A comparison `value relation bound`, the bound a product, or a flag alone; used by guards and conditionals.

    `compares_magnitude`: the magnitude of the value is compared.
    """

    value: sp.Basic
    relation: str = ""  # ">", "!=", "=="; of ">" NaN fails
    bound: tuple[sp.Basic | float, ...] = ()
    compares_magnitude: bool = False

    @property
    def names(self) -> Names:
        """Return the arguments from which C reads thresholds in the bound, such as the smallest pivot allowed.

        There are none if the bound is a fraction of the value itself (`is_relative_to_value`): no threshold is printed
        then.
        """
        if self.is_relative_to_value:
            return NO_NAMES
        return frozenset(x.storage_location.base for x in self.bound if isinstance(x, Threshold) and x.storage_location)

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """Return the expressions on both sides."""
        return (self.value, *(x for x in self.bound if isinstance(x, sp.Basic)))

    @property
    def is_relative_to_value(self) -> bool:
        """Return whether the test is value > c · value with a number c between 0 and 1, or the same with magnitudes.

        Such a test means that the value is greater than 0 (with magnitudes: not 0) and finite.
        """
        if self.relation != ">" or len(self.bound) != 2 or not isinstance(self.bound[0], float):
            return False
        return 0 < self.bound[0] < 1 and self.bound[1] == (
            ComparedMagnitude(self.value) if self.compares_magnitude else self.value
        )


@dataclass(frozen=True)
class Conditional:
    """A conditional value: `then` if the test holds, else `otherwise`."""

    test: Test
    then: sp.Basic
    otherwise: sp.Basic
    names: ClassVar[Names] = NO_NAMES

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """Return the expressions in the test and in both values."""
        return (*self.test.expressions, self.then, self.otherwise)


@dataclass(frozen=True)
class Sum:
    """A sum of places, in their order."""

    places: tuple[StorageLocation, ...]
    expressions: ClassVar[tuple[sp.Basic, ...]] = ()

    @property
    def names(self) -> Names:
        """Return the arguments in which the places are."""
        return frozenset(place.base for place in self.places)


@dataclass(frozen=True)
class ContinuedSum:
    """A sum whose first terms are in a local: from left to right `first`, then the terms of `more` in their order."""

    first: sp.Symbol
    more: sp.Basic
    names: ClassVar[Names] = NO_NAMES

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """Return the local and the terms that are added to it."""
        return (self.first, self.more)


@dataclass(frozen=True)
class ParameterOrDefault:
    """Parameter k: the value of the run if it has one, else the default."""

    k: int
    default: sp.Expr
    names: ClassVar[Names] = frozenset(["given", "is_given"])

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """Return the default."""
        return (self.default,)


Value: TypeAlias = sp.Basic | StorageLocation | Conditional | Sum | ContinuedSum | ParameterOrDefault
