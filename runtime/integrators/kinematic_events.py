"""Search the user events of a kinematic run between its samples (engine/kinematic/events.c).

Sign changes of event functions are searched on intervals in which they are monotone. Zeros are located to 4 ulp of t or
1e-13 of the interval (engine/watch/zeros.h). A zero at the end of the run counts: the search extends a little
beyond it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.boundary import EVENT_STOPS, EVENTS_FULL, MAX_LISTED, STOPPED
from gudgeon.errors import SolverError
from gudgeon.integrators.trajectory import EVENT_DTYPE, Problem, make_empty_events, split_undefined_events
from gudgeon.model.compiled import Array

if TYPE_CHECKING:
    from gudgeon.integrators.kinematic import KinematicRun


class KinematicEvents:
    """Collect the user events of a kinematic run in `found_events` (EVENT_DTYPE), in the order of the search."""

    def __init__(self, problem: Problem) -> None:
        self.problem, self.end = problem, float(problem.t[-1])
        self.signs = np.zeros(len(problem.compiled.source.events), dtype=np.int8)  # of zero, seen last
        self.found_events, self.capacity = make_empty_events(), MAX_LISTED

    def search_events(self, run_state: KinematicRun, first: int, last: int) -> bool:
        """Search the intervals between samples `first` to `last`; return whether an event ends the run there.

        Events are appended to `found_events`; `capacity` grows if one interval has more. The last interval of the run
        is searched slightly beyond the end, where a failure is ignored. Raises SolverError where the constraint
        equations have no solution between the samples.
        """
        times, n_done = run_state.t[first : last + 1], 0
        if last == len(self.problem.t) - 1:  # searched beyond the end, for zeros at the end
            more = max(4.0 * float(np.spacing(abs(self.end))), 1e-12 * (self.end - float(times[-2])))
            times = np.append(times, self.end + more)
        while n_done < len(times) - 1:
            status, count = self._search_intervals(run_state, first + n_done, times[n_done:])
            n_done += count
            if status == EVENT_STOPS:
                return True
            if status == EVENTS_FULL:
                self.capacity *= 4  # one interval may have more events than the capacity
            elif status and times[n_done] < self.end:
                t = float(times[n_done])
                message = f"events cannot be searched beyond t = {t:.9g} s: no position was found there"
                raise SolverError(message, t)
            elif status:
                break  # beyond the end
        return False

    def _search_intervals(self, run_state: KinematicRun, first: int, times: Array) -> tuple[int, int]:
        """Search the intervals between these times from sample `first` on, and append the events to `found_events`.

        Return the status of C and the number of complete intervals. Raises KeyboardInterrupt. At most `capacity` events
        are found in one call.
        """
        pointer, counts = self.problem.compiled.pointer, np.zeros(2, dtype=np.int_)
        event_times, event_indices = np.zeros(self.capacity), np.zeros(self.capacity, dtype=np.intc)
        status = self.problem.compiled.lib.gudgeon_kinematic_events(
            pointer(run_state.motion_struct, "void *"),
            len(times) - 1,
            pointer(times),
            pointer(self.problem.values_of_motion),
            pointer(run_state.q[first:]),
            pointer(run_state.v[first:]),
            float(run_state.t[0]),
            int(self.problem.stop),
            pointer(self.signs, "signed char *"),
            self.capacity,
            pointer(event_times),
            pointer(event_indices, "int *"),
            pointer(counts, "long *"),
            pointer(counts[1:], "long *"),
        )
        run_state.cancellation_poll.raise_stored_exception(status == STOPPED)
        new_events = np.zeros(int(counts[0]), dtype=EVENT_DTYPE)
        new_events["event"], new_events["t"] = event_indices[: len(new_events)], event_times[: len(new_events)]
        self.found_events = np.concatenate([self.found_events, new_events])
        return int(status), int(counts[1])

    def sort_events(self) -> tuple[NDArray[Any], NDArray[Any]]:
        """Return the events sorted by time, and for each event that became undefined the first time at which it was.

        Both are arrays (EVENT_DTYPE). Times beyond the end are set to the end.
        """
        events, undefined = split_undefined_events(self.problem.compiled, self.found_events)
        events["t"] = np.minimum(events["t"], self.end)
        return events, undefined[np.unique(undefined["event"], return_index=True)[1]]
