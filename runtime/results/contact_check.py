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
from gudgeon.model.contours import contour_of, corner_at, depth_at
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
    """What contradicts the contacts of a run, in one joint over neighbouring samples.

    kind: "penetration" or "force" outside every listed contact, "pull" of a rigid contact, "peak" above the largest
    force of the contacts.
    """

    kind: str
    joint: str
    t: float  # s, where it is largest
    depth: float  # m, the largest penetration there
    force: float  # N, the largest force there; NaN: not known

    def __str__(self) -> str:
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
    """The faults that were found, by time; `samples` tells at how many times the run was looked at."""

    samples: int
    faults: tuple[Fault, ...]
    notes: tuple[str, ...] = ()

    def __bool__(self) -> bool:
        """True where nothing was found."""
        return not self.faults

    def __str__(self) -> str:
        head = f"contacts checked at {self.samples} samples: {len(self.faults) or 'no'} faults"
        return "\n".join([head, *self.notes, *map(str, self.faults)])

    def raise_faults(self) -> None:
        """Raise SolverError with joint, time and depth of every fault, if there is one."""
        if self.faults:
            raise SolverError(str(self), self.faults[0].t)


def penetrations(run: Result) -> Array:
    """Penetration (N, n_clearances) at all samples, m, from positions of the bodies; negative: no contact."""
    columns = [_at_wall(run, joint) if joint.at_wall else _in_bearing(run, joint) for joint in run.source.clearances]
    return np.stack(columns, axis=1) if columns else np.zeros((len(run.t), 0))


def check_samples(run: Result, peaks: Result | None = None) -> ContactCheck:
    """Check the samples of a run against its contacts; `peaks`: the run whose peaks were asked for, None: the same."""
    found: list[Fault] = []
    delta = penetrations(run)
    for k, joint in enumerate(run.source.clearances):
        if not joint.dry:
            continue
        force = np.full(len(run.t), np.nan) if run.compiled is None or joint.film else run[f"{joint.name}.F"]
        free = ~_in_contact(run, k)
        limit = max(DEPTH_TOL * float(run.p[joint.clearance]), SHALLOW)
        found += _excursions(run, joint, "penetration", free & (delta[:, k] > limit), delta[:, k], force)
        touches = free & (np.abs(delta[:, k]) <= SHALLOW)
        bears = (force > FORCE_TOL * float(np.nanmax(force, initial=0.0))) & ~touches
        found += _excursions(run, joint, "force", free & (delta[:, k] <= limit) & bears, delta[:, k], force)
        if joint.name in run.source.rigid and run.compiled is not None:
            pull = sum(run[f"{joint.name}.F{axis}"] * run[f"{joint.name}.e{axis}"] for axis in "xy")
            wrong = ~free & (pull > PULL_TOL * float(np.abs(pull).max(initial=0.0)))
            found += _excursions(run, joint, "pull", wrong, delta[:, k], force)
        found += _peaks(peaks or run, k, joint, float(np.nanmax(force[touches], initial=0.0)))
    return ContactCheck(len(run.t), tuple(sorted(found, key=lambda one: one.t)))


def _in_contact(run: Result, k: int) -> NDArray[np.bool_]:
    """Whether each sample lies in a listed contact of joint k."""
    own = run.impacts[run.impacts["joint"] == k]
    slack = TIME_TOL * float(run.t[-1] - run.t[0])
    inside = np.zeros(len(run.t) + 1, int)
    ends = np.where(np.isnan(own["t_off"]), np.inf, own["t_off"])
    np.add.at(inside, np.searchsorted(run.t, own["t_on"] - slack), 1)
    np.add.at(inside, np.searchsorted(run.t, ends + slack, "right"), -1)
    return np.cumsum(inside)[:-1] > 0


def _excursions(
    run: Result, joint: ClearanceInfo, kind: str, wrong: NDArray[np.bool_], delta: Array, force: Array
) -> Iterator[Fault]:
    """One fault for each series of neighbouring samples that are wrong."""
    at = np.flatnonzero(wrong)
    for part in np.split(at, np.flatnonzero(np.diff(at) > 1) + 1):
        if len(part):
            deepest = part[np.argmax(delta[part])] if kind == "penetration" else part[np.argmax(force[part])]
            largest = float(force[part].max())
            yield Fault(kind, joint.name, float(run.t[deepest]), float(delta[part].max()), largest)


def _peaks(run: Result, k: int, joint: ClearanceInfo, touches: float) -> Iterator[Fault]:
    """A peak over all steps that no listed contact has; joints with a film have forces outside contacts."""
    if joint.film or (joint.at_wall and joint.joint in run.source.rigid):
        return
    own = run.impacts[run.impacts["joint"] == k]
    if joint.name in run.source.rigid:  # those without a duration have impulses
        own = own[own["t_off"] != own["t_on"]]
    largest = float(own["F_peak"].max(initial=0.0))
    extremes = [one for one in run.diagnostics.extremes if one.name == f"{joint.name}.F" and not one.against]
    peaks = [(one.max, one.t_max) for one in extremes]
    peaks += [(one.F, one.t) for one in run.diagnostics.peaks if one.joint == joint.name]
    allowed = max(touches, largest * (1.0 + (PEAK_TOL_FIXED if np.isfinite(run.diagnostics.step) else PEAK_TOL)))
    for F, t in peaks:
        if allowed < F:
            yield Fault("peak", joint.name, t, float("nan"), F)


def _in_bearing(run: Result, joint: ClearanceInfo) -> Array:
    """‖e‖ − c of a journal, of a bearing with a contour less its depth in the direction of e."""
    first, second = _ends(run, joint)
    ex, ey = (_points(run, second) - _points(run, first)).T
    delta = np.hypot(ex, ey) - float(run.p[joint.clearance])
    if (depths := contour_of(run.source, run.p, joint.name)) is not None:
        delta -= depth_at(depths, np.arctan2(ey, ex) - _angle(run, joint.first))
    return delta


def _at_wall(run: Result, joint: ClearanceInfo) -> Array:
    """Penetration of a slider's corner, m: how far it is nearer to its wall than in mid-guide, less the gap."""
    first, second = _ends(run, joint)
    place = run.source.place
    numbers = {
        key: float(run.p[place[at]]) if (at := f"joints.{joint.joint}.{key}") in place else 0.0
        for key in ("axis.x", "axis.y", "angle")
    }
    direction = np.arctan2(numbers["axis.y"], numbers["axis.x"]) + _angle(run, joint.first)
    turned = numbers["angle"] if f"joints.{joint.joint}.angle" in place or _written(run, joint) else None
    mounted = np.arctan2(numbers["axis.y"], numbers["axis.x"]) if turned is None else turned
    tilt = _angle(run, joint.second) - _angle(run, joint.first) - mounted
    apart = _points(run, second) - _points(run, first)
    offset = apart[:, 1] * np.cos(direction) - apart[:, 0] * np.sin(direction)
    return np.asarray(corner_at(run.source, run.p, joint, offset, tilt) - float(run.p[joint.clearance]))


def _written(run: Result, joint: ClearanceInfo) -> bool:
    return any(one.address == f"joints.{joint.joint}.angle" for one in run.source.written)


def _ends(run: Result, joint: ClearanceInfo) -> tuple[str, str]:
    """The bearing's and the journal's points."""
    part = next(one for one in run.source.parts if one.section == "joints" and one.name == joint.joint)
    return part.ends[0], part.ends[1]


def _angle(run: Result, body: int) -> Array:
    return run.q[:, run.source.bodies[body].index + 2] if body >= 0 else np.zeros(len(run.t))


def _points(run: Result, name: str) -> Array:
    """Positions (N, 2) of a point, m; the origin for the ground's own."""
    info = next((one for one in run.source.points if one.name == name), None)
    if info is None:
        return np.zeros((len(run.t), 2))
    return np.stack([point_motion(run, info, axis, 0) for axis in (0, 1)], axis=1)
