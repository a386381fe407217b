"""Own `State`: the end of a run, from which a further run restarts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, TypeAlias

from numpy.typing import NDArray

Array: TypeAlias = NDArray[Any]


@dataclass(frozen=True, eq=False)
class State:
    """The state at the end of a run, and the identity of the scene that it belongs to; `simulate(start=…)` restarts
    from it.
    """

    mechanism: str
    scene: str
    t: float
    q: Array  # (n,)
    v: Array  # (n,)
    state: Array  # (n_clearances,) 0 free, 1 impact, 2 contact
    memory: Array  # (n_clearances,) δ̇⁻ in m/s, NaN while free
    parameters: Mapping[str, float | str]  # address -> overridden value; a further run uses it unless given another
    sha256: str = ""  # of the mechanism's file; "": made by hand
    overrides: tuple[tuple[str, str | float | bool], ...] = ()  # (address, value) with which the file was loaded
    formulation: str = ""  # "reduced" or "full"; each restarts from a state of the other
    beside: tuple[tuple[str, str], ...] = ()  # files of tables and user-defined laws, and their SHA-256

    def __getstate__(self) -> dict[str, Any]:
        """Return the fields for pickle, with the parameters as a plain dict."""
        return self.__dict__ | {"parameters": dict(self.parameters)}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Restore the fields from pickle, with read-only parameters."""
        self.__dict__.update(state | {"parameters": MappingProxyType(state["parameters"])})
