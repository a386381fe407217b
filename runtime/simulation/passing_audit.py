"""Decide by few comparisons whether the samples of a short run pass all checks of audit.py; most runs do.

Then no finding is built before somebody reads the run's diagnostics. Where a comparison does not decide, the findings
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
from gudgeon.model.evaluation import FIRST, Evaluation, view_evaluation
from gudgeon.simulation.audit import (
    LIMITS,
    MIN_CALLS_OF_LONG_RUN,
    MIN_SAMPLES,
    check_energy_balance,
    choose_samples,
    draw_samples,
    has_failed_finding,
    list_checks_left_out,
)
from gudgeon.simulation.sample_checks import compute_energy_balance

MAX_SAMPLES = FIRST  # which C evaluates in one call


def is_short_run(problem: Problem, trajectory: Trajectory) -> bool:
    """Return whether ShortRunSamples may decide: few samples and steps, run to its end by C, in a scene with forces.

    The equations of single bodies are checked in runs of more steps only.
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
    """Evaluate all samples of a short run at `times` (N,), s, and compare what the audit compares.

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
        """Return whether no check of the run fails, neither of its steps nor of its samples; False: unknown."""
        problem, layout = self.problem, self.layout
        if not problem.audit:
            return True
        if problem.audit != AUDIT_ON or self.trajectory.may_fail_audit:
            return False
        clearances = self.values[layout.clearances].reshape(-1, N_CLEARANCE_COLUMNS)
        if np.count_nonzero(clearances[:, :2]) or not math.isfinite(np.add.reduce(self.values)):
            return False  # a force, which only a contact or a film may have
        return self._begins_at_start() and self._balances_energy() and self._passes_at_drawn_samples()

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
        """Return whether the first sample is surely nearer to the start than allowed; a resumed run need not be."""
        problem, motion = self.problem, self.motion
        if problem.state is not None or problem.compiled.source.rigid:
            return True
        if problem.allowed_start_error is None:
            return False
        error = motion[:, 0].copy()
        error[0] -= problem.q
        error[1] -= problem.v
        return b"\0" not in (np.abs(error) <= problem.allowed_start_error).tobytes()  # quicker than all()

    def _passes_at_drawn_samples(self) -> bool:
        """Return whether power, torques and constraint equations at the drawn samples are within the limits."""
        problem, x, compiled, layout = self.problem, self.trajectory, self.problem.compiled, self.layout
        t, state, n, pointer = self.t, self.state, len(x.t), compiled.pointer
        if n > layout.n_undrawn or problem.state is not None:
            samples = draw_samples(problem, x)
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
    """Hold where quantities lie in the block of a run's samples, and what else depends on the scene alone."""

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
    """Return the layout of the block of so many samples."""
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
        len(choose_samples(MAX_SAMPLES, AUDIT_ON, 0)),
        np.array([np.inf if check in left_out else AUDIT_FAILS * limit for check, limit in LIMITS.items()]),
    )
