"""Choose the functions that observe each step of a run: peaks of series, wear, errors against another scene.

Errors over all steps are computed from the other scene at the times of these steps.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Protocol

import numpy as np

from gudgeon.assembly.start import assemble_start
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BadValueError, GudgeonError
from gudgeon.integrators.adaptive import RTOL
from gudgeon.integrators.steps import Steps
from gudgeon.integrators.trajectory import Problem
from gudgeon.language.argument_checks import check_names, raise_bad_value
from gudgeon.model.choices import format_parameter
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.parameters import compute_parameter_values, compute_values_without_baumgarte
from gudgeon.results.diagnostics import Extremes
from gudgeon.results.results import Result
from gudgeon.results.series import check_series, get_catalogue
from gudgeon.results.wear import SlidingLoads, SlidingRequest
from gudgeon.simulation.arguments import integrate_run, select_method

if TYPE_CHECKING:
    from gudgeon.simulation.simulation import Simulation


LIST = "a list of names of series"  # expected type of the argument `peaks`, for messages


class StepObserver(Protocol):
    """Observe the states of all steps of one run."""

    def __call__(self, steps: Steps) -> None:
        """Process the next states of the run."""

    def build_observation(self) -> Observation:
        """Return the findings."""


def check_requested_peaks(
    source: KernelSource, peaks: Iterable[str | SlidingRequest] | None
) -> tuple[str | SlidingRequest, ...]:
    """Check the argument `peaks` and return the names of series whose peaks are requested, then the requests for wear.

    None gives the series that the scene's file names. Raises UnknownNameError, BadValueError.
    """
    if peaks is None:
        return check_series(source, source.peaks) if source.peaks else ()
    wear_requests = (
        tuple(request for request in peaks if isinstance(request, SlidingRequest)) if isinstance(peaks, tuple) else ()
    )
    series_names = check_names(
        [request for request in peaks if request not in wear_requests] if wear_requests else peaks, "peaks", LIST
    )
    if "t" in series_names:
        raise BadValueError("peaks: t has no peaks", hint="leave it out: a peak comes with its time")
    return (*check_series(source, series_names), *wear_requests)


@dataclass(frozen=True)
class Observation:
    """Hold the findings of the observers of one run: extremes, notes and wear."""

    extremes: tuple[Extremes, ...] = ()
    notes: tuple[str, ...] = ()
    sliding_loads: tuple[SlidingLoads, ...] = ()

    def store_in(self, run: Result) -> None:
        """Store the findings in the diagnostics of a run, in place; notes are appended."""
        notes = (*run.diagnostics.notes, *self.notes)
        run.diagnostics = replace(
            run.diagnostics, extremes=self.extremes, notes=notes, sliding_loads=self.sliding_loads
        )


def make_observer(
    compiled: CompiledModel,
    parameter_arrays: tuple[Array, Array, Array],
    rtol: float,
    requests: tuple[str | SlidingRequest, ...],
    compared_simulation: Simulation | None,
) -> StepObserver | None:
    """Return the step observer of a run; None if nothing is requested.

    It is a PeakSearch for series, a WearObserver for a request for wear, or a CombinedObserver of several.
    `parameter_arrays`: parameter values, given values and their mask. `compared_simulation`: scene for errors of the
    series, or None; it is integrated with `rtol`, the default tolerance if that is 0.
    """
    if not requests:
        return None
    observers, series = list[StepObserver](), tuple(request for request in requests if isinstance(request, str))
    if series:
        from gudgeon.simulation.peaks import PeakSearch

        compared_scene = (
            ComparedScene(compared_simulation, compiled.source, parameter_arrays[0], rtol or RTOL)
            if compared_simulation
            else None
        )
        observers.append(PeakSearch(compiled, series, parameter_arrays, compared_scene))
    if len(series) < len(requests):
        from gudgeon.simulation.wear import WearObserver

        observers += [
            WearObserver(compiled, request, parameter_arrays)
            for request in requests
            if isinstance(request, SlidingRequest)
        ]
    return observers[0] if len(observers) == 1 else CombinedObserver(observers) if observers else None


class CombinedObserver:
    """Combine several observers of one run."""

    def __init__(self, observers: Sequence[StepObserver]) -> None:
        self.observers = observers

    def __call__(self, steps: Steps) -> None:
        """Pass the next states to each observer."""
        for observer in self.observers:
            observer(steps)

    def build_observation(self) -> Observation:
        """Return the findings of all observers, concatenated field by field."""
        observations = [observer.build_observation() for observer in self.observers]
        return Observation(
            *(tuple(item for each in observations for item in getattr(each, name.name)) for name in fields(Observation))
        )


class ComparedScene:
    """Integrate another scene step by step from t = 0, with the parameter values of the observed run where it has
    them.
    """

    def __init__(self, simulation: Simulation, source: KernelSource, p: Array, rtol: float) -> None:
        self.compiled = simulation.compiled
        self.scene, self.names = simulation.source.scene, frozenset(get_catalogue(simulation.source))
        addresses = {slot.address for slot in self.compiled.source.parameters}
        values = {
            slot.address: format_parameter(slot, float(p[k]))
            for k, slot in enumerate(source.parameters)
            if slot.address in addresses
        }
        _, given, is_given = compute_parameter_values(self.compiled, values)
        self.parameter_arrays = compute_values_without_baumgarte(self.compiled, given, is_given), given, is_given
        self.failure_reason = ""  # message of the error that ended its integration; "" without one
        self.problem: Problem | None = None  # the problem from the last state on
        self.last_state: Steps | None = None  # last state of the integration
        self.rtol = rtol

    def integrate_to(self, t: Array) -> Steps | None:
        """Integrate to times t (k,) in s, which do not decrease from call to call, and return the states there.

        Return None after a failure. The first failure is stored as a text in `failure_reason`.
        """
        if self.failure_reason:
            return None
        try:
            return self._integrate_from_last_state(t)
        except GudgeonError as error:
            self.failure_reason = str(error)
            return None

    def _integrate_from_last_state(self, t: Array) -> Steps:
        """Integrate the scene from its last state, or its start, to the times t (k,) in s; return the states there.

        The last one is stored for the next call. Raises the error that ends the integration.
        """
        problem = self.problem or self._build_start_problem()
        times = np.union1d(problem.t[:1], t)
        if self.last_state is not None and len(times) == 1:
            return self.last_state[np.zeros(len(t), dtype=int)]
        trajectory = integrate_run(replace(problem, t=times))
        if trajectory.stopped is not None:
            raise trajectory.stopped
        work = trajectory.work  # works of a part begin at 0
        work = work if self.last_state is None else work + self.last_state.work
        steps = Steps(
            trajectory.t,
            trajectory.q,
            trajectory.v,
            work,
            trajectory.memory,
            trajectory.state,
            np.zeros(len(trajectory.t), dtype=bool),
        )
        self.last_state = steps[-1:]
        state = trajectory.state[-1] if trajectory.state.shape[1] else None
        self.problem = replace(
            problem, t=times[-1:], q=trajectory.q[-1], v=trajectory.v[-1], memory=trajectory.memory[-1], state=state
        )
        return steps[np.searchsorted(trajectory.t, t)]

    def _build_start_problem(self) -> Problem:
        """Return the Problem of the assembled scene at t = 0, by method "auto" and without discrete states."""
        p, given, is_given = self.parameter_arrays
        assembled, method = assemble_start(self.compiled, p), select_method(self.compiled.source, "auto", False)
        discrete_states = np.full(self.compiled.n_discrete_states, np.nan)
        return Problem(
            self.compiled,
            p,
            np.zeros(1),
            assembled.q,
            assembled.v,
            discrete_states,
            math.inf,
            method=method,
            rtol=self.rtol,
            stop=False,
        )


def check_compared_scene(source: KernelSource, against: Simulation | None) -> Simulation | None:
    """Check the argument `against` and return it: a loaded scene of the same mechanism, or None.

    Raises BadValueError for anything else.
    """
    if against is None:
        return None
    if not hasattr(against, "compiled") or not hasattr(against, "simulate"):
        raise_bad_value("against", against, "a loaded scene, gudgeon.load(file)")
    if against.source.mechanism != source.mechanism:
        message = f"against is a scene of {against.source.mechanism}: this is a scene of {source.mechanism}"
        raise BadValueError(message, hint="expected another scene of the same mechanism")
    return against
