"""Check the samples of a finished run, which are evaluated block by block: energy balance, audit, notes.

A long run is never evaluated as a whole: the evaluation of a sample takes twice the memory of its state.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from gudgeon.contract.audit import Finding
from gudgeon.contract.boundary import MAX_STICK_SPEED, MODE_CONSTRAINED
from gudgeon.integrators.trajectory import Problem, Trajectory
from gudgeon.model.compiled import Array
from gudgeon.model.evaluation import FIELD_NAMES, Evaluation
from gudgeon.results.results import EvaluatedSamples, make_evaluated_samples
from gudgeon.results.samples import select_samples
from gudgeon.simulation.audit import SampleAudit
from gudgeon.simulation.undefined_outputs import UndefinedOutputs

MAX_STORED = 20_000  # samples up to which the evaluation is stored with the Result; longer runs are checked in blocks
MAX_RELATIVE_RESIDUAL = 1e-4  # of the energy throughput: a larger residual of rk4 is reported
POLLED_SAMPLES = 1 << 16  # samples of the energy balance between two polls for cancellation


@dataclass(frozen=True)
class CheckedSamples:
    """Hold the evaluation of the samples of a run, and the results of its checks."""

    evaluation: Evaluation | None  # of all samples; None: more than MAX_STORED, they are evaluated again on request
    a: Array | None  # (N, n) q̈; None for more than MAX_STORED samples without stored accelerations
    balance: tuple[float, float]  # largest residual of the energy balance, energy throughput (J)
    findings: tuple[Finding, ...]  # of the audit of the samples
    notes: tuple[str, ...]


def check_samples(
    problem: Problem,
    trajectory: Trajectory,
    times: Array,
    poll: Callable[[], object],
) -> CheckedSamples:
    """Evaluate all samples of a run at `times` (N,), s, and check them.

    `poll` polls for cancellation; its exceptions are passed on. Raises SingularError for a sample without
    accelerations.
    """
    compiled, N = problem.compiled, len(trajectory.t)
    audit, outputs = SampleAudit(problem, trajectory), UndefinedOutputs(compiled.source)
    skipped = int(not problem.start_is_sample and N > 1)  # the start was not requested
    energy, slip, a, start = list[Array](), list[Array](), trajectory.a, None
    for first in range(0, max(N, 1), MAX_STORED):
        rows = slice(first, first + MAX_STORED)
        evaluation = compiled.evaluate(
            times[rows], trajectory.q[rows], trajectory.v[rows], trajectory.memory[rows], problem.values_of_motion, poll
        )
        energy.append(evaluation.energy)
        slip.append(evaluation.friction[:, :, 1])
        audit.add_samples(first, evaluation)
        if a is not None and N and first + MAX_STORED >= N and times[-1] < trajectory.t[-1]:  # the limit from the left
            a = np.append(a[:-1], evaluation.a[-1:], axis=0)
        if outputs.expressions:
            samples = _make_samples(problem, trajectory, rows, a, evaluation)
            if not first and (skipped or N > MAX_STORED):
                start = select_samples(samples, lambda x: x[:1])
            if skipped and not first:
                samples = select_samples(samples, lambda x: x[1:])
            samples.start_row = start if first or skipped else None
            outputs.add_samples(samples)
    all_energy, all_slip = (parts[0] if len(parts) == 1 else np.concatenate(parts) for parts in (energy, slip))
    balance = compute_energy_balance(all_energy, trajectory.work, poll)
    notes = (
        ()
        if compiled.source.massless_bodies
        else _build_non_finite_energy_note(trajectory.t, all_energy, trajectory.work, balance[0])
    )
    notes += () if compiled.source.massless_bodies else _build_coarse_step_note(problem, *balance)
    notes += outputs.build_notes()
    if compiled.source.frictions:
        notes += _build_undetermined_friction_notes(
            problem, trajectory.t[skipped:], trajectory.memory[skipped:], all_slip[skipped:]
        )
    is_whole = N <= MAX_STORED
    return CheckedSamples(
        evaluation if is_whole else None,
        evaluation.a if is_whole and a is None else a,
        balance,
        audit.build_findings(balance),
        notes,
    )


def _make_samples(
    problem: Problem, trajectory: Trajectory, rows: slice, a: Array | None, evaluation: Evaluation
) -> EvaluatedSamples:
    """Return the samples `rows` of a run as a result without diagnostics, with their evaluation.

    `a` (N, n): accelerations of all samples of the run; None: those of the evaluation.
    """
    samples = make_evaluated_samples(
        problem.compiled.source,
        problem.compiled,
        problem.p,
        trajectory.t[rows],
        trajectory.q[rows],
        trajectory.v[rows],
        trajectory.work[rows],
        trajectory.memory[rows],
        trajectory.state[rows],
        FIELD_NAMES,
    )
    samples.accelerations = None if a is None else a[rows]
    samples.__dict__["evaluation"] = evaluation  # a cached property: not computed again
    return samples


def compute_energy_balance(energy: Array, work: Array, poll: Callable[[], object]) -> tuple[float, float]:
    """Return the largest residual of the energy balance and the energy throughput of a run, both in J.

    Throughput: the sum of |ΔW| of each work over the intervals between samples, plus the range of the kinetic energy.
    `energy` (N, 2): kinetic and potential; `work` (N, 3): works of drives, force elements and joints with play since
    the start. Both results are NaN without samples.
    An impact at the very start has done its work before the first sample. `poll` polls for cancellation between blocks;
    its exceptions are passed on.
    """
    if not len(energy):  # the run failed at its start, which has no accelerations
        return math.nan, math.nan
    residual_max = throughput = 0.0
    kinetic, potential = energy.T
    by_drives, by_forces, by_clearances = work.T
    with np.errstate(invalid="ignore", over="ignore"):  # infinities: reported by `_build_non_finite_energy_note`
        for first in range(0, len(energy), POLLED_SAMPLES):
            rows, following = slice(first, first + POLLED_SAMPLES), slice(first + 1, first + POLLED_SAMPLES + 1)
            change = (kinetic[rows] + potential[rows]) - (kinetic[0] + potential[0])
            total = by_drives[rows] + by_forces[rows] + by_clearances[rows]
            residual = change - (total - (by_drives[0] + by_forces[0] + by_clearances[0]))
            residual_max = float(np.maximum(residual_max, np.abs(residual).max()))  # NaN stays NaN
            later = work[following]
            throughput += float(np.abs(later - work[first : first + len(later)]).sum())
            poll()
        return residual_max, throughput + float(kinetic.max() - kinetic.min())


def _build_coarse_step_note(problem: Problem, residual: float, throughput: float) -> tuple[str, ...]:
    """Return a note if the energy residual of a run with fixed steps exceeds MAX_RELATIVE_RESIDUAL, else ().

    `residual`, `throughput`: of the energy balance (J). Methods with error control get no note.
    """
    if math.isinf(problem.step) or not residual > MAX_RELATIVE_RESIDUAL * throughput:
        return ()
    return (
        f"the energy residual is {residual:.3g} J at an energy throughput of {throughput:.3g} J: a step of"
        f" {problem.step:.3g} s is too long for these forces; compare with a shorter step or with method auto",
    )


def _build_non_finite_energy_note(t: Array, energy: Array, work: Array, residual: float) -> tuple[str, ...]:
    """Return a note if the energy residual `residual` (J) is not finite, with the time of the first such sample; else
    ().
    """
    if math.isfinite(residual) or not len(t):
        return ()
    with np.errstate(invalid="ignore"):
        is_finite = np.isfinite(energy.sum(axis=1) + work.sum(axis=1))
    k = int(is_finite.argmin()) if not is_finite.all() else 0
    subject = "the energy" if not np.isfinite(energy[k]).all() else "the work"
    return (f"the energy residual is not known: {subject} is not finite at t = {t[k]:.9g} s",)


def _build_undetermined_friction_notes(problem: Problem, t: Array, memory: Array, slips: Array) -> tuple[str, ...]:
    """Return a note for each friction that drives or other frictions hold at rest over successive samples.

    Its force is not determined. Frictions without a static limit are skipped. `slips` (N, n_frictions).
    """
    source, notes = problem.compiled.source, list[str]()
    for k, name in enumerate(source.frictions):
        mode, slip = memory[:, len(source.clearances) + k], slips[:, k]
        rests = (mode != 0.0) & ((mode == MODE_CONSTRAINED) | (np.abs(slip) <= MAX_STICK_SPEED))
        rests_successively = rests[1:] & rests[:-1]
        static = source.parameter_indices.get(
            f"forces.{name}.static"
        )  # None: the file has 0 N, which no parameter changes
        if rests_successively.any() and static is not None and problem.p[static] > 0.0:
            t_rest, count = float(t[rests_successively.argmax()]), f"{int(rests.sum())} of {len(rests)} samples"
            notes.append(
                f"drives or other friction hold friction {name} at rest from t = {t_rest:.9g} s on, in {count}: its"
                " force within the static limit, drive torques and reactions are not determined there; the run has the"
                " last sliding force, or 0"
            )
    return tuple(notes)
