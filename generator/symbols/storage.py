"""Storage locations of values in generated code: fields of structs, elements of arrays, arguments.

Each target writes its own syntax for them. Tables of a model or a program grow while it is derived, and are only read
afterwards (`Freezable`).
"""

from __future__ import annotations

import copy
from dataclasses import dataclass
from functools import lru_cache
from types import MappingProxyType
from typing import Any, ClassVar, Self, TypeAlias

import sympy as sp

PARAMETERS = "p"  # the argument that holds the parameters of a run


@dataclass(frozen=True)
class StorageLocation:
    """A storage location: an argument or local, or a part of it.

    Example: `StorageLocation("rhs")["clearance"][0]["Fx"]`. `path` has one step for each field name or element number.
    As a string, by which terms are ordered, the location is `rhs.clearance[0].Fx`.
    """

    base: str
    path: tuple[str | int, ...] = ()
    expressions: ClassVar[tuple[sp.Basic, ...]] = ()

    def __getitem__(self, step: str | int) -> StorageLocation:
        """Return the storage location of a field (text) or element (number) within this one."""
        return StorageLocation(self.base, (*self.path, step))

    def __str__(self) -> str:
        """Return the location as text, such as "rhs.clearance[0].Fx"."""
        return self.base + "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in self.path)

    @property
    def names(self) -> frozenset[str]:
        """Return the name of the argument or local that contains the location, in a set."""
        return frozenset([self.base])

    @property
    def is_parameter(self) -> bool:
        """Return whether the location is a field of the argument that holds the parameters of a run."""
        return self.base == PARAMETERS and self.path != ()

    @property
    def member(self) -> str:
        """Return the path within the struct as text, without the argument: `mass`, `contour_A[3]`.

        It is "" for a whole argument.
        """
        return str(self).partition(".")[2]


class Result(StorageLocation):
    """The value that a function returns through the argument of this name."""


@lru_cache(1_000_000)
def make_real_symbol(name: str) -> sp.Symbol:
    """Return the real symbol of a name: the same object at each call, which SymPy compares fastest."""
    return sp.Symbol(name, real=True)


class StoredSymbol(sp.Symbol):
    """A symbol that is read from a storage location; SymPy orders it like a plain symbol of that name."""

    storage_location: StorageLocation
    __slots__ = ("storage_location",)

    def __new__(cls, storage_location: StorageLocation) -> StoredSymbol:
        """Return the real symbol whose value is read from a storage location; its name is the text of the location."""
        symbol: StoredSymbol = sp.Symbol.__xnew__(cls, str(storage_location), real=True)
        symbol.storage_location = storage_location
        return symbol

    def __getnewargs_ex__(self) -> tuple[Any, ...]:
        """Return the arguments with which the symbol is unpickled."""
        return (self.storage_location,), {}

    @classmethod
    def class_key(cls) -> Any:
        """Return the key of plain symbols."""
        return sp.Symbol.class_key()


Key: TypeAlias = str | StorageLocation  # identifies a value: the name of a local or definition, or its storage location


def find_value_key(symbol: sp.Symbol) -> Key:
    """Return the storage location of a symbol that is read from one (a StoredSymbol), else the symbol's name."""
    return symbol.storage_location if isinstance(symbol, StoredSymbol) else str(symbol.name)


_READ_ONLY_TYPES: dict[type, Any] = {dict: MappingProxyType, list: tuple, set: frozenset}
_MUTABLE_TYPES: dict[type, Any] = {
    MappingProxyType: dict,
    tuple: list,
    frozenset: set,
    dict: dict,
    list: list,
    set: set,
}


class Freezable:
    """An object with dictionaries, lists and sets: `freeze` makes them read only, a `copy_mutable` copy has its own."""

    frozen = False

    def freeze(self) -> None:
        """Make every dictionary, list and set of this object read only.

        It cannot be undone; `copy_mutable` returns a copy that may grow.
        """
        self.frozen = True
        _convert_containers(self, _READ_ONLY_TYPES)

    def copy_mutable(self) -> Self:
        """Return a copy with its own dictionaries, lists and sets, which may grow."""
        copy_ = copy.copy(self)
        copy_.frozen = False
        _convert_containers(copy_, _MUTABLE_TYPES)
        return copy_


def _convert_containers(owner: Freezable, type_map: dict[type, Any]) -> None:
    """Convert the attributes of an object, each whose type is a key of `type_map`, to the type that the map gives."""
    for name, value in vars(owner).items():
        if type(value) in type_map:
            setattr(owner, name, type_map[type(value)](value))
