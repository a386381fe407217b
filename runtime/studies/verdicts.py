"""Classify a run as stable, inaccurate, diverged or outside the validity of the model; every verdict has a reason."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import partial
from typing import TypeAlias

import numpy as np

from gudgeon.files.free_space import check_memory
from gudgeon.language.plot_units import format_quantity
from gudgeon.model.contours import compute_max_clearance
from gudgeon.results.results import Result
from gudgeon.studies.runs import NAN, Attempt, Error, Parameters, Setting, compare_runs, find_mechanism_size
from gudgeon.studies.show.tables import format_fraction, format_rough_fraction, format_seconds

CELL_BYTES = 2048  # approximate memory of a cell: values, texts and its job
Pair: TypeAlias = tuple[Attempt, Attempt]  # runs over the same window with a setting and with a finer one


class Status(StrEnum):
    """Verdict on a run, from best to worst; a cell has the worst that applies. MISSING: interrupted by Ctrl-C."""

    STABLE = "stable"
    OUTSIDE = "outside the model"
    INACCURATE = "inaccurate"
    DIVERGED = "diverged"
    MISSING = "not judged"


SEVERITY = (Status.DIVERGED, Status.INACCURATE, Status.OUTSIDE, Status.STABLE, Status.MISSING)  # worst first


@dataclass(frozen=True)
class Limits:
    """Limits of a stable run. All but `closed` are fractions."""

    phi: float = 1e-6  # max |Φ| divided by the mechanism's size
    closed: float = math.inf  # m, max |Φ| itself
    energy: float = 1e-3  # energy residual divided by the energy throughput
    lost: float = 0.1  # the same ratio: above it, the run has diverged
    motion: float = 1e-3  # error of a coordinate relative to a finer run, divided by the size or 1 rad
    path: float = 1e-2  # error of a journal's centre, divided by the clearance
    force: float = 5e-2  # error of a joint's force, divided by the peak force
    through: float = 0.1  # δ divided by the bearing radius: above it, the journal has passed through the bearing
    half: float = 0.5  # δ divided by the clearance: above it, the contact law is not valid
    thin: float = 0.01  # δ divided by the bearing radius: above it, the contact law is not valid


# Limits for methods with projection and error control, stricter than those of fixed steps. Errors are relative to a run
# with a hundred times tighter tolerance over the first contacts.
STRICT = Limits(closed=1e-10, energy=1e-4, motion=1e-6, path=1e-3, force=1e-2)


def select_limits(setting: Setting) -> Limits:
    """Return the default limits for a setting: `Limits()` for a fixed step, STRICT for a tolerance."""
    return Limits() if setting.has_fixed_step else STRICT


@dataclass(frozen=True)
class Cell:
    """Verdict on one run, a point of a stability map: a method with its step or tolerance, and parameters.

    The parameters are those that differ from the file.
    """

    setting: Setting
    parameters: Parameters  # arguments of `simulate` that repeat the run
    status: Status
    reason: str  # a sentence, "" for a stable run
    label: str  # the reason in a few characters, for the map
    error: Error  # over [0, compared]
    energy: float = NAN  # energy residual divided by the energy throughput
    penetration: float = NAN  # m, the largest δ
    seconds: float = NAN  # s, processor time of the long run
    compared: float = NAN  # s, end of the time in which the run was compared with a finer run

    @property
    def failed(self) -> bool:
        """Return whether the method, and not the model, caused a bad verdict: inaccurate or diverged."""
        return self.status in (Status.INACCURATE, Status.DIVERGED)


def check_memory_of_cells(n_cells: float) -> None:
    """Raise MemoryError if this number of cells, CELL_BYTES each, does not fit into the free memory."""
    check_memory(CELL_BYTES * n_cells, f"{n_cells:.0f} cells")


def make_missing_cell(parameters: Parameters, setting: Setting) -> Cell:
    """Return a cell with the status MISSING and no measured values, for a run that Ctrl-C prevented."""
    return Cell(setting, parameters, Status.MISSING, "interrupted", "–", Error())


def classify_runs(
    parameters: Parameters, long_run: Attempt, run_pairs: Sequence[Pair], limits: Limits | None = None
) -> Cell:
    """Return the cell of a setting: diverged, inaccurate, outside the model or stable, with the reason of its worst
    fault.

    Faults in order of precedence, of which the first decides (`_find_faults`):

    - diverged: journal through its bearing, energy not conserved, missed contact, a failed run over a short window;
    - inaccurate or outside the model: penetration too deep for the contact law, inaccurate if a finer run has less;
    - inaccurate: constraints violated, a finer run failed, or energy residual, motion, force or path above its limit.

    long_run: the run over the long window. run_pairs: over short windows, a run with the same setting and a finer one;
    failed ones do not count for the error. A failed long run is judged alone: it is "outside the model" if it left the
    validity of the model and has no fixed step, else "diverged". limits: None means those of the setting of `long_run`.
    """
    limits = limits or select_limits(long_run.setting)
    compared_runs = [(a.run, b.run) for a, b in run_pairs if a.run and b.run and not (a.failure or b.failure)]
    error = find_largest_errors([compare_runs(a, b) for a, b in compared_runs])
    compared = max((float(min(a.t[-1], b.t[-1])) for a, b in compared_runs), default=NAN)
    cell = partial(Cell, long_run.setting, parameters, seconds=long_run.cpu, compared=compared)
    if long_run.failure or long_run.run is None:
        failure_text = f"at {format_seconds(long_run.failed_at)}" if math.isfinite(long_run.failed_at) else "fails"
        # with a fixed step that is too long, a journal passes through its bearing for any model
        status = Status.OUTSIDE if long_run.outside and not long_run.setting.has_fixed_step else Status.DIVERGED
        return cell(status, long_run.failure or "no result", failure_text, error)
    diagnostics = long_run.run.diagnostics
    energy = diagnostics.energy_residual / max(diagnostics.energy_turned_over, 1e-300)
    deepest = max((d for d, _ in _compute_penetrations(long_run.run)), default=NAN)
    for status, reason, label in _find_faults(long_run.run, energy, error, run_pairs, limits):
        return cell(status, reason, label, error, energy, deepest)
    return cell(Status.STABLE, "", format_rough_fraction(error.largest), error, energy, deepest)


def _find_faults(
    run: Result, energy_residual: float, error: Error, run_pairs: Sequence[Pair], limits: Limits
) -> Iterator[tuple[Status, str, str]]:
    """Yield status, reason and label of each fault of a run in order of precedence; a stable run yields nothing.

    energy_residual: divided by the energy throughput. error: largest differences from the finer runs. run_pairs: runs
    over short windows with the same and a finer setting. Of several errors above their limits, only the one with the
    largest ratio to its limit is yielded.
    """
    for depth, radius in _compute_penetrations(run):
        if depth > limits.through * radius:
            yield Status.DIVERGED, f"a journal passed through its bearing: δ = {format_quantity(depth, 'm')}", "through"
    if not math.isfinite(energy_residual) or energy_residual > limits.lost:
        yield (
            Status.DIVERGED,
            f"energy is not conserved: residual {format_fraction(energy_residual)} of the energy throughput",
            "energy",
        )
    if _has_lost_contact(run):
        yield Status.DIVERGED, "missed contact: the surfaces overlap while the contact state is open", "lost"
    for coarse, _ in run_pairs:
        if coarse.failure:
            yield Status.DIVERGED, coarse.failure, f"at {format_seconds(coarse.failed_at)}"
    if violation := _describe_model_violation(run, limits):
        if any(_is_violation_caused_by_method(coarse, fine, limits) for coarse, fine in run_pairs):
            yield Status.INACCURATE, f"too deep, but not in the finer run: {violation}", "δ"
        yield Status.OUTSIDE, f"the contact law is not valid: {violation}", "δ"
    phi = run.diagnostics.phi_max
    if not phi <= min(limits.phi * find_mechanism_size(run), limits.closed):
        yield Status.INACCURATE, f"the constraints are violated: max |Φ| is {phi:.1e} m or rad", "|Φ|"
    for _, fine in run_pairs:
        if fine.failure:
            message = f"the finer run ({fine.setting}) failed, so the errors are unknown: {fine.failure}"
            yield Status.INACCURATE, message, "?"
    exceeded = [
        (value / limit, f"{name} {format_fraction(value)} of {reference}", f"{short} {format_fraction(value)}")
        for short, name, value, limit, reference in (
            ("energy", "energy residual", energy_residual, limits.energy, "the energy throughput"),
            ("motion", "coordinates differ by", error.motion, limits.motion, "the mechanism's size"),
            ("force", "joint force differs by", error.force, limits.force, "its peak"),
            ("path", "journal path differs by", error.path, limits.path, "the clearance"),
        )
        if value > limit
    ]
    if exceeded:
        yield Status.INACCURATE, *max(exceeded)[1:]


def find_largest_errors(errors: Sequence[Error]) -> Error:
    """Return the largest finite motion, path and force error over several pairs of runs; NaN where none is finite."""
    names = ("motion", "path", "force")
    finite_values = ([getattr(e, m) for e in errors if math.isfinite(getattr(e, m))] for m in names)
    return Error(*(max(values, default=NAN) for values in finite_values))


def _compute_penetrations(run: Result) -> list[tuple[float, float]]:
    """Return for each joint with play the largest penetration δ (m) and the bearing radius R_i (m), over all steps.

    δ is negative for a joint that was never in contact. The radius is infinite for a joint without one.
    """
    depths = []
    for joint, peak in zip(run.source.clearances, run.diagnostics.peaks, strict=True):
        radius = float(run.p[joint.constants["R_i"]]) if "R_i" in joint.constants else math.inf
        depths.append((peak.e_max - compute_max_clearance(run.source, run.p, joint), radius))
    return depths


def _describe_model_violation(run: Result, limits: Limits) -> str:
    """Return a text on the first joint whose penetration is too large for its contact law; "" if there is none.

    The penetration is too large above the fraction `limits.half` of the clearance or `limits.thin` of the bearing
    radius.
    """
    for joint, (depth, radius) in zip(run.source.clearances, _compute_penetrations(run), strict=True):
        c = float(run.p[joint.clearance])
        if depth > limits.half * c:
            return f"δ = {format_quantity(depth, 'm')} at {joint.name} is {format_fraction(depth / c)} of the clearance"
        if depth > limits.thin * radius:
            return (
                f"δ = {format_quantity(depth, 'm')} at {joint.name} is "
                f"{format_fraction(depth / radius)} of the bearing radius"
            )
    return ""


def _is_violation_caused_by_method(coarse_run: Attempt, fine_run: Attempt, limits: Limits) -> bool:
    """Return whether a too large penetration of a long run is an error of the method: a finer run does not have it.

    It is False if either run has no result, or if the finer run violates the limits of the contact law, too. Without a
    fixed step, the coarse run over the same short window must violate them.
    """
    if coarse_run.run is None or fine_run.run is None or _describe_model_violation(fine_run.run, limits):
        return False
    return coarse_run.setting.has_fixed_step or bool(_describe_model_violation(coarse_run.run, limits))


def _has_lost_contact(run: Result) -> bool:
    """Return whether any sample of a run has a penetration δ > 1e-9 c while the contact state of the joint is open."""
    for i, joint in enumerate(run.source.clearances):
        c = float(run.p[joint.clearance])
        if bool(np.any((run[f"{joint.name}.delta"] > c * 1e-9) & (run.state[:, i] == 0))):
            return True
    return False
