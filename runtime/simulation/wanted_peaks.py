"""Whose peaks a run is asked for, and what it is told of them; they are sought by peaks.py, imported where they are."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BadValueError
from gudgeon.integrators.adaptive import RTOL
from gudgeon.language.wanted import names
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.results.diagnostics import Extremes
from gudgeon.results.results import Result
from gudgeon.results.unknown import check_series
from gudgeon.simulation.beside import Beside

if TYPE_CHECKING:
    from gudgeon.simulation.peaks import Search
    from gudgeon.simulation.simulation import Simulation


def wanted_peaks(source: KernelSource, peaks: Iterable[str] | None) -> tuple[str, ...]:
    """Names of series whose peaks are wanted: those given, else the scene's. Raises UnknownNameError, BadValueError."""
    if peaks is None:
        return check_series(source, source.peaks)
    wanted = names(peaks, "peaks", "a list of names of series")
    if "t" in wanted:
        raise BadValueError("peaks: t has no peaks", hint="leave it out: a peak comes with its time")
    return check_series(source, wanted)


@dataclass(frozen=True)
class Told:
    """Of one run: peaks and errors, and what its notes say of them."""

    extremes: tuple[Extremes, ...] = ()
    notes: tuple[str, ...] = ()

    def to(self, run: Result) -> None:
        """They become a part of what a run says of itself."""
        notes = (*run.diagnostics.notes, *self.notes)
        run.diagnostics = replace(run.diagnostics, extremes=self.extremes, notes=notes)


def search_of(
    compiled: CompiledModel, numbers: tuple[Array, Array, Array], rtol: float, names: tuple[str, ...],
    against: Simulation | None,
) -> Search | None:  # fmt: skip
    """For a run with these numbers, p, given and is_given; None where nothing is wanted."""
    if not names:
        return None
    from gudgeon.simulation.peaks import Search

    beside = Beside(against, compiled.source, numbers[0], rtol or RTOL) if against else None
    return Search(compiled, names, numbers, beside)
