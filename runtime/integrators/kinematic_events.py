"""Events of a scene without a degree of freedom: its motion is known at every time, so their times are too.

engine/kinematic/events.c looks for changes of sign over parts of the way in which no expression
turns back, and finds their times by bisection to 4 ulp of t or 1e-12 of the part. A zero at the end of the run counts:
the way is looked at a little beyond it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.boundary import EVENT_STOPS, EVENTS_FULL, MAX_LISTED, STOPPED
from gudgeon.errors import SolverError
from gudgeon.integrators.events import split_undefined
from gudgeon.integrators.trajectory import EVENT_DTYPE, Problem, no_events
from gudgeon.model.compiled import Array

if TYPE_CHECKING:
    from gudgeon.integrators.kinematic import _Way



class Events:
    """Those of a run as far as they were looked for: `found`, EVENT_DTYPE, in the order of the search."""

    def __init__(self, problem: Problem) -> None:
        self.problem, self.end = problem, float(problem.t[-1])
        self.side = np.zeros(len(problem.compiled.source.events), dtype=np.int8)  # of zero, seen last
        self.found, self.capacity = no_events(), MAX_LISTED

    def find(self, way: _Way, first: int, last: int) -> bool:
        """Looks through the intervals between rows first to last of the way; whether an event ends the run there.

        Raises SolverError where the motion cannot be followed between its samples.
        """
        times, done = way.t[first : last + 1], 0
        if last == len(self.problem.t) - 1:  # a little more, for what is zero at the end
            more = max(4.0 * float(np.spacing(abs(self.end))), 1e-12 * (self.end - float(times[-2])))
            times = np.append(times, self.end + more)
        while done < len(times) - 1:
            status, count = self._look(way, first + done, times[done:])
            done += count
            if status == EVENT_STOPS:
                return True
            if status == EVENTS_FULL:
                self.capacity *= 4  # one interval may have more than there was room for
            elif status and times[done] < self.end:
                t = float(times[done])
                told = f"events cannot be looked for beyond t = {t:.9g} s: no position was found there"
                raise SolverError(told, t)
            elif status:
                break  # beyond the end
        return False

    def _look(self, way: _Way, row: int, times: Array) -> tuple[int, int]:
        """From a row on through the intervals between these times: a status, and how many are complete."""
        pointer, counts = self.problem.compiled.pointer, np.zeros(2, dtype=np.int_)
        at, which = np.zeros(self.capacity), np.zeros(self.capacity, dtype=np.intc)
        status = self.problem.compiled.lib.gudgeon_kinematic_events(
            pointer(way.course, "void *"), len(times) - 1, pointer(times), pointer(self.problem.p),
            pointer(way.q[row:]), pointer(way.v[row:]), float(way.t[0]), int(self.problem.stop),
            pointer(self.side, "signed char *"), self.capacity, pointer(at), pointer(which, "int *"),
            pointer(counts, "long *"), pointer(counts[1:], "long *"),
        )  # fmt: skip
        way.asker.check(status == STOPPED)
        some = np.zeros(int(counts[0]), dtype=EVENT_DTYPE)
        some["event"], some["t"] = which[: len(some)], at[: len(some)]
        self.found = np.concatenate([self.found, some])
        return int(status), int(counts[1])

    def in_order(self) -> tuple[NDArray[Any], NDArray[Any]]:
        """Events by time, not beyond the end, and the first time at which each is no number."""
        events, lost = split_undefined(self.problem.compiled, self.found)
        events["t"] = np.minimum(events["t"], self.end)
        return events, lost[np.unique(lost["event"], return_index=True)[1]]
