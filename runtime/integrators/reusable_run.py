"""Integrate one run after the other in C in preallocated arrays, for calls that must be short.

A run is one call of C (engine/batch/repeated_run.c), from its parameter values to its series. Lists of contacts and
events are discarded. The results are, bit for bit, those of `Runs` with one run.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from gudgeon.assembly.start import assemble_start
from gudgeon.contract.boundary import INTEGRATE, NEW, NOT_CLOSED, NOT_VALID, RUN_FAILED, STOPPED
from gudgeon.integrators import adaptive
from gudgeon.integrators.batch import Runs
from gudgeon.integrators.times import Times
from gudgeon.model.compiled import Array
from gudgeon.model.parameter_columns import ParameterColumns
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
        self._poll = CancellationPoll(self.compiled, self.compiled.lib.switch_library_if_ready)
        self.struct.is_stop_requested, self.struct.context, self.struct.poll_interval = self._poll.c_arguments
        self._begun_row, self._has_guessed_points = 0, any(x.count(".") > 1 for x in columns.source.start_guess)
        self._tolerance_table, self._tolerance_arrays = adaptive.make_tolerance_table(self.compiled, rtol)
        # all that C needs for a call; the audit of samples and the series are set by sample_reader.py
        self.repeated = self.compiled.ffi.new("RepeatedRun *")
        self.repeated.batch, self.repeated.x = self.struct, columns.x_pointer
        self.repeated.parameters, self.repeated.tolerances = columns.struct, self._tolerance_table
        self.repeated.limit = [np.inf] * len(self.repeated.limit)

    @property
    def next_row(self) -> int:
        """Return the row of the next run; the row of the last run keeps its values, from which C copies the start."""
        return 1 - self._begun_row

    def set_row(self, x: Array, k: int) -> bool:
        """Compute parameter values and tolerances of row k from x (n_names,); return whether the values are valid.

        Values with a clearance below rounding at the mechanism's size are not.
        """
        lib, null = self.compiled.lib, self.compiled.ffi.NULL
        return self.columns.compute_values_of_row(x, k) and bool(lib.gudgeon_set_repeated_run(self.repeated, k, null))

    def repeat(self, k: int, stage: int) -> int:
        """Run row k = `next_row` from `stage` (RepeatStage) to its series, and return C's RepeatResult.

        The parameter values are those of `columns.x`. A start that C cannot assemble is assembled in Python. Raises
        AssemblyError if it does not close, and KeyboardInterrupt after Ctrl-C.
        """
        result = self._repeat(k, stage)
        if result == RUN_FAILED and self.arrays["status"][k] == NOT_CLOSED:
            start = assemble_start(self.compiled, self.columns.p[k])
            self.arrays["start"][k] = np.concatenate([start.q, start.v])
            self.arrays["started"][k] = 1
            try:
                result = self._repeat(k, INTEGRATE)
            finally:  # C then copies this start to the next run only if the parameters of starts are equal
                self.arrays["started"][k] = 0
                if self._has_guessed_points:  # guesses of points depend on parameters that C does not compare
                    self.arrays["phase"][k] = NEW
        return result

    def _repeat(self, k: int, stage: int) -> int:
        """Call C for row k, and return its RepeatResult. Raises KeyboardInterrupt after Ctrl-C."""
        lib = self.compiled.lib
        lib.switch_library_if_ready()
        result: int = lib.gudgeon_repeat_run(self.repeated, self._integrator, k, stage)
        if result == NOT_VALID:
            return result
        self._begun_row = k
        if self._poll.raised is not None or result == RUN_FAILED:
            self._poll.raise_stored_exception(bool(self.arrays["status"][k] == STOPPED))
        return result

    def build_error(self, k: int) -> Any:
        """Build the error that ended the run in row k; see Runs._build_error."""
        return self._build_error(k)
