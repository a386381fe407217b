"""Libraries of a study's scenes, in whichever process runs its blocks."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

from gudgeon.errors import InputError
from gudgeon.simulation.from_file import load
from gudgeon.simulation.simulation import Simulation

if TYPE_CHECKING:
    from gudgeon.contract.kernel_source import KernelSource


@lru_cache(maxsize=16)
def loaded(mechanism: str, scene: str, overrides: tuple[tuple[str, str], ...], sha256: str) -> Simulation:
    """The library of a part, in a worker's own process. Raises InputError for a file that was edited since."""
    found = load(mechanism, scene, overrides=dict(overrides))
    if found.source.whole_sha256 != sha256:
        told = f"{mechanism} was edited after the study began"
        raise InputError(told, hint="put it back as it was, or begin anew with --restart")
    return found


def method_in(source: KernelSource, method: str) -> str:
    """The method that a scene is run with: one without a degree of freedom follows its drives, whatever is asked."""
    return method if source.degrees_of_freedom else "auto"
