"""Events of a scene without a degree of freedom: its motion is known at every time, so their times are too.

templates/c/kinematic_events.c.jinja looks for changes of sign, and finds their times by bisection to
max(1e-12 s, 4 ulp of t). Two zeros between two looks (some 0.1 rad apart) are not seen.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from gudgeon.errors import SolverError
from gudgeon.integrators.failure import STOPPED
from gudgeon.integrators.trajectory import EVENT_DTYPE, Problem, no_events

if TYPE_CHECKING:
    from gudgeon.integrators.kinematic import _Way

EVENT_STOPS, EVENTS_FULL = 1, -3
CAPACITY = 256  # events of one call; more where one interval has more


class Events:
    """Those of a run as far as they were looked for: `found`, EVENT_DTYPE by time."""

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.side = np.zeros(len(problem.compiled.source.events), dtype=np.int8)  # of zero, seen last
        self.found, self.capacity = no_events(), CAPACITY

    def find(self, way: _Way, first: int, last: int) -> bool:
        """Looks through the intervals between rows first to last of the way; whether an event ends the run there.

        Raises SolverError where the motion cannot be followed between its samples.
        """
        lib, pointer, t = self.problem.compiled.lib, self.problem.compiled.pointer, way.t
        while first < last:
            counts, rows = np.zeros(2, dtype=np.int_), slice(first, None)
            at, which = np.zeros(self.capacity), np.zeros(self.capacity, dtype=np.intc)
            status = lib.gudgeon_kinematic_events(
                pointer(way.course, "void *"), last - first, pointer(t[rows]), pointer(self.problem.p),
                pointer(way.q[rows]), pointer(way.v[rows]), float(t[0]), int(self.problem.stop),
                pointer(self.side, "signed char *"), self.capacity, pointer(at), pointer(which, "int *"),
                pointer(counts, "long *"), pointer(counts[1:], "long *"),
            )  # fmt: skip
            way.asker.check(status == STOPPED)
            some = np.zeros(int(counts[0]), dtype=EVENT_DTYPE)
            some["event"], some["t"] = which[: len(some)], at[: len(some)]
            self.found = np.concatenate([self.found, some])
            first += int(counts[1])
            if status == EVENT_STOPS:
                return True
            if status == EVENTS_FULL:
                self.capacity *= 4  # one interval may have more than there was room for
            elif status:
                now = float(t[first])
                told = f"events cannot be looked for beyond t = {now:.9g} s: no position was found there"
                raise SolverError(told, now)
        return False
