"""Choose the step observers of a run: peaks of series (peaks.py), wear (wear.py), errors against another scene.

Errors over all steps are computed from the other scene at the times of these steps.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Protocol

import numpy as np

from gudgeon.assembly.start import assemble
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BadValueError, GudgeonError
from gudgeon.integrators.adaptive import RTOL
from gudgeon.integrators.steps import Steps
from gudgeon.integrators.trajectory import Problem
from gudgeon.language.argument_checks import names, refuse
from gudgeon.model.choices import specified
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.parameters import prepare, without_baumgarte
from gudgeon.results.diagnostics import Extremes
from gudgeon.results.results import Result
from gudgeon.results.series import catalogue, check_series
from gudgeon.results.wear import SlidingLoads, SlidingRequest
from gudgeon.simulation.arguments import integrate, method_of

if TYPE_CHECKING:
    from gudgeon.simulation.simulation import Simulation


LIST = "a list of names of series"  # expected type of the argument `peaks`, for messages


class StepObserver(Protocol):
    """Observe the states of all steps of one run."""

    def __call__(self, steps: Steps) -> None:
        """Process the next states of the run."""

    def message(self) -> Observation:
        """Return the findings."""


def requested_peaks(
    source: KernelSource, peaks: Iterable[str | SlidingRequest] | None
) -> tuple[str | SlidingRequest, ...]:
    """Return the requested peaks: the given names of series, else those of the scene, and requests for wear.

    Raises UnknownNameError, BadValueError.
    """
    if peaks is None:
        return check_series(source, source.peaks)
    rubbing = tuple(one for one in peaks if isinstance(one, SlidingRequest)) if isinstance(peaks, tuple) else ()
    expected = names([one for one in peaks if one not in rubbing] if rubbing else peaks, "peaks", LIST)
    if "t" in expected:
        raise BadValueError("peaks: t has no peaks", hint="leave it out: a peak comes with its time")
    return (*check_series(source, expected), *rubbing)


@dataclass(frozen=True)
class Observation:
    """Hold the findings of the observers of one run: extremes, notes and wear."""

    extremes: tuple[Extremes, ...] = ()
    notes: tuple[str, ...] = ()
    rubbed: tuple[SlidingLoads, ...] = ()

    def to(self, run: Result) -> None:
        """Store the findings in the diagnostics of a run."""
        notes = (*run.diagnostics.notes, *self.notes)
        run.diagnostics = replace(run.diagnostics, extremes=self.extremes, notes=notes, rubbed=self.rubbed)


def make_observer(
    compiled: CompiledModel,
    numbers: tuple[Array, Array, Array],
    rtol: float,
    expected: tuple[str | SlidingRequest, ...],
    against: Simulation | None,
) -> StepObserver | None:
    """Return the observer of a run with parameter arrays `numbers` (p, given, is_given); None if nothing is
    requested.
    """
    found, series = list[StepObserver](), tuple(one for one in expected if isinstance(one, str))
    if series:
        from gudgeon.simulation.peaks import Search

        beside = ComparedScene(against, compiled.source, numbers[0], rtol or RTOL) if against else None
        found.append(Search(compiled, series, numbers, beside))
    if len(series) < len(expected):
        from gudgeon.simulation.wear import WearObserver

        found += [WearObserver(compiled, one, numbers) for one in expected if isinstance(one, SlidingRequest)]
    return found[0] if len(found) == 1 else CombinedObserver(found) if found else None


class CombinedObserver:
    """Combine several observers of one run."""

    def __init__(self, lookers: Sequence[StepObserver]) -> None:
        self.lookers = lookers

    def __call__(self, steps: Steps) -> None:
        """Pass the next states to each observer."""
        for observer in self.lookers:
            observer(steps)

    def message(self) -> Observation:
        """Return the findings of all observers."""
        message = [observer.message() for observer in self.lookers]
        return Observation(
            *(tuple(one for each in message for one in getattr(each, name.name)) for name in fields(Observation))
        )


class ComparedScene:
    """Follow another scene from t = 0, as its file describes, with the parameter values of the run where it has
    them.
    """

    def __init__(self, simulation: Simulation, source: KernelSource, p: Array, rtol: float) -> None:
        self.compiled = simulation.compiled
        self.scene, self.names = simulation.source.scene, frozenset(catalogue(simulation.source))
        own = {slot.address for slot in self.compiled.source.slots}
        values = {
            slot.address: specified(slot, float(p[k])) for k, slot in enumerate(source.slots) if slot.address in own
        }
        self.numbers = prepare(self.compiled, values)
        self.lost = ""  # reason why it cannot be followed further; "" if it can
        self.problem: Problem | None = None  # from where it resumes
        self.last: Steps | None = None  # the state there
        self.rtol = rtol

    def follow(self, t: Array) -> Steps | None:
        """Return the scene's states at times t (k,), which do not decrease from call to call; None after a failure."""
        if self.lost:
            return None
        try:
            return self._integrate_to(t)
        except GudgeonError as error:
            self.lost = str(error)
            return None

    def _integrate_to(self, t: Array) -> Steps:
        """Integrate the scene to the times t (k,) and return its states there."""
        problem = self.problem or self._begin()
        times = np.union1d(problem.t[:1], t)
        if self.last is not None and len(times) == 1:
            return self.last[np.zeros(len(t), dtype=int)]
        x = integrate(replace(problem, t=times))
        if x.stopped is not None:
            raise x.stopped
        work = x.work if self.last is None else x.work + self.last.work  # each part begins with none
        steps = Steps(x.t, x.q, x.v, work, x.memory, x.state, np.zeros(len(x.t), dtype=bool))
        self.last = steps[-1:]
        state = x.state[-1] if x.state.shape[1] else None
        self.problem = replace(problem, t=times[-1:], q=x.q[-1], v=x.v[-1], memory=x.memory[-1], state=state)
        return steps[np.searchsorted(x.t, t)]

    def _begin(self) -> Problem:
        """Return the scene's problem at its start."""
        p, given, is_given = self.numbers
        assembled, method = assemble(self.compiled, p), method_of(self.compiled.source, "auto", False)
        memory = np.full(self.compiled.n_memory, np.nan)
        return Problem(
            self.compiled,
            p,
            np.zeros(1),
            assembled.q,
            assembled.v,
            memory,
            math.inf,
            method=method,
            rtol=self.rtol,
            p_free=without_baumgarte(self.compiled, given, is_given),
            stop=False,
        )


def check_compared_scene(source: KernelSource, against: Simulation | None) -> Simulation | None:
    """Raise BadValueError unless `against` is a loaded scene of the same mechanism. Return it, or None."""
    if against is None:
        return None
    if not hasattr(against, "compiled") or not hasattr(against, "simulate"):
        refuse("against", against, "a loaded scene, gudgeon.load(file)")
    if against.source.mechanism != source.mechanism:
        message = f"against is a scene of {against.source.mechanism}: this is a scene of {source.mechanism}"
        raise BadValueError(message, hint="errors are taken against another scene of the same mechanism")
    return against
