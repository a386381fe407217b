"""Check the contacts of a run, `run.check()`, by computations that are independent of the integrator.

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

from gudgeon.contract.boundary import MIN_TOUCHING_PENETRATION
from gudgeon.contract.clearance_info import ClearanceInfo
from gudgeon.errors import SolverError
from gudgeon.model.compiled import Array
from gudgeon.model.contours import compute_corner_approach, get_contour_depths, interpolate_depth

if TYPE_CHECKING:
    from gudgeon.results.results import Result

DEPTH_TOL = 1e-9  # penetration without contact that is rounding, over the clearance; >= MIN_TOUCHING_PENETRATION (m)
FORCE_TOL = 1e-12  # force outside a contact that counts as rounding, over the joint's largest force
TIME_TOL = 1e-11  # widening of the interval of a contact, over the duration of the run
PULL_TOL = 1e-6  # tensile force of a rigid contact that counts as rounding, over the largest force
PEAK_TOL = 1e-3  # relative excess of a peak over the largest force of the contacts
PEAK_TOL_FIXED = 0.1  # the same for rk4, which evaluates the forces of contacts at the ends of steps only


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


def compute_penetrations(run: Result) -> Array:
    """Return the penetration of each joint with play at all samples, (N, n_clearances), m, from positions of bodies.

    Negative values are gaps. NumPy computes it without the engine; (N, 0) without joints with play.
    """
    columns = [
        _compute_wall_penetration(run, joint) if joint.is_corner else _compute_bearing_penetration(run, joint)
        for joint in run.source.clearances
    ]
    return np.stack(columns, axis=1) if columns else np.zeros((len(run.t), 0))


def check_contact_samples(run: Result, run_with_peaks: Result | None = None) -> ContactCheck:
    """Compare the samples of a run with its list of contacts and return a ContactCheck with the faults, by time.

    Kinds of faults: "penetration" or "force" outside of the listed contacts, "pull" (a rigid contact that attracts),
    and "peak" (a peak of the force that no listed contact has). `run_with_peaks` is the run whose diagnostics have the
    peaks over all steps; None: the same run. Joints without dry contact are skipped. Forces are checked only with a
    compiled library and in joints without a film.
    """
    faults: list[Fault] = []
    penetration = compute_penetrations(run)
    for k, joint in enumerate(run.source.clearances):
        if not joint.dry:
            continue
        force = np.full(len(run.t), np.nan) if run.compiled is None or joint.film else run[f"{joint.name}.F"]
        is_free = ~_find_samples_in_contact(run, k)
        depth_limit = max(DEPTH_TOL * float(run.p[joint.clearance]), MIN_TOUCHING_PENETRATION)
        faults += _find_sample_faults(
            run, joint, "penetration", is_free & (penetration[:, k] > depth_limit), penetration[:, k], force
        )
        is_touching = is_free & (np.abs(penetration[:, k]) <= MIN_TOUCHING_PENETRATION)
        carries_force = (force > FORCE_TOL * float(np.nanmax(force, initial=0.0))) & ~is_touching
        faults += _find_sample_faults(
            run, joint, "force", is_free & (penetration[:, k] <= depth_limit) & carries_force, penetration[:, k], force
        )
        if joint.name in run.source.rigid_joints and run.compiled is not None:
            pull = sum(run[f"{joint.name}.F{axis}"] * run[f"{joint.name}.e{axis}"] for axis in "xy")
            pulls = ~is_free & (pull > PULL_TOL * float(np.abs(pull).max(initial=0.0)))
            faults += _find_sample_faults(run, joint, "pull", pulls, penetration[:, k], force)
        faults += _find_peak_faults(run_with_peaks or run, k, joint, float(np.nanmax(force[is_touching], initial=0.0)))
    return ContactCheck(len(run.t), tuple(sorted(faults, key=lambda fault: fault.t)))


def _find_samples_in_contact(run: Result, k: int) -> NDArray[np.bool_]:
    """Return a mask (N,) of the samples that lie in a listed contact of joint k.

    Contacts without an end last to the end of the run; both ends are widened by TIME_TOL.
    """
    impacts = run.impacts[run.impacts["joint"] == k]
    tolerance = TIME_TOL * float(run.t[-1] - run.t[0])
    n_contacts = np.zeros(len(run.t) + 1, int)
    ends = np.where(np.isnan(impacts["t_off"]), np.inf, impacts["t_off"])
    np.add.at(n_contacts, np.searchsorted(run.t, impacts["t_on"] - tolerance), 1)
    np.add.at(n_contacts, np.searchsorted(run.t, ends + tolerance, "right"), -1)
    return np.cumsum(n_contacts)[:-1] > 0


def _find_sample_faults(
    run: Result, joint: ClearanceInfo, kind: str, fault_mask: NDArray[np.bool_], penetration: Array, force: Array
) -> Iterator[Fault]:
    """Yield one fault of a kind for each group of neighbouring samples that `fault_mask` (N,) marks.

    `penetration` (m) and `force` (N) are those of the joint at all samples, (N,). The fault has their largest values.
    Its time is that of the largest penetration for "penetration", else that of the largest force.
    """
    indices = np.flatnonzero(fault_mask)
    for neighbour_indices in np.split(indices, np.flatnonzero(np.diff(indices) > 1) + 1):
        if len(neighbour_indices):
            index = (
                neighbour_indices[np.argmax(penetration[neighbour_indices])]
                if kind == "penetration"
                else neighbour_indices[np.argmax(force[neighbour_indices])]
            )
            max_force = float(force[neighbour_indices].max())
            yield Fault(kind, joint.name, float(run.t[index]), float(penetration[neighbour_indices].max()), max_force)


def _find_peak_faults(run: Result, k: int, joint: ClearanceInfo, max_touching_force: float) -> Iterator[Fault]:
    """Yield a fault for each peak over all steps that exceeds the force of every listed contact of joint k.

    The excess must be above PEAK_TOL, or PEAK_TOL_FIXED for a fixed step. Joints with a film and rigid guides are
    skipped. `max_touching_force` (N) is the largest force of samples with |penetration| up to MIN_TOUCHING_PENETRATION.
    """
    if joint.film or (joint.is_corner and joint.joint in run.source.rigid_joints):
        return
    impacts = run.impacts[run.impacts["joint"] == k]
    if joint.name in run.source.rigid_joints:  # F_peak of a rigid impact is an impulse
        impacts = impacts[impacts["t_off"] != impacts["t_on"]]
    max_contact_force = float(impacts["F_peak"].max(initial=0.0))
    force_extremes = [
        extremes for extremes in run.diagnostics.extremes if extremes.name == f"{joint.name}.F" and not extremes.against
    ]
    peaks = [(extremes.max, extremes.t_max) for extremes in force_extremes]
    peaks += [(extremes.F, extremes.t) for extremes in run.diagnostics.peaks if extremes.joint == joint.name]
    limit = max(
        max_touching_force,
        max_contact_force * (1.0 + (PEAK_TOL_FIXED if np.isfinite(run.diagnostics.step) else PEAK_TOL)),
    )
    for force, t in peaks:
        if limit < force:
            yield Fault("peak", joint.name, t, float("nan"), force)


def _compute_bearing_penetration(run: Result, joint: ClearanceInfo) -> Array:
    """Return the penetration of a journal at all samples, (N,), m: ‖e‖ − c, less the contour's depth in the direction
    of e.
    """
    first, second = _find_end_point_names(run, joint)
    ex, ey = (_compute_point_positions(run, second) - _compute_point_positions(run, first)).T
    delta = np.hypot(ex, ey) - float(run.p[joint.clearance])
    if (depths := get_contour_depths(run.source, run.p, joint.name)) is not None:
        delta -= interpolate_depth(depths, np.arctan2(ey, ex) - _get_body_angle(run, joint.first))
    return delta


def _compute_wall_penetration(run: Result, joint: ClearanceInfo) -> Array:
    """Return the penetration of a slider's corner into its wall at all samples, (N,), in m.

    It is the displacement of the corner towards its wall from the middle of the guide, less the gap. The relative angle
    of the bodies in the middle is `angle` of the joint, or else the direction of `axis`.
    """
    first, second = _find_end_point_names(run, joint)
    parameter_indices = run.source.parameter_indices
    values = {
        key: float(run.p[parameter_indices[address]])
        if (address := f"joints.{joint.joint}.{key}") in parameter_indices
        else 0.0
        for key in ("axis.x", "axis.y", "angle")
    }
    direction = np.arctan2(values["axis.y"], values["axis.x"]) + _get_body_angle(run, joint.first)
    specified_angle = (
        values["angle"]
        if f"joints.{joint.joint}.angle" in parameter_indices or _has_mounting_angle(run, joint)
        else None
    )
    mounting_angle = np.arctan2(values["axis.y"], values["axis.x"]) if specified_angle is None else specified_angle
    tilt = _get_body_angle(run, joint.second) - _get_body_angle(run, joint.first) - mounting_angle
    distance = _compute_point_positions(run, second) - _compute_point_positions(run, first)
    offset = distance[:, 1] * np.cos(direction) - distance[:, 0] * np.sin(direction)
    return np.asarray(compute_corner_approach(run.source, run.p, joint, offset, tilt) - float(run.p[joint.clearance]))


def _has_mounting_angle(run: Result, joint: ClearanceInfo) -> bool:
    """Return whether the mechanism file specifies the mounting angle of the joint."""
    return any(entry.address == f"joints.{joint.joint}.angle" for entry in run.source.file_expressions)


def _find_end_point_names(run: Result, joint: ClearanceInfo) -> tuple[str, str]:
    """Return the names of the two points that a joint with play connects: that of the bearing, then that of the
    journal.
    """
    joint_part = next(
        candidate for candidate in run.source.parts if candidate.section == "joints" and candidate.name == joint.joint
    )
    return joint_part.ends[0], joint_part.ends[1]


def _get_body_angle(run: Result, body: int) -> Array:
    """Return the angle of a body at all samples, (N,), rad; 0 for the ground (body < 0)."""
    return run.q[:, run.source.bodies[body].index + 2] if body >= 0 else np.zeros(len(run.t))


def _compute_point_positions(run: Result, name: str) -> Array:
    """Return the positions of a point at all samples in ground axes, (N, 2), in m; the origin for an unknown name."""
    if f"{name}.x" not in run:
        return np.zeros((len(run.t), 2))
    return np.stack([run[f"{name}.x"], run[f"{name}.y"]], axis=1)
