"""Values that statements assign: SymPy expressions, and the few forms that SymPy has no word for.

Names are those of locals and arguments; a symbol may also stand for a place, `p->mass` or `x[3]`, and then reads the
argument in front.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import ClassVar, TypeAlias

import sympy as sp

from gudgeon.generator.symbols.corners import SideOf, Size
from gudgeon.generator.symbols.derivatives import symbols_of

Names = frozenset[str]
NONE: Names = frozenset()


@lru_cache(maxsize=4096)  # a scene has some hundred names, and each is asked for tens of times
def base_of(text: str) -> str:
    """The name in front of a place: `aside` of `aside->lambda[3]`, `F_t_out` of `*F_t_out`."""
    text = text.lstrip("*-")
    return text[: next((k for k, c in enumerate(text) if not (c.isalnum() or c == "_")), len(text))]


@lru_cache(20_000)
def names_in(value: sp.Basic) -> Names:
    """What an expression reads: locals, arguments in front of places; of a side what holds it and is told it."""
    return frozenset(base_of(s.name) for s in symbols_of(value)) | ({"side", "g"} if value.has(SideOf) else NONE)


@dataclass(frozen=True)
class Place:
    """Where a number lives that is no local: `q[3]`, `p->mass`, `aside->clearance[0].F_x`, an argument."""

    text: str
    expressions: ClassVar[tuple[sp.Basic, ...]] = ()

    @property
    def base(self) -> str:
        """The argument or array."""
        return base_of(self.text)

    @property
    def index(self) -> int:
        """k of `base[k]`; −1 of everything else."""
        inner = self.text.removeprefix(f"{self.base}[").removesuffix("]")
        return int(inner) if self.text == f"{self.base}[{inner}]" and inner.isdecimal() else -1

    @property
    def names(self) -> Names:
        """The base."""
        return frozenset([self.base])


class Threshold(float):
    """A number of a bound with the name under which every target writes it; C may read it from a `place` instead."""

    name: str
    place: str

    def __new__(cls, name: str, value: float, place: str = "") -> Threshold:
        """Of that value."""
        own = super().__new__(cls, value)
        own.name, own.place = name, place
        return own


@dataclass(frozen=True)
class Test:
    """`value relation bound`, the bound a product, or a flag alone; `size`: of the value's magnitude."""

    value: sp.Basic
    relation: str = ""  # ">", "!=", "=="; of ">" NaN fails
    bound: tuple[sp.Basic | float, ...] = ()
    size: bool = False

    @property
    def names(self) -> Names:
        """Where thresholds are read: not of a share of the value itself."""
        if self.of_itself:
            return NONE
        return frozenset(base_of(x.place) for x in self.bound if isinstance(x, Threshold) and x.place)

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """On both sides."""
        return (self.value, *(x for x in self.bound if isinstance(x, sp.Basic)))

    @property
    def of_itself(self) -> bool:
        """Whether the bound is a share of the value itself: what is asked is whether it is above zero, and finite."""
        if self.relation != ">" or len(self.bound) != 2 or not isinstance(self.bound[0], float):
            return False
        return 0 < self.bound[0] < 1 and self.bound[1] == (Size(self.value) if self.size else self.value)


@dataclass(frozen=True)
class Chosen:
    """`then` where the test holds, else `otherwise`."""

    test: Test
    then: sp.Basic
    otherwise: sp.Basic
    names: ClassVar[Names] = NONE

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """All of them."""
        return (*self.test.expressions, self.then, self.otherwise)


@dataclass(frozen=True)
class Sum:
    """Of places, in their order."""

    places: tuple[Place, ...]
    expressions: ClassVar[tuple[sp.Basic, ...]] = ()

    @property
    def names(self) -> Names:
        """The arguments in front of them."""
        return frozenset(place.base for place in self.places)


@dataclass(frozen=True)
class Given:
    """Slot k as it is given, or else its default."""

    k: int
    default: sp.Expr
    names: ClassVar[Names] = frozenset(["given", "is_given"])

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """The default."""
        return (self.default,)


Value: TypeAlias = sp.Basic | Place | Chosen | Sum | Given
