"""The audit of a run's samples: what is reported there against equations that produced none of it.

The checks of steps are C's (engine/run/audit.c). Here the reported accelerations, torques and forces are held against
the change of energy, sampled forces against the list of contacts, and the works against the energy of the motion.
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
from gudgeon.language.wanted import told
from gudgeon.model.compiled import CompiledModel
from gudgeon.model.evaluation import Evaluation
from gudgeon.model.sizes import mechanism_sizes
from gudgeon.simulation.newton_euler import newton_euler

DRAWN = np.sort(np.random.default_rng(1).random(8))  # where in the run samples lie that are checked in C
LIMITS = {"power": 1e-6, "torque": 1e-6, "rows": 1e-12, "rates": 1e-7}  # of the largest terms, by check
BODY = {"body": 1e-9}  # the same of the largest force or moment
SHORT = 500  # right-hand sides: a run of fewer costs less than the checks of all these samples may
LONG = 2000  # right-hand sides: a run of more is worth the equations of single bodies
NOT_FINITE = 2.0  # a note: at an instant, as a singular position is one, a motion may have no accelerations
ENERGY = 1e3  # times rtol and the root of the number of steps, of the energy that was turned over
LEAST_ENERGY = 1e-6  # the same, at least
ENOUGH = 20  # samples from which on the energy that was turned over is known
AT_REST = 1e-9  # of the speed that crosses the mechanism in the time of the run: the energy of less is rounding
LEAST = 1e-250  # J: works of a motion that hardly leaves zero have no digits
FORCE = 1e-6  # of a joint's largest force, that an open joint may seem to bear
START, START_RATES = 1e-9, 1e-6  # of the size, and of the largest speed: how far the first sample is from the start
PEAK = 1e-2  # of the largest force of its contacts, that the peak of a joint may exceed it by


def audit_level(audit: bool | str) -> int:
    """Return the level of the audit for C. BadValueError for anything but True, False and "full"."""
    if isinstance(audit, (bool, np.bool_, str)) and audit in LEVELS:
        return LEVELS[audit]
    raise BadValueError(f"audit is {told(audit)}: expected True, False or 'full'", hint="audit=True is the default")


def audit_samples(
    compiled: CompiledModel, problem: Problem, x: Trajectory, evaluation: Evaluation, balance: tuple[float, float]
) -> tuple[Finding, ...]:
    """Return the findings of all checks of samples that apply to the run; none where the audit is switched off."""
    if not problem.audit or not len(x.t):
        return ()
    source, size = compiled.source, max(float(mechanism_sizes(compiled.source, problem.p)), 1e-300)
    found = [*_start(problem, x, size), *_contacts(compiled, x, evaluation)]
    if not source.massless and not source.indeterminate:
        found += [*_energy(compiled, problem, x, evaluation, balance, size), *_finite(compiled, x, evaluation)]
    left_out = set[str]()
    if source.massless or source.indeterminate:
        left_out.add("body")
    if source.massless or source.indeterminate:
        left_out |= {"power", "torque"}
    if problem.method == "rk4" and source.formulation == "full":  # its rows drift
        left_out |= {"rows", "rates", "power", "body"}
    return (*found, *(one for one in _balances(compiled, problem, x, size, evaluation) if one.check not in left_out))


def failed(findings: tuple[Finding, ...]) -> bool:
    """Whether a check of samples ends the run with an error."""
    return any(not one.worst <= FAILS for one in findings)


def _start(problem: Problem, x: Trajectory, size: float) -> Iterator[Finding]:
    """The first sample is the start that was found, which is where the file says.

    A state that a run goes on from may lie off its constraints; rigid contacts that are closed change the start.
    """
    if problem.state is not None or problem.compiled.source.rigid:
        return
    states = np.array((problem.q, problem.v, x.q[0] - problem.q, x.v[0] - problem.v))  # of bodies: x, y, theta
    largest = np.abs(states).reshape(4, -1, 3).max(axis=1).tolist()
    far, fast, off, slower = (max(of_x, of_y, size * angle) for of_x, of_y, angle in largest)
    off = max(off, _off_given(problem, size))
    worst = max(off / (START * (size + far)), slower / max(START_RATES * fast, 1e-300))
    yield Finding("start", worst, float(x.t[0]), "")


def _off_given(problem: Problem, size: float) -> float:
    """Return how far the start is from the positions that the file gives (start.set), m; angles at `size`, m."""
    source, off = problem.compiled.source, 0.0
    for k, name in enumerate(source.coordinates):
        given = source.place.get(f"start.set.{name}") if name in source.start_set else None
        if given is not None:
            miss = abs(float(problem.q[k] - problem.p[given]))
            turns = round(miss / math.tau) * math.tau if k % 3 == 2 else 0.0
            off = max(off, abs(miss - turns) * (size if k % 3 == 2 else 1.0))
    return off


def _energy(
    compiled: CompiledModel,
    problem: Problem,
    x: Trajectory,
    evaluation: Evaluation,
    balance: tuple[float, float],
    size: float,
) -> Iterator[Finding]:
    """The balance of the whole run; a fixed step has no tolerance to compare it with."""
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


def _finite(compiled: CompiledModel, x: Trajectory, evaluation: Evaluation) -> Iterator[Finding]:
    """What is computed at each sample is finite; forces of rigid contacts are known to a run alone."""
    parts = [evaluation.a, evaluation.multipliers, evaluation.reactions, evaluation.torques, evaluation.power]
    parts += [] if compiled.source.rigid else [evaluation.clearance[:, :, :2]]
    if all(math.isfinite(np.add.reduce(part, axis=None)) for part in parts if part.size):
        yield Finding("finite", 0.0, float(x.t[0]), "")
        return
    odd = ~np.all([np.isfinite(part.reshape(len(x.t), -1)).all(axis=1) for part in parts], axis=0)
    yield Finding("finite", NOT_FINITE if odd.any() else 0.0, float(x.t[int(odd.argmax())]), "")


def _contacts(compiled: CompiledModel, x: Trajectory, evaluation: Evaluation) -> Iterator[Finding]:
    """Forces of samples outside contacts, and peaks against the forces of contacts, of joints without a film."""
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


def _balances(
    compiled: CompiledModel, problem: Problem, x: Trajectory, size: float, evaluation: Evaluation
) -> tuple[Finding, ...]:
    """Power, drive torques, positions and velocities of all rows at drawn samples, by C's gudgeon_audit_samples.

    And, in long runs and where audit is "full", the equations of motion of single bodies there.
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
