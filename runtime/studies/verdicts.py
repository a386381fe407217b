"""Decide whether a run is stable, inaccurate, diverged or outside the model; every verdict has a reason."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import partial
from typing import TypeAlias

import numpy as np

from gudgeon.files.free_space import check_memory
from gudgeon.language.plot_units import quantity
from gudgeon.model.contours import widest
from gudgeon.results.results import Result
from gudgeon.studies.runs import NAN, Attempt, Error, Parameters, Setting, difference, size
from gudgeon.studies.show.tables import rough_share, seconds, share

OF_A_CELL = 2048  # bytes of a cell, about: values, texts and its job
Pair: TypeAlias = tuple[Attempt, Attempt]  # the same window with a setting and with a finer one


class Status(StrEnum):
    """Verdict on a run, from good to bad; a cell has the worst that applies. MISSING: interrupted by Ctrl-C."""

    STABLE = "stable"
    OUTSIDE = "outside the model"
    INACCURATE = "inaccurate"
    DIVERGED = "diverged"
    MISSING = "not judged"


SEVERITY = (Status.DIVERGED, Status.INACCURATE, Status.OUTSIDE, Status.STABLE, Status.MISSING)  # worst first


@dataclass(frozen=True)
class Limits:
    """Limits of a stable run. All but `closed` are fractions."""

    phi: float = 1e-6  # max |Φ| over the mechanism's size
    closed: float = math.inf  # m, max |Φ| itself
    energy: float = 1e-3  # energy residual over the energy turned over
    lost: float = 0.1  # the same: above it the energy is made up, the run has diverged
    motion: float = 1e-3  # error of a coordinate against a finer run, by size or 1 rad
    path: float = 1e-2  # error of a journal's centre, by the clearance
    force: float = 5e-2  # error of a joint's force, by the peak force
    through: float = 0.1  # δ over the bearing radius: beyond it the journal has flown through the bearing
    half: float = 0.5  # δ over the clearance: beyond it the contact law does not hold
    thin: float = 0.01  # δ over the bearing radius: the same


# Of methods that project and control their error: what they promise, not what a fixed step can do. Errors are
# those against a hundred times tighter tolerance over the first contacts.
STRICT = Limits(closed=1e-10, energy=1e-4, motion=1e-6, path=1e-3, force=1e-2)


def limits_of(setting: Setting) -> Limits:
    """Return the limits for a setting: those of fixed steps, or the stricter ones of a tolerance."""
    return Limits() if setting.fixed else STRICT


@dataclass(frozen=True)
class Cell:
    """Verdict on one run: a method with its step or tolerance, and the parameters that differ from the file."""

    setting: Setting
    parameters: Parameters  # what to give to `simulate` to see the same
    status: Status
    reason: str  # a sentence, "" for a stable run
    label: str  # the same in a few characters, for the map
    error: Error  # over [0, compared]
    energy: float = NAN  # residual over turned over
    penetration: float = NAN  # m, the largest δ
    seconds: float = NAN  # processor time of the long run
    compared: float = NAN  # s, until when it was compared with a finer run

    @property
    def failed(self) -> bool:
        """Whether the method caused the verdict."""
        return self.status in (Status.INACCURATE, Status.DIVERGED)


def check_room(cells: float) -> None:
    """Raise MemoryError if so many cells do not fit into memory."""
    check_memory(OF_A_CELL * cells, f"{cells:.0f} cells")


def not_judged(parameters: Parameters, setting: Setting) -> Cell:
    """Return the cell of a run that Ctrl-C cut short or left out."""
    return Cell(setting, parameters, Status.MISSING, "interrupted", "–", Error())


def judge(parameters: Parameters, long: Attempt, pairs: Sequence[Pair], limits: Limits | None = None) -> Cell:
    """Return the verdict on a setting.

    `long`: the run over the long window. `pairs`: over short windows, a run with the same setting and one with a finer.
    """
    limits = limits or limits_of(long.setting)
    both = [(a.run, b.run) for a, b in pairs if a.run and b.run and not (a.failure or b.failure)]
    error = largest_errors([difference(a, b) for a, b in both])
    compared = max((float(min(a.t[-1], b.t[-1])) for a, b in both), default=NAN)
    cell = partial(Cell, long.setting, parameters, seconds=long.cpu, compared=compared)
    if long.failure or long.run is None:
        at = f"at {seconds(long.failed_at)}" if math.isfinite(long.failed_at) else "fails"
        # a fixed step too long throws a journal through its bearing, whatever the model
        status = Status.OUTSIDE if long.outside and not long.setting.fixed else Status.DIVERGED
        return cell(status, long.failure or "no result", at, error)
    diagnostics = long.run.diagnostics
    energy = diagnostics.energy_residual / max(diagnostics.energy_turned_over, 1e-300)
    deepest = max((d for d, _ in _penetrations(long.run)), default=NAN)
    for status, reason, label in _find_faults(long.run, energy, error, pairs, limits):
        return cell(status, reason, label, error, energy, deepest)
    return cell(Status.STABLE, "", rough_share(error.largest), error, energy, deepest)


def _find_faults(
    run: Result, energy: float, error: Error, pairs: Sequence[Pair], limits: Limits
) -> Iterator[tuple[Status, str, str]]:
    """Yield status, reason and label of each fault, the worst first."""
    for depth, radius in _penetrations(run):
        if depth > limits.through * radius:
            yield Status.DIVERGED, f"a journal flew through its bearing: δ = {quantity(depth, 'm')}", "through"
    if not math.isfinite(energy) or energy > limits.lost:
        yield Status.DIVERGED, f"energy from nowhere: residual {share(energy)} of the energy turned over", "energy"
    if _has_lost_contact(run):
        yield Status.DIVERGED, "lost contact: the surfaces overlap while the joint counts as free", "lost"
    for coarse, _ in pairs:
        if coarse.failure:
            yield Status.DIVERGED, coarse.failure, f"at {seconds(coarse.failed_at)}"
    if outside := _model_violation(run, limits):
        if any(_is_outside_by_step(coarse, fine, limits) for coarse, fine in pairs):
            yield Status.INACCURATE, f"too deep for the method's sake: {outside}, not so in the finer run", "δ"
        yield Status.OUTSIDE, f"the contact law does not hold: {outside}", "δ"
    phi = run.diagnostics.phi_max
    if not phi <= min(limits.phi * size(run), limits.closed):
        yield Status.INACCURATE, f"the linkage comes apart: max |Φ| is {phi:.1e} m or rad", "|Φ|"
    for _, fine in pairs:
        if fine.failure:
            message = f"the finer run ({fine.setting}) fails, so nothing vouches for this one: {fine.failure}"
            yield Status.INACCURATE, message, "?"
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


def largest_errors(errors: Sequence[Error]) -> Error:
    """Return the largest of each measure of the errors; NaN for a measure that none has."""
    measures = ("motion", "path", "force")
    found = ([getattr(e, m) for e in errors if math.isfinite(getattr(e, m))] for m in measures)
    return Error(*(max(values, default=NAN) for values in found))


def _penetrations(run: Result) -> list[tuple[float, float]]:
    """Return the largest δ (m; negative: never in contact) and the bearing radius of every joint with play."""
    found = []
    for joint, peak in zip(run.source.clearances, run.diagnostics.peaks, strict=True):
        radius = float(run.p[joint.constants["R_i"]]) if "R_i" in joint.constants else math.inf
        found.append((peak.e_max - widest(run.source, run.p, joint), radius))
    return found


def _model_violation(run: Result, limits: Limits) -> str:
    """Return why the contact law does not hold in a run; "" if it does."""
    for joint, (depth, radius) in zip(run.source.clearances, _penetrations(run), strict=True):
        c = float(run.p[joint.clearance])
        if depth > limits.half * c:
            return f"δ = {quantity(depth, 'm')} at {joint.name} is {share(depth / c)} of the clearance"
        if depth > limits.thin * radius:
            return f"δ = {quantity(depth, 'm')} at {joint.name} is {share(depth / radius)} of the bearing radius"
    return ""


def _is_outside_by_step(coarse: Attempt, fine: Attempt, limits: Limits) -> bool:
    """Return whether only the coarse run of a pair leaves the model.

    A fixed step that leaves it is always attributed to the method.
    """
    if coarse.run is None or fine.run is None or _model_violation(fine.run, limits):
        return False
    return coarse.setting.fixed or bool(_model_violation(coarse.run, limits))


def _has_lost_contact(run: Result) -> bool:
    """Return whether any sample overlaps by more than rounding while the joint counts as free."""
    for i, joint in enumerate(run.source.clearances):
        c = float(run.p[joint.clearance])
        if bool(np.any((run[f"{joint.name}.delta"] > c * 1e-9) & (run.state[:, i] == 0))):
            return True
    return False
