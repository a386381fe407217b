"""Measure neighbouring trajectories of runs: Lyapunov exponents, predictability horizons, kinds of motion.

A measure is of `run`, the whole motion, or of a section: an event of the file, or a period by each run's own
parameters. Measures of one section and window share one computation.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BadValueError, GudgeonError, InputError
from gudgeon.integrators.adaptive import RTOL
from gudgeon.integrators.threads import available_threads
from gudgeon.language.parser import parse
from gudgeon.language.units import TIME
from gudgeon.results.batch import Array
from gudgeon.results.motion import CHAOTIC, PERIODIC, QUASI, UNDECIDED
from gudgeon.simulation.lyapunov import neighbours_rtol
from gudgeon.studies.ensemble.libraries import method_in
from gudgeon.studies.ensemble.notes import collect_guess_notes
from gudgeon.studies.ensemble.numbers import ROUNDING, check_expression, evaluate_for_runs

if TYPE_CHECKING:
    from gudgeon.generator.study.spec import Measure, StudyFile
    from gudgeon.integrators.trajectory import Progress
    from gudgeon.results.lyapunov import Lyapunov
    from gudgeon.simulation.simulation import Simulation
    from gudgeon.studies.ensemble.block import Job, Table

WHOLE = "run"  # in the place of a section
OF_SECTION = ("lyapunov_per_return", "motion", "motion_confidence")
FOLLOWED: Mapping[str, str] = {"lyapunov": "1/s", "lyapunov_error": "1/s", "believable": "s"} | dict.fromkeys(
    OF_SECTION, ""
)  # with their units
KINDS: Mapping[str, float] = {QUASI: 0.0, CHAOTIC: -1.0, UNDECIDED: math.nan}  # a periodic motion is its period
KINDS_TOLD = "its period in returns, 0: quasi-periodic, -1: chaotic, NaN: undecided"


def check_followed(study: StudyFile, source: KernelSource) -> None:
    """Raise an InputError for a section that a scene cannot have, or for a measure that a study cannot provide."""
    for one in (one for one in study.measures if one.statistic in FOLLOWED):
        where, owner = one.of.where, f"measures.{one.name}"
        if study.wear is not None:
            message = f"{owner}: a neighbour is followed beside circles, not beside contours that wear"
            raise BadValueError(message, where, "leave out wear:, or this measure")
        if one.statistic == "believable" and (study.step is not None or study.method == "rk4"):
            message = f"{owner}: what a fixed step errs by is not known"
            raise BadValueError(message, where, "expected a method that chooses its step, by rtol")
        if one.of == WHOLE and one.statistic in OF_SECTION:
            message = f"{owner}: {one.statistic.replace('_', ' ')} is of returns to a section"
            raise BadValueError(message, where, "expected an event of the file, or a period: 2*pi/omega")
        if one.of != WHOLE and not _is_event(one, source):
            _check_period(one, source)


def _is_event(measure: Measure, source: KernelSource) -> bool:
    """Return whether the section of a measure is an event of the scene."""
    return measure.of in [event.name for event in source.events]


def _check_period(measure: Measure, source: KernelSource) -> None:
    """Raise an InputError unless the section of a measure is a period: an expression of time."""
    from gudgeon.generator.study.spec import Written

    written = Written(parse(measure.of, measure.of.where), measure.of)
    try:
        check_expression(source, written, TIME, {"t_end": TIME})
    except InputError as error:
        events = ", ".join(event.name for event in source.events) or "none"
        hint = f"expected {WHOLE}, an event of scene {source.scene} ({events}), or a period: 2*pi/omega"
        raise type(error)(error.message, error.where, hint) from None


def follow(
    simulation: Simulation, job: Job, table: Table, t_last: Array, failures: list[str], progress: Progress | None
) -> dict[str, Array]:
    """Return the measures of neighbouring trajectories of all runs that have not failed, (n,) by name.

    `t_last` (n,) s: the end of each run, at an event or as requested. The failure of a neighbour is entered in
    `failures`.
    """
    measures = [one for one in job.expected.measures if one.statistic in FOLLOWED]
    found = {one.name: np.full(job.n, np.nan) for one in measures}
    if not measures or simulation.source.degrees_of_freedom <= 0:
        return found
    runs = [i for i in range(job.n) if not failures[i]]
    each = _NeighbourComputation(simulation, job, table, t_last, progress)
    with ThreadPoolExecutor(job.threads or available_threads(), thread_name_prefix="gudgeon") as pool:
        for i, own in zip(runs, pool.map(lambda i: each(i, measures), runs), strict=True):
            if isinstance(own, str):
                failures[i] = own
            else:
                for name, value in own.items():
                    found[name][i] = value
    return found


class _NeighbourComputation:
    """Computation of the neighbouring trajectories of one run, section by section."""

    def __init__(
        self, simulation: Simulation, job: Job, table: Table, t_last: Array, progress: Progress | None
    ) -> None:
        """Store the job, its parameters and the ends of the runs."""
        self.simulation, self.job, self.table, self.progress = simulation, job, table, progress
        self.error = RTOL if job.expected.rtol is None else job.expected.rtol
        self.rtol = neighbours_rtol(simulation.source, job.expected.rtol)
        is_cut = t_last < table.t_end * (1.0 - ROUNDING)
        self.t_last = np.where(is_cut, t_last, table.t_end)

    def __call__(self, i: int, measures: Sequence[Measure]) -> dict[str, float] | str:
        """Return the measures of run i by name, or the reason why there are none."""
        followed: dict[tuple[str, str], Lyapunov | None] = {}
        values = {}
        with collect_guess_notes(
            self.simulation.source, self.job.first
        ):  # notes of the run itself are reported already
            try:
                for one in measures:
                    key = (str(one.of), one.window)
                    if key not in followed:
                        followed[key] = self._lyapunov(i, one)
                    values[one.name] = _statistic_value(one.statistic, followed[key], self.error)
            except GudgeonError as error:
                return f"{one.name}: {error}"
        return values

    def _lyapunov(self, i: int, measure: Measure) -> Lyapunov | None:
        """Return the exponent of run i for the section of a measure; None if the run ended before the window or a
        return.
        """
        table, expected, source = self.table, self.job.expected, self.simulation.source
        begin, end = (None if one is None else float(one[i]) for one in table.spans.get(measure.window, (None, None)))
        last, section = float(self.t_last[i]), self._section(i, measure)
        shortest = section if isinstance(section, float) else 0.0
        if last < table.t_end[i] and last - max(begin or 0.0, 0.0) <= shortest:
            return None
        parameters = {
            name: value if isinstance(value, str) else float(value)
            for name, value in ((name, own[i]) for name, own in table.columns.items())
        }
        return self.simulation.lyapunov(
            last if end is None else min(end, last),
            section=section,
            skip=max(begin or 0.0, 0.0),
            method=method_in(source, expected.method),
            rtol=self.rtol,
            parameters=parameters,
            step=None if table.step is None else float(table.step[i]),
            progress=self._report_progress,
        )

    def _section(self, i: int, measure: Measure) -> str | float | None:
        """Return the section of a measure for run i: None for the whole run, an event, or a period (s)."""
        if measure.of == WHOLE:
            return None
        if _is_event(measure, self.simulation.source):
            return str(measure.of)
        expr, known = parse(measure.of, measure.of.where), {"t_end": self.table.t_end}
        return float(evaluate_for_runs(self.simulation.source, expr, self.table.p, known)[i])

    def _report_progress(self, fraction: float, text: str) -> None:
        """Report progress, so that the caller may cancel; the runs themselves are finished."""
        if self.progress:
            self.progress(1.0, text)


def _statistic_value(statistic: str, found: Lyapunov | None, error: float) -> float:
    """Return the value of a statistic from an exponent; NaN for None."""
    if found is None:
        return math.nan
    if statistic == "believable":
        return found.believable(error)
    if statistic == "motion":
        motion = found.motion
        return float(motion.period) if motion.kind == PERIODIC else KINDS[motion.kind]
    values: dict[str, Any] = {
        "lyapunov": lambda: found.exponent,
        "lyapunov_error": lambda: found.uncertainty,
        "lyapunov_per_return": lambda: found.per_return,
        "motion_confidence": lambda: found.motion.confidence,
    }
    return float(values[statistic]())
