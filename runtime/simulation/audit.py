"""Audit the samples of a run: check reported results with equations that did not produce them.

The audit of the steps is in C (engine/run/audit.c). Here, accelerations, torques and forces are compared with the
rate of change of energy, sampled forces with the list of contacts, and works with the energy of the motion.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from gudgeon.contract.audit import LEVELS, Finding
from gudgeon.contract.boundary import AUDIT_FAILS as FAILS
from gudgeon.contract.boundary import PEAK_F, SHALLOW, CLEARANCE_delta, CLEARANCE_Fx, CLEARANCE_Fy, PEAK_t
from gudgeon.errors import BadValueError
from gudgeon.integrators.trajectory import Problem, Trajectory
from gudgeon.language.argument_checks import message
from gudgeon.model.compiled import CompiledModel
from gudgeon.model.evaluation import Evaluation
from gudgeon.model.sizes import mechanism_sizes
from gudgeon.simulation.newton_euler import newton_euler

DRAWN = np.sort(np.random.default_rng(1).random(8))  # random positions in the run, 0 to 1, of the samples that C checks
# allowed error of each check, relative to the largest terms
LIMITS = {"power": 1e-6, "torque": 1e-6, "rows": 1e-12, "rates": 1e-7}
BODY = {"body": 1e-9}  # the same for the equations of single bodies, relative to the largest force or moment
SHORT = 500  # right-hand sides: in a shorter run, fewer samples are checked to save time
LONG = 2000  # right-hand sides: in a longer run, the equations of single bodies are checked too
NOT_FINITE = 2.0  # a note, not a failure: at a singular position a motion may have no finite accelerations
ENERGY = 1e3  # times rtol times the root of the number of steps: allowed residual relative to the energy throughput
LEAST_ENERGY = 1e-6  # smallest allowed residual, relative to the energy throughput
ENOUGH = 20  # samples: with fewer, the energy throughput is not known
AT_REST = 1e-9  # of the speed that crosses the mechanism during the run: slower motion has an energy of rounding size
LEAST = 1e-250  # J: smaller works have no reliable digits
FORCE = 1e-6  # of a joint's largest force: allowed force of an open joint
# allowed distance of the first sample from the start: of the size, and of the largest speed
START, START_RATES = 1e-9, 1e-6
PEAK = 1e-2  # of the largest force of its contacts: allowed excess of a joint's peak force


def audit_level(audit: bool | str) -> int:
    """Return the level of the audit for C. BadValueError for anything but True, False and "full"."""
    if isinstance(audit, (bool, np.bool_, str)) and audit in LEVELS:
        return LEVELS[audit]
    raise BadValueError(f"audit is {message(audit)}: expected True, False or 'full'", hint="audit=True is the default")


def audit_samples(
    compiled: CompiledModel, problem: Problem, x: Trajectory, evaluation: Evaluation, balance: tuple[float, float]
) -> tuple[Finding, ...]:
    """Return the findings of all checks of samples that apply to the run; an empty tuple without an audit.

    `balance`: largest energy residual and energy throughput (J).
    """
    if not problem.audit or not len(x.t):
        return ()
    source, size = compiled.source, max(float(mechanism_sizes(compiled.source, problem.p)), 1e-300)
    found = [*_check_first_sample(problem, x, size), *_check_contact_forces(compiled, x, evaluation)]
    if not source.massless and not source.indeterminate:
        found += [
            *_check_energy(compiled, problem, x, evaluation, balance, size),
            *_check_finite(compiled, x, evaluation),
        ]
    left_out = set[str]()
    if source.massless or source.indeterminate:
        left_out.add("body")
    if source.massless or source.indeterminate:
        left_out |= {"power", "torque"}
    if problem.method == "rk4" and source.formulation == "full":  # its rows drift
        left_out |= {"rows", "rates", "power", "body"}
    return (
        *found,
        *(one for one in _check_drawn_samples(compiled, problem, x, size, evaluation) if one.check not in left_out),
    )


def failed(findings: tuple[Finding, ...]) -> bool:
    """Return whether a finding about the samples is so bad that the run ends with an error."""
    return any(not one.worst <= FAILS for one in findings)


def _check_first_sample(problem: Problem, x: Trajectory, size: float) -> Iterator[Finding]:
    """Compare the first sample with the computed start, and the start with the positions that the file gives.

    Resumed runs are skipped: their states may violate the constraints. Rigid contacts that are closed change the
    start.
    """
    if problem.state is not None or problem.compiled.source.rigid:
        return
    states = np.array((problem.q, problem.v, x.q[0] - problem.q, x.v[0] - problem.v))  # of bodies: x, y, theta
    largest = np.abs(states).reshape(4, -1, 3).max(axis=1).tolist()
    far, fast, off, slower = (max(of_x, of_y, size * angle) for of_x, of_y, angle in largest)
    off = max(off, _distance_from_given_start(problem, size))
    worst = max(off / (START * (size + far)), slower / max(START_RATES * fast, 1e-300))
    yield Finding("start", worst, float(x.t[0]), "")


def _distance_from_given_start(problem: Problem, size: float) -> float:
    """Return the largest difference (m) between the start and the file's `start.set`; angles are scaled by `size`."""
    source, off = problem.compiled.source, 0.0
    for k, name in enumerate(source.coordinates):
        given = source.place.get(f"start.set.{name}") if name in source.start_set else None
        if given is not None:
            miss = abs(float(problem.q[k] - problem.p[given]))
            turns = round(miss / math.tau) * math.tau if k % 3 == 2 else 0.0
            off = max(off, abs(miss - turns) * (size if k % 3 == 2 else 1.0))
    return off


def _check_energy(
    compiled: CompiledModel,
    problem: Problem,
    x: Trajectory,
    evaluation: Evaluation,
    balance: tuple[float, float],
    size: float,
) -> Iterator[Finding]:
    """Check the energy balance of the whole run; a fixed step has no tolerance to compare the residual with."""
    residual, turned = balance[0], balance[1] + float(np.abs(evaluation.energy).max(initial=0.0))
    adaptive = math.isinf(problem.step) and problem.method != "kinematic"
    if not adaptive or len(x.t) < ENOUGH or not math.isfinite(residual):
        return
    crossing = size / max(abs(float(x.t[-1] - x.t[0])), 1e-300)
    most = 0.5 * float(compiled.mass(problem.p)[::3].sum()) * crossing * crossing
    if not turned > max(LEAST, AT_REST**2 * most):
        return
    share = max(ENERGY * problem.rtol * math.sqrt(x.counts.steps + 1.0), LEAST_ENERGY)
    if not x.v[0].any():  # tolerances of a motion that begins at rest are those of one by its size in the time
        turned += most
    yield Finding("energy", residual / (share * turned), float(x.t[-1]), "")


def _check_finite(compiled: CompiledModel, x: Trajectory, evaluation: Evaluation) -> Iterator[Finding]:
    """Check that the results of each sample are finite. Forces of rigid contacts are not recomputed here."""
    parts = [evaluation.a, evaluation.multipliers, evaluation.reactions, evaluation.torques, evaluation.power]
    parts += [] if compiled.source.rigid else [evaluation.clearance[:, :, :2]]
    if all(math.isfinite(np.add.reduce(part, axis=None)) for part in parts if part.size):
        yield Finding("finite", 0.0, float(x.t[0]), "")
        return
    odd = ~np.all([np.isfinite(part.reshape(len(x.t), -1)).all(axis=1) for part in parts], axis=0)
    yield Finding("finite", NOT_FINITE if odd.any() else 0.0, float(x.t[int(odd.argmax())]), "")


def _check_contact_forces(compiled: CompiledModel, x: Trajectory, evaluation: Evaluation) -> Iterator[Finding]:
    """Check contact forces of joints without a film: none outside contacts, and peaks equal to those of contacts."""
    for k, joint in enumerate(compiled.source.clearances):
        if joint.film or joint.name in compiled.source.rigid:
            continue
        force = np.hypot(evaluation.clearance[:, k, CLEARANCE_Fx], evaluation.clearance[:, k, CLEARANCE_Fy])
        peak, own = float(x.peaks[k, PEAK_F]), x.impacts[x.impacts["joint"] == k]
        free = np.isnan(x.memory[:, k])
        touches = free & (np.abs(evaluation.clearance[:, k, CLEARANCE_delta]) <= SHALLOW)
        outside = np.where(free & ~touches, force, 0.0)
        worst = int(outside.argmax())
        scale = max(FORCE * max(peak, float(force.max())), 1e-300)
        yield Finding("sample", float(outside[worst]) / scale, float(x.t[worst]), joint.name)
        listed = float(own["F_peak"].max(initial=0.0))
        begins_free = bool(np.isnan(x.memory[0, k]))  # a contact that a run resumes has had a peak before
        if peak > float(force[touches].max(initial=0.0)) and begins_free and np.isfinite(own["t_off"]).all():
            over = (max(peak, float(force.max())) - listed) / (PEAK * max(listed, 1e-300))
            yield Finding("peak", max(over, 0.0), float(x.peaks[k, PEAK_t]), joint.name)


def _check_drawn_samples(
    compiled: CompiledModel, problem: Problem, x: Trajectory, size: float, evaluation: Evaluation
) -> tuple[Finding, ...]:
    """Check power, drive torques and constraint equations at random samples with C's gudgeon_audit_samples.

    In long runs, and if audit is "full", the equations of motion of single bodies are checked there too.
    """
    N = len(x.t)
    drawn = DRAWN if problem.audit > 1 or x.counts.right_hand_sides > SHORT else DRAWN[::2]
    at = (N * drawn).astype(np.intp) if len(drawn) < N else np.arange(N)
    at = at[at > 0] if problem.state is not None and N > 1 else at  # a resumed state may lie off its constraints
    memory = x.memory[at] if compiled.n_memory else np.full((len(at), 1), np.nan)
    off = np.zeros((len(at), len(LIMITS)))
    given = [compiled.pointer(values) for values in (x.t[at], x.q[at], x.v[at], memory, problem.p)]
    compiled.lib.gudgeon_audit_samples(len(at), *given, size, compiled.pointer(off, written=True))
    limits, body = LIMITS, ""
    if problem.audit > 1 or x.counts.right_hand_sides > LONG:
        left = newton_euler(compiled, problem.p, x.q, evaluation, at)
        off, limits = np.column_stack([off, left.max(axis=1)]), LIMITS | BODY
        body = compiled.source.bodies[int(left.max(axis=0).argmax())].name
    off[~np.isfinite(off)] = 0.0  # those are of another check
    times = x.t[at[off.argmax(axis=0)]].tolist()
    shares = zip(limits.items(), off.max(axis=0).tolist(), times, strict=True)
    return tuple(Finding(check, worst / limit, t, body if check in BODY else "") for (check, limit), worst, t in shares)
