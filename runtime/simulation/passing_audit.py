"""Decide in C whether the samples of a short run pass all checks of audit.py; most runs do.

Findings are then built only when the diagnostics of the run are read. Where C does not decide, the findings of audit.py
do (engine/scene/audit_samples.c).
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.boundary import AUDIT_FAILS, AUDIT_ON, COUNT_NAMES, N_ENERGY
from gudgeon.integrators.trajectory import Problem, Trajectory
from gudgeon.model.cached_values import cache_by_values
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.evaluation import FIRST_CHUNK_SAMPLES
from gudgeon.simulation.audit import (
    LIMITS,
    MAX_CALLS_OF_SHORT_RUN,
    MIN_CALLS_OF_LONG_RUN,
    MIN_SAMPLES,
    check_energy_balance,
    has_failed_finding,
    list_inapplicable_checks,
    select_audit_samples,
)
from gudgeon.simulation.sample_checks import compute_energy_balance

MAX_SAMPLES = FIRST_CHUNK_SAMPLES  # of a short run
_ARRAYS = ("y", "discrete_states", "p", "audit_values", "start", "size")  # of a run, that C reads
RIGHT_HAND_SIDES = COUNT_NAMES.index("right_hand_sides")  # column of the counts of a run


def passes_audit(problem: Problem, trajectory: Trajectory, times: Array) -> bool:
    """Return whether no check of the steps and samples of a short run fails; False: not known, findings are needed.

    A short run has 1 to MAX_SAMPLES samples and at most MIN_CALLS_OF_LONG_RUN evaluations; longer runs need the
    equations of single bodies. C integrated it to its end, without a progress callback, in a scene with all masses and
    reactions. `times` (N,): times (s) at which the samples are evaluated.

    The result is False for audit="full", for a contact or film force at any sample, and for values that are not finite.
    Without an audit, it is True if all samples can be evaluated.
    """
    compiled, n_samples, block = problem.compiled, len(times), trajectory.block
    if not (
        block is not None
        and 0 < n_samples <= MAX_SAMPLES
        and trajectory.stopped is None
        and problem.progress is None
        and not trajectory.interrupted
        and compiled.has_all_forces
    ):
        return False
    right_hand_sides, is_audited = block["counts"].item(0, RIGHT_HAND_SIDES), problem.audit == AUDIT_ON
    if right_hand_sides > MIN_CALLS_OF_LONG_RUN or (problem.audit and not is_audited):
        return False
    is_resumed, ffi = problem.state is not None, compiled.ffi
    checks = _prepare_checks(
        compiled, n_samples, problem.method, right_hand_sides <= MAX_CALLS_OF_SHORT_RUN, is_resumed
    )
    energies = np.empty((n_samples, N_ENERGY))
    y, discrete, p, audited, start, size = block.find_pointers(ffi, _ARRAYS)
    passes = compiled.lib.gudgeon_check_samples(
        n_samples,
        compiled.pointer(times),
        y,
        discrete,
        p,
        compiled.pointer(energies, is_written=True),
        audited,
        checks.limits if is_audited else ffi.NULL,
        max(size[0], 1e-300),
        ffi.NULL if is_resumed or compiled.source.rigid_joints else start,
        *checks.sample_indices,
    )
    if not (passes and is_audited and n_samples >= MIN_SAMPLES):
        return bool(passes)
    balance, largest = compute_energy_balance(energies, trajectory.work, lambda: None), float(np.abs(energies).max())
    findings = check_energy_balance(compiled, problem, trajectory, largest, balance, max(size[0], 1e-300))
    return not has_failed_finding(tuple(findings))


class _Checks(NamedTuple):
    """Hold arguments of gudgeon_check_samples that do not depend on the values of a run."""

    limits: Any  # pointer to the errors at which runs fail; infinity for checks that are left out
    sample_indices: tuple[int, Any]  # number of pseudo-random samples, and pointer to their indices
    arrays: tuple[NDArray[Any], ...]  # to which the pointers point


@cache_by_values
def _prepare_checks(compiled: CompiledModel, n_samples: int, method: str, is_short: bool, is_resumed: bool) -> _Checks:
    """Return limits and pseudo-random samples of a run with `n_samples` samples; `is_short`: it has few right-hand
    sides.

    The first sample of a resumed run is left out, whose state may violate the constraints.
    """
    left_out = list_inapplicable_checks(compiled.source, method)
    limits = np.array([np.inf if check in left_out else AUDIT_FAILS * limit for check, limit in LIMITS.items()])
    sample_indices = select_audit_samples(n_samples, AUDIT_ON, 0 if is_short else MIN_CALLS_OF_LONG_RUN).astype(np.int_)
    sample_indices = sample_indices[sample_indices > 0] if is_resumed and n_samples > 1 else sample_indices
    return _Checks(
        compiled.pointer(limits),
        (len(sample_indices), compiled.pointer(sample_indices, "long *")),
        (limits, sample_indices),
    )
