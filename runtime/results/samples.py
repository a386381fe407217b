"""Define the samples of a run in addition to the requested ones: its start, and its states at events.

A Result contains exactly the times that `simulate(output=[…])` requests. Where these begin after the start,
`Result.start_row` is a result of one sample with the state at the start: works and energy.residual count from there.

C stores the state at each event in the same form as samples. They are a separate Result here, whose first sample is the
start of the run, because energy.residual counts from there. A kinematically driven scene stores none: its motion is
computed again at these times on request.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from gudgeon.errors import GudgeonError
from gudgeon.model.baumgarte import select_motion_values
from gudgeon.model.deferred_fields import find_deferred_function, replace_fields
from gudgeon.model.evaluation import Evaluation
from gudgeon.results.state import Array

if TYPE_CHECKING:
    from gudgeon.integrators.trajectory import Trajectory
    from gudgeon.results.results import Result

# arrays of a Result with a row for each sample
SAMPLE_ARRAYS = ("t", "q", "v", "accelerations", "state", "memory", "work")
Run = TypeVar("Run", bound="Result")
MAX_SHOWN_TIMES = 6  # times that repr shows
NO_EVENT_STATES = "the file has no states at events, which older versions did not store: run the scene again"


def split_off_start(run: Run) -> Run:
    """Return the run without its first sample, which becomes the `start_row` of the new run.

    A run with fewer than two samples is returned as it is. Called if the start was not a requested output time.
    """
    if len(run.t) < 2:
        return run
    start_row = select_samples(run, lambda x: x[:1].copy())
    start_row.trace, start_row.event_states = None, None
    run_without_start = select_samples(run, lambda x: x[1:])
    run_without_start.start_row = start_row
    return run_without_start


def prepend_start(run: Run) -> Run:
    """Return the run with its start as the first sample; the run itself if its samples include the start.

    Cached series remain if they are cached for the start too.
    """
    start_row = run.start_row
    if start_row is None:
        return run
    arrays: dict[str, Any] = {
        name: _concatenate_arrays(getattr(start_row, name), getattr(run, name)) for name in SAMPLE_ARRAYS
    }
    common_series = run.stored.keys() & start_row.stored.keys()
    stored = {name: np.concatenate([start_row.stored[name], run.stored[name]]) for name in common_series}
    return replace(run, **arrays, stored=stored, start_row=None)


def _concatenate_arrays(*arrays: Array | None) -> Array | None:
    """Return the concatenated arrays; None if one of them is None."""
    available = [part for part in arrays if part is not None]
    return np.concatenate(available) if len(available) == len(arrays) else None


def select_samples(run: Run, select_rows: Callable[[Array], Array]) -> Run:
    """Return a copy of the run with some of its samples: `select_rows` is applied to each array with a row a sample.

    Cached series are dropped. An Evaluation that exists or is deferred is evaluated, and its rows are selected too.
    """
    arrays = ((name, getattr(run, name)) for name in SAMPLE_ARRAYS)
    selected: dict[str, Any] = {name: None if values is None else select_rows(values) for name, values in arrays}
    selected_run = replace_fields(run, **selected, stored={})
    if "evaluation" in run.__dict__ or find_deferred_function(run, "evaluation"):
        evaluation = run.evaluation
        selected_run.__dict__["evaluation"] = Evaluation(*(select_rows(part) for part in vars(evaluation).values()))
    return selected_run


@dataclass(frozen=True, eq=False)
class AtEvents:
    """The k states at an event: `at["S9.y"]` is (k,), `at.t` their times (s), `at.q` and `at.v` (k, n); all names of a
    result.
    """

    event: str
    all: Result = field(repr=False)  # the start, then every event of the run
    rows: Array = field(repr=False)  # (k,) indices of the samples of `all` at this event

    @property
    def t(self) -> Array:
        """Times of the event, (k,), s."""
        return self["t"]

    @property
    def q(self) -> Array:
        """Coordinates at the event, (k, n)."""
        return self.all.q[self.rows]

    @property
    def v(self) -> Array:
        """Velocities q̇ at the event, (k, n), after the impulse if there is one."""
        return self.all.v[self.rows]

    def __getitem__(self, name: str) -> Array:
        """Return a series at the events, (k,), SI. Raises UnknownNameError with the nearest name."""
        values: Array = self.all[name][self.rows]
        return values

    def __iter__(self) -> Iterator[str]:
        """Iterate over the names of all series."""
        return iter(self.all.names)

    def __contains__(self, name: str) -> bool:
        """Return whether there is a series of that name."""
        return name in self.all

    def __len__(self) -> int:
        """Return the number of states."""
        return len(self.rows)

    def __repr__(self) -> str:
        """Return number and times of the states, such as "2 states at 'top': t = 0.1, 0.3 s".

        At most MAX_SHOWN_TIMES times are listed.
        """
        times = [f"{t:.6g}" for t in self.t[:MAX_SHOWN_TIMES]] + ["…"] * (len(self) > MAX_SHOWN_TIMES)
        states = "state" if len(self) == 1 else "states"
        return f"{len(self)} {states} at {self.event!r}" + (f": t = {', '.join(times)} s" if times else "")

    def unit(self, name: str) -> str:
        """Return the SI unit of a series."""
        return self.all.unit(name)


def make_result_at_events(run: Result) -> Result:
    """Return a result whose samples are the start of the run and then all its events, by time.

    Stored states are used; the motion of a kinematically driven scene is computed again. Raises GudgeonError if neither
    is possible.
    """
    run, event_states, n = prepend_start(run), run.event_states, run.q.shape[1]
    if event_states is None:
        repeated_motion = _recompute_motion(run)
        sample_indices = np.searchsorted(repeated_motion.t, run.events["t"])
        arrays = [
            array[[0, *sample_indices]]
            for array in (
                repeated_motion.q,
                repeated_motion.v,
                repeated_motion.work,
                repeated_motion.memory,
                repeated_motion.state,
            )
        ]
    else:
        y = event_states["y"]
        start_arrays, event_arrays = (
            (run.q, run.v, run.work, run.memory, run.state),
            (
                y[:, :n],
                y[:, n : 2 * n],
                y[:, 2 * n :],
                event_states["memory"],
                event_states["state"],
            ),
        )
        arrays = [
            np.concatenate([run_array[:1], event_array])
            for run_array, event_array in zip(start_arrays, event_arrays, strict=True)
        ]
    q, v, work, discrete_states, state = arrays
    return make_result_of_samples(run, run.events["t"], q, v, work, discrete_states, state)


def make_result_of_samples(run: Result, t: Array, *sample_arrays: Array) -> Result:
    """Return a copy of a result with other samples: the start, then one for each of the times t.

    `sample_arrays` are q, v, works, discrete states and contact codes at these samples, start included.
    Accelerations, envelope, states at events and stored series are dropped; impacts and diagnostics stay.
    """
    q, v, work, discrete_states, state = sample_arrays
    return replace(
        run,
        t=np.concatenate([run.t[:1], t]),
        q=q,
        v=v,
        accelerations=None,
        work=work,
        memory=discrete_states,
        state=state,
        trace=None,
        event_states=None,
        stored={},
    )


def _recompute_motion(run: Result) -> Trajectory:
    """Return the motion of a kinematically driven scene at the times of its samples and its events, computed again.

    Raises GudgeonError for a result from a file or of another method, KeyboardInterrupt after Ctrl-C, and the error
    that ended the motion early.
    """
    from gudgeon.integrators import kinematic
    from gudgeon.integrators.trajectory import Problem

    if run.compiled is None:
        raise GudgeonError(NO_EVENT_STATES)
    if run.diagnostics.method != kinematic.NAME:
        raise GudgeonError(f"no states at events: method {run.diagnostics.method!r} does not store them")
    times = np.union1d(run.t, run.events["t"])
    p = select_motion_values(run.compiled, kinematic.NAME, run.p)
    problem = Problem(run.compiled, p, times, run.q[0], run.v[0], np.zeros(0), np.inf, stop=False)
    trajectory = kinematic.integrate_kinematic(problem)
    if trajectory.interrupted:
        raise KeyboardInterrupt
    if trajectory.stopped is not None and trajectory.t[-1] < times[-1]:
        raise trajectory.stopped
    return trajectory


def select_event_states(run: Result, name: str) -> AtEvents:
    """Return the states at the event `name` of a run, by time; see Result.at_events.

    Raises UnknownNameError for a name that is not an event of the file.
    """
    run.events_of(name)  # UnknownNameError
    event_names: Sequence[str] = [event.name for event in run.source.events]
    return AtEvents(name, run.states_at_events, 1 + np.flatnonzero(run.events["event"] == event_names.index(name)))
