"""Where numbers are stored: fields of structs, elements of arrays, arguments. Each target writes them in its syntax."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar, TypeAlias

import sympy as sp

PARAMETERS = "p"  # the argument that holds the parameters of a run


class Place:
    """A place in memory; `base` is the argument or local array that leads to it.

    As a string it is the path, `p.mass`, `aside.clearance[0].Fx`: by it terms are put in order.
    """

    expressions: ClassVar[tuple[sp.Basic, ...]] = ()
    base: str

    @property
    def names(self) -> frozenset[str]:
        """Return the base as a set: what a line that reads the place reads."""
        return frozenset([self.base])

    @property
    def is_parameter(self) -> bool:
        """Return whether the place is a parameter of the run."""
        return self.base == PARAMETERS and not isinstance(self, Variable)

    @property
    def member(self) -> str:
        """Return the path within the struct: `mass`, `contour_A[3]`."""
        return str(self).partition(".")[2]


@dataclass(frozen=True)
class Variable(Place):
    """An argument as a whole, or a local."""

    name: str

    @property
    def base(self) -> str:  # type: ignore[override]
        """Return its own name."""
        return self.name

    def __str__(self) -> str:
        return self.name


@dataclass(frozen=True)
class Result(Variable):
    """The number that a function returns through the argument of this name."""


@dataclass(frozen=True)
class Inner(Place):
    """A part of an argument or local array of that name, or of another place."""

    of: str | Place

    @property
    def base(self) -> str:  # type: ignore[override]
        """Return the base of the whole."""
        return self.of if isinstance(self.of, str) else self.of.base


@dataclass(frozen=True)
class Field(Inner):
    """A field of a struct."""

    name: str

    def __str__(self) -> str:
        return f"{self.of}.{self.name}"


@dataclass(frozen=True)
class Element(Inner):
    """An element of an array, counted from 0."""

    index: int

    def __str__(self) -> str:
        return f"{self.of}[{self.index}]"


class PlaceSymbol(sp.Symbol):
    """A symbol that is read at a place; among others it is put in order as a plain symbol of its path."""

    place: Place
    __slots__ = ("place",)

    def __new__(cls, place: Place) -> PlaceSymbol:
        """Return the real symbol of the place."""
        own: PlaceSymbol = sp.Symbol.__xnew__(cls, str(place), real=True)
        own.place = place
        return own

    def __getnewargs_ex__(self) -> tuple[Any, ...]:
        return (self.place,), {}

    @classmethod
    def class_key(cls) -> Any:
        """Return the key of plain symbols."""
        return sp.Symbol.class_key()


Key: TypeAlias = str | Place  # what a value is known by: the name of a local or definition, or its place


def key_of(symbol: sp.Symbol) -> Key:
    """Return the place of a symbol that is read there, else its name."""
    return symbol.place if isinstance(symbol, PlaceSymbol) else str(symbol.name)
