"""The audit of a run's samples: what is reported there against equations that produced none of it.

The checks of steps are C's (engine/run/audit.c). Here the reported accelerations, torques and forces are held against
the change of energy, sampled forces against the list of contacts, and the works against the energy of the motion.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from gudgeon.contract.audit import FAILS, Finding
from gudgeon.errors import SolverError
from gudgeon.integrators.trajectory import Problem, Trajectory
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.evaluation import Evaluation
from gudgeon.model.sizes import mechanism_sizes

SAMPLES = 8  # drawn samples whose power is balanced
POWER = 1e-6  # of the largest terms
ENERGY = 1e3  # times rtol and the root of the number of steps, of the energy that was turned over
LEAST_ENERGY = 1e-9  # the same, at least: sums of works are rounded
FORCE = 1e-6  # of a joint's largest force, that an open joint may seem to bear
PEAK = 1e-3  # of the largest force of its contacts, that the peak of a joint may exceed it by
ROWS = 1e-9  # of the size, and of the speed
APART = 1e-5  # of the time in which the motion turns by a radian: steps of differences


def audit_samples(
    compiled: CompiledModel, problem: Problem, x: Trajectory, evaluation: Evaluation, balance: tuple[float, float]
) -> tuple[Finding, ...]:
    """Return the findings of all checks of samples that apply to the run; none where the audit is switched off."""
    if not problem.audit or not len(x.t):
        return ()
    source = compiled.source
    found = [*_contacts(compiled, x, evaluation)]
    if not source.massless and not source.indeterminate:
        found += _energy(problem, x, balance)
        found += _power(compiled, problem, x, evaluation)
    if problem.method == "kinematic":
        found += _rows(compiled, problem, x)
    return tuple(found)


def failed(findings: tuple[Finding, ...]) -> bool:
    """Whether a check of samples ends the run with an error."""
    return any(not one.worst <= FAILS for one in findings)


def _energy(problem: Problem, x: Trajectory, balance: tuple[float, float]) -> Iterator[Finding]:
    """The balance of the whole run; a fixed step has no tolerance to compare it with."""
    residual, turned = balance
    if math.isfinite(problem.step) or problem.method == "kinematic" or not (math.isfinite(residual) and turned > 0.0):
        return
    share = max(ENERGY * problem.rtol * math.sqrt(x.counts.steps + 1.0), LEAST_ENERGY)
    yield Finding("energy", residual / (share * turned), float(x.t[-1]), "")


def _contacts(compiled: CompiledModel, x: Trajectory, evaluation: Evaluation) -> Iterator[Finding]:
    """Forces of samples outside contacts, and peaks against the forces of contacts, of joints without a film."""
    for k, joint in enumerate(compiled.source.clearances):
        if joint.film or joint.name in compiled.source.rigid:
            continue
        force = np.hypot(evaluation.clearance[:, k, 0], evaluation.clearance[:, k, 1])
        peak, own = float(x.peaks[k, 0]), x.impacts[x.impacts["joint"] == k]
        outside = np.where(np.isnan(x.memory[:, k]), force, 0.0)
        worst = int(outside.argmax())
        scale = max(FORCE * max(peak, float(force.max())), 1e-300)
        yield Finding("sample", float(outside[worst]) / scale, float(x.t[worst]), joint.name)
        listed = float(own["F_peak"].max(initial=0.0))
        if peak > 0.0 and _begins_free(x, k):
            over = (max(peak, float(force.max())) - listed) / (PEAK * max(listed, 1e-300))
            yield Finding("peak", max(over, 0.0), float(x.peaks[k, 1]), joint.name)


def _begins_free(x: Trajectory, k: int) -> bool:
    """Whether joint k was open at the first sample: a contact that a run resumes has a peak before it."""
    return bool(np.isnan(x.memory[0, k]))


def _power(compiled: CompiledModel, problem: Problem, x: Trajectory, evaluation: Evaluation) -> Iterator[Finding]:
    """v · M a + dV/dt = powers of drives, force elements and joints with play, at drawn samples."""
    rng, N = np.random.default_rng(1), len(x.t)
    at = np.unique(rng.integers(0, N, SAMPLES)) if N > SAMPLES else np.arange(N)
    p, mass = problem.p, compiled.mass(problem.p)
    t, q, v, a = x.t[at], x.q[at], x.v[at], evaluation.a[at]
    kinetic = v * mass * a
    size = max(float(mechanism_sizes(compiled.source, p)), 1e-300)
    units = np.array([1.0 if name.endswith(".theta") else size for name in compiled.source.coordinates])
    with np.errstate(all="ignore"):
        rate = np.maximum(np.abs(v / units).max(axis=1), np.sqrt(np.abs(a / units).max(axis=1)))
    h = np.where(rate > 0.0, APART / np.maximum(rate, 1e-300), 0.0)
    try:
        near = [compiled.evaluate(t, q + way * h[:, None] * v, v, x.memory[at], p, parts=("energy",)).energy[:, 1]
                for way in (-1.0, 1.0)]  # fmt: skip
    except SolverError:  # next to a singular position
        return
    with np.errstate(all="ignore"):
        stored = np.where(h > 0.0, (near[1] - near[0]) / (2.0 * h), 0.0)
    powers = evaluation.power[at]
    rounding = 4e-16 * np.abs(near[1]) / np.maximum(h, 1e-300)
    scale = np.abs(kinetic).sum(axis=1) + np.abs(powers).sum(axis=1) + np.abs(stored) + rounding / POWER
    residual = kinetic.sum(axis=1) + stored - powers.sum(axis=1)
    yield _worst("power", residual, scale, t)
    drives = [k for k, row in enumerate(compiled.source.rows) if row.kind == "drive"]
    if drives:
        rates = np.array([compiled.nu(float(s), one, p)[drives] for s, one in zip(t, q, strict=True)])
        each = evaluation.torques[at] * rates
        yield _worst("torque", each.sum(axis=1) - powers[:, 0], np.abs(each).sum(axis=1) + np.abs(powers[:, 0]), t)


def _worst(check: str, residual: Array, scale: Array, t: Array) -> Finding:
    """The largest share of a residual, as a multiple of POWER."""
    share = np.where(np.isfinite(residual), np.abs(residual), 0.0) / np.maximum(scale, 1e-300)
    k = int(share.argmax())
    return Finding(check, float(share[k]) / POWER, float(t[k]), "")


def _rows(compiled: CompiledModel, problem: Problem, x: Trajectory) -> Iterator[Finding]:
    """Positions and velocities of all rows at drawn samples of a kinematic run."""
    rng, N, p = np.random.default_rng(2), len(x.t), problem.p
    size = max(float(mechanism_sizes(compiled.source, p)), 1e-300)
    worst = Finding("rows", 0.0, float(x.t[0]), "")
    for k in np.unique(rng.integers(0, N, SAMPLES)).tolist():
        t, q, v = float(x.t[k]), x.q[k], x.v[k]
        phi, rate = compiled.phi(t, q, p), compiled.phi_q(t, q, p) @ v - compiled.nu(t, q, p)
        angle = max(1.0, float(np.abs(q[2::3]).max(initial=0.0)))
        speed = max(float(np.abs(v).max(initial=0.0)), 1e-300)
        for r, row in enumerate(compiled.source.rows):
            of = size + float(np.abs(q).max(initial=0.0)) if row.unit == "m" else angle
            value = max(abs(float(phi[r])) / (ROWS * of), abs(float(rate[r])) / (10.0 * ROWS * speed * max(of, 1.0)))
            if not value <= worst.worst:
                worst = Finding("rows", value, t, row.name)
    yield worst
