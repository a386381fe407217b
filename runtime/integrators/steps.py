"""Pass states at and between the step ends of a run to observers, such as the search for peaks.

The time loops in C write the states into rows (engine/run/step_record.c) and return when the rows are full. An observer
reads the rows before the loop continues. A run without observers has no rows.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.boundary import N_RECORD_HEAD, N_WORK, RECORD_JUMPED, RECORD_T
from gudgeon.model.compiled import Array, CompiledModel

N_ROWS_OF_BLOCK = 4096  # rows of a block


@dataclass(frozen=True)
class Steps:
    """Hold k states in the order of time, SI units; at a jump, the states before and after it at nearly one time."""

    t: Array  # (k,)
    q: Array  # (k, n)
    v: Array
    work: Array  # (k, 3)
    memory: Array  # (k, n_discrete_states)
    state: NDArray[Any]  # (k, n_clearances) int8
    is_after_jump: NDArray[np.bool_]  # (k,) whether the run began or a quantity jumped since the row before

    def __len__(self) -> int:
        """Return the number k of states."""
        return len(self.t)

    def __getitem__(self, rows: slice | NDArray[Any]) -> Steps:
        """Return the states of these rows."""
        return Steps(*(getattr(self, each.name)[rows] for each in fields(self)))

    def concatenate(self, later: Steps) -> Steps:
        """Return new Steps: these states followed by the later ones."""
        return Steps(*(np.concatenate([getattr(self, x.name), getattr(later, x.name)]) for x in fields(self)))


StepCallback: TypeAlias = Callable[[Steps], None]  # observer of the states of all steps of a run


class StepLog:
    """Hold the rows that a run in C fills, and pass them to the observer."""

    def __init__(self, compiled: CompiledModel, observer: StepCallback | None = None) -> None:
        self.compiled, self.observer = compiled, observer
        joints = len(compiled.source.clearances)
        self.widths = (N_RECORD_HEAD, 2 * compiled.n + N_WORK, max(compiled.n_discrete_states, 1), max(joints, 1))
        self.rows = np.zeros((N_ROWS_OF_BLOCK, sum(self.widths)))

    def register_record_buffer(self, run: Any) -> None:
        """Register the rows with C's integrator `run`, which is about to begin and will write its states into them."""
        self.compiled.lib.gudgeon_run_set_record_buffer(
            run, self.compiled.pointer(self.rows, is_written=True), len(self.rows)
        )

    def flush_recorded_states(self, run: Any) -> None:
        """Pass copies of the states that C's integrator has written since the last call to the observer; clear them.

        Without an observer, the states are discarded.
        """
        count = int(self.compiled.lib.gudgeon_run_recorded(run))
        if count and self.observer:
            self.observer(self._convert_rows_to_steps(self.rows[:count].copy()))

    def _convert_rows_to_steps(self, rows: Array) -> Steps:
        """Convert rows that C wrote to Steps: each has head (time, whether a jump precedes), state, discrete states,
        codes.

        The state is q, q̇ and the works; the last part has the contact code of each joint with play.
        """
        (head, y, discrete_states, state), n = np.split(rows, np.cumsum(self.widths)[:-1], axis=1), self.compiled.n
        joints = len(self.compiled.source.clearances)
        return Steps(
            head[:, RECORD_T],
            y[:, :n],
            y[:, n : 2 * n],
            y[:, 2 * n :],
            discrete_states[:, : self.compiled.n_discrete_states],
            state[:, :joints].astype(np.int8),
            head[:, RECORD_JUMPED] > 0.0,
        )


class StepCollector:
    """Collect the states of a run with a time loop in Python, and pass them in blocks to the observer, if any."""

    def __init__(self, compiled: CompiledModel, observer: StepCallback | None) -> None:
        self.n, self.observer = compiled.n, observer
        self.waiting: list[Steps] = []

    def add_states(self, t: Array, y: Array, discrete_states: Array, state: NDArray[Any], is_after_jump: bool) -> None:
        """Add states (k, 2n + 3) at times t (k,), all with the same discrete states and contact codes.

        `is_after_jump`: whether something jumped before the first. A full block is passed to the observer.
        """
        k, n = len(t), self.n
        first = np.arange(k) < int(is_after_jump)
        repeated = np.tile(discrete_states, (k, 1)), np.tile(state, (k, 1))
        self.waiting.append(Steps(t, y[:, :n], y[:, n : 2 * n], y[:, 2 * n :], *repeated, first))
        if sum(map(len, self.waiting)) >= N_ROWS_OF_BLOCK:
            self.flush_states()

    def flush_states(self) -> None:
        """Pass the collected states to the observer in one block and clear them; without an observer, discard them."""
        waiting, self.waiting = self.waiting, []
        if self.observer and waiting:
            columns = zip(*(vars(steps).values() for steps in waiting), strict=True)
            self.observer(Steps(*(np.concatenate(column) for column in columns)))


class KinematicStepLog:
    """Collect the states of a kinematic motion (engine/kinematic), add their works, and pass them to an observer."""

    def __init__(
        self, compiled: CompiledModel, observer: StepCallback, allocate_struct: Callable[[], NDArray[Any]], first: Steps
    ) -> None:
        self.compiled, self.observer, self.last = compiled, observer, first
        self.rows = np.zeros((N_ROWS_OF_BLOCK, 1 + 2 * compiled.n))
        self.waiting: list[Array] = []  # rows of a chunk that an event may yet cut off
        self.works = allocate_struct()  # a separate struct of C for the works
        observer(first)

    def register_record_buffer(self, motion_struct: Any, rows: int = N_ROWS_OF_BLOCK) -> None:
        """Make C record the states of the motion in the first `rows` rows from now on; with 0, end the recording."""
        lib, where = self.compiled.lib, self.compiled.pointer(self.rows, is_written=True)
        lib.gudgeon_kinematic_set_recording(motion_struct, where if rows else self.compiled.ffi.NULL, rows)

    def collect_steps(self, motion_struct: Any) -> None:
        """Copy the states that C has written since the last call, and clear C's list.

        They wait for the next call of `flush_states`, because an event may discard them.
        """
        count = int(self.compiled.lib.gudgeon_kinematic_fetch_records(motion_struct))
        if count:
            self.waiting.append(self.rows[:count].copy())

    def flush_states(self, p: Array, end: tuple[float, Array, Array] | None = None) -> None:
        """Pass the collected states to the observer in blocks, with parameter values p, and clear them.

        `end`: last state (t, q, q̇) if an event ends the motion; states after it are dropped. States that were passed
        before are skipped. `end` None: all states are passed.
        """
        rows = np.concatenate(self.waiting) if self.waiting else self.rows[:0]
        self.waiting = []
        if end is not None:
            rows = np.concatenate([rows[rows[:, 0] < end[0]], np.hstack(end)[None]])
        rows = rows[rows[:, 0] > self.last.t[0]]
        for first in range(0, len(rows), N_ROWS_OF_BLOCK):
            self._pass_states(rows[first : first + N_ROWS_OF_BLOCK], p)

    def _pass_states(self, rows: Array, p: Array) -> None:
        """Compute the works of a block of states (k, 1 + 2n): t, q, q̇, and pass both to the observer as Steps.

        Works continue those of the last state that was passed, and are NaN after a failure. The last state is stored.
        """
        n, count, pointer = self.compiled.n, len(rows), self.compiled.pointer
        t, q, v = rows[:, 0].copy(), rows[:, 1 : 1 + n].copy(), rows[:, 1 + n :].copy()
        work, done = np.full((count + 1, N_WORK), np.nan), np.zeros(1, dtype=np.int_)
        work[0] = self.last.work[0]
        motion = tuple(
            np.concatenate([old, new]) for old, new in ((self.last.t, t), (self.last.q, q), (self.last.v, v))
        )
        status = self.compiled.lib.gudgeon_kinematic_works(
            pointer(self.works, "void *"),
            count,
            pointer(motion[0]),
            pointer(p),
            pointer(motion[1]),
            pointer(motion[2]),
            pointer(work, is_written=True),
            pointer(done, "long *", True),
        )
        if status:  # the works of the samples report the error
            work[int(done[0]) + 1 :] = np.nan
        none = np.zeros((count, 0))
        steps = Steps(t, q, v, work[1:], none, none.astype(np.int8), np.zeros(count, dtype=bool))
        self.last = steps[-1:]
        self.observer(steps)
