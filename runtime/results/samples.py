"""Samples of a run in addition to those that were requested: its start, and its states at events.

A Result contains exactly the times that `simulate(output=[…])` requests. Where these begin after the start,
`Result.start_row` is a result of one sample with the state at the start: works and energy.residual count from there.

C keeps the state at each event as it does of samples; they are a Result of their own here, whose first sample is the
run's start, for what is counted from there (energy.residual). A scene without a degree of freedom keeps none: its
motion is followed again to these times, when somebody asks.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from gudgeon.errors import GudgeonError
from gudgeon.model.evaluation import Evaluation
from gudgeon.results.state import Array

if TYPE_CHECKING:
    from gudgeon.integrators.trajectory import Trajectory
    from gudgeon.results.results import Result

ROWS = ("t", "q", "v", "accelerations", "state", "memory", "work")  # arrays of a Result with a row for each sample
Run = TypeVar("Run", bound="Result")
FEW = 6  # times that are told
OLDER = "the file was written before states at events were kept: run the scene again"


def without_start(run: Run) -> Run:
    """Return the run without its first sample, which becomes its `start_row`; the run itself if there is no other."""
    if len(run.t) < 2:
        return run
    first = replace(_rows(run, lambda x: x[:1].copy()), trace=None, event_states=None)
    others = _rows(run, lambda x: x[1:])
    others.start_row = first
    return others


def with_start(run: Run) -> Run:
    """Return the run with its start as the first sample; the run itself if its samples include the start."""
    first = run.start_row
    if first is None:
        return run
    rows: dict[str, Any] = {name: _joined(getattr(first, name), getattr(run, name)) for name in ROWS}
    both = run.stored.keys() & first.stored.keys()
    stored = {name: np.concatenate([first.stored[name], run.stored[name]]) for name in both}
    return replace(run, **rows, stored=stored, start_row=None)


def _joined(*parts: Array | None) -> Array | None:
    known = [part for part in parts if part is not None]
    return np.concatenate(known) if len(known) == len(parts) else None


def _rows(run: Run, take: Callable[[Array], Array]) -> Run:
    """Return a run with the samples that `take` selects, and what was evaluated of them so far."""
    arrays = ((name, getattr(run, name)) for name in ROWS)
    rows: dict[str, Any] = {name: None if x is None else take(x) for name, x in arrays}
    found = replace(run, **rows, stored={})
    if (known := run.__dict__.get("evaluation")) is not None:
        found.__dict__["evaluation"] = Evaluation(*(take(part) for part in vars(known).values()))
    return found


@dataclass(frozen=True, eq=False)
class AtEvents:
    """k states: `at["S9.y"]` is (k,), `at.t` their times (s), `at.q` and `at.v` (k, n); all names of a result."""

    event: str
    all: Result = field(repr=False)  # the start, then every event of the run
    rows: Array = field(repr=False)  # (k,) of these, the ones of this event

    @property
    def t(self) -> Array:
        """(k,) s."""
        return self["t"]

    @property
    def q(self) -> Array:
        """(k, n)."""
        return self.all.q[self.rows]

    @property
    def v(self) -> Array:
        """(k, n), behind the impulse where there is one."""
        return self.all.v[self.rows]

    def __getitem__(self, name: str) -> Array:
        """That series at the events, (k,), SI. UnknownNameError names the nearest."""
        values: Array = self.all[name][self.rows]
        return values

    def __iter__(self) -> Iterator[str]:
        return iter(self.all.names)

    def __contains__(self, name: str) -> bool:
        return name in self.all

    def __len__(self) -> int:
        return len(self.rows)

    def __repr__(self) -> str:
        """How many, and when: "3 states at 'top': t = 0.1, 0.3, 0.5 s"."""
        times = [f"{t:.6g}" for t in self.t[:FEW]] + ["…"] * (len(self) > FEW)
        states = "state" if len(self) == 1 else "states"
        return f"{len(self)} {states} at {self.event!r}" + (f": t = {', '.join(times)} s" if times else "")

    def unit(self, name: str) -> str:
        """SI unit of a series."""
        return self.all.unit(name)


def everything(run: Result) -> Result:
    """A result whose samples are the run's start and then its events. Raises GudgeonError where they are not known."""
    run, found, n = with_start(run), run.event_states, run.q.shape[1]
    if found is None:
        reached = _again(run)
        rows = np.searchsorted(reached.t, run.events["t"])
        parts = [array[[0, *rows]] for array in (reached.q, reached.v, reached.work, reached.memory, reached.state)]
    else:
        y = found["y"]
        ours, theirs = (
            (run.q, run.v, run.work, run.memory, run.state),
            (
                y[:, :n],
                y[:, n : 2 * n],
                y[:, 2 * n :],
                found["memory"],
                found["state"],
            ),
        )
        parts = [np.concatenate([own[:1], at]) for own, at in zip(ours, theirs, strict=True)]
    q, v, work, memory, state = parts
    return of_rows(run, run.events["t"], q, v, work, memory, state)


def of_rows(run: Result, t: Array, *parts: Array) -> Result:
    """The same of rows: the start, then one for each of the times t; q, v, works, memory, state."""
    q, v, work, memory, state = parts
    return replace(
        run,
        t=np.concatenate([run.t[:1], t]),
        q=q,
        v=v,
        accelerations=None,
        work=work,
        memory=memory,
        state=state,
        trace=None,
        event_states=None,
        stored={},
    )


def _again(run: Result) -> Trajectory:
    """The motion of a kinematic scene at its samples and its events."""
    from gudgeon.integrators import kinematic
    from gudgeon.integrators.trajectory import Problem

    if run.compiled is None:
        raise GudgeonError(OLDER)
    if run.diagnostics.method != kinematic.NAME:
        raise GudgeonError(f"method {run.diagnostics.method!r} keeps no states at events")
    times = np.union1d(run.t, run.events["t"])
    problem = Problem(run.compiled, run.p, times, run.q[0], run.v[0], np.zeros(0), np.inf, stop=False)
    reached = kinematic.run(problem)
    if reached.interrupted:
        raise KeyboardInterrupt
    if reached.stopped is not None and reached.t[-1] < times[-1]:
        raise reached.stopped
    return reached


def at_events(run: Result, name: str) -> AtEvents:
    """See Result.at_events."""
    run.events_of(name)  # UnknownNameError
    number: Sequence[str] = [event.name for event in run.source.events]
    return AtEvents(name, run.states_at_events, 1 + np.flatnonzero(run.events["event"] == number.index(name)))
