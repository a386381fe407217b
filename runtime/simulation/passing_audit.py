"""Decide by few comparisons whether the samples of a short run pass all checks of audit.py; most runs do.

Findings are then built only when the diagnostics of the run are read. Where a comparison does not decide, the findings
of audit.py do.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.boundary import AUDIT_FAILS, AUDIT_ON, N_CLEARANCE_COLUMNS
from gudgeon.integrators.trajectory import Problem, Trajectory
from gudgeon.model.cached_values import cache_by_values
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.evaluation import FIRST_CHUNK_SAMPLES, Evaluation, view_evaluation
from gudgeon.simulation.audit import (
    LIMITS,
    MIN_CALLS_OF_LONG_RUN,
    MIN_SAMPLES,
    check_energy_balance,
    has_failed_finding,
    list_checks_left_out,
    select_audit_samples,
    select_audit_samples_of_run,
)
from gudgeon.simulation.sample_checks import compute_energy_balance

MAX_SAMPLES = FIRST_CHUNK_SAMPLES  # which C evaluates in one call


def is_short_run(problem: Problem, trajectory: Trajectory) -> bool:
    """Return whether ShortRunSamples may audit a run.

    The run has 1 to MAX_SAMPLES samples and at most MIN_CALLS_OF_LONG_RUN evaluations; longer runs need the equations
    of single bodies. C integrated it to its end, without a progress callback. The scene has all masses and reactions.
    """
    return (
        0 < len(trajectory.t) <= MAX_SAMPLES
        and trajectory.counts.right_hand_sides <= MIN_CALLS_OF_LONG_RUN
        and trajectory.a is None
        and trajectory.stopped is None
        and problem.progress is None
        and not trajectory.interrupted
        and problem.compiled.has_all_forces
    )


class ShortRunSamples:
    """Evaluate all samples of a short run at `times` (N,), s, and audit them without findings.

    Raises SingularError for a sample without accelerations.
    """

    def __init__(self, problem: Problem, trajectory: Trajectory, times: Array) -> None:
        compiled, x, N = problem.compiled, trajectory, len(trajectory.t)
        self.problem, self.trajectory = problem, trajectory
        self.layout = layout = _compute_block_layout(compiled, N, problem.method)
        self.block = block = np.empty(layout.n_total)
        self.values = values = block[: layout.n_values]
        values.fill(np.nan)
        self.motion = motion = block[layout.n_values : layout.first_error].reshape(2, N, compiled.n)
        motion[0], motion[1] = x.q, x.v
        pointer = compiled.pointer
        self.pointer = first = pointer(block, is_written=True)
        self.t, self.p = pointer(x.t), pointer(problem.p)
        memory = pointer(x.memory) if compiled.n_memory else first
        self.state = first + layout.n_values, first + (layout.n_values + N * compiled.n), memory
        time, failed = self.t if times is x.t else pointer(times), compiled.ffi.new("long *")
        results = [first + offset for offset in layout.offsets]
        status = compiled.lib.gudgeon_evaluate(N, time, *self.state, self.p, *results, failed)
        if status:
            compiled.check_pivot(status, float(times[failed[0]]), p=problem.p)

    def build_evaluation(self) -> Evaluation:
        """Return the evaluated quantities as views of a new block."""
        return view_evaluation(self.problem.compiled, self.values.copy(), len(self.trajectory.t))

    def passes_audit(self) -> bool:
        """Return whether no check of the steps and samples of the run fails; False: not known, findings are needed.

        It is False for audit="full", for a contact or film force at any sample, and for values that are not finite.
        """
        problem, layout = self.problem, self.layout
        if not problem.audit:
            return True
        if problem.audit != AUDIT_ON or self.trajectory.may_fail_audit:
            return False
        clearances = self.values[layout.clearances].reshape(-1, N_CLEARANCE_COLUMNS)
        if np.count_nonzero(clearances[:, :2]) or not math.isfinite(np.add.reduce(self.values)):
            return False  # forces of contacts and films need checks of their own
        return self._begins_at_start() and self._balances_energy() and self._passes_sample_checks()

    def _balances_energy(self) -> bool:
        """Return whether the energy balance is within its tolerance; in a run of few samples it is not checked."""
        problem, x = self.problem, self.trajectory
        if len(x.t) < MIN_SAMPLES:
            return True
        energy = self.values[self.layout.energy].reshape(len(x.t), -1)
        balance, largest = compute_energy_balance(energy, x.work, lambda: None), float(np.abs(energy).max())
        findings = check_energy_balance(problem.compiled, problem, x, largest, balance, max(x.size, 1e-300))
        return not has_failed_finding(tuple(findings))

    def _begins_at_start(self) -> bool:
        """Return whether the first sample differs from the start by no more than `problem.allowed_start_error`.

        Resumed runs and scenes with rigid contacts pass. Without an allowed error, return False.
        """
        problem, motion = self.problem, self.motion
        if problem.state is not None or problem.compiled.source.rigid:
            return True
        if problem.allowed_start_error is None:
            return False
        error = motion[:, 0].copy()
        error[0] -= problem.q
        error[1] -= problem.v
        return b"\0" not in (np.abs(error) <= problem.allowed_start_error).tobytes()  # quicker than all()

    def _passes_sample_checks(self) -> bool:
        """Return whether the checks in C of power, torques and constraint equations pass at pseudo-random samples."""
        problem, x, compiled, layout = self.problem, self.trajectory, self.problem.compiled, self.layout
        t, state, n, pointer = self.t, self.state, len(x.t), compiled.pointer
        if n > layout.n_undrawn or problem.state is not None:
            samples = select_audit_samples_of_run(problem, x)
            n = len(samples)
            drawn = [np.ascontiguousarray(array[samples]) for array in (x.t, *self.motion, x.memory)]
            t, *drawn_state = (pointer(array) if array.size else self.p for array in drawn)
            state = drawn_state[0], drawn_state[1], drawn_state[2]
        errors = self.block[layout.first_error : layout.first_error + n * len(LIMITS)].reshape(n, len(LIMITS))
        errors.fill(0.0)
        size = max(x.size, 1e-300)
        compiled.lib.gudgeon_audit_samples(n, t, *state, self.p, size, self.pointer + layout.first_error)
        return b"\0" not in (errors <= layout.limits).tobytes()  # quicker than all()


class _BlockLayout(NamedTuple):
    """Hold the offsets of quantities in the block of a run's samples, and the limits of the checks."""

    offsets: tuple[int, ...]  # of each field of an Evaluation
    clearances: slice  # of the field of joints with play
    energy: slice  # of the field of energies
    n_values: int  # of all fields; then come the motion, and the errors of samples
    first_error: int
    n_total: int
    n_undrawn: int  # number of samples that are all checked
    limits: NDArray[np.float64]  # errors (len(LIMITS),) at which runs fail; infinity for checks that are left out


@cache_by_values
def _compute_block_layout(compiled: CompiledModel, n_samples: int, method: str) -> _BlockLayout:
    """Return the layout of the block of a run with `n_samples` samples, and the limits of its checks for `method`."""
    source, names = compiled.source, [name for name, *_ in compiled.field_shapes]
    ends = np.cumsum([0, *(n_samples * width for *_, width in compiled.field_shapes)]).tolist()
    first_error = ends[-1] + 2 * n_samples * compiled.n
    clearances, energy = (slice(ends[k], ends[k + 1]) for k in map(names.index, ("clearance", "energy")))
    left_out = list_checks_left_out(source, method)
    return _BlockLayout(
        tuple(ends[:-1]),
        clearances,
        energy,
        ends[-1],
        first_error,
        first_error + n_samples * len(LIMITS),
        len(select_audit_samples(MAX_SAMPLES, AUDIT_ON, 0)),
        np.array([np.inf if check in left_out else AUDIT_FAILS * limit for check, limit in LIMITS.items()]),
    )
