"""Compute Lyapunov exponents, predictability horizons and kinds of motion for the runs of a study.

The object of a measure is `run`, the whole motion, or a Poincaré section: an event of the file, or a period that is an
expression of each run's parameters. Measures of one section and window share one computation.
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
from gudgeon.integrators.threads import count_available_threads
from gudgeon.language.parser import parse
from gudgeon.language.units import TIME
from gudgeon.results.batch import Array
from gudgeon.results.motion import CHAOTIC, PERIODIC, QUASI, UNDECIDED
from gudgeon.simulation.lyapunov import limit_rtol_of_neighbours
from gudgeon.studies.ensemble.libraries import get_method_for_scene
from gudgeon.studies.ensemble.notes import collect_start_deviation_warnings
from gudgeon.studies.ensemble.parameter_values import ROUNDING, check_expression, evaluate_expression_for_runs

if TYPE_CHECKING:
    from gudgeon.generator.study.spec import Measure, StudyFile
    from gudgeon.integrators.trajectory import Progress
    from gudgeon.results.lyapunov import Lyapunov
    from gudgeon.simulation.simulation import Simulation
    from gudgeon.studies.ensemble.block import Job, RunTable

WHOLE_RUN = "run"  # object of a measure of the whole motion, without a section
SECTION_STATISTICS = ("lyapunov_per_return", "motion", "motion_confidence")
NEIGHBOUR_STATISTICS: Mapping[str, str] = {
    "lyapunov": "1/s",
    "lyapunov_error": "1/s",
    "mean_horizon": "s",
} | dict.fromkeys(SECTION_STATISTICS, "")  # statistic -> SI unit
MOTION_CODES: Mapping[str, float] = {QUASI: 0.0, CHAOTIC: -1.0, UNDECIDED: math.nan}  # periodic: number of returns
MOTION_CODES_TEXT = "its period in returns, 0: quasi-periodic, -1: chaotic, NaN: undecided"


def check_lyapunov_measures(study: StudyFile, source: KernelSource) -> None:
    """Check a study's measures of neighbouring trajectories: Lyapunov exponents, predictability horizon, kind of
    motion.

    Called for each scene with degrees of freedom. Raises BadValueError at the measure for a study with wear, a
    predictability horizon with fixed steps, or a statistic of returns without a section; an InputError for a section
    that is neither an event nor a period.
    """
    for measure in (measure for measure in study.measures if measure.statistic in NEIGHBOUR_STATISTICS):
        where, owner = measure.measured_name.where, f"measures.{measure.name}"
        if study.wear is not None:
            message = f"{owner}: neighbouring trajectories are not computed for contours with wear"
            raise BadValueError(message, where, "remove wear:, or this measure")
        if measure.statistic == "mean_horizon" and (study.step is not None or study.method == "rk4"):
            message = (
                f"{owner}: the predictability horizon needs the relative error of a step, unknown for a fixed step"
            )
            raise BadValueError(message, where, "expected a method with step-size control, and rtol")
        if measure.measured_name == WHOLE_RUN and measure.statistic in SECTION_STATISTICS:
            message = f"{owner}: {measure.statistic.replace('_', ' ')} needs a section"
            raise BadValueError(message, where, "expected an event of the file, or a period: 2*pi/omega")
        if measure.measured_name != WHOLE_RUN and not _is_event_section(measure, source):
            _check_period_expression(measure, source)


def _is_event_section(measure: Measure, source: KernelSource) -> bool:
    """Return whether the section of a measure is the name of a user-defined event of the scene."""
    return measure.measured_name in [event.name for event in source.events]


def _check_period_expression(measure: Measure, source: KernelSource) -> None:
    """Raise an InputError unless the section of a measure is an expression of parameters with the dimension of time."""
    from gudgeon.generator.study.spec import ParsedExpression

    expression = ParsedExpression(parse(measure.measured_name, measure.measured_name.where), measure.measured_name)
    try:
        check_expression(source, expression, TIME, {"t_end": TIME})
    except InputError as error:
        events = ", ".join(event.name for event in source.events) or "none"
        hint = f"expected {WHOLE_RUN}, an event of scene {source.scene} ({events}), or a period: 2*pi/omega"
        raise type(error)(error.message, error.where, hint) from None


def compute_neighbour_measures(
    simulation: Simulation, job: Job, table: RunTable, t_last: Array, failures: list[str], progress: Progress | None
) -> dict[str, Array]:
    """Integrate all runs again with a neighbouring trajectory, and return their measures, (n,) by name.

    t_last (n,) s: end of each run, at an event or as requested. Failed runs are left out (NaN); the reason of a new
    failure is entered in `failures`. Runs are distributed over threads. All values are NaN in a scene with dof = 0; the
    result is empty without such measures. `progress` is called meanwhile, so that it can cancel.
    """
    measures = [measure for measure in job.run_settings.measures if measure.statistic in NEIGHBOUR_STATISTICS]
    values = {measure.name: np.full(job.n_runs, np.nan) for measure in measures}
    if not measures or simulation.source.degrees_of_freedom <= 0:
        return values
    runs = [i for i in range(job.n_runs) if not failures[i]]
    computation = _NeighbourComputation(simulation, job, table, t_last, progress)
    with ThreadPoolExecutor(job.threads or count_available_threads(), thread_name_prefix="gudgeon") as pool:
        for i, values_or_reason in zip(runs, pool.map(lambda i: computation(i, measures), runs), strict=True):
            if isinstance(values_or_reason, str):
                failures[i] = values_or_reason
            else:
                for name, value in values_or_reason.items():
                    values[name][i] = value
    return values


class _NeighbourComputation:
    """Computation of the neighbouring trajectories of the runs of a job; a call computes those of one run."""

    def __init__(
        self, simulation: Simulation, job: Job, table: RunTable, t_last: Array, progress: Progress | None
    ) -> None:
        """Store the job and its parameters, the tolerances, and the end of each run.

        The end is t_last if an event ended the run early, else the requested end.
        """
        self.simulation, self.job, self.table, self.progress = simulation, job, table, progress
        self.error = RTOL if job.run_settings.rtol is None else job.run_settings.rtol
        self.rtol = limit_rtol_of_neighbours(simulation.source, job.run_settings.rtol)
        is_cut = t_last < table.t_end * (1.0 - ROUNDING)
        self.t_last = np.where(is_cut, t_last, table.t_end)

    def __call__(self, i: int, measures: Sequence[Measure]) -> dict[str, float] | str:
        """Return the measures of run i by name, or the reason (a text) of the first error.

        Measures of the same section and window share one computation. Notes on guesses are dropped, since the run
        itself reports them.
        """
        computed: dict[tuple[str, str], Lyapunov | None] = {}
        values = {}
        with collect_start_deviation_warnings(self.simulation.source, self.job.first_run):
            try:
                for measure in measures:
                    key = (str(measure.measured_name), measure.window)
                    if key not in computed:
                        computed[key] = self._compute_lyapunov(i, measure)
                    values[measure.name] = _read_statistic(measure.statistic, computed[key], self.error)
            except GudgeonError as error:
                return f"{measure.name}: {error}"
        return values

    def _compute_lyapunov(self, i: int, measure: Measure) -> Lyapunov | None:
        """Integrate run i with a neighbouring trajectory over the window of a measure, and return its `Lyapunov`
        result.

        The result has the states at the section of the measure. None if an event ended the run before the window, or
        within one period of the section after its begin. Raises GudgeonError if the integration fails.
        """
        table, settings, source = self.table, self.job.run_settings, self.simulation.source
        begin, end = (
            None if limit is None else float(limit[i]) for limit in table.spans.get(measure.window, (None, None))
        )
        run_end, section = float(self.t_last[i]), self._resolve_section(i, measure)
        min_duration = section if isinstance(section, float) else 0.0
        if run_end < table.t_end[i] and run_end - max(begin or 0.0, 0.0) <= min_duration:
            return None
        parameters = {
            name: value if isinstance(value, str) else float(value)
            for name, value in ((name, column[i]) for name, column in table.columns.items())
        }
        return self.simulation.lyapunov(
            run_end if end is None else min(end, run_end),
            section=section,
            skip=max(begin or 0.0, 0.0),
            method=get_method_for_scene(source, settings.method),
            rtol=self.rtol,
            parameters=parameters,
            step=None if table.step is None else float(table.step[i]),
            progress=self._report_progress,
        )

    def _resolve_section(self, i: int, measure: Measure) -> str | float | None:
        """Return the section of a measure for run i: None for the whole motion, an event's name, or a period (s)."""
        if measure.measured_name == WHOLE_RUN:
            return None
        if _is_event_section(measure, self.simulation.source):
            return str(measure.measured_name)
        expr, values_by_name = parse(measure.measured_name, measure.measured_name.where), {"t_end": self.table.t_end}
        return float(evaluate_expression_for_runs(self.simulation.source, expr, self.table.p, values_by_name)[i])

    def _report_progress(self, fraction: float, text: str) -> None:
        """Call the progress function with fraction 1, since the runs themselves are finished; it may cancel the run."""
        if self.progress:
            self.progress(1.0, text)


def _read_statistic(statistic: str, lyapunov: Lyapunov | None, initial_error: float) -> float:
    """Return the value of a statistic (a key of NEIGHBOUR_STATISTICS) from a computed `Lyapunov` result; NaN for None.

    initial_error: relative error of the initial state, for the predictability horizon. A periodic motion is coded by
    its period in returns, other kinds of motion by MOTION_CODES.
    """
    if lyapunov is None:
        return math.nan
    if statistic == "mean_horizon":
        return lyapunov.mean_horizon(initial_error)
    if statistic == "motion":
        motion = lyapunov.motion
        return float(motion.period) if motion.kind == PERIODIC else MOTION_CODES[motion.kind]
    values: dict[str, Any] = {
        "lyapunov": lambda: lyapunov.exponent,
        "lyapunov_error": lambda: lyapunov.uncertainty,
        "lyapunov_per_return": lambda: lyapunov.per_return,
        "motion_confidence": lambda: lyapunov.motion.confidence,
    }
    return float(values[statistic]())
