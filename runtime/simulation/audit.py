"""Audit the samples of a run: check the reported results by other equations than those that produced them.

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
from gudgeon.language.argument_checks import shorten_value
from gudgeon.model.compiled import CompiledModel
from gudgeon.model.evaluation import Evaluation
from gudgeon.model.sizes import compute_size
from gudgeon.simulation.newton_euler import compute_newton_euler_residuals

SAMPLE_POSITIONS = np.sort(
    np.random.default_rng(1).random(8)
)  # random positions in the run, 0 to 1, of the samples that C checks
# allowed error of each check, relative to the largest terms
LIMITS = {"power": 1e-6, "torque": 1e-6, "rows": 1e-12, "rates": 1e-7}
BODY = {"body": 1e-9}  # the same for the equations of single bodies, relative to the largest force or moment
MAX_CALLS_OF_SHORT_RUN = 500  # right-hand sides: in a shorter run, fewer samples are checked to save time
MIN_CALLS_OF_LONG_RUN = 2000  # right-hand sides: in a longer run, the equations of single bodies are checked too
NOT_FINITE = 2.0  # a note, not a failure: at a singular position a motion may have no finite accelerations
ENERGY = 1e3  # times rtol times the root of the number of steps: allowed residual relative to the energy throughput
MIN_ENERGY_TOL = 1e-6  # smallest allowed residual, relative to the energy throughput
MIN_SAMPLES = 20  # samples: with fewer, the energy throughput is not known
AT_REST = 1e-9  # of the speed that crosses the mechanism during the run: slower motion has an energy of rounding size
MIN_WORK_J = 1e-250  # J: smaller works have no reliable digits
FORCE = 1e-6  # of a joint's largest force: allowed force of an open joint
# allowed distance of the first sample from the start: of the size, and of the largest speed
START, START_RATES = 1e-9, 1e-6
PEAK = 1e-2  # of the largest force of its contacts: allowed excess of a joint's peak force


def parse_audit_level(audit: bool | str) -> int:
    """Return the level of the audit for C (0 for False) from the argument `audit`: True, False or "full".

    Raises BadValueError for anything else.
    """
    if isinstance(audit, (bool, np.bool_, str)) and audit in LEVELS:
        return LEVELS[audit]
    raise BadValueError(
        f"audit is {shorten_value(audit)}: expected True, False or 'full'", hint="audit=True is the default"
    )


def audit_samples(
    compiled: CompiledModel,
    problem: Problem,
    trajectory: Trajectory,
    evaluation: Evaluation,
    balance: tuple[float, float],
) -> tuple[Finding, ...]:
    """Return the findings of all checks of samples that apply to the run; an empty tuple without an audit.

    `balance`: largest energy residual and energy throughput (J).
    """
    if not problem.audit or not len(trajectory.t):
        return ()
    source, size = compiled.source, max(compute_size(compiled.source, problem.p), 1e-300)
    findings = [
        *_check_first_sample(problem, trajectory, size),
        *_check_contact_forces(compiled, trajectory, evaluation),
    ]
    if not source.massless and not source.indeterminate:
        findings += [
            *_check_energy_balance(compiled, problem, trajectory, evaluation, balance, size),
            *_check_finite_results(compiled, trajectory, evaluation),
        ]
    left_out = set[str]()
    if source.massless or source.indeterminate:
        left_out.add("body")
    if source.massless or source.indeterminate:
        left_out |= {"power", "torque"}
    if problem.method == "rk4" and source.formulation == "full":  # its rows drift
        left_out |= {"rows", "rates", "power", "body"}
    return (
        *findings,
        *(
            finding
            for finding in _check_random_samples(compiled, problem, trajectory, size, evaluation)
            if finding.check not in left_out
        ),
    )


def has_failed_finding(findings: tuple[Finding, ...]) -> bool:
    """Return whether any finding exceeds the value at which the run ends with an error; NaN counts as such."""
    return any(not finding.worst <= FAILS for finding in findings)


def _check_first_sample(problem: Problem, trajectory: Trajectory, size: float) -> Iterator[Finding]:
    """Yield a finding on the first sample: its distance from the computed start, and that of the start from the file's.

    Yields nothing for resumed runs, whose states may violate the constraints, and with rigid contacts, which may change
    the start. `size`: that of the mechanism (m).
    """
    if problem.state is not None or problem.compiled.source.rigid:
        return
    states = np.array(
        (problem.q, problem.v, trajectory.q[0] - problem.q, trajectory.v[0] - problem.v)
    )  # of bodies: x, y, theta
    largest = np.abs(states).reshape(4, -1, 3).max(axis=1).tolist()
    far, fast, off, slower = (max(of_x, of_y, size * angle) for of_x, of_y, angle in largest)
    off = max(off, _compute_distance_from_given_start(problem, size))
    worst = max(off / (START * (size + far)), slower / max(START_RATES * fast, 1e-300))
    yield Finding("start", worst, float(trajectory.t[0]), "")


def _compute_distance_from_given_start(problem: Problem, size: float) -> float:
    """Return the largest difference (m) between the start and the file's `start.set`, whole turns left out.

    Angles are multiplied by `size` (m).
    """
    source, off = problem.compiled.source, 0.0
    for k, name in enumerate(source.coordinates):
        given = source.slot_index.get(f"start.set.{name}") if name in source.start_set else None
        if given is not None:
            miss = abs(float(problem.q[k] - problem.p[given]))
            turns = round(miss / math.tau) * math.tau if k % 3 == 2 else 0.0
            off = max(off, abs(miss - turns) * (size if k % 3 == 2 else 1.0))
    return off


def _check_energy_balance(
    compiled: CompiledModel,
    problem: Problem,
    trajectory: Trajectory,
    evaluation: Evaluation,
    balance: tuple[float, float],
    size: float,
) -> Iterator[Finding]:
    """Yield a finding on the energy balance of the whole run, relative to its tolerance.

    Yields nothing for a fixed step, which has no tolerance, for few samples, and where the energy throughput is too
    small. `balance`: residual and throughput (J).
    """
    residual, turned = balance[0], balance[1] + float(np.abs(evaluation.energy).max(initial=0.0))
    adaptive = math.isinf(problem.step) and problem.method != "kinematic"
    if not adaptive or len(trajectory.t) < MIN_SAMPLES or not math.isfinite(residual):
        return
    crossing = size / max(abs(float(trajectory.t[-1] - trajectory.t[0])), 1e-300)
    most = 0.5 * float(compiled.mass(problem.p)[::3].sum()) * crossing * crossing
    if not turned > max(MIN_WORK_J, AT_REST**2 * most):
        return
    tolerance = max(ENERGY * problem.rtol * math.sqrt(trajectory.counts.steps + 1.0), MIN_ENERGY_TOL)
    if not trajectory.v[0].any():  # tolerances of a motion that begins at rest are those of one by its size in the time
        turned += most
    if residual > tolerance * turned:  # samples at one phase of a periodic motion may all lie where it is slow
        turned = max(turned, _estimate_kinetic_energy(compiled, problem, trajectory, size))
    yield Finding("energy", residual / (tolerance * turned), float(trajectory.t[-1]), "")


def _estimate_kinetic_energy(compiled: CompiledModel, problem: Problem, trajectory: Trajectory, size: float) -> float:
    """Return the kinetic energy (J) of all bodies at the largest speed at the ends of steps; 0 if none is recorded.

    `size`: that of the mechanism (m), the arm of the largest angular velocity.
    """
    speeds = np.array([trajectory.counts.speed_max, size * trajectory.counts.omega_max])
    speed = float(np.nan_to_num(speeds).max())
    return 0.5 * float(compiled.mass(problem.p)[::3].sum()) * speed * speed


def _check_finite_results(compiled: CompiledModel, trajectory: Trajectory, evaluation: Evaluation) -> Iterator[Finding]:
    """Yield a finding on whether the evaluated results of all samples are finite, with the time of the first that is
    not.

    Forces of rigid contacts are not recomputed here and are left out.
    """
    parts = [evaluation.a, evaluation.multipliers, evaluation.reactions, evaluation.torques, evaluation.power]
    parts += [] if compiled.source.rigid else [evaluation.clearance[:, :, :2]]
    if all(math.isfinite(np.add.reduce(part, axis=None)) for part in parts if part.size):
        yield Finding("finite", 0.0, float(trajectory.t[0]), "")
        return
    is_not_finite = ~np.all([np.isfinite(part.reshape(len(trajectory.t), -1)).all(axis=1) for part in parts], axis=0)
    yield Finding(
        "finite", NOT_FINITE if is_not_finite.any() else 0.0, float(trajectory.t[int(is_not_finite.argmax())]), ""
    )


def _check_contact_forces(compiled: CompiledModel, trajectory: Trajectory, evaluation: Evaluation) -> Iterator[Finding]:
    """Yield findings on the contact forces of joints without a film and without rigid contact.

    At samples outside contacts the force must be zero. The peak of a joint must equal that of its listed contacts.
    """
    for k, joint in enumerate(compiled.source.clearances):
        if joint.film or joint.name in compiled.source.rigid:
            continue
        force = np.hypot(evaluation.clearance[:, k, CLEARANCE_Fx], evaluation.clearance[:, k, CLEARANCE_Fy])
        peak, contacts = float(trajectory.peaks[k, PEAK_F]), trajectory.impacts[trajectory.impacts["joint"] == k]
        free = np.isnan(trajectory.memory[:, k])
        touches = free & (np.abs(evaluation.clearance[:, k, CLEARANCE_delta]) <= SHALLOW)
        outside = np.where(free & ~touches, force, 0.0)
        worst = int(outside.argmax())
        scale = max(FORCE * max(peak, float(force.max())), 1e-300)
        yield Finding("sample", float(outside[worst]) / scale, float(trajectory.t[worst]), joint.name)
        listed = float(contacts["F_peak"].max(initial=0.0))
        begins_free = bool(np.isnan(trajectory.memory[0, k]))  # a contact that a run resumes has had a peak before
        if peak > float(force[touches].max(initial=0.0)) and begins_free and np.isfinite(contacts["t_off"]).all():
            over = (max(peak, float(force.max())) - listed) / (PEAK * max(listed, 1e-300))
            yield Finding("peak", max(over, 0.0), float(trajectory.peaks[k, PEAK_t]), joint.name)


def _check_random_samples(
    compiled: CompiledModel, problem: Problem, trajectory: Trajectory, size: float, evaluation: Evaluation
) -> tuple[Finding, ...]:
    """Return findings on power, drive torques and constraint equations at pseudo-random samples.

    C's gudgeon_audit_samples computes them. In long runs, and if audit is "full", the equations of motion of single
    bodies are checked there too.
    """
    N = len(trajectory.t)
    drawn = (
        SAMPLE_POSITIONS
        if problem.audit > 1 or trajectory.counts.right_hand_sides > MAX_CALLS_OF_SHORT_RUN
        else SAMPLE_POSITIONS[::2]
    )
    samples = (N * drawn).astype(np.intp) if len(drawn) < N else np.arange(N)
    samples = (
        samples[samples > 0] if problem.state is not None and N > 1 else samples
    )  # a resumed state may lie off its constraints
    memory = trajectory.memory[samples] if compiled.n_memory else np.full((len(samples), 1), np.nan)
    errors = np.zeros((len(samples), len(LIMITS)))
    given = [
        compiled.pointer(values)
        for values in (trajectory.t[samples], trajectory.q[samples], trajectory.v[samples], memory, problem.p)
    ]
    compiled.lib.gudgeon_audit_samples(len(samples), *given, size, compiled.pointer(errors, is_written=True))
    limits, body = LIMITS, ""
    if problem.audit > 1 or trajectory.counts.right_hand_sides > MIN_CALLS_OF_LONG_RUN:
        residuals = compute_newton_euler_residuals(compiled, problem.p, trajectory.q, evaluation, samples)
        errors, limits = np.column_stack([errors, residuals.max(axis=1)]), LIMITS | BODY
        body = compiled.source.bodies[int(residuals.max(axis=0).argmax())].name
    errors[~np.isfinite(errors)] = 0.0  # those are of another check
    times = trajectory.t[samples[errors.argmax(axis=0)]].tolist()
    shares = zip(limits.items(), errors.max(axis=0).tolist(), times, strict=True)
    return tuple(Finding(check, worst / limit, t, body if check in BODY else "") for (check, limit), worst, t in shares)
