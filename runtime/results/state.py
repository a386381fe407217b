"""Where a run ended, for another one to go on from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, TypeAlias

from numpy.typing import NDArray

Array: TypeAlias = NDArray[Any]


@dataclass(frozen=True, eq=False)
class State:
    """Where a run ended: what a further run needs to go on from there."""

    mechanism: str
    scene: str
    t: float
    q: Array  # (n,)
    v: Array  # (n,)
    state: Array  # (n_clearances,) 0 free, 1 impact, 2 contact
    memory: Array  # (n_clearances,) δ̇⁻ in m/s, NaN while free
    parameters: Mapping[str, float | str]  # address -> what was overridden: a further run's, unless given others
    sha256: str = ""  # of the mechanism's file; "": made by hand
    overrides: tuple[tuple[str, str | float | bool], ...] = ()  # (address, value) with which the file was loaded
    formulation: str = ""  # what was integrated; either goes on from the other's
    beside: tuple[tuple[str, str], ...] = ()  # tables and laws of one's own with which it was, and their SHA-256

    def __getstate__(self) -> dict[str, Any]:
        return self.__dict__ | {"parameters": dict(self.parameters)}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state | {"parameters": MappingProxyType(state["parameters"])})
