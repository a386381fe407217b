"""Define `State`: the end of a run, from which a further run restarts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, TypeAlias

from numpy.typing import NDArray

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.model.choices import format_parameter

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
    sha256: str = ""  # of the mechanism's file; "": the state was constructed by the user
    overrides: tuple[tuple[str, str | float | bool], ...] = ()  # (address, value) with which the file was loaded
    formulation: str = ""  # "reduced" or "full"; each restarts from a state of the other
    beside: tuple[tuple[str, str], ...] = ()  # files of tables and user-defined laws, and their SHA-256

    def __getstate__(self) -> dict[str, Any]:
        """Return the fields for pickle, with the parameters as a plain dict."""
        return self.__dict__ | {"parameters": dict(self.parameters)}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Restore the fields from pickle, with read-only parameters."""
        self.__dict__.update(state | {"parameters": MappingProxyType(state["parameters"])})


def make_state(
    source: KernelSource, given: Array, is_given: Array, t: float, q: Array, v: Array, state: Array, memory: Array
) -> State:
    """Return the state of a scene at time t (s), with copies of its arrays and the parameters that the run was given.

    `given`, `is_given` (n_parameters,): values and mask of these parameters. Other arrays as in State.
    """
    given_slots = zip(source.parameters, given, is_given, strict=True)
    parameters = {slot.address: format_parameter(slot, float(x)) for slot, x, mask in given_slots if mask}
    return State(
        source.mechanism,
        source.scene,
        t,
        q.copy(),
        v.copy(),
        state.copy(),
        memory.copy(),
        MappingProxyType(parameters),
        source.whole_sha256,
        source.overrides,
        source.formulation,
        source.external_files,
    )
