"""Whose peaks a run is asked for, and what it is told of them; they are sought by peaks.py, what rubs by wear.py.

Both are imported where they are.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Protocol

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BadValueError
from gudgeon.integrators.adaptive import RTOL
from gudgeon.language.wanted import names
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.results.diagnostics import Extremes
from gudgeon.results.results import Result
from gudgeon.results.series import check_series
from gudgeon.results.wear import Rubbed, Rubbing
from gudgeon.simulation.beside import Beside

if TYPE_CHECKING:
    from gudgeon.integrators.steps import Steps
    from gudgeon.simulation.simulation import Simulation

LIST = "a list of names of series"


class Looker(Protocol):
    """Who is shown the states of all steps of one run."""

    def __call__(self, steps: Steps) -> None:
        """The next ones."""

    def told(self) -> Told:
        """What came of it."""


def wanted_peaks(source: KernelSource, peaks: Iterable[str | Rubbing] | None) -> tuple[str | Rubbing, ...]:
    """Names of series whose peaks are wanted: those given, else the scene's, and what rubs.

    Raises UnknownNameError, BadValueError.
    """
    if peaks is None:
        return check_series(source, source.peaks)
    rubbing = tuple(one for one in peaks if isinstance(one, Rubbing)) if isinstance(peaks, tuple) else ()
    wanted = names([one for one in peaks if one not in rubbing] if rubbing else peaks, "peaks", LIST)
    if "t" in wanted:
        raise BadValueError("peaks: t has no peaks", hint="leave it out: a peak comes with its time")
    return (*check_series(source, wanted), *rubbing)


@dataclass(frozen=True)
class Told:
    """Of one run: peaks and errors, and what its notes say of them."""

    extremes: tuple[Extremes, ...] = ()
    notes: tuple[str, ...] = ()
    rubbed: tuple[Rubbed, ...] = ()

    def to(self, run: Result) -> None:
        """They become a part of what a run says of itself."""
        notes = (*run.diagnostics.notes, *self.notes)
        run.diagnostics = replace(run.diagnostics, extremes=self.extremes, notes=notes, rubbed=self.rubbed)


def search_of(
    compiled: CompiledModel, numbers: tuple[Array, Array, Array], rtol: float, wanted: tuple[str | Rubbing, ...],
    against: Simulation | None,
) -> Looker | None:  # fmt: skip
    """For a run with these numbers, p, given and is_given; None where nothing is wanted."""
    found, series = list[Looker](), tuple(one for one in wanted if isinstance(one, str))
    if series:
        from gudgeon.simulation.peaks import Search

        beside = Beside(against, compiled.source, numbers[0], rtol or RTOL) if against else None
        found.append(Search(compiled, series, numbers, beside))
    if len(series) < len(wanted):
        from gudgeon.simulation.wear import Rubs

        found += [Rubs(compiled, one, numbers) for one in wanted if isinstance(one, Rubbing)]
    return found[0] if len(found) == 1 else Several(found) if found else None


class Several:
    """Who look at one run."""

    def __init__(self, lookers: Sequence[Looker]) -> None:
        self.lookers = lookers

    def __call__(self, steps: Steps) -> None:
        """The next states, for each."""
        for looker in self.lookers:
            looker(steps)

    def told(self) -> Told:
        """What came of all."""
        told = [looker.told() for looker in self.lookers]
        return Told(*(tuple(one for each in told for one in getattr(each, name.name)) for name in fields(Told)))
