"""Independent check of the contacts of a run: `run.check()`.

The penetration of every joint with play is computed in NumPy from positions of the bodies alone, at the samples of a
run. Nothing of the engine that locates contacts is used. A joint must not penetrate outside a contact of
`run.impacts`, must not carry a force there, a rigid contact must not pull, and no peak may exceed the largest force of
the listed contacts.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.boundary import SHALLOW
from gudgeon.contract.clearance_info import ClearanceInfo
from gudgeon.errors import SolverError
from gudgeon.model.compiled import Array
from gudgeon.model.contours import contour_of, corner_approach, depth_at
from gudgeon.results.series import point_motion

if TYPE_CHECKING:
    from gudgeon.results.results import Result

DEPTH_TOL = 1e-9  # of the clearance, that a penetration outside a contact is rounding; 1e-13 m at least
FORCE_TOL = 1e-12  # of a joint's largest force, that a force outside a contact is rounding
TIME_TOL = 1e-11  # of the span of a run, by which a sample may miss the end of a contact
PULL_TOL = 1e-6  # of the largest force, by which a rigid contact may seem to pull
PEAK_TOL = 1e-3  # relative, by which a peak may exceed the largest force of the contacts
PEAK_TOL_FIXED = 0.1  # the same of rk4, whose contacts have the largest force at the ends of steps alone


@dataclass(frozen=True)
class Fault:
    """A contradiction between the samples of a run and its list of contacts, at one joint over neighbouring samples.

    kind: "penetration" or "force" outside every listed contact, "pull" of a rigid contact, "peak" above the largest
    force of the contacts.
    """

    kind: str
    joint: str
    t: float  # s, where it is largest
    depth: float  # m, the largest penetration there
    force: float  # N, the largest force there; NaN: not known

    def __str__(self) -> str:
        """Return kind, joint, depth or force, and time of the fault as a sentence."""
        where = f"at t = {self.t:.9g} s"
        if self.kind == "penetration":
            return f"joint {self.joint} penetrates {self.depth:.3g} m outside every listed contact {where}"
        if self.kind == "force":
            return f"joint {self.joint} carries {self.force:.4g} N outside every listed contact {where}"
        if self.kind == "pull":
            return f"joint {self.joint} pulls with {self.force:.4g} N, which a rigid contact cannot, {where}"
        return f"joint {self.joint} has a peak of {self.force:.4g} N above every listed contact {where}"


@dataclass(frozen=True)
class ContactCheck:
    """Result of a check: faults sorted by time, the number of checked samples, and notes."""

    samples: int
    faults: tuple[Fault, ...]
    notes: tuple[str, ...] = ()

    def __bool__(self) -> bool:
        """Return True if there is no fault."""
        return not self.faults

    def __str__(self) -> str:
        """Return the number of samples and faults, then notes and faults, one a line."""
        head = f"contacts checked at {self.samples} samples: {len(self.faults) or 'no'} faults"
        return "\n".join([head, *self.notes, *map(str, self.faults)])

    def raise_faults(self) -> None:
        """Raise SolverError with joint, time and depth of every fault; return without an effect if there is none."""
        if self.faults:
            raise SolverError(str(self), self.faults[0].t)


def penetrations(run: Result) -> Array:
    """Return the penetration of each joint with play at all samples, (N, n_clearances), m, from the positions of the
    bodies.

    Negative values mean that the surfaces are apart.
    """
    columns = [
        _wall_penetration(run, joint) if joint.at_wall else _bearing_penetration(run, joint)
        for joint in run.source.clearances
    ]
    return np.stack(columns, axis=1) if columns else np.zeros((len(run.t), 0))


def check_samples(run: Result, peaks: Result | None = None) -> ContactCheck:
    """Compare the samples of a run with its list of contacts and return the faults.

    `peaks` is the run whose diagnostics have the peaks over all steps; None: the same run.
    """
    found: list[Fault] = []
    delta = penetrations(run)
    for k, joint in enumerate(run.source.clearances):
        if not joint.dry:
            continue
        force = np.full(len(run.t), np.nan) if run.compiled is None or joint.film else run[f"{joint.name}.F"]
        free = ~_in_contact(run, k)
        limit = max(DEPTH_TOL * float(run.p[joint.clearance]), SHALLOW)
        found += _find_excursions(run, joint, "penetration", free & (delta[:, k] > limit), delta[:, k], force)
        touches = free & (np.abs(delta[:, k]) <= SHALLOW)
        bears = (force > FORCE_TOL * float(np.nanmax(force, initial=0.0))) & ~touches
        found += _find_excursions(run, joint, "force", free & (delta[:, k] <= limit) & bears, delta[:, k], force)
        if joint.name in run.source.rigid and run.compiled is not None:
            pull = sum(run[f"{joint.name}.F{axis}"] * run[f"{joint.name}.e{axis}"] for axis in "xy")
            wrong = ~free & (pull > PULL_TOL * float(np.abs(pull).max(initial=0.0)))
            found += _find_excursions(run, joint, "pull", wrong, delta[:, k], force)
        found += _find_peak_faults(peaks or run, k, joint, float(np.nanmax(force[touches], initial=0.0)))
    return ContactCheck(len(run.t), tuple(sorted(found, key=lambda one: one.t)))


def _in_contact(run: Result, k: int) -> NDArray[np.bool_]:
    """Return for each sample whether it lies in a listed contact of joint k, (N,)."""
    impacts = run.impacts[run.impacts["joint"] == k]
    slack = TIME_TOL * float(run.t[-1] - run.t[0])
    inside = np.zeros(len(run.t) + 1, int)
    ends = np.where(np.isnan(impacts["t_off"]), np.inf, impacts["t_off"])
    np.add.at(inside, np.searchsorted(run.t, impacts["t_on"] - slack), 1)
    np.add.at(inside, np.searchsorted(run.t, ends + slack, "right"), -1)
    return np.cumsum(inside)[:-1] > 0


def _find_excursions(
    run: Result, joint: ClearanceInfo, kind: str, wrong: NDArray[np.bool_], delta: Array, force: Array
) -> Iterator[Fault]:
    """Yield one fault for each series of neighbouring samples that `wrong` marks."""
    at = np.flatnonzero(wrong)
    for part in np.split(at, np.flatnonzero(np.diff(at) > 1) + 1):
        if len(part):
            deepest = part[np.argmax(delta[part])] if kind == "penetration" else part[np.argmax(force[part])]
            largest = float(force[part].max())
            yield Fault(kind, joint.name, float(run.t[deepest]), float(delta[part].max()), largest)


def _find_peak_faults(run: Result, k: int, joint: ClearanceInfo, touches: float) -> Iterator[Fault]:
    """Yield a fault for each peak over all steps that exceeds the force of every listed contact.

    Joints with a film are skipped, since they have forces outside contacts.
    """
    if joint.film or (joint.at_wall and joint.joint in run.source.rigid):
        return
    impacts = run.impacts[run.impacts["joint"] == k]
    if joint.name in run.source.rigid:  # those without a duration have impulses
        impacts = impacts[impacts["t_off"] != impacts["t_on"]]
    largest = float(impacts["F_peak"].max(initial=0.0))
    extremes = [one for one in run.diagnostics.extremes if one.name == f"{joint.name}.F" and not one.against]
    peaks = [(one.max, one.t_max) for one in extremes]
    peaks += [(one.F, one.t) for one in run.diagnostics.peaks if one.joint == joint.name]
    allowed = max(touches, largest * (1.0 + (PEAK_TOL_FIXED if np.isfinite(run.diagnostics.step) else PEAK_TOL)))
    for F, t in peaks:
        if allowed < F:
            yield Fault("peak", joint.name, t, float("nan"), F)


def _bearing_penetration(run: Result, joint: ClearanceInfo) -> Array:
    """Return the penetration of a journal at all samples, (N,), m: ‖e‖ − c, less the contour's depth in the direction
    of e.
    """
    first, second = _end_points(run, joint)
    ex, ey = (_point_positions(run, second) - _point_positions(run, first)).T
    delta = np.hypot(ex, ey) - float(run.p[joint.clearance])
    if (depths := contour_of(run.source, run.p, joint.name)) is not None:
        delta -= depth_at(depths, np.arctan2(ey, ex) - _body_angle(run, joint.first))
    return delta


def _wall_penetration(run: Result, joint: ClearanceInfo) -> Array:
    """Return the penetration of a slider's corner at all samples, (N,), m.

    It is the displacement of the corner towards its wall from the middle of the guide, less the gap.
    """
    first, second = _end_points(run, joint)
    place = run.source.place
    numbers = {
        key: float(run.p[place[at]]) if (at := f"joints.{joint.joint}.{key}") in place else 0.0
        for key in ("axis.x", "axis.y", "angle")
    }
    direction = np.arctan2(numbers["axis.y"], numbers["axis.x"]) + _body_angle(run, joint.first)
    turned = numbers["angle"] if f"joints.{joint.joint}.angle" in place or _has_mounting_angle(run, joint) else None
    mounted = np.arctan2(numbers["axis.y"], numbers["axis.x"]) if turned is None else turned
    tilt = _body_angle(run, joint.second) - _body_angle(run, joint.first) - mounted
    distance = _point_positions(run, second) - _point_positions(run, first)
    offset = distance[:, 1] * np.cos(direction) - distance[:, 0] * np.sin(direction)
    return np.asarray(corner_approach(run.source, run.p, joint, offset, tilt) - float(run.p[joint.clearance]))


def _has_mounting_angle(run: Result, joint: ClearanceInfo) -> bool:
    """Return whether the mechanism file specifies the mounting angle of the joint."""
    return any(one.address == f"joints.{joint.joint}.angle" for one in run.source.written)


def _end_points(run: Result, joint: ClearanceInfo) -> tuple[str, str]:
    """Return the names of the two points that a joint connects: that of the bearing, then that of the journal."""
    part = next(one for one in run.source.parts if one.section == "joints" and one.name == joint.joint)
    return part.ends[0], part.ends[1]


def _body_angle(run: Result, body: int) -> Array:
    """Return the angle of a body at all samples, (N,), rad; 0 for the ground (body < 0)."""
    return run.q[:, run.source.bodies[body].index + 2] if body >= 0 else np.zeros(len(run.t))


def _point_positions(run: Result, name: str) -> Array:
    """Return the positions of a point at all samples, (N, 2), m; the origin for the ground itself."""
    info = next((one for one in run.source.points if one.name == name), None)
    if info is None:
        return np.zeros((len(run.t), 2))
    return np.stack([point_motion(run, info, axis, 0) for axis in (0, 1)], axis=1)
