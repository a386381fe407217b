"""Estimate the accuracy of a run for its report, by a repetition, a run of smaller tolerance, and the ideal scene.

The same run is repeated bit for bit and sampled at Gauss points within its contacts. This gives the works of each
joint with play and the speeds at separation. A second run with half the step or a tighter tolerance estimates the
error. The ideal scene gives the forces of joints without play. The findings are in `diagnostics.examined`, also in
files.

`check_contacts` checks the contacts of a run at many more times than its samples: `run.check()`, `run --verify`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.polynomial.legendre import leggauss

from gudgeon.contract.methods import ADAPTIVE, STEP_CONTROLLED_METHODS
from gudgeon.errors import GudgeonError
from gudgeon.language.argument_checks import check_integer
from gudgeon.model.contours import get_contour_depths, interpolate_depth
from gudgeon.results.contact_check import ContactCheck, check_contact_samples
from gudgeon.results.diagnostics import Difference, Examination, IdealForce, JointContactStatistics
from gudgeon.results.samples import prepend_start
from gudgeon.results.series import MOTION, choose_default_series, find_rate_names
from gudgeon.simulation.predictability_horizon import (
    build_repeat_settings,
    build_start_state,
    check_simulation_of_run,
    repeat_run,
)

if TYPE_CHECKING:
    from gudgeon.contract.clearance_info import ClearanceInfo
    from gudgeon.contract.kernel_source import KernelSource
    from gudgeon.integrators.trajectory import Progress
    from gudgeon.model.compiled import Array, CompiledModel
    from gudgeon.results.results import Result
    from gudgeon.results.wear import SlidingRequest
    from gudgeon.simulation.simulation import Simulation

NODES, WEIGHTS = leggauss(6)  # nodes and weights of Gauss's quadrature on −1 to 1
MAX_INTERVALS = 20_000  # largest number of intervals between samples that get Gauss points
MIN_SAMPLES, MAX_SAMPLES = 2, 100_000_000  # limits of the number of intervals of a contact check
NOTE_STORED_SAMPLES = "the run could not be repeated bit for bit: only its stored samples were checked"
NOTE_NOT_REPEATED = "the run could not be repeated bit for bit: the works of its joints are not known"


def examine(
    simulation: Simulation, run: Result, ideal: Simulation | Result | None = None, progress: Progress | None = None
) -> Result:
    """Return the run with `diagnostics.examined`: works and forces of its joints, estimated errors, forces of ideal
    joints.

    `ideal`: the ideal scene, or its run at the run's times; None leaves its forces out. Raises BadValueError for a run
    of another scene, or of a file without the scene. Ctrl-C is passed on.
    """
    check_simulation_of_run(simulation, run, "examine")
    notes: list[str] = []
    run_with_start = prepend_start(run)
    joints = _examine_joints(simulation, run_with_start, notes, progress)
    differences, description = _estimate_errors(simulation, run_with_start, notes, progress)
    examined = Examination(joints, _compute_ideal_forces(run, ideal, notes), differences, description, tuple(notes))
    return replace(run, diagnostics=replace(run.diagnostics, examined=examined))


def _yield_repetitions(
    simulation: Simulation,
    run: Result,
    t: Array,
    settings: dict[str, Any],
    progress: Progress | None,
    peaks: tuple[str | SlidingRequest, ...] = (),
    requested_end: float = math.nan,
) -> Iterator[Result]:
    """Yield repetitions of the run with samples at times t (s), from one or two starts.

    A run from t = 0 that was not resumed is repeated from the file's start first, then from its first sample. Other
    runs are repeated from the state that they resumed, or their first sample. Repetitions that fail or end early are
    skipped. `settings`, `peaks`: arguments of simulate. `requested_end` (s): t_end of a run that an event or an error
    ended at the last of the times; else NaN. Raises KeyboardInterrupt after Ctrl-C.
    """
    own_start, has_end = build_start_state(run), math.isfinite(requested_end)
    times = np.append(t, requested_end) if has_end else t
    for start in (None, own_start) if own_start.t == 0.0 and run.given_start is None else (own_start,):
        try:
            repetition = repeat_run(simulation, times, start, settings, progress, peaks, has_end)
        except GudgeonError:  # for example a start that violates the constraint equations
            continue
        if repetition is not None and repetition.diagnostics.interrupted:
            raise KeyboardInterrupt
        if repetition is not None and len(repetition.t) == len(t):
            yield repetition


def _examine_joints(
    simulation: Simulation, run: Result, notes: list[str], progress: Progress | None
) -> tuple[JointContactStatistics, ...]:
    """Return the works, forces and restitution of each joint with play, from a repetition of the run at Gauss points.

    Return () without play or with one sample. If the run cannot be repeated exactly, return () and append a note to
    `notes`. The work of a single film is the remainder of the energy balance.
    """
    if not run.source.clearances or len(run.t) < 2:
        return ()
    t, weights = _compute_quadrature(run)
    ends = run.impacts["t_off"]
    times = np.unique(np.concatenate([run.t, t, ends[(ends >= run.t[0]) & (ends <= run.t[-1])]]))
    repetition = repeat_run_exactly(simulation, run, times, progress)
    if repetition is None:
        notes.append(NOTE_NOT_REPEATED)
        return ()
    indices, joints = np.searchsorted(repetition.t, t), run.source.clearances
    dry_repetition = repetition  # the same states with the forces of touching surfaces only, without those of films
    if any(joint.dry and joint.film for joint in joints) and not run.source.laws:
        dry_repetition = replace(repetition, p=clear_oil_viscosities(simulation.compiled, repetition.p))
    examined_joints = tuple(
        _examine_joint(run, repetition, dry_repetition, k, joint, indices, weights) for k, joint in enumerate(joints)
    )
    if [joint.film for joint in joints].count(True) != 1 or run.source.laws or run.source.rigid_joints:
        return examined_joints
    remainder = -float(
        weights @ repetition.evaluation.power[indices, 2]
    )  # the film dissipated the remainder, including the work of its shear torque
    remainder -= sum(
        x
        for joint_examined in examined_joints
        for x in (joint_examined.used - joint_examined.returned, joint_examined.friction)
        if math.isfinite(x)
    )
    return tuple(
        replace(joint_examined, film=remainder) if math.isfinite(joint_examined.film) else joint_examined
        for joint_examined in examined_joints
    )


def repeat_run_exactly(
    simulation: Simulation,
    run: Result,
    t: Array,
    progress: Progress | None,
    peaks: tuple[str | SlidingRequest, ...] = (),
) -> Result | None:
    """Repeat the run bit for bit with samples at times t (s), which include its own, and return the repetition.

    Return None if no repetition is identical. `peaks`: argument of simulate.
    """
    settings, requested_end = (
        build_repeat_settings(run)[0],
        math.nan if run.diagnostics.interrupted else run.diagnostics.t_end,
    )
    for repetition in (
        x
        for exact_settings in _yield_exact_repeat_settings(settings)
        for x in _yield_repetitions(simulation, run, t, exact_settings, progress, peaks, requested_end)
    ):
        if repetition.t[-1] != t[-1]:  # its last event has moved
            continue
        same = np.searchsorted(repetition.t, run.t)
        if np.array_equal(repetition.q[same], run.q, equal_nan=True) and np.array_equal(repetition.v[same], run.v):
            return repetition
    return None


def _yield_exact_repeat_settings(settings: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """Yield the arguments of simulate that may repeat the run exactly.

    For methods that "auto" chooses between, the adaptive method comes first, then `settings` as it is.
    """
    if settings["method"] in STEP_CONTROLLED_METHODS and "step" not in settings:
        yield settings | {"method": ADAPTIVE}
    yield settings


def _compute_quadrature(run: Result) -> tuple[Array, Array]:
    """Return times and weights (s) of a Gauss quadrature over all contacts of a run, or over the whole run if it has a
    film.

    Six points lie between successive samples, onsets, peaks, separations and recorded step ends. In runs with more than
    MAX_INTERVALS samples, some samples are skipped.
    """
    edges = [
        run.t[:: max(1, len(run.t) // MAX_INTERVALS)],
        run.t[-1:],
        *(run.impacts[n] for n in ("t_on", "t_off", "t_peak")),
    ]
    edges += [] if run.trace is None else [run.trace.t]
    t = np.unique(np.concatenate(edges))
    t = t[(t >= run.t[0]) & (t <= run.t[-1])]
    half, middle = 0.5 * np.diff(t), 0.5 * (t[1:] + t[:-1])
    is_used = half > 1e-12 * (t[-1] - t[0])
    if not any(joint.film for joint in run.source.clearances):
        begin = np.sort(run.impacts["t_on"])
        end = np.sort(np.where(np.isnan(run.impacts["t_off"]), np.inf, run.impacts["t_off"]))
        is_used &= np.searchsorted(begin, middle, "right") > np.searchsorted(end, middle, "right")
    half, middle = half[is_used], middle[is_used]
    return (middle[:, None] + half[:, None] * NODES).ravel(), (half[:, None] * WEIGHTS).ravel()


def _examine_joint(
    run: Result, repetition: Result, dry_repetition: Result, k: int, joint: ClearanceInfo, indices: Any, weights: Array
) -> JointContactStatistics:
    """Return the examined quantities of joint k from the repeated run `repetition` at the sample indices `indices`.

    `weights` (s) belong to these samples. `dry_repetition` is the same run with the forces of touching surfaces only,
    without oil. Quantities that do not apply, as film work of a dry joint, are NaN.
    """
    name, span = joint.name, float(run.t[-1] - run.t[0])
    e, force = repetition[f"{name}.e"][indices], repetition[f"{name}.F"][indices]
    products = ((dry_repetition[f"{name}.F{axis}"] * repetition[f"{name}.e{axis}"])[indices] for axis in "xy")
    with np.errstate(invalid="ignore", divide="ignore"):
        radial_force = sum(products) / e
        if (
            depths := get_contour_depths(run.source, run.p, name)
        ) is not None:  # component along the penetration's gradient
            bearing = run.source.bodies[joint.first].name if joint.first >= 0 else None
            theta = repetition[f"{bearing}.theta"][indices] if bearing else 0.0
            angle = np.arctan2(repetition[f"{name}.ey"][indices], repetition[f"{name}.ex"][indices]) - theta
            radial_force = -repetition[f"{name}.Fn"][indices] / np.hypot(1.0, interpolate_depth(depths, angle, 1) / e)
        normal = np.where(e > 0.0, radial_force, 0.0) * repetition[f"{name}.deltadot"][indices]  # W, by the forces
    rigid = name in run.source.rigid_joints  # closed at δ = 0, where its force does no work along the normal
    touching = (repetition.state[indices, k] > 0) if rigid else joint.dry & (repetition[f"{name}.delta"][indices] > 0.0)
    slip = (dry_repetition[f"{name}.Ft"] * repetition[f"{name}.vt"])[indices]
    film_power = _compute_film_power(repetition, joint)[indices] if joint.film else np.zeros(len(indices))
    dry_film_power = (
        _compute_film_power(dry_repetition, joint)[indices]
        if dry_repetition is not repetition and joint.film
        else film_power
    )
    works = [
        float(weights @ np.where(touching, power, 0.0))
        for power in (np.maximum(-normal, 0.0), np.maximum(normal, 0.0), -slip)
    ]
    film = float(weights @ np.where(touching, dry_film_power - film_power, -film_power))
    impacting = _compute_compression_time(run, repetition, k, name) / span if joint.dry else math.nan
    rms = math.sqrt(float(weights @ force**2) / span)
    compression, returned, friction = works if joint.dry else (math.nan,) * 3
    compression, returned = (math.nan, math.nan) if rigid else (compression, returned)
    return JointContactStatistics(
        name,
        impacting,
        rms,
        compression,
        returned,
        friction,
        film if joint.film else math.nan,
        *_compute_restitution(run, repetition, k, name),
    )


def has_known_contact_force(source: KernelSource, joint: ClearanceInfo) -> bool:
    """Return whether the contact force of a joint's surfaces is known: it has a dry contact, without a film of a
    user's law.
    """
    return joint.dry and not (joint.film and source.laws)


def clear_oil_viscosities(compiled: CompiledModel, p: Array) -> Array:
    """Return the parameter values (n_p,) of a run with the viscosities of all films set to zero, so that films carry no
    load.

    The derived parameters are computed again.
    """
    parameters = compiled.source.parameters
    values = p[: len(parameters)].copy()
    values[[s.address.startswith("contacts.") and s.address.endswith(".film.viscosity") for s in parameters]] = 0.0
    return compiled.prepare(values, np.ones(len(parameters), dtype=bool))


def _compute_compression_time(run: Result, repetition: Result, k: int, name: str) -> float:
    """Return the sum over the contacts of joint k of the time (s) from the onset to the first maximum of the
    penetration (compression phase).

    Contacts are cut at the ends of the run; zeros of the rate are interpolated between samples of `repetition`. `name`:
    name of the joint.
    """
    rate, total = repetition[f"{name}.deltadot"], 0.0
    for contact in run.impacts[run.impacts["joint"] == k]:
        begin, end = max(contact["t_on"], run.t[0]), contact["t_off"]
        end = run.t[-1] if math.isnan(end) else min(end, run.t[-1])
        first, last = np.searchsorted(repetition.t, (begin, end), "right")
        not_growing = np.flatnonzero(rate[first:last] <= 0.0)
        t_max_penetration = end
        if len(not_growing) and (j := int(first + not_growing[0])) > first and rate[j - 1] > 0.0:
            t_max_penetration = repetition.t[j - 1] + (repetition.t[j] - repetition.t[j - 1]) * rate[j - 1] / (
                rate[j - 1] - rate[j]
            )
        elif len(not_growing):
            t_max_penetration = repetition.t[first + not_growing[0]]
        total += max(float(t_max_penetration - begin), 0.0)
    return total


def _compute_film_power(run: Result, joint: ClearanceInfo) -> Array:
    """Return the power (N,) in W of the film's resultant at the journal's centre: F · (ė − ω_i ẑ × e)."""
    name, source = joint.name, run.source
    bearing = next((part.ends[0] for part in source.parts if part.section == "joints" and part.name == name), "")
    omega = run[f"{source.bodies[joint.first].name}.omega"] if joint.first >= 0 else 0.0
    ex, ey = run[f"{name}.ex"], run[f"{name}.ey"]
    x, y = (_get_point_velocity(run, joint.point, axis) - _get_point_velocity(run, bearing, axis) for axis in (0, 1))
    power: Array = run[f"{name}.Fx"] * (x + omega * ey) + run[f"{name}.Fy"] * (y - omega * ex)
    return power


def _get_point_velocity(run: Result, point: str, axis: int) -> Array:
    """Return the velocity (m/s) of a point along an axis (0: x, 1: y) at each sample; zero for points of the ground."""
    body, _, last = point.rpartition(".")
    name = f"{body if last == 'com' else point}.{MOTION[axis][1]}"
    return run[name] if name in run else np.zeros(len(run.t))


def _compute_restitution(
    run: Result, repetition: Result, k: int, name: str
) -> tuple[int, float, float, float, float, float]:
    """Return the number of ended contacts of joint k, and minimum, quartiles and maximum of their restitution.

    Contacts that began at rest have no restitution. If all did, the five values are NaN. `name`: name of the joint.
    """
    contacts = run.impacts[run.impacts["joint"] == k]
    contacts = contacts[(contacts["t_off"] >= run.t[0]) & (contacts["t_off"] <= run.t[-1])]
    ended, contacts = len(contacts), contacts[contacts["deltadot"] > 0.0]
    separation_speeds = -repetition[f"{name}.deltadot"][np.searchsorted(repetition.t, contacts["t_off"])]
    if not len(contacts):
        return ended, math.nan, math.nan, math.nan, math.nan, math.nan
    low, q1, middle, q3, high = map(
        float, np.quantile(separation_speeds / contacts["deltadot"], (0.0, 0.25, 0.5, 0.75, 1.0))
    )
    return ended, low, q1, middle, q3, high


def _compute_ideal_forces(run: Result, ideal: Simulation | Result | None, notes: list[str]) -> tuple[IdealForce, ...]:
    """Return the largest and rms forces (N) at the joints with play if they had none, from the ideal scene or its run.

    A Simulation is run with the same parameters and times. If it fails, a note is appended to `notes`. Return ()
    without play, masses or an ideal scene, and on failure.
    """
    if ideal is None or run.source.massless_bodies or not run.source.clearances:
        return ()
    if hasattr(ideal, "simulate"):
        addresses = {parameter.address for parameter in ideal.source.parameters}
        values = {
            parameter.address: run.parameters[parameter.address]
            for parameter in run.source.parameters
            if parameter.address in addresses
        }
        try:
            ideal = ideal.simulate(output=run.t, parameters=values, stop=False, peaks=())
        except GudgeonError as error:
            notes.append(f"the run of the ideal scene failed: {str(error).partition(chr(10))[0]}")
            return ()
    forces = []
    joints_with_play = dict.fromkeys(joint.joint for joint in run.source.clearances)
    for name in (joint for joint in joints_with_play if f"{joint}.F" in ideal.names):
        force = ideal[f"{name}.F"]
        if np.isfinite(force).all():
            peak_index = int(force.argmax())
            rms = _compute_mean_square(ideal.t, force) ** 0.5
            forces.append(IdealForce(name, float(force[peak_index]), float(ideal.t[peak_index]), rms))
    return tuple(forces)


def _compute_mean_square(t: Array, values: Array) -> float:
    """Return the mean square over time of a series (N,) at times t (s), by the trapezoidal rule.

    With one sample, return its square.
    """
    span = float(t[-1] - t[0])
    return float(np.trapezoid(values**2, t)) / span if span > 0.0 else float(values[0] ** 2)


def _estimate_errors(
    simulation: Simulation, run: Result, notes: list[str], progress: Progress | None
) -> tuple[tuple[Difference, ...], str]:
    """Return the largest differences of the main series and joint forces from a more accurate run, and a description.

    The more accurate run has half the step or a tighter tolerance, which the description names. Times after the
    predictability horizon are not compared. Return ((), "") for kinematic runs without play and for one sample. If the
    other run fails or ends early, a note is appended to `notes` too.
    """
    if simulation.source.degrees_of_freedom == 0 and not run.source.clearances or len(run.t) < 2:
        return (), ""  # Newton's method at each sample, without steps
    settings_of_run, tighter = build_repeat_settings(run)
    fixed = "step" in settings_of_run
    description = "steps half as long" if fixed else f"tolerance {tighter['rtol']:.3g} a step"
    settings = settings_of_run | {"step": settings_of_run["step"] / 2.0} if fixed else tighter
    accurate_run = next(_yield_repetitions(simulation, run, run.t, settings, progress), None)
    if accurate_run is None:
        notes.append(f"errors are not estimated: a run with {description} fails or ends before the end of this run")
        return (), ""
    horizon = run.diagnostics.horizon
    until = min(horizon, float(run.t[-1])) if math.isfinite(horizon) else float(run.t[-1])
    is_compared = run.t <= until
    names = [
        name
        for default_name in choose_default_series(run)
        for name in (default_name, *find_rate_names(default_name))
        if name
    ]
    results = []
    for name in dict.fromkeys([*names, *(f"{joint.name}.F" for joint in run.source.clearances)]):
        differences = np.abs(accurate_run[name] - run[name])[is_compared]
        if np.isfinite(differences).all():
            index = int(differences.argmax())
            results.append(Difference(name, run.unit(name), float(differences[index]), float(run.t[index]), until))
    return tuple(results), description


def check_contacts(run: Result, n_intervals: int, progress: Progress | None = None) -> ContactCheck:
    """Check the contacts of a run at the ends of `n_intervals` equal intervals and at its samples; see Result.check.

    The run is repeated bit for bit for more samples. If it cannot be, only stored samples are checked, and a note says
    so. Returns a ContactCheck with the faults. `progress` None: nothing is reported.
    """
    from gudgeon.simulation.simulation import Simulation

    n_intervals = check_integer(n_intervals, "samples", MIN_SAMPLES, MAX_SAMPLES)
    run = prepend_start(run)
    if not run.source.clearances or len(run.t) < MIN_SAMPLES:
        return check_contact_samples(run)
    dense_run = run
    if run.compiled is not None:
        times = np.union1d(run.t, np.linspace(run.t[0], run.t[-1], n_intervals + 1))
        dense_run = repeat_run_exactly(Simulation(run.compiled, ""), run, times, progress) or run
    check = check_contact_samples(dense_run, run)
    return check if dense_run is not run else replace(check, notes=(NOTE_STORED_SAMPLES,))
