"""Audit the samples of a run: check the reported results by other equations than those that produced them.

The audit of the steps is in C (engine/run/audit.c). Here, accelerations, torques and forces are compared with the
rate of change of energy, sampled forces with the list of contacts, and works with the energy of the motion.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.audit import LEVELS, Finding
from gudgeon.contract.boundary import AUDIT_FAILS as FAILS
from gudgeon.contract.boundary import (
    MIN_TOUCHING_PENETRATION,
    PEAK_F,
    CLEARANCE_delta,
    CLEARANCE_Fx,
    CLEARANCE_Fy,
    PEAK_t,
)
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BadValueError
from gudgeon.integrators.trajectory import Problem, Trajectory
from gudgeon.language.argument_checks import shorten_value
from gudgeon.model.cached_values import cache_by_values
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.evaluation import Evaluation, select_evaluated_rows
from gudgeon.model.sizes import compute_size
from gudgeon.simulation.newton_euler import compute_newton_euler_residuals

SAMPLE_POSITIONS = np.sort(
    np.random.default_rng(1).random(8)
)  # random positions in the run, 0 to 1, of the samples that C checks
SHORT_RUN_POSITIONS = SAMPLE_POSITIONS[::2]  # the same in a run with few right-hand sides
# allowed error of each check, relative to the largest terms
LIMITS = {"power": 1e-6, "torque": 1e-6, "rows": 1e-12, "rates": 1e-7}
BODY_LIMIT = {"body": 1e-9}  # the same for the equations of single bodies, relative to the largest force or moment
MAX_CALLS_OF_SHORT_RUN = 500  # right-hand sides: in a shorter run, fewer samples are checked to save time
MIN_CALLS_OF_LONG_RUN = 2000  # right-hand sides: in a longer run, the equations of single bodies are checked too
NON_FINITE_FINDING_VALUE = (
    2.0  # a note, not a failure: at a singular position a motion may have no finite accelerations
)
# times rtol times the root of the number of steps: allowed residual relative to the energy throughput
ENERGY_TOL_FACTOR = 1e3
MIN_ENERGY_TOL = 1e-6  # smallest allowed residual, relative to the energy throughput
MIN_SAMPLES = 20  # samples: with fewer, the energy throughput is not known
# of the speed that crosses the mechanism during the run: slower motion has an energy of rounding size
REST_SPEED_TOL = 1e-9
MIN_WORK_J = 1e-250  # J: smaller works have no reliable digits
OPEN_FORCE_TOL = 1e-6  # of a joint's largest force: allowed force of an open joint
# allowed distance of the first sample from the start: of the size, and of the largest speed
START_TOL, START_RATES_TOL = 1e-9, 1e-6
PEAK_EXCESS_TOL = 1e-2  # of the largest force of its contacts: allowed excess of a joint's peak force


def parse_audit_level(audit: bool | str) -> int:
    """Return the level of the audit for C (0 for False) from the argument `audit`: True, False or "full".

    Raises BadValueError for anything else.
    """
    if isinstance(audit, (bool, np.bool_, str)) and audit in LEVELS:
        return LEVELS[audit]
    raise BadValueError(
        f"audit is {shorten_value(audit)}: expected True, False or 'full'", hint="audit=True is the default"
    )


class SampleAudit:
    """Audit the samples of a run, which are added block by block with their evaluated quantities.

    Without an audit (`problem.audit` is 0) or without samples, nothing is checked.
    """

    def __init__(self, problem: Problem, trajectory: Trajectory) -> None:
        compiled, N = problem.compiled, len(trajectory.t)
        self.compiled, self.problem, self.trajectory, self.source = compiled, problem, trajectory, compiled.source
        self.is_on = bool(problem.audit and N)
        self.has_no_forces = bool(self.source.massless_bodies or self.source.indeterminate)
        self.joints = list_audited_joints(self.source)
        self.contact_forces = [ContactForces() for _ in self.joints]
        self.samples = select_audit_samples_of_run(problem, trajectory) if self.is_on else np.zeros(0, np.intp)
        self.random_evaluations: list[Evaluation] = []  # the evaluation of `samples`
        self.largest_energy = 0.0  # J
        self.first_undefined: float | None = None  # s, first sample at which an evaluated result is not finite

    def add_samples(self, first: int, evaluation: Evaluation) -> None:
        """Add the next block of samples, which begins with sample `first` of the run, to the maxima of the checks.

        The evaluation of the pseudo-random samples in the block is stored. Nothing is done if the audit is off.
        """
        if not self.is_on:
            return
        if self.joints:
            self._update_contact_force_maxima(first, evaluation)
        self.random_evaluations.append(
            evaluation
            if len(evaluation.a) == len(self.trajectory.t)
            else select_evaluated_rows(
                evaluation, self.samples[(self.samples >= first) & (self.samples < first + len(evaluation.a))] - first
            )
        )
        if self.has_no_forces:
            return
        energy = float(np.abs(evaluation.energy).max(initial=0.0))
        self.largest_energy = energy if _exceeds(energy, self.largest_energy) else self.largest_energy
        if self.first_undefined is None:
            row = _find_first_non_finite_sample(evaluation, bool(self.source.rigid_joints))
            self.first_undefined = None if row is None else float(self.trajectory.t[first + row])

    def _update_contact_force_maxima(self, first: int, evaluation: Evaluation) -> None:
        """Update the maxima of each joint's contact force (N) by the next samples; `first`: index of the first of them.

        They are the maxima over all samples, over samples outside contacts (discrete state NaN) with its time, and over
        those of them that touch (|δ| of rounding size). Joints with a film or a rigid contact are left out.
        """
        discrete_states = self.trajectory.memory[first : first + len(evaluation.a)]
        clearance, t_first = evaluation.clearance, float(self.trajectory.t[first])
        if not clearance[:, :, :2].any():
            for forces in self.contact_forces:
                forces.update_maxima(0.0, t_first, 0.0, 0.0)
            return
        if len(self.joints) < clearance.shape[1]:
            clearance, discrete_states = clearance[:, self.joints], discrete_states[:, self.joints]
        force = np.hypot(clearance[:, :, CLEARANCE_Fx], clearance[:, :, CLEARANCE_Fy])
        is_open = np.isnan(discrete_states[:, : len(self.joints)])
        touches = is_open & (np.abs(clearance[:, :, CLEARANCE_delta]) <= MIN_TOUCHING_PENETRATION)
        open_force = np.where(is_open & ~touches, force, 0.0)
        touching = np.where(touches, force, 0.0).max(axis=0).tolist()
        argmax_open, largest = open_force.argmax(axis=0).tolist(), force.max(axis=0).tolist()
        for k, forces in enumerate(self.contact_forces):
            t_open = float(self.trajectory.t[first + argmax_open[k]])
            forces.update_maxima(float(open_force[argmax_open[k], k]), t_open, largest[k], touching[k])

    def build_findings(self, balance: tuple[float, float]) -> tuple[Finding, ...]:
        """Return the findings of all checks that apply to the run, after all samples; () without an audit.

        `balance`: largest energy residual and energy throughput (J).
        """
        if not self.is_on:
            return ()
        problem, trajectory, source = self.problem, self.trajectory, self.source
        size = max(compute_size(source, problem.p), 1e-300)
        findings = list(_check_first_sample(problem, trajectory, size))
        findings += check_contact_forces(source, trajectory, self.joints, self.contact_forces)
        if not self.has_no_forces:
            findings += check_energy_balance(self.compiled, problem, trajectory, self.largest_energy, balance, size)
            t = self.first_undefined
            findings.append(
                Finding("finite", 0.0, float(trajectory.t[0]), "")
                if t is None
                else Finding("finite", NON_FINITE_FINDING_VALUE, t, "")
            )
        left_out = list_inapplicable_checks(source, problem.method)
        findings += [finding for finding in self._check_random_samples(size) if finding.check not in left_out]
        return tuple(findings)

    def _check_random_samples(self, size: float) -> tuple[Finding, ...]:
        """Return findings on power, drive torques and constraint equations at pseudo-random samples.

        Each has the largest error over its limit, and its time; errors that are not finite count as 0. `size` (m): size
        of the mechanism. C's gudgeon_audit_samples computes them. In long runs, and if audit is "full", the equations
        of motion of single bodies are checked there too.
        """
        compiled, problem, trajectory, samples = self.compiled, self.problem, self.trajectory, self.samples
        discrete_states = (
            trajectory.memory[samples] if compiled.n_discrete_states else np.full((len(samples), 1), np.nan)
        )
        t, q = trajectory.t[samples], trajectory.q[samples]
        errors = np.zeros((len(samples), len(LIMITS)))
        p = problem.values_of_motion
        given = [compiled.pointer(values) for values in (t, q, trajectory.v[samples], discrete_states, p)]
        compiled.lib.gudgeon_audit_samples(len(samples), *given, size, compiled.pointer(errors, is_written=True))
        limits, body = LIMITS, ""
        if problem.audit > 1 or trajectory.counts.right_hand_sides > MIN_CALLS_OF_LONG_RUN:
            residuals = compute_newton_euler_residuals(compiled, p, q, self._join_random_evaluations())
            errors, limits = np.column_stack([errors, residuals.max(axis=1)]), LIMITS | BODY_LIMIT
            body = compiled.source.bodies[int(residuals.max(axis=0).argmax())].name
        times, findings = t.tolist(), []
        for (check, limit), values in zip(limits.items(), errors.T.tolist(), strict=True):
            finite = [value if math.isfinite(value) else 0.0 for value in values]  # the check "finite" finds others
            worst = max(finite)
            findings.append(
                Finding(check, worst / limit, times[finite.index(worst)], body if check in BODY_LIMIT else "")
            )
        return tuple(findings)

    def _join_random_evaluations(self) -> Evaluation:
        """Return the evaluation of all pseudo-random samples, joined from the blocks of `add_samples`.

        A single block of all samples contains others too; its pseudo-random samples are selected.
        """
        if len(self.random_evaluations) == 1:
            return select_evaluated_rows(self.random_evaluations[0], self.samples)
        return Evaluation(
            *map(
                np.concatenate, zip(*(vars(evaluation).values() for evaluation in self.random_evaluations), strict=True)
            )
        )


def find_deviating_starts(source: KernelSource, p: Array, start: Array, size: Array) -> NDArray[np.bool_]:
    """Return a mask (n,) of runs whose computed start differs from the file's `start.set` by more than START_TOL.

    Whole turns count as differences here, so a run may be reported without a fault. Shapes: parameter values p (n, …),
    `start` (n, 2 n_q), mechanism sizes (n,) in m.
    """
    distances = np.zeros(len(p))
    for k, given in list_given_coordinates(source):
        distances = np.maximum(distances, np.abs(start[:, k] - p[:, given]) * (size if k % 3 == 2 else 1.0))
    return np.asarray(distances > START_TOL * size)


def has_failed_finding(findings: tuple[Finding, ...]) -> bool:
    """Return whether any finding exceeds the value at which the run ends with an error; NaN counts as such."""
    return any(not finding.worst <= FAILS for finding in findings)


def _check_first_sample(problem: Problem, trajectory: Trajectory, size: float) -> Iterator[Finding]:
    """Yield a finding on the first sample: its difference from the computed start, and that of the start from the file.

    Its value is the larger of the differences of positions and of velocities, each over its tolerance.

    Yields nothing for resumed runs, whose states may violate the constraints, and with rigid contacts, which may change
    the start. `size`: of the mechanism (m).
    """
    if problem.state is not None or problem.compiled.source.rigid_joints:
        return
    states = np.array((problem.q, problem.v, trajectory.q[0], trajectory.v[0]))  # of bodies: x, y, theta
    states[2:] -= states[:2]
    largest = np.abs(states).reshape(4, -1, 3).max(axis=1).tolist()
    max_position, max_velocity, distance, velocity_difference = (
        max(max_x, max_y, size * angle) for max_x, max_y, angle in largest
    )
    distance = max(distance, _compute_distance_from_given_start(problem.compiled.source, problem.p, problem.q, size))
    ratio = max(
        distance / (START_TOL * (size + max_position)),
        velocity_difference / max(START_RATES_TOL * max_velocity, 1e-300),
    )
    yield Finding("start", ratio, float(trajectory.t[0]), "")


def _compute_distance_from_given_start(source: KernelSource, p: Array, q: Array, size: float) -> float:
    """Return the largest difference (m) between a start q (n,) and the file's `start.set`, whole turns left out.

    Angles are multiplied by `size` (m).
    """
    distance = 0.0
    for k, given in list_given_coordinates(source):
        difference = abs(float(q[k] - p[given]))
        turns = round(difference / math.tau) * math.tau if k % 3 == 2 else 0.0
        distance = max(distance, abs(difference - turns) * (size if k % 3 == 2 else 1.0))
    return distance


@cache_by_values
def list_given_coordinates(source: KernelSource) -> tuple[tuple[int, int], ...]:
    """Return pairs of indices for the coordinates in the file's `start.set`: of the coordinate and its parameter."""
    indices = ((k, source.parameter_indices.get(f"start.set.{name}")) for k, name in enumerate(source.coordinates))
    return tuple((k, i) for k, i in indices if i is not None and source.coordinates[k] in source.start_set)


def check_energy_balance(
    compiled: CompiledModel,
    problem: Problem,
    trajectory: Trajectory,
    largest_energy: float,
    balance: tuple[float, float],
    size: float,
) -> Iterator[Finding]:
    """Yield a finding on the energy balance of the whole run, relative to its tolerance.

    Yields nothing for a fixed step, which has no tolerance, for kinematic runs, for fewer than MIN_SAMPLES samples, and
    where the energy throughput is too small. `largest_energy`: kinetic or potential (J). `balance`: residual and
    throughput (J). `size` (m): size of the mechanism.
    """
    residual, throughput = balance[0], balance[1] + largest_energy
    adaptive = math.isinf(problem.step) and problem.method != "kinematic"
    if not adaptive or len(trajectory.t) < MIN_SAMPLES or not math.isfinite(residual):
        return
    crossing_speed = size / max(abs(float(trajectory.t[-1] - trajectory.t[0])), 1e-300)
    crossing_energy = 0.5 * float(compiled.mass(problem.p)[::3].sum()) * crossing_speed * crossing_speed
    if not throughput > max(MIN_WORK_J, REST_SPEED_TOL**2 * crossing_energy):
        return
    tolerance = max(ENERGY_TOL_FACTOR * problem.rtol * math.sqrt(trajectory.counts.steps + 1.0), MIN_ENERGY_TOL)
    if not trajectory.v[0].any():  # tolerances of velocities from rest are those of the crossing speed
        throughput += crossing_energy
    if residual > tolerance * throughput:  # samples at one phase of a periodic motion may all be slow
        throughput = max(throughput, _estimate_kinetic_energy(compiled, problem, trajectory, size))
    yield Finding("energy", residual / (tolerance * throughput), float(trajectory.t[-1]), "")


def _estimate_kinetic_energy(compiled: CompiledModel, problem: Problem, trajectory: Trajectory, size: float) -> float:
    """Return an estimate of the largest kinetic energy (J): ½ m max(v, l ω)², without moments of inertia.

    m: mass of all bodies; v and ω: largest speed and angular velocity at the ends of steps, NaN counts as 0; l: `size`
    of the mechanism (m).
    """
    speeds = np.array([trajectory.counts.speed_max, size * trajectory.counts.omega_max])
    speed = float(np.nan_to_num(speeds).max())
    return 0.5 * float(compiled.mass(problem.p)[::3].sum()) * speed * speed


def _find_first_non_finite_sample(evaluation: Evaluation, has_rigid_contacts: bool) -> int | None:
    """Return the index of the first sample at which an evaluated result is not finite; None if all are finite.

    Clearance forces are left out with rigid contacts, whose forces are not computed again at samples.
    """
    fields = [evaluation.a, evaluation.multipliers, evaluation.reactions, evaluation.torques, evaluation.power]
    fields += [] if has_rigid_contacts else [evaluation.clearance[:, :, :2]]
    if all(math.isfinite(np.add.reduce(field, axis=None)) for field in fields if field.size):
        return None
    is_finite = np.all([np.isfinite(field.reshape(len(field), -1)).all(axis=1) for field in fields], axis=0)
    return None if is_finite.all() else int(is_finite.argmin())


@dataclass
class ContactForces:
    """Hold the largest contact forces (N) of a joint at the samples so far; NaN once one of them is NaN."""

    COLUMNS: ClassVar = ("max_open", "max_all", "max_touching")  # of the array that C fills

    max_open: float = -math.inf  # at samples outside contacts, where the force must be zero
    max_all: float = -math.inf
    max_touching: float = -math.inf  # outside contacts with a penetration of zero within MIN_TOUCHING_PENETRATION
    t_open: float = math.nan  # s, time of the first sample with `max_open`

    def update_maxima(self, max_open: float, t_open: float, max_all: float, max_touching: float) -> None:
        """Update the maxima by those of the next samples, which have the same names as the attributes."""
        if _exceeds(max_open, self.max_open):
            self.max_open, self.t_open = max_open, t_open
        self.max_all = max_all if _exceeds(max_all, self.max_all) else self.max_all
        self.max_touching = max_touching if _exceeds(max_touching, self.max_touching) else self.max_touching


def list_audited_joints(source: KernelSource) -> list[int]:
    """Return the indices of the joints with play whose contact forces are checked: without a film or rigid contact."""
    return [k for k, joint in enumerate(source.clearances) if not joint.film and joint.name not in source.rigid_joints]


def check_contact_forces(
    source: KernelSource, trajectory: Trajectory, joints: Sequence[int], contact_forces: Sequence[ContactForces]
) -> Iterator[Finding]:
    """Yield findings on the largest contact forces at samples of `joints`, from `list_audited_joints`.

    A finding has a value over its tolerance. At samples outside contacts the force must be zero. The peak force of a
    joint must not exceed the largest peak of its recorded contacts. The peak is not checked if the run begins or ends
    within a contact.
    """
    for k, forces in zip(joints, contact_forces, strict=True):
        name, peak = source.clearances[k].name, float(trajectory.peaks[k, PEAK_F])
        largest = max(peak, forces.max_all)
        yield Finding("sample", forces.max_open / max(OPEN_FORCE_TOL * largest, 1e-300), forces.t_open, name)
        begins_open = bool(np.isnan(trajectory.memory[0, k]))  # a contact that a run resumes has had a peak before
        if not (peak > forces.max_touching and begins_open):
            continue
        contacts = trajectory.impacts[trajectory.impacts["joint"] == k]
        if np.isfinite(contacts["t_off"]).all():
            listed = float(contacts["F_peak"].max(initial=0.0))
            over = (largest - listed) / (PEAK_EXCESS_TOL * max(listed, 1e-300))
            yield Finding("peak", max(over, 0.0), float(trajectory.peaks[k, PEAK_t]), name)


def select_audit_samples(n_samples: int, audit: int, right_hand_sides: int) -> NDArray[np.intp]:
    """Return the indices of the pseudo-random samples that C checks, of a run with `n_samples` samples.

    There are 8; 4 after at most MAX_CALLS_OF_SHORT_RUN evaluations (`right_hand_sides`), unless `audit`, the level of
    the audit, is "full". A run with fewer samples is checked at all of them.
    """
    is_short = audit <= 1 and right_hand_sides <= MAX_CALLS_OF_SHORT_RUN
    positions = SHORT_RUN_POSITIONS if is_short else SAMPLE_POSITIONS
    return (n_samples * positions).astype(np.intp) if len(positions) < n_samples else np.arange(n_samples)


def list_inapplicable_checks(source: KernelSource, method: str) -> set[str]:
    """Return the names of the sample checks that do not apply to the scene with this method.

    - "body" (balance of each body), "power" and "torque" if any body has no mass, or if reactions are undetermined:
      forces and powers are then not known.
    - "rows" (constraint equations), "rates" (their rates), and "power" and "body", which are computed from them, with
      rk4 in the full formulation: the constraint equations then drift.
    """
    names = set[str]()
    if source.massless_bodies or source.indeterminate:
        names |= {"body", "power", "torque"}
    if method == "rk4" and source.formulation == "full":
        names |= {"rows", "rates", "power", "body"}
    return names


def _exceeds(value: float, largest: float) -> bool:
    """Return whether a value is larger than the largest so far; the first NaN is, and nothing is larger than NaN."""
    return not value <= largest and largest == largest


def select_audit_samples_of_run(problem: Problem, trajectory: Trajectory) -> NDArray[np.intp]:
    """Return the result of `select_audit_samples` for a problem and its run; a resumed run without its first sample."""
    N = len(trajectory.t)
    samples = select_audit_samples(N, problem.audit, trajectory.counts.right_hand_sides)
    # a resumed state may violate the constraints
    return samples[samples > 0] if problem.state is not None and N > 1 else samples
