"""Examine a run by further runs, for its report: `examine(simulation, run, ideal)`.

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

from gudgeon.contract.methods import ADAPTIVE, CHOOSING
from gudgeon.errors import GudgeonError
from gudgeon.language.argument_checks import whole as whole_number
from gudgeon.model.contours import contour_of, depth_at
from gudgeon.results.contact_check import ContactCheck, check_samples
from gudgeon.results.diagnostics import Difference, Examined, IdealForce, JointExamined
from gudgeon.results.samples import with_start
from gudgeon.results.series import MOTION, default_watch, rates
from gudgeon.simulation.horizon import check_simulation_of_run, repeat_settings, repeated, start_of_run

if TYPE_CHECKING:
    from gudgeon.contract.clearance_info import ClearanceInfo
    from gudgeon.contract.kernel_source import KernelSource
    from gudgeon.integrators.trajectory import Progress
    from gudgeon.model.compiled import Array, CompiledModel
    from gudgeon.results.results import Result
    from gudgeon.results.wear import SlidingRequest
    from gudgeon.simulation.simulation import Simulation

NODES, WEIGHTS = leggauss(6)  # nodes and weights of Gauss's quadrature on −1 to 1
MOST = 20_000  # largest number of intervals between samples that get Gauss points
MIN_SAMPLES, MAX_SAMPLES = 2, 100_000_000  # limits of the number of intervals of a contact check
STORED = "the run could not be repeated bit for bit: only its stored samples were checked"
ANOTHER = "the run could not be repeated bit for bit: where the work of its joints went is not known"


def examine(
    simulation: Simulation, run: Result, ideal: Simulation | Result | None = None, progress: Progress | None = None
) -> Result:
    """Return the run with `diagnostics.examined`. `ideal`: the ideal scene, or its run at the run's times.

    Raises BadValueError for a run of another scene, or of a file without the scene. Ctrl-C is passed on.
    """
    check_simulation_of_run(simulation, run, "examine")
    notes: list[str] = []
    whole = with_start(run)
    joints = _examine_joints(simulation, whole, notes, progress)
    differences, message = _estimate_errors(simulation, whole, notes, progress)
    found = Examined(joints, _ideal_forces(run, ideal, notes), differences, message, tuple(notes))
    return replace(run, diagnostics=replace(run.diagnostics, examined=found))


def _repeat_run(
    simulation: Simulation,
    run: Result,
    t: Array,
    settings: dict[str, Any],
    progress: Progress | None,
    peaks: tuple[str | SlidingRequest, ...] = (),
    beyond: float = math.nan,
) -> Iterator[Result]:
    """Yield repetitions of the run with samples at times t: from the file's start, then from its first sample.

    Repetitions that end early are skipped. `beyond` (s): end of the repetition if an event or an error ended the run
    at the last of the times; NaN if nothing did.
    """
    begin, ends = start_of_run(run), math.isfinite(beyond)
    times = np.append(t, beyond) if ends else t
    for start in (None, begin) if begin.t == 0.0 and run.begun is None else (begin,):
        try:
            other = repeated(simulation, times, start, settings, progress, peaks, ends)
        except GudgeonError:  # a start that does not close any more
            continue
        if other is not None and other.diagnostics.interrupted:
            raise KeyboardInterrupt
        if other is not None and len(other.t) == len(t):
            yield other


def _examine_joints(
    simulation: Simulation, run: Result, notes: list[str], progress: Progress | None
) -> tuple[JointExamined, ...]:
    """Return the works, forces and restitution of each joint with play, from a repetition of the run."""
    if not run.source.clearances or len(run.t) < 2:
        return ()
    t, weights = _quadrature(run)
    ends = run.impacts["t_off"]
    every = np.unique(np.concatenate([run.t, t, ends[(ends >= run.t[0]) & (ends <= run.t[-1])]]))
    other = repeat_exactly(simulation, run, every, progress)
    if other is None:
        notes.append(ANOTHER)
        return ()
    at, joints = np.searchsorted(other.t, t), run.source.clearances
    solid = other  # the same states, and of its joints' forces what the surfaces bear that touch
    if any(joint.dry and joint.film for joint in joints) and not run.source.laws:
        solid = replace(other, p=without_oil(simulation.compiled, other.p))
    found = tuple(_examine_joint(run, other, solid, k, joint, at, weights) for k, joint in enumerate(joints))
    if [joint.film for joint in joints].count(True) != 1 or run.source.laws or run.source.rigid:
        return found
    rest = -float(weights @ other.evaluation.power[at, 2])  # its film took, the torque of its shear too, all the rest
    rest -= sum(x for one in found for x in (one.used - one.returned, one.friction) if math.isfinite(x))
    return tuple(replace(one, film=rest) if math.isfinite(one.film) else one for one in found)


def repeat_exactly(
    simulation: Simulation,
    run: Result,
    t: Array,
    progress: Progress | None,
    peaks: tuple[str | SlidingRequest, ...] = (),
) -> Result | None:
    """Return the run repeated bit for bit at times t, which include its own; None if that does not succeed."""
    usual, to = repeat_settings(run)[0], math.nan if run.diagnostics.interrupted else run.diagnostics.t_end
    for other in (
        x for own in _exact_settings(usual) for x in _repeat_run(simulation, run, t, own, progress, peaks, to)
    ):
        if other.t[-1] != t[-1]:  # its event is not quite where it was
            continue
        same = np.searchsorted(other.t, run.t)
        if np.array_equal(other.q[same], run.q, equal_nan=True) and np.array_equal(other.v[same], run.v):
            return other
    return None


def _exact_settings(usual: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """Yield the settings that may repeat the run exactly: for "auto", first those of the method that made all steps."""
    if usual["method"] in CHOOSING and "step" not in usual:
        yield usual | {"method": ADAPTIVE}
    yield usual


def _quadrature(run: Result) -> tuple[Array, Array]:
    """Return times (s) and weights (s) of a quadrature over all contacts, or over the whole run if there is a film."""
    edges = [run.t[:: max(1, len(run.t) // MOST)], run.t[-1:], *(run.impacts[n] for n in ("t_on", "t_off", "t_peak"))]
    edges += [] if run.trace is None else [run.trace.t]
    t = np.unique(np.concatenate(edges))
    t = t[(t >= run.t[0]) & (t <= run.t[-1])]
    half, middle = 0.5 * np.diff(t), 0.5 * (t[1:] + t[:-1])
    kept = half > 1e-12 * (t[-1] - t[0])
    if not any(joint.film for joint in run.source.clearances):
        begin = np.sort(run.impacts["t_on"])
        end = np.sort(np.where(np.isnan(run.impacts["t_off"]), np.inf, run.impacts["t_off"]))
        kept &= np.searchsorted(begin, middle, "right") > np.searchsorted(end, middle, "right")
    half, middle = half[kept], middle[kept]
    return (middle[:, None] + half[:, None] * NODES).ravel(), (half[:, None] * WEIGHTS).ravel()


def _examine_joint(
    run: Result, other: Result, solid: Result, k: int, joint: ClearanceInfo, at: Any, weights: Array
) -> JointExamined:
    """Return the examined quantities of joint k from the repeated run `other` at the sample indices `at`.

    `solid` is the same run whose forces are those of the touching surfaces only.
    """
    name, span = joint.name, float(run.t[-1] - run.t[0])
    e, force = other[f"{name}.e"][at], other[f"{name}.F"][at]
    parts = ((solid[f"{name}.F{axis}"] * other[f"{name}.e{axis}"])[at] for axis in "xy")
    with np.errstate(invalid="ignore", divide="ignore"):
        along = sum(parts) / e
        if (depths := contour_of(run.source, run.p, name)) is not None:  # of the force, what acts by the penetration
            bearing = run.source.bodies[joint.first].name if joint.first >= 0 else None
            theta = other[f"{bearing}.theta"][at] if bearing else 0.0
            angle = np.arctan2(other[f"{name}.ey"][at], other[f"{name}.ex"][at]) - theta
            along = -other[f"{name}.Fn"][at] / np.hypot(1.0, depth_at(depths, angle, 1) / e)
        normal = np.where(e > 0.0, along, 0.0) * other[f"{name}.deltadot"][at]  # W, by the forces
    rigid = name in run.source.rigid  # closed at δ = 0, where its force does no work along the normal
    touching = (other.state[at, k] > 0) if rigid else joint.dry & (other[f"{name}.delta"][at] > 0.0)
    slip = (solid[f"{name}.Ft"] * other[f"{name}.vt"])[at]
    in_film = _film_power(other, joint)[at] if joint.film else np.zeros(len(at))
    of_both = _film_power(solid, joint)[at] if solid is not other and joint.film else in_film
    found = [
        float(weights @ np.where(touching, power, 0.0))
        for power in (np.maximum(-normal, 0.0), np.maximum(normal, 0.0), -slip)
    ]
    film = float(weights @ np.where(touching, of_both - in_film, -in_film))
    impacting = _compression_time(run, other, k, name) / span if joint.dry else math.nan
    rms = math.sqrt(float(weights @ force**2) / span)
    used, returned, friction = found if joint.dry else (math.nan,) * 3
    used, returned = (math.nan, math.nan) if rigid else (used, returned)
    return JointExamined(
        name,
        impacting,
        rms,
        used,
        returned,
        friction,
        film if joint.film else math.nan,
        *_restitution(run, other, k, name),
    )


def has_known_contact_force(source: KernelSource, joint: ClearanceInfo) -> bool:
    """Return whether a joint's surfaces touch with a known contact force; not beside a film of a user-defined law."""
    return joint.dry and not (joint.film and source.laws)


def without_oil(compiled: CompiledModel, p: Array) -> Array:
    """Return the parameter values p of a run with all oil viscosities zero, so that its films carry no load."""
    slots = compiled.source.slots
    values = p[: len(slots)].copy()
    values[[s.address.startswith("contacts.") and s.address.endswith(".film.viscosity") for s in slots]] = 0.0
    return compiled.prepare(values, np.ones(len(slots), dtype=bool))


def _compression_time(run: Result, other: Result, k: int, name: str) -> float:
    """Return the total time (s) from each onset of joint k until its penetration first stops growing."""
    rate, total = other[f"{name}.deltadot"], 0.0
    for contact in run.impacts[run.impacts["joint"] == k]:
        begin, end = max(contact["t_on"], run.t[0]), contact["t_off"]
        end = run.t[-1] if math.isnan(end) else min(end, run.t[-1])
        first, last = np.searchsorted(other.t, (begin, end), "right")
        fell = np.flatnonzero(rate[first:last] <= 0.0)
        turn = end
        if len(fell) and (j := int(first + fell[0])) > first and rate[j - 1] > 0.0:
            turn = other.t[j - 1] + (other.t[j] - other.t[j - 1]) * rate[j - 1] / (rate[j - 1] - rate[j])
        elif len(fell):
            turn = other.t[first + fell[0]]
        total += max(float(turn - begin), 0.0)
    return total


def _film_power(run: Result, joint: ClearanceInfo) -> Array:
    """Return the power (N,) in W of the film's resultant at the journal's centre: F · (ė − ω_i ẑ × e)."""
    name, source = joint.name, run.source
    bearing = next((part.ends[0] for part in source.parts if part.section == "joints" and part.name == name), "")
    omega = run[f"{source.bodies[joint.first].name}.omega"] if joint.first >= 0 else 0.0
    ex, ey = run[f"{name}.ex"], run[f"{name}.ey"]
    x, y = (_rate(run, joint.point, axis) - _rate(run, bearing, axis) for axis in (0, 1))
    power: Array = run[f"{name}.Fx"] * (x + omega * ey) + run[f"{name}.Fy"] * (y - omega * ex)
    return power


def _rate(run: Result, point: str, axis: int) -> Array:
    """Return the velocity (m/s) of a point along an axis (0: x, 1: y); zero for points of the ground."""
    body, _, last = point.rpartition(".")
    name = f"{body if last == 'com' else point}.{MOTION[axis][1]}"
    return run[name] if name in run else np.zeros(len(run.t))


def _restitution(run: Result, other: Result, k: int, name: str) -> tuple[int, float, float, float, float, float]:
    """Return the number of ended contacts, and minimum, quartiles and maximum of their restitution.

    Contacts that began at rest, such as closed ones pressed by the impact of another contact, are not counted in it.
    """
    own = run.impacts[run.impacts["joint"] == k]
    own = own[(own["t_off"] >= run.t[0]) & (own["t_off"] <= run.t[-1])]
    ended, own = len(own), own[own["deltadot"] > 0.0]
    parting = -other[f"{name}.deltadot"][np.searchsorted(other.t, own["t_off"])]
    if not len(own):
        return ended, math.nan, math.nan, math.nan, math.nan, math.nan
    low, q1, middle, q3, high = map(float, np.quantile(parting / own["deltadot"], (0.0, 0.25, 0.5, 0.75, 1.0)))
    return ended, low, q1, middle, q3, high


def _ideal_forces(run: Result, ideal: Simulation | Result | None, notes: list[str]) -> tuple[IdealForce, ...]:
    """Return the largest and rms forces at the joints with play if they had none, from the ideal scene."""
    if ideal is None or run.source.massless or not run.source.clearances:
        return ()
    if hasattr(ideal, "simulate"):
        known = {slot.address for slot in ideal.source.slots}
        values = {slot.address: run.parameters[slot.address] for slot in run.source.slots if slot.address in known}
        try:
            ideal = ideal.simulate(output=run.t, parameters=values, stop=False, peaks=())
        except GudgeonError as error:
            notes.append(f"the ideal scene cannot be followed: {str(error).partition(chr(10))[0]}")
            return ()
    found = []
    played = dict.fromkeys(joint.joint for joint in run.source.clearances)
    for name in (joint for joint in played if f"{joint}.F" in ideal.names):
        force = ideal[f"{name}.F"]
        if np.isfinite(force).all():
            at = int(force.argmax())
            rms = mean_square(ideal.t, force) ** 0.5
            found.append(IdealForce(name, float(force[at]), float(ideal.t[at]), rms))
    return tuple(found)


def mean_square(t: Array, values: Array) -> float:
    """Return the mean square over time of a series by the trapezoidal rule; of one sample, its square."""
    span = float(t[-1] - t[0])
    return float(np.trapezoid(values**2, t)) / span if span > 0.0 else float(values[0] ** 2)


def _estimate_errors(
    simulation: Simulation, run: Result, notes: list[str], progress: Progress | None
) -> tuple[tuple[Difference, ...], str]:
    """Return how far the main series and joint forces change in a more accurate run, and how that was run.

    Times after the predictability horizon are not compared.
    """
    if simulation.source.degrees_of_freedom == 0 and not run.source.clearances or len(run.t) < 2:
        return (), ""  # Newton's method at each sample, without steps
    usual, tighter = repeat_settings(run)
    fixed = "step" in usual
    message = "steps half as long" if fixed else f"tolerance {tighter['rtol']:.3g} a step"
    settings = usual | {"step": usual["step"] / 2.0} if fixed else tighter
    other = next(_repeat_run(simulation, run, run.t, settings, progress), None)
    if other is None:
        notes.append(f"a run with {message} does not come to the end of this one")
        return (), ""
    horizon = run.diagnostics.horizon
    until = min(horizon, float(run.t[-1])) if math.isfinite(horizon) else float(run.t[-1])
    believed = run.t <= until
    names = [name for watched in default_watch(run) for name in (watched, *rates(watched)) if name]
    found = []
    for name in dict.fromkeys([*names, *(f"{joint.name}.F" for joint in run.source.clearances)]):
        apart = np.abs(other[name] - run[name])[believed]
        if np.isfinite(apart).all():
            at = int(apart.argmax())
            found.append(Difference(name, run.unit(name), float(apart[at]), float(run.t[at]), until))
    return tuple(found), message


def check_contacts(run: Result, samples: int, progress: Progress | None = None) -> ContactCheck:
    """Return the check of a run's contacts at `samples` equal intervals and at its own samples; see Result.check."""
    from gudgeon.simulation.simulation import Simulation

    samples = whole_number(samples, "samples", MIN_SAMPLES, MAX_SAMPLES)
    run = with_start(run)
    if not run.source.clearances or len(run.t) < MIN_SAMPLES:
        return check_samples(run)
    dense = run
    if run.compiled is not None:
        times = np.union1d(run.t, np.linspace(run.t[0], run.t[-1], samples + 1))
        dense = repeat_exactly(Simulation(run.compiled, ""), run, times, progress) or run
    found = check_samples(dense, run)
    return found if dense is not run else replace(found, notes=(STORED,))
