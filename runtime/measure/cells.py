"""When a run counts as stable, inaccurate, diverged or outside the model; every verdict with its reason."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import TypeAlias

import numpy as np

from gudgeon.measure.words import rough_share, seconds, share
from gudgeon.measure.work import NAN, Attempt, Error, difference, size
from gudgeon.plot_units import quantity
from gudgeon.results import Result

Pair: TypeAlias = tuple[Attempt, Attempt]  # the same window with a step and with a tenth of it


class Status(StrEnum):
    """From good to bad; a cell takes the worst that applies."""

    STABLE = "stable"
    OUTSIDE = "outside the model"
    INACCURATE = "inaccurate"
    DIVERGED = "diverged"


@dataclass(frozen=True)
class Limits:
    """Of a run that counts as stable. Each is a share."""

    phi: float = 1e-6  # max |Φ| over the mechanism's size
    energy: float = 1e-3  # energy residual over the energy turned over
    lost: float = 0.1  # the same: above it the energy is made up, the run has diverged
    motion: float = 1e-3  # error of a coordinate against a ten times shorter step, by size or 1 rad
    path: float = 1e-2  # error of a journal's centre, by the clearance
    force: float = 5e-2  # error of a joint's force, by the peak force
    through: float = 0.1  # δ over the bearing radius: beyond it the journal has flown through the bearing
    half: float = 0.5  # δ over the clearance: beyond it the contact law does not hold
    thin: float = 0.01  # δ over the bearing radius: the same


@dataclass(frozen=True)
class Cell:
    """One step with one value on the other axis."""

    step: float  # s
    clearance: float  # m; NaN in a scene without play
    status: Status
    reason: str  # for people, "" where there is nothing to say
    label: str  # the same in a few characters, for the map
    error: Error
    energy: float = NAN  # residual over turned over
    penetration: float = NAN  # m, the largest δ


def judge(step: float, clearance: float, long: Attempt, pairs: Sequence[Pair], limits: Limits) -> Cell:
    """`long`: the run over the long window. `pairs`: a run with the step, and the same with a tenth of it."""
    errors = [difference(a.run, b.run) for a, b in pairs if a.run and b.run and not (a.failure or b.failure)]
    error = worst(errors)
    if long.failure or long.run is None:
        at = f"at {seconds(long.failed_at)}" if math.isfinite(long.failed_at) else "fails"
        return Cell(step, clearance, Status.DIVERGED, long.failure or "no result", at, error)
    diagnostics = long.run.diagnostics
    energy = diagnostics.energy_residual / max(diagnostics.energy_turned_over, 1e-300)
    deepest = max((d for d, _ in _penetrations(long.run)), default=NAN)
    for status, reason, label in _verdicts(long.run, energy, error, pairs, limits):
        return Cell(step, clearance, status, reason, label, error, energy, deepest)
    largest = max((x for x in (error.path, error.force, error.motion) if math.isfinite(x)), default=NAN)
    return Cell(step, clearance, Status.STABLE, "", rough_share(largest), error, energy, deepest)


def _verdicts(
    run: Result, energy: float, error: Error, pairs: Sequence[Pair], limits: Limits
) -> Iterator[tuple[Status, str, str]]:
    """What is wrong, the worst first."""
    for depth, radius in _penetrations(run):
        if depth > limits.through * radius:
            yield Status.DIVERGED, f"a journal flew through its bearing: δ = {quantity(depth, 'm')}", "through"
    if not math.isfinite(energy) or energy > limits.lost:
        yield Status.DIVERGED, f"energy from nowhere: residual {share(energy)} of the energy turned over", "energy"
    if _lost_contact(run):
        yield Status.DIVERGED, "lost contact: the surfaces overlap while the joint counts as free", "lost"
    for coarse, _ in pairs:
        if coarse.failure:
            yield Status.DIVERGED, coarse.failure, f"at {seconds(coarse.failed_at)}"
    if outside := _outside(run, limits):
        if all(_outside(fine.run, limits) for _, fine in pairs if fine.run):
            yield Status.OUTSIDE, f"the contact law does not hold: {outside}", "δ"
        yield Status.INACCURATE, f"too deep for the step's sake: {outside}, not so with a tenth of the step", "δ"
    phi = run.diagnostics.phi_max / size(run)
    if phi > limits.phi:
        yield Status.INACCURATE, f"the linkage comes apart: max |Φ| is {phi:.1e} of its size", "|Φ|"
    if any(fine.failure for _, fine in pairs):
        yield Status.INACCURATE, "a tenth of the step fails, so nothing vouches for this one", "?"
    beyond = [
        (value / limit, f"{name} {share(value)} of {of}", f"{short} {share(value)}")
        for short, name, value, limit, of in (
            ("energy", "energy residual", energy, limits.energy, "the energy turned over"),
            ("motion", "coordinates off by", error.motion, limits.motion, "the mechanism's size"),
            ("force", "joint force off by", error.force, limits.force, "its peak"),
            ("path", "journal's path off by", error.path, limits.path, "the clearance"),
        )
        if value > limit
    ]
    if beyond:
        yield Status.INACCURATE, *max(beyond)[1:]


def worst(errors: Sequence[Error]) -> Error:
    """The largest of each measure; NaN where there is none."""
    measures = ("motion", "path", "force")
    found = ([getattr(e, m) for e in errors if math.isfinite(getattr(e, m))] for m in measures)
    return Error(*(max(values, default=NAN) for values in found))


def _penetrations(run: Result) -> list[tuple[float, float]]:
    """Largest δ (m, negative: never in contact) and bearing radius of every joint with play."""
    found = []
    for joint, peak in zip(run.source.clearances, run.diagnostics.peaks, strict=True):
        radius = float(run.p[joint.constants["R_i"]]) if "R_i" in joint.constants else math.inf
        found.append((peak.e_max - float(run.p[joint.clearance]), radius))
    return found


def _outside(run: Result, limits: Limits) -> str:
    for joint, (depth, radius) in zip(run.source.clearances, _penetrations(run), strict=True):
        c = float(run.p[joint.clearance])
        if depth > limits.half * c:
            return f"δ = {quantity(depth, 'm')} at {joint.name} is {share(depth / c)} of the clearance"
        if depth > limits.thin * radius:
            return f"δ = {quantity(depth, 'm')} at {joint.name} is {share(depth / radius)} of the bearing radius"
    return ""


def _lost_contact(run: Result) -> bool:
    """Whether any sample overlaps by more than rounding while no contact is latched."""
    for i, joint in enumerate(run.source.clearances):
        c = float(run.p[joint.clearance])
        if bool(np.any((run[f"{joint.name}.e"] > c * (1 + 1e-9)) & (run.state[:, i] == 0))):
            return True
    return False
