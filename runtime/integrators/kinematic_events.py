"""Events of a scene without a degree of freedom: its motion is known at every time, so their times are too.

templates/c/kinematic_events.c.jinja looks for changes of sign over parts of the way in which no expression turns back,
and finds their times by bisection to 4 ulp of t or 1e-12 of the part. A zero at the end of the run counts: the way is
looked at a little beyond it.
"""

from __future__ import annotations

import numpy as np

from gudgeon.compiled import Array, CompiledModel
from gudgeon.errors import SolverError
from gudgeon.integrators.session import told_apart
from gudgeon.integrators.trajectory import EVENT_DTYPE, Problem, no_events

EVENT_STOPS, EVENTS_FULL = 1, -3
CAPACITY = 256  # events of one call; more where one interval has more


def find_events(
    problem: Problem, times: Array, q: Array, v: Array, reach: float, extent: float
) -> tuple[Array, Array, bool]:
    """Events by time, those that are no number from a time on (EVENT_DTYPE), and whether the last one ends the run.

    q and v (N, n) are the motion at `times` (N,). Raises SolverError where the motion cannot be followed
    between its samples.
    """
    compiled, pointer = problem.compiled, problem.compiled.pointer
    side = np.zeros(len(compiled.source.events), dtype=np.int8)
    found, first, capacity, end = [no_events()], 0, CAPACITY, float(times[-1])
    if len(times) == len(problem.t) > 1:  # a little more, for what is zero at the end
        times = np.append(times, end + max(4.0 * np.spacing(abs(end)), 1e-12 * (end - times[-2])))
    while first < len(times) - 1:
        at, which, counts = np.zeros(capacity), np.zeros(capacity, dtype=np.intc), np.zeros(2, dtype=np.int_)
        status = compiled.lib.gudgeon_kinematic_events(
            len(times) - 1 - first, pointer(times[first:]), pointer(problem.p), reach, extent, pointer(q[first:]),
            pointer(v[first:]), float(times[0]), int(problem.stop),
            pointer(side, "signed char *"), capacity, pointer(at), pointer(which, "int *"),
            pointer(counts, "long *"), pointer(counts[1:], "long *"),
        )  # fmt: skip
        some = np.zeros(int(counts[0]), dtype=EVENT_DTYPE)
        some["event"], some["t"] = which[: len(some)], at[: len(some)]
        found.append(some)
        first += int(counts[1])
        if status == EVENT_STOPS:
            return *_in_order(compiled, found, end), True
        if status == EVENTS_FULL:
            capacity *= 4  # one interval may have more than there was room for
        elif status and times[first] < end:
            t = float(times[first])
            raise SolverError(f"events cannot be looked for beyond t = {t:.9g} s: no position was found there", t)
        elif status:
            break  # beyond the end
    return *_in_order(compiled, found, end), False


def _in_order(compiled: CompiledModel, found: list[Array], end: float) -> tuple[Array, Array]:
    """Events by time, not beyond the end, and the first time at which each is no number."""
    events, lost = told_apart(compiled, np.concatenate(found))
    events["t"] = np.minimum(events["t"], end)
    return events, lost[np.unique(lost["event"], return_index=True)[1]]
