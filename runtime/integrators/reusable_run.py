"""Integrate one run after the other in C in preallocated arrays, for calls that must be short.

Lists of contacts and events are discarded. The results are, bit for bit, those of `Runs` with one run.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from gudgeon.assembly.start import assemble_start
from gudgeon.contract.boundary import BUFFERS_FULL, NEW, NOT_CLOSED, RUN_ENDED, STOPPED
from gudgeon.integrators import adaptive
from gudgeon.integrators.batch import Runs
from gudgeon.integrators.stored import Contacts
from gudgeon.integrators.times import Times
from gudgeon.model.compiled import Array
from gudgeon.model.parameter_columns import ParameterColumns
from gudgeon.model.sizes import (
    compute_size_of_run,
    find_size_indices,
    find_size_parameters,
    is_clearance_unresolved,
)
from gudgeon.waiting.cancellation import CancellationPoll

N_ROWS = 2  # the current run, and the last one, whose start is copied if the parameters of the start are equal


class ReusableRun(Runs):
    """Integrate the run in row `next_row` of the arrays, with the parameter values that `columns` computed there.

    `t` (N,): sample times (s) of all runs. `steps` (N_ROWS,): fixed step (s) of each row, infinity without one.
    """

    def __init__(
        self,
        columns: ParameterColumns,
        t: Array,
        method: str,
        steps: Array,
        rtol: float,
        stop: bool,
        audit: int,
    ) -> None:
        times = Times(t, np.full(N_ROWS, len(t)), np.zeros(N_ROWS, np.int_))
        super().__init__(
            columns.compiled, columns.p, columns.p_motion, times, method, steps, rtol, stop, audit, False, 1
        )
        self.columns = columns
        self._storage = np.zeros(self.compiled.lib.gudgeon_run_size(), dtype=np.uint8)
        self._integrator = self.compiled.pointer(self._storage, "void *", True)
        self._current = self.compiled.ffi.new("long *")
        self._poll = CancellationPoll(self.compiled, self.compiled.lib.switch_library_if_ready)
        self.struct.is_stop_requested, self.struct.context, self.struct.poll_interval = self._poll.c_arguments
        self._begun_row, self._has_guessed_points = 0, any(x.count(".") > 1 for x in columns.source.start_guess)
        self._tolerance_keys: list[bytes | None] = [None] * N_ROWS  # None: not computed
        self._size, self._size_parameters = 0.0, find_size_parameters(columns.source)
        self._size_key: bytes | None = None
        self._phase, self._done, self._checked, self._status = (
            self.arrays[name] for name in ("phase", "done", "checked", "status")
        )

    @property
    def next_row(self) -> int:
        """Return the row of the next run; the row of the last run keeps its values, from which C copies the start."""
        return 1 - self._begun_row

    def update_tolerances(self, k: int) -> bool:
        """Compute size and tolerances of row k from its parameter values; return whether all clearances are resolved.

        A clearance is not resolved if it is below rounding at the mechanism's size; the size is then not stored.
        Nothing is computed, and True returned, if the lengths have not changed since the last resolved call.
        """
        key = self.columns.p[k].take(self.columns.length_indices).tobytes()
        if key == self._tolerance_keys[k]:
            return True
        self._tolerance_keys[k] = None
        source, x, p = self.compiled.source, self.arrays, self.columns.p[k]
        size_key = p.take(self._size_parameters).tobytes()
        if size_key != self._size_key:
            self._size, self._size_key = compute_size_of_run(find_size_indices(source), p.tolist()), size_key
        if is_clearance_unresolved(source, p, self._size):
            return False
        x["scale"][k], x["min_size"][k] = adaptive.compute_tolerances_of_single_run(source, p, self._size, self.rtol)
        x["size"][k] = self._size
        self._tolerance_keys[k] = key
        return True

    def integrate_row(self, k: int) -> int:
        """Integrate the run in row k = `next_row` from start to end, and return its status (engine/boundary.h).

        A start that C cannot assemble is assembled in Python. Raises AssemblyError if it does not close, and
        KeyboardInterrupt after Ctrl-C.
        """
        status = self._integrate(k)
        if status == NOT_CLOSED:
            start = assemble_start(self.compiled, self.columns.p[k])
            self.arrays["start"][k] = np.concatenate([start.q, start.v])
            self.arrays["started"][k] = 1
            try:
                status = self._integrate(k)
            finally:  # C then copies this start to the next run only if the parameters of starts are equal
                self.arrays["started"][k] = 0
                if self._has_guessed_points:  # guesses of points depend on parameters that C does not compare
                    self._phase[k] = NEW
        return status

    def _integrate(self, k: int) -> int:
        """Integrate the run in row k in C and return its status. Raises KeyboardInterrupt after Ctrl-C.

        Full lists of contacts and events are discarded; the run then continues.
        """
        lib, current = self.compiled.lib, self._current
        lib.switch_library_if_ready()
        self._phase[k], self._done[k], self._checked[k] = NEW, 0, 0
        self._begun_row, current[0] = k, k
        while current[0] == k:
            result = lib.gudgeon_ensemble(self.struct, self._integrator, current, k + 1)
            self._poll.raise_stored_exception(False)
            if result == RUN_ENDED:
                break
            if result == BUFFERS_FULL:
                self._discard_contacts_and_events(k)
        status: int = self._status.item(k)
        if status == STOPPED:
            raise KeyboardInterrupt
        return status

    def _discard_contacts_and_events(self, k: int) -> None:
        """Fetch and discard C's full lists of contacts and events of the run in row k, which then continues."""
        self.fetch_contacts_and_events(k, self._integrator, False)
        self.fetched = Contacts(self.compiled)
        self.events.clear()

    def build_error(self, k: int) -> Any:
        """Build the error that ended the run in row k; see Runs._build_error."""
        return self._build_error(k)
