"""Decide in C whether the samples of a run pass all checks of audit.py; most runs do.

Findings are then built only when the diagnostics of the run are read. Where C does not decide, the findings of audit.py
do (engine/scene/audit_samples.c).
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.boundary import AUDIT_FAILS, AUDIT_ON, COUNT_NAMES, N_ENERGY, PEAK_F
from gudgeon.integrators.trajectory import Problem, Trajectory
from gudgeon.model.cached_values import cache_by_values
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.evaluation import FIRST_CHUNK_SAMPLES
from gudgeon.simulation.audit import (
    BODY_LIMIT,
    LIMITS,
    MAX_CALLS_OF_SHORT_RUN,
    MIN_CALLS_OF_LONG_RUN,
    MIN_SAMPLES,
    ContactForces,
    check_contact_forces,
    check_energy_balance,
    has_failed_finding,
    list_audited_joints,
    list_inapplicable_checks,
    select_audit_samples,
)
from gudgeon.simulation.newton_euler import make_body_force_table
from gudgeon.simulation.sample_checks import compute_energy_balance

MAX_SAMPLES = FIRST_CHUNK_SAMPLES  # of a run that C checks in one call
_ARRAYS = ("y", "discrete_states", "p_motion", "audit_values", "start", "size")  # of a run, that C reads
RIGHT_HAND_SIDES = COUNT_NAMES.index("right_hand_sides")  # column of the counts of a run


def passes_audit(problem: Problem, trajectory: Trajectory, times: Array) -> bool:
    """Return whether no check of the steps and samples of a run fails; False: not known, findings are needed.

    The run has 1 to MAX_SAMPLES samples. C integrated it to its end, without a progress callback, in a scene with all
    masses and reactions. `times` (N,): times (s) at which the samples are evaluated.

    The result is False for audit="full" and for values that are not finite. Without an audit, it is True if all samples
    can be evaluated.
    """
    compiled, n_samples, block = problem.compiled, len(times), trajectory.block
    is_audited = problem.audit == AUDIT_ON
    if not (
        block is not None
        and 0 < n_samples <= MAX_SAMPLES
        and trajectory.stopped is None
        and problem.progress is None
        and not trajectory.interrupted
        and compiled.has_all_forces
        and (is_audited or not problem.audit)
    ):
        return False
    right_hand_sides = block["counts"].item(0, RIGHT_HAND_SIDES)
    is_resumed, ffi = problem.state is not None, compiled.ffi
    checks = _prepare_checks(
        compiled, n_samples, problem.method, right_hand_sides <= MAX_CALLS_OF_SHORT_RUN, is_resumed
    )
    checks_bodies = right_hand_sides > MIN_CALLS_OF_LONG_RUN
    energies, n_joints = np.empty((n_samples, N_ENERGY)), len(compiled.source.clearances)
    forces = np.zeros((max(n_joints, 1), len(ContactForces.COLUMNS)))
    y, discrete, p, audited, start, size = block.find_pointers(ffi, _ARRAYS)
    passes = compiled.lib.gudgeon_check_samples(
        n_samples,
        compiled.pointer(times),
        y,
        discrete,
        p,
        compiled.pointer(energies, is_written=True),
        compiled.pointer(forces, is_written=True),
        audited,
        checks.limits if is_audited else ffi.NULL,
        max(size[0], 1e-300),
        ffi.NULL if is_resumed or compiled.source.rigid_joints else start,
        *checks.sample_indices,
        make_body_force_table(compiled)[0] if checks_bodies else ffi.NULL,
    )
    if not (passes and is_audited):
        return bool(passes)
    if n_joints and (forces.any() or trajectory.peaks[:, PEAK_F].any()):
        joints = list_audited_joints(compiled.source)
        contact_forces = [ContactForces(*forces[k].tolist()) for k in joints]
        if has_failed_finding(tuple(check_contact_forces(compiled.source, trajectory, joints, contact_forces))):
            return False
    if n_samples < MIN_SAMPLES:
        return True
    balance, largest = compute_energy_balance(energies, trajectory.work, lambda: None), float(np.abs(energies).max())
    findings = check_energy_balance(compiled, problem, trajectory, largest, balance, max(size[0], 1e-300))
    return not has_failed_finding(tuple(findings))


class _Checks(NamedTuple):
    """Hold arguments of gudgeon_check_samples that do not depend on the values of a run."""

    limits: Any  # pointer to the errors at which runs fail, the last one of bodies; infinity for checks left out
    sample_indices: tuple[int, Any]  # number of pseudo-random samples, and pointer to their indices
    arrays: tuple[NDArray[Any], ...]  # to which the pointers point


@cache_by_values
def _prepare_checks(compiled: CompiledModel, n_samples: int, method: str, is_short: bool, is_resumed: bool) -> _Checks:
    """Return limits and pseudo-random samples of a run with `n_samples` samples; `is_short`: it has few right-hand
    sides.

    The first sample of a resumed run is left out, whose state may violate the constraints.
    """
    left_out = list_inapplicable_checks(compiled.source, method)
    limits = np.array(
        [np.inf if check in left_out else AUDIT_FAILS * limit for check, limit in (LIMITS | BODY_LIMIT).items()]
    )
    sample_indices = select_audit_samples(n_samples, AUDIT_ON, 0 if is_short else MIN_CALLS_OF_LONG_RUN).astype(np.int_)
    sample_indices = sample_indices[sample_indices > 0] if is_resumed and n_samples > 1 else sample_indices
    return _Checks(
        compiled.pointer(limits),
        (len(sample_indices), compiled.pointer(sample_indices, "long *")),
        (limits, sample_indices),
    )
