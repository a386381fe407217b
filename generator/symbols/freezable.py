"""Tables that grow while a model or a program is derived, and are read only afterwards."""

from __future__ import annotations

import copy
from types import MappingProxyType
from typing import Any, Self

_READ_ONLY: dict[type, Any] = {dict: MappingProxyType, list: tuple, set: frozenset}
_GROWING: dict[type, Any] = {MappingProxyType: dict, tuple: list, frozenset: set, dict: dict, list: list, set: set}


class Freezable:
    """An object with dictionaries, lists and sets: `freeze` makes them read only, a `thawed` copy has its own."""

    frozen = False

    def freeze(self) -> None:
        """Make every table of this object read only. There is no way back."""
        self.frozen = True
        _replace_tables(self, _READ_ONLY)

    def thawed(self) -> Self:
        """Return a copy with tables of its own, which may grow."""
        other = copy.copy(self)
        other.frozen = False
        _replace_tables(other, _GROWING)
        return other


def _replace_tables(of: Freezable, types: dict[type, Any]) -> None:
    for name, value in vars(of).items():
        if type(value) in types:
            setattr(of, name, types[type(value)](value))
