"""Compute the wear of a joint with play, step by step: `gudgeon.wear(simulation, run, "A", k=1e-4, hardness=2e9)`.

The run is repeated bit for bit. The time loop passes the states of its steps (integrators/steps.py). Between two states
in contact, the motion is the polynomial of degree five through both with their rates and accelerations. Forces are
evaluated at its Gauss points and distributed over the arc that the contact sweeps.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.polynomial.legendre import leggauss

from gudgeon.errors import BadValueError, GudgeonError, UnknownNameError
from gudgeon.integrators.steps import Steps
from gudgeon.language.argument_checks import (
    check_integer,
    check_number,
    check_positive,
    check_text,
    raise_bad_value,
    shorten_value,
)
from gudgeon.language.quantities import parse_quantity
from gudgeon.language.text_output import format_one_line
from gudgeon.model.evaluation import CLEARANCE_COLUMNS
from gudgeon.results.wear import (
    HOUR,
    LAWS,
    POINTS,
    SlidingLoads,
    SlidingRequest,
    Surface,
    Wear,
    compute_cell_angles,
    distribute_loads,
    find_bearing_parameters,
)
from gudgeon.simulation.examine import clear_oil_viscosities, has_known_contact_force, repeat_run_exactly
from gudgeon.simulation.predictability_horizon import build_start_state, check_simulation_of_run
from gudgeon.simulation.run_interpolant import RunInterpolant
from gudgeon.simulation.step_observers import Observation

if TYPE_CHECKING:
    from gudgeon.contract.kernel_source import KernelSource
    from gudgeon.integrators.trajectory import Progress
    from gudgeon.model.compiled import Array, CompiledModel
    from gudgeon.results.results import Result
    from gudgeon.simulation.simulation import Simulation

# nodes of Gauss's quadrature on 0 to 1, and weights
NODES, WEIGHTS = 0.5 * (leggauss(4)[0] + 1.0), 0.5 * leggauss(4)[1]
ENDS = np.concatenate([[0.0], np.cumsum(WEIGHTS)])  # bounds of each node's part of the interval
# matrix from values at the nodes to those at the bounds
NODES_TO_ENDS = np.vander(ENDS, 4) @ np.linalg.inv(np.vander(NODES, 4))
MAX_POINTS = 1_000_000  # largest number of cells of a circumference
# exponents of m, kg, s of k, of H, and of k/H in m³/(N·m)
DIMENSIONLESS, PRESSURE, SPECIFIC_RATE = (0, 0, 0), (-1, 1, -2), (1, -1, 2)
CONTACT_MODELS = ("point", "overlap")
NOTE_NOT_REPEATABLE = "the run could not be repeated bit for bit: the loads of its sliding contacts are not known"


def wear(
    simulation: Simulation,
    run: Result,
    joint: str,
    *,
    k: float | str,
    hardness: float | str | None = None,
    journal_k: float | str | None = None,
    journal_hardness: float | str | None = None,
    law: str = "archard",
    contact: str = "point",
    points: int = POINTS,
    since: float | None = None,
    until: float | None = None,
    progress: Progress | None = None,
) -> Wear:
    """Return the wear depths of a joint with dry contact in a run, over the circumferences of bearing and journal.

    In mixed lubrication only the force of the touching asperities wears; the force of the film does not.

    `k`: dimensionless wear coefficient of Archard's law with the `hardness` H of the softer surface (Pa, '1.2 GPa'), or
    without `hardness` the specific wear rate k/H, '1e-6 mm^3/N/m', in m³/(N·m). `journal_k`, `journal_hardness`: those
    of the journal, if they differ. `law`: worn volume k F_n s/H over the sliding distance s ("archard"), or k/H times
    the work of friction ("reye"). `contact`: the force acts at the "point" of contact, or is distributed by a parabola
    over the arc in which the undeformed circles "overlap", cos φ_w ≥ c/e. `points`: number of cells of a circumference.
    `since`, `until` (s): the part of the run that is evaluated, for example without the transient at the start.

    Raises UnknownNameError for a joint without play, BadValueError for arguments, for a joint without dry contact and
    for a run of another scene, GudgeonError if the run cannot be repeated, KeyboardInterrupt after Ctrl-C.
    """
    check_simulation_of_run(simulation, run, "wear")
    requested = _build_sliding_request(run, joint, points, since, until, contact)
    rates = (
        parse_wear_rate(k, hardness, "k", "hardness"),
        parse_wear_rate(
            k if journal_k is None else journal_k,
            hardness if journal_hardness is None else journal_hardness,
            "journal_k",
            "journal_hardness",
        ),
    )
    if check_text(law, "law") not in LAWS:
        raise_bad_value("law", law, " or ".join(LAWS))
    repetition = repeat_run_exactly(simulation, run, run.t, progress, (requested,))
    if repetition is None:
        raise GudgeonError(NOTE_NOT_REPEATABLE)
    return _build_wear(run, repetition.diagnostics.sliding_loads[0], rates, law)


def _build_sliding_request(
    run: Result, joint: Any, points: Any, since: Any, until: Any, contact_model: Any
) -> SlidingRequest:
    """Check the arguments of `wear` and build the request to observe the joint between `since` and `until` (s).

    None: the start or the end of the run. Raises BadValueError, UnknownNameError.
    """
    check_joint_can_wear(run.source, joint)
    if check_text(contact_model, "contact") not in CONTACT_MODELS:
        raise_bad_value("contact", contact_model, " or ".join(CONTACT_MODELS))
    first, last = (build_start_state(run).t, float(run.t[-1])) if len(run.t) else (0.0, 0.0)
    begin = first if since is None else check_number(since, "since")
    end = last if until is None else check_number(until, "until")
    if not first <= begin < end <= last:
        message = f"wear from {begin:g} to {end:g} s of a run from {first:g} to {last:g} s"
        raise BadValueError(message, hint="expected since before until, both within the run")
    return SlidingRequest(joint, check_integer(points, "points", 8, MAX_POINTS), begin, end, contact_model == "overlap")


def check_joint_can_wear(source: KernelSource, joint: Any) -> None:
    """Raise an error unless wear can be computed for a joint: revolute, with play, dry contact and a known contact
    force.

    UnknownNameError for a joint without play, BadValueError for the rest.
    """
    matching = [clearance for clearance in source.clearances if isinstance(joint, str) and clearance.name == joint]
    if not matching:
        hint = f"its joints with play: {', '.join(clearance.name for clearance in source.clearances) or 'none'}"
        raise UnknownNameError(f"no wear of {shorten_value(joint)}: expected a joint with play", hint=hint)
    if matching[0].is_corner:
        message = f"no wear of {joint}: it is a corner of a slider, and wear is computed for bearings only"
        raise BadValueError(message, hint="expected a revolute joint with play")
    if not matching[0].dry:
        raise BadValueError(f"{joint} has a film only: nothing wears", hint="expected a contact with a normal law")
    if not has_known_contact_force(source, matching[0]):
        message = f"no wear of {joint}: the force of its film is not known with user-defined laws"
        raise BadValueError(message, hint=f"without {', '.join(name for name, _ in source.laws)}, or without the film")


def parse_wear_rate(k: Any, hardness: Any, k_name: str, hardness_name: str) -> float:
    """Return the wear rate k/H (1/Pa) from the arguments k and hardness of `wear`; without a hardness, k is k/H itself.

    Both are numbers in SI or texts with a unit ("2 GPa"); k is dimensionless with a hardness, else in 1/Pa. `k_name`
    and `hardness_name` of the arguments are for messages. Raises InputError for values that are not positive.
    """

    def parse_positive(value: Any, argument_name: str, exponents: tuple[int, int, int]) -> float:
        """Return a positive number from a text with a unit or a number."""
        return check_positive(
            parse_quantity(value, argument_name, exponents) if isinstance(value, str) else value, argument_name
        )

    if hardness is None:
        return parse_positive(k, k_name, SPECIFIC_RATE)
    return parse_positive(k, k_name, DIMENSIONLESS) / parse_positive(hardness, hardness_name, PRESSURE)


def _build_wear(run: Result, loads: SlidingLoads, rates: tuple[float, float], law: str) -> Wear:
    """Build the Wear of a run from the observed loads of bearing and journal, their wear rates k/H (1/Pa) and the
    law.
    """
    hours = (loads.end - loads.begin) / HOUR
    bearing, journal = (
        Surface(loads.compute_depth(side, law, rate), loads.radii[side], loads.length, hours)
        for side, rate in enumerate(rates)
    )
    span, title = (loads.begin, loads.end), f"{format_one_line(run.source.title)}: {run.source.scene}"
    angle = compute_cell_angles(loads.requested.points)
    return Wear(loads.requested.joint, law, angle, bearing, journal, loads.slip, span, title)


class WearObserver:
    """Observe the contacts of a joint over all steps of one run: sums of load and friction over its circumference."""

    def __init__(
        self, compiled: CompiledModel, request: SlidingRequest, parameter_arrays: tuple[Array, Array, Array]
    ) -> None:
        self.interpolant, self.compiled, self.requested = (
            RunInterpolant(compiled, parameter_arrays, ()),
            compiled,
            request,
        )
        self.joint_index = [clearance.name for clearance in compiled.source.clearances].index(request.joint)
        self.joint = compiled.source.clearances[self.joint_index]
        self.rigid = self.joint.name in compiled.source.rigid_joints
        self.p = clear_oil_viscosities(compiled, self.interpolant.p) if self.joint.film else self.interpolant.p
        self.load, self.friction = np.zeros((2, request.points)), np.zeros((2, request.points))
        self.slip, self.first, self.last, self.n_states = 0.0, np.nan, np.nan, 0

    def __call__(self, steps: Steps) -> None:
        """Process the next states of the run: add the loads of closed intervals within the requested time."""
        path, before = self.interpolant, min(self.n_states, 2)
        path.load_states(steps)
        self.n_states += len(steps)
        x, k = path.steps, np.arange(max(before - 1, 0), len(path.steps) - 1)
        self.first = float(x.t[0]) if np.isnan(self.first) else self.first
        self.last = float(x.t[-1])
        is_finite = np.asarray(np.isfinite(path.run.a[1:]).all(axis=1))
        begin, end = (np.clip(x.t[rows], self.requested.begin, self.requested.end) for rows in (k, k + 1))
        is_loaded = (
            ~x.is_after_jump[k + 1]  # short intervals count too: rounding of positions changes slip and force little
            & (x.state[k, self.joint_index] > 0)
            & is_finite[k]
            & is_finite[k + 1]
            & (end > begin)
        )
        if is_loaded.any():
            self._add_loads(k[is_loaded], begin[is_loaded], end[is_loaded])

    def build_observation(self) -> Observation:
        """Return the loads over the circumference, and a note on states without accelerations, as an Observation."""
        begin, end = max(self.first, self.requested.begin), min(self.last, self.requested.end)
        notes = (
            f"wear: {self.interpolant.n_without_accelerations} states of steps have no accelerations and are left out",
        )
        R_i, R_j, L = (
            float(self.interpolant.p[k]) for k in find_bearing_parameters(self.compiled.source, self.requested.joint)
        )
        sliding = SlidingLoads(self.requested, self.load, self.friction, self.slip, begin, end, (R_i, R_j), L)
        return Observation(notes=notes if self.interpolant.n_without_accelerations else (), sliding_loads=(sliding,))

    def _add_loads(self, k: Array, begin: Array, end: Array) -> None:
        """Add the loads of the intervals between states k and k + 1 (K,), from times `begin` to `end` (K,) in s.

        The integrals of F_n and F_t over the slip are computed by quadrature of an interpolated motion.
        """
        steps, h = self.interpolant.steps, (end - begin)[:, None]
        t = begin[:, None] + h * NODES
        s = ((t - steps.t[k, None]) / (steps.t[k + 1] - steps.t[k])[:, None])[:, :, None]
        q, v = self._interpolate_motion(k, s)
        discrete_states = np.repeat(steps.memory[k][:, None], len(NODES), axis=1)
        states = slice(discrete_states.shape[2] - len(self.compiled.source.internal_states), None)
        discrete_states[:, :, states] += s * (steps.memory[k + 1, states] - steps.memory[k, states])[:, None]
        q_flat, v_flat, states_flat = (array.reshape(t.size, -1) for array in (q, v, discrete_states))
        evaluation = self.compiled.evaluate(t.ravel(), q_flat, v_flat, states_flat, self.p, field_names=("clearance",))
        columns = dict(zip(CLEARANCE_COLUMNS, evaluation.clearance[:, self.joint_index].T, strict=True))
        F_n, F_t, e_x, e_y, e, v_t, delta = (
            columns[name].reshape(t.shape) for name in ("Fn", "Ft", "ex", "ey", "e", "vt", "delta")
        )
        w, touching = (
            h * WEIGHTS,
            self.rigid | (delta > 0.0),
        )  # a rigid contact is closed at δ = 0
        slip = w * np.where(touching, np.abs(v_t), 0.0)
        loads = np.stack([slip * np.maximum(F_n, 0.0), slip * np.abs(F_t)]).reshape(2, -1)  # tension causes no wear
        self.slip += float(slip.sum())
        half_widths = np.arccos(np.clip(1.0 - delta / e, -1.0, 1.0)).ravel() if self.requested.overlap else None
        for side, body in enumerate((self.joint.first, self.joint.second)):
            index = self.compiled.source.bodies[body].index if body >= 0 else -1
            angle = np.unwrap(np.arctan2(e_y, e_x), axis=1) - (q[:, :, index + 2] if body >= 0 else 0.0)
            self._distribute_loads(side, angle, half_widths, loads)

    def _distribute_loads(self, side: int, angle: Array, half_widths: Array | None, loads: Array) -> None:
        """Add the loads of each quadrature point to the cells of the arc that the contact sweeps on a surface.

        `load` and `friction` of that surface are updated. `side`: 0 bearing, 1 journal; `angle` (K, points) in rad;
        `half_widths`: those of the contact in rad, or None for contact at a point; `loads` (2, K·points): normal and
        tangential force times slip, N·m.
        """
        ends = angle @ NODES_TO_ENDS.T
        low, high = np.minimum(ends[:, 1:], ends[:, :-1]), np.maximum(ends[:, 1:], ends[:, :-1])
        cell_loads = distribute_loads(self.requested.points, low.ravel(), high.ravel(), loads, half_widths)
        self.load[side] += cell_loads[0]
        self.friction[side] += cell_loads[1]

    def _interpolate_motion(self, k: Array, s: Array) -> tuple[Array, Array]:
        """Return q and q̇ (K, points, n) at fractions s (K, points, 1) of the intervals after states k (K,).

        They are Hermite polynomials of degree five through positions, velocities and accelerations.
        """
        steps, a = self.interpolant.steps, self.interpolant.run.a[1:]
        h = (steps.t[k + 1] - steps.t[k])[:, None, None]
        q0, q1, v0, v1, a0, a1 = (array[rows][:, None] for array in (steps.q, steps.v, a) for rows in (k, k + 1))
        r0 = q1 - q0 - h * v0 - 0.5 * h**2 * a0  # error of a parabola from the first state at the second
        r1, r2 = h * (v1 - v0 - h * a0), h**2 * (a1 - a0)  # errors of its first and second derivative
        c3, c4, c5 = 10 * r0 - 4 * r1 + 0.5 * r2, -15 * r0 + 7 * r1 - r2, 6 * r0 - 3 * r1 + 0.5 * r2
        q = q0 + s * (h * v0 + s * (0.5 * h**2 * a0 + s * (c3 + s * (c4 + s * c5))))
        v = v0 + s * (h * a0 + s / h * (3 * c3 + s * (4 * c4 + s * 5 * c5)))
        return q, v
