"""Diagnose why a run failed: errors for the status codes of the time loops in C (engine/boundary.h)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gudgeon.assembly.linkage import compute_mechanism_size
from gudgeon.assembly.rank import find_nearly_dependent_equations
from gudgeon.contract.audit import CHECKS, SAMPLE_CHECKS, Check, Finding
from gudgeon.contract.boundary import (
    CHATTERING,
    FRICTION_INCONSISTENT,
    LOST,
    MAX_STICK_SPEED,
    NOT_FINITE,
    NOT_FOUND,
    OUTSIDE,
    STALLED,
    STOPPED,
    TOO_SMALL,
    UNBOUNDED,
    PEAK_e_max,
)
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.contract.methods import NEED_SLOPES
from gudgeon.errors import AuditError, NonFiniteError, SingularError, SolverError
from gudgeon.language.functions import WITH_SWITCHING_POINTS
from gudgeon.language.tree import list_functions
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.contours import compute_max_clearance
from gudgeon.model.file_expressions import (
    evaluate_at_times,
    explain_undefined_rate,
    explain_undefined_value_after,
    explain_undefined_value_near,
    find_force_with_unbounded_slope,
    find_unbounded_drive,
    read_expression_trees,
)

# messages by status
MESSAGES = {
    FRICTION_INCONSISTENT: "friction jams a contact of newton_restitution at t = {t:.9g} s: with it, normal forces "
    "accelerate the surfaces towards each other, or grow beyond all bounds (Painlevé)\n"
    "  use less friction, or an elastic normal law",
    NOT_FOUND: "the stages of {method}'s step were not found at t = {t:.9g} s: the step is too long\n"
    "  use a shorter step, or leave out step: the method then controls it",
}
SHORTER = "the step {:.3g} s is too long for this scene: take a smaller one"
ADVICE = "the motion may leave the validity of the model: inspect the last samples"
INTERRUPTED = "interrupted before its end"
NO_NUMBER = "end the run before that time, or write the expression so that it and its rates are finite at all times"
NO_SLOPE = "use method dop853, which needs no slopes, or write the force so that its slope is finite there"
BOUNDED = "write the drive with powers of 2 and more, or end the run before that; a larger rtol may step over it"
GROWN = "a drive that grows beyond all bounds cannot be followed: end the run before it, or change the drive"
JUMPS = (
    "a force that jumps with the sign of a speed v may hold v at zero: use a dry_friction element; replace a jump at a"
    " speed v1 by a smooth function: tanh((v - v1) / v0) with a small speed v0"
)
SLOWER = "use a slower drive: check its unit"
OVERFLOWING_RATE = 1e75  # rad/s or m/s: an acceleration is its square, an energy or a force the square of that
# smallest change (rad or m) of a drive in one step that counts as motion; rate in rad/s or m/s that is too fast
MIN_DRIVE_MOTION, MAX_DRIVE_RATE = 1e-3, 1e9
MIN_SQUEEZED_RATIO = 0.99  # e/c of a film beyond which its law causes the failure
REMEDY = (
    "the result cannot be trusted: compare with another method, a smaller rtol or formulation full; audit=False runs"
    " without this check"
)


def build_run_error(compiled: CompiledModel, method: str, values: Mapping[str, Any], t_end: float) -> SolverError:
    """Build the error of a run to t_end (s) that C ended, from the values that C stored for the run.

    `values`: status, t_last, step and others by the names of Batch (engine/scene/calls.h).
    """
    status, t, step, p = int(values["status"]), float(values["t_last"]), float(values["step"]), values["p_motion"]
    e_max, last = values["peaks"][: len(compiled.source.clearances), PEAK_e_max], values["last"]
    if status == STALLED:
        return _build_stalled_error(compiled, values, t_end, e_max)
    if math.isfinite(step):  # a fixed step evaluates up to its end, after the last state
        return _build_status_error(compiled, method, status, t, SHORTER.format(step), last, e_max, p, step)
    return _build_status_error(compiled, method, status, t, ADVICE, last, e_max, p, 0.0)


def _build_status_error(
    compiled: CompiledModel,
    method: str,
    status: int,
    t: float,
    advice: str,
    last_state: Array,
    e_max: Array,
    p: Array,
    step_ahead: float,
) -> SolverError:
    """Return the error for a nonzero status of C at time t (s).

    `advice`: text for errors without a more specific one. `last_state`: last state (2n + 3,). `e_max` (n_clearances,):
    largest eccentricities. `step_ahead` (s): time after that state up to which a step of fixed length evaluated.
    """
    if status != STOPPED and (too_large := build_overflow_error(compiled, p, t)):
        return too_large
    q, v = np.ravel(last_state)[: compiled.n], np.ravel(last_state)[compiled.n : 2 * compiled.n]
    if status in (UNBOUNDED, TOO_SMALL, NOT_FINITE) and (
        reason_text := explain_undefined_value_near(compiled.source, p, t, q, v, step_ahead)
    ):
        return NonFiniteError(f"{reason_text}\n  {NO_NUMBER}", t)
    if status in (UNBOUNDED, TOO_SMALL) and (drive := find_unbounded_drive(compiled, p, t)):
        return _build_unbounded_drive_error(drive, t)
    status = NOT_FINITE if status == UNBOUNDED else status
    if status in (NOT_FINITE, TOO_SMALL) or status > 0:
        reason_text = explain_undefined_value_after(compiled.source, p, t, q, v, step_ahead)
        if reason_text or (
            reason_text := explain_undefined_rate(
                compiled, p, np.array([t, t + 1e-13 * max(1.0, abs(t))]), np.zeros_like(q)
            )[0]
        ):
            return NonFiniteError(f"{reason_text}\n  {NO_NUMBER}", t)
        if drive := find_unbounded_drive(compiled, p, t):
            return _build_unbounded_drive_error(drive, t)
        if method in NEED_SLOPES and (reason_text := find_force_with_unbounded_slope(compiled.source, p, t, q, v)):
            return NonFiniteError(f"{reason_text}\n  {NO_SLOPE}", t)
        fast_drive_hint = format_drive_states(compiled, p, t, MAX_DRIVE_RATE)
        advice = GROWN if fast_drive_hint else advice
    if status == NOT_FINITE:
        return NonFiniteError(f"the motion is no longer finite at t = {t:.9g} s{fast_drive_hint}\n  {advice}", t)
    if status in MESSAGES:
        return SolverError(MESSAGES[status].format(method=method, t=t), t)
    if status == CHATTERING:
        return _build_chattering_error(compiled, t)
    if status == TOO_SMALL:
        known_error = _build_squeezed_film_error(compiled, e_max, p, t) or _build_dead_centre_error(
            compiled, last_state, p, t
        )
        return known_error or SolverError(f"no step is small enough at t = {t:.9g} s{fast_drive_hint}\n  {advice}", t)
    if status == LOST:
        fault_at_corner = {True: "an open corner is inside its wall", False: "an open journal is outside its bearing"}
        faults = sorted({fault_at_corner[joint.is_corner] for joint in compiled.source.clearances}, reverse=True)
        return SolverError(f"a contact was lost at t = {t:.9g} s: {', or '.join(faults)}", t)
    if status == OUTSIDE:
        return _build_penetration_error(compiled, e_max, p, t)
    if status == STOPPED:
        return SolverError(INTERRUPTED, t)
    if status == STALLED:
        return SolverError(
            f"the run no longer advances at t = {t:.9g} s{format_drive_states(compiled, p, t)}\n  {advice}", t
        )
    return _build_singular_error(compiled, status, t, advice, last_state, p, fast_drive_hint)


def _build_unbounded_drive_error(drive: str, t: float) -> SolverError:
    """Build the error for a drive whose second rate is unbounded at t (s)."""
    message = f"the second rate of drive {drive} grows beyond all bounds there"
    return SolverError(f"no step leads beyond t = {t:.9g} s: {message}\n  {BOUNDED}", t)


def _build_chattering_error(compiled: CompiledModel, t: float) -> SolverError:
    """Build the error for endless changes of contacts or switching points at one time t (s) (chattering).

    Its advice depends on whether the scene has rigid contacts, dry friction, or forces with switching points.
    """
    if compiled.source.rigid_joints:
        return SolverError(
            f"contacts collide, or open and close, without end near t = {t:.9g} s\n"
            f"  use a larger threshold of newton_restitution in {' or '.join(compiled.source.rigid_joints)}, which"
            " closes them earlier",
            t,
        )
    source = compiled.source
    used = f"  dry_friction sticks at a slip below {MAX_STICK_SPEED:g} m/s: speeds that small are not resolved"
    advice = [used] if source.frictions else []
    if _format_forces_with_switching_points(source) or not advice:
        advice.append(f"  {JUMPS}")
    message = f"a friction or another switching point of the forces changes its branch without end near t = {t:.9g} s"
    return SolverError("\n".join([message, *advice]), t)


def _build_singular_error(
    compiled: CompiledModel, status: int, t: float, advice: str, last_state: Array, p: Array, fast_drive_hint: str
) -> SolverError:
    """Build the error for a vanishing pivot of the constraint equations at t (s); status − 1 is its index.

    - SingularError, dead centre: the equation belongs to driven loops.
    - SingularError, singular position: the last state (2n + 3,) is finite and all its values are below 1e12.
    - SingularError, dead centre: the last state is finite but larger, and its positions are within bounds.
    - NonFiniteError, the motion diverged before: in all other cases.

    `fast_drive_hint`: text on drives with high rates, or "", for the message of NonFiniteError.
    """
    row = compiled.source.integrated_pivots[status - 1]
    if row in compiled.source.driven_loop_equations:
        return SingularError(
            f"the linkage reaches a dead centre at t = {t:.9g} s: at the position of its drives, constraint equation"
            f" {row} has no solution{format_drive_states(compiled, p, t)}\n"
            "  with these lengths the drives cannot move further; end the run before it, or change the drive; rk4 can"
            " follow a faster drive with a shorter step",
            t,
            row,
        )
    try:
        compiled.check_pivot(status, t, compiled.source.integrated_pivots, p)
    except SingularError as error:
        finite = bool(np.isfinite(last_state).all())
        if finite and np.abs(last_state).max() < 1e12:
            return error
        # at a dead centre, speeds grow until a pivot vanishes by rounding, while positions hardly change
        dead_centre_error = (
            _build_dead_centre_error(compiled, last_state, p, t)
            if finite and _is_within_bounds(compiled, last_state, p)
            else None
        )
        if dead_centre_error:
            return dead_centre_error
        where = f"t = {t:.9g} s (constraint equation {error.pivot})"
        return NonFiniteError(f"the motion diverged before {where}{fast_drive_hint}\n  {advice}", t, error.pivot)
    raise AssertionError(f"status {status} is not a failure")


@dataclass(frozen=True)
class RunProgress:
    """Describe the progress of a run that no longer advances: time, remaining time, advance of its last steps (s)."""

    t: float
    remaining: float
    advance: float  # of the last `steps` steps together
    steps: int
    is_slowing: bool  # whether steps became far shorter than before; else its end is too far away

    @property
    def steps_to_end(self) -> float:
        """Return the expected number of steps to the end, if they advance like the last ones."""
        return self.remaining / max(self.advance, 1e-300) * self.steps


def format_drive_states(compiled: CompiledModel, p: Array, t: float, min_rate: float = 0.0) -> str:
    """Return a text with value and rate of each drive whose rate is at least `min_rate`; "" without any.

    An example is "; drive motor is at 12.3 rad, its rate 2 rad/s". Drives that are not expressions are left out.
    """
    source, rates = compiled.source, compiled.closed_nu(t, np.zeros(compiled.n), p)
    trees = {info.address.split(".")[1]: tree for info, tree in read_expression_trees(source, ("drives",))}
    with np.errstate(all="ignore"):
        values = {name: evaluate_at_times(source, p, tree, np.array([t]))[0] for name, tree in trees.items()}
    parts = [
        f"drive {row.owner} is at {values[row.owner]:.9g} {row.unit}, its rate {rate:.9g} {row.unit}/s"
        for row, rate in zip(source.start_equations, rates, strict=True)
        if row.kind == "drive" and row.owner in values and not abs(rate) < min_rate  # constants have no rate
    ]
    return "".join(f"; {text}" for text in parts)


def build_overflow_error(compiled: CompiledModel, p: Array, t: float) -> NonFiniteError | None:
    """Return the error for drives whose rates exceed OVERFLOWING_RATE at t (s) and at t/2; None if there are none.

    Drives that are not numbers, or that grow to such rates within the run, have their own messages.
    """
    rates = [compiled.closed_nu(s, np.zeros(compiled.n), p) for s in (t, 0.5 * t)]
    if not (np.abs(rates) >= OVERFLOWING_RATE).all(axis=0).any():
        return None
    if fast := format_drive_states(compiled, p, t, OVERFLOWING_RATE):
        message = f"velocities and accelerations are too large for doubles at t = {t:.9g} s{fast}"
        return NonFiniteError(f"{message}\n  {SLOWER}", t)
    return None


def build_runaway_error(progress: RunProgress, drive_states: str) -> SolverError:
    """Build the error for a run whose motion becomes ever faster; `drive_states`: text of `format_drive_states`."""
    return SolverError(
        f"the motion no longer advances at t = {progress.t:.12g} s: its last {progress.steps} steps advanced by"
        f" {progress.advance:.3g} s, each by less, and {progress.remaining:.3g} s remain{drive_states}\n"
        f"  {GROWN}",
        progress.t,
    )


def build_too_slow_error(progress: RunProgress) -> SolverError:
    """Build the error for a run whose end is too far away at the speed of its last steps."""
    return SolverError(
        f"the run has reached t = {progress.t:.9g} s, and at the pace of its last {progress.steps} steps the remaining "
        f"{progress.remaining:.3g} s take {progress.steps_to_end:.1e} more\n"
        "  use an earlier t_end, or resume from the final state of the stored part",
        progress.t,
    )


def _format_forces_with_switching_points(source: KernelSource) -> str:
    """Return the addresses and positions in the file of forces with switching points; "" if there are none.

    An example is "forces.push.value.x (line 7, column 12)".
    """
    force_names = [
        info
        for info, tree in read_expression_trees(source, ("forces",))
        if not WITH_SWITCHING_POINTS.isdisjoint(list_functions(tree))
    ]
    return ", ".join(f"{info.address} (line {info.line}, column {info.column})" for info in force_names)


def _build_stalled_error(compiled: CompiledModel, values: Mapping[str, Any], t_end: float, e_max: Array) -> SolverError:
    """Return the error of a run to t_end (s) that no longer advances, from the values that C has stored.

    `values` contains t_last, p_motion, the advance `time_gain` (s) of the last steps, and in `monitored_steps` their
    number and whether they became shorter. `ended` counts the steps that ended at contacts, switching points, frictions
    and events. `e_max` (n_clearances,): largest eccentricities (m).
    """
    t, (steps, has_shortened_steps), ended, p = (
        float(values["t_last"]),
        values["monitored_steps"].tolist(),
        values["ended"],
        values["p_motion"],
    )
    progress = RunProgress(t, t_end - t, float(values["time_gain"]), steps, bool(has_shortened_steps))
    if not progress.is_slowing:
        return build_too_slow_error(progress)
    # a drive that moves this far in such a short step is the cause of the short steps
    fast = format_drive_states(compiled, p, t, MIN_DRIVE_MOTION * progress.steps / max(progress.advance, 1e-300))
    film, cause = _format_squeezed_film(compiled, e_max, p), int(ended.argmax())
    if fast and not film and ended[cause] <= 0.01 * progress.steps:
        return build_runaway_error(progress, fast)
    switching_forces = _format_forces_with_switching_points(compiled.source)
    location = f" in {switching_forces}" if switching_forces else " of a law"
    causes = (
        "a contact begins or ends",
        f"a force changes its form (a switching point{location})",
        "friction changes between stick and slip",
        "an event's expression is zero",
    )
    count = "all" if ended[cause] == progress.steps else str(ended[cause])
    if film:
        why = film
    elif ended[cause] > 0.01 * progress.steps:
        why = f"{count} of them ended where {causes[cause]}: the motion stays there"
    else:
        why = "their errors allow no longer steps: forces change fast there, or speeds grow"
    return SolverError(
        f"the run no longer advances at t = {progress.t:.9g} s: its last {progress.steps} steps advanced by"
        f" {progress.advance:.3g} s; {progress.remaining:.3g} s remain, {progress.steps_to_end:.1e} steps at this"
        f" pace\n  {why}\n"
        f"  the computed part is stored: inspect its last samples, or end the run before; {JUMPS};"
        " rk4 with a fixed step steps over a jump of a force, with an error",
        progress.t,
    )


def _format_squeezed_film(compiled: CompiledModel, e_max: Array, p: Array) -> str:
    """Return a text on the first film that is squeezed out (e/c near 1); "" if there is none.

    `e_max` (n_clearances,): largest eccentricities (m).
    """
    for joint, e in zip(compiled.source.clearances, e_max, strict=True):
        ratio = float(e) / float(p[joint.film_clearance])
        if joint.film and ratio > MIN_SQUEEZED_RATIO:
            return f"the film in joint {joint.name} is squeezed out, e/c = {ratio:.7g}"
    return ""


def _build_penetration_error(compiled: CompiledModel, e_max: Array, p: Array, t: float) -> SolverError:
    """Build the error for the joint whose penetration is largest relative to its limit, at t (s).

    The limit is the smaller of a tenth of the bearing's radius (of half a guide's width) and the validity range of the
    contact law. `e_max` (n_clearances,): largest eccentricities (m). The error has `outside_model` set.
    """
    _, penetration, law_limit, name, at_wall = max(
        (depth / min(law_limit, 0.1 * float(p[joint.constants["R_i"]])), depth, law_limit, joint.name, joint.is_corner)
        for joint, e in zip(compiled.source.clearances, e_max, strict=True)
        for depth in [float(e) - compute_max_clearance(compiled.source, p, joint)]
        for law_limit in [float(p[joint.constants["deepest"]]) if "deepest" in joint.constants else np.inf]
    )
    tenth = "a tenth of half the guide's width," if at_wall else "a tenth of its radius,"
    limit = f"{1e3 * law_limit:.3g} mm, the validity of its contact law," if penetration > law_limit else tenth
    body, surface = (f"corner {name}", "its wall") if at_wall else (f"the journal of {name}", "its bearing")
    laws, oil = ("contact laws", "") if at_wall else ("contact and film laws", ", an oil of higher viscosity")
    error = SolverError(
        f"{body} lies {1e3 * penetration:.3g} mm deep in {surface}, beyond {limit} at t = {t:.9g} s\n"
        f"  {laws} are valid for far less: use a stiffer material{oil} or less speed, and with rk4 a shorter step",
        t,
    )
    error.outside_model = True
    return error


def _is_within_bounds(compiled: CompiledModel, last_state: Array, p: Array) -> bool:
    """Return whether all coordinates x, y of `last_state` are below 10⁴ times the mechanism's size (at least 1 mm)."""
    indices = [k for k, name in enumerate(compiled.source.coordinates) if not name.endswith(".theta")]
    return bool(
        np.abs(np.ravel(last_state)[indices]).max(initial=0.0) < 1e4 * max(compute_mechanism_size(compiled, p), 1e-3)
    )


def _build_dead_centre_error(compiled: CompiledModel, last_state: Array, p: Array, t: float) -> SolverError | None:
    """Build the error for a linkage near a dead centre, where constraint equations depend on each other; else None.

    `last_state`: state before the failure, of which q is tested; t (s): time for the message. The advice depends on
    whether the scene has drives.
    """
    rows = find_nearly_dependent_equations(compiled, p, t, np.ravel(last_state)[: compiled.n])
    if not rows:
        return None
    advice = (
        "with these lengths the drives cannot move further; end the run before it, or change the drive"
        if compiled.source.drives
        else "links are in one line there, and their further motion is not determined; another rtol may step over it"
    )
    return SolverError(
        f"the linkage reaches a dead centre at t = {t:.9g} s: constraint equations {', '.join(rows)} depend on each"
        f" other\n  {advice}",
        t,
    )


def _build_squeezed_film_error(compiled: CompiledModel, e_max: Array, p: Array, t: float) -> SolverError | None:
    """Build the error for the first film that is squeezed out (e/c near 1), where its law is singular; else None.

    The error has `outside_model` set.
    """
    for joint, e in zip(compiled.source.clearances, e_max, strict=True):
        ratio = float(e) / float(p[joint.film_clearance])
        if joint.film and ratio > MIN_SQUEEZED_RATIO:
            error = SolverError(
                f"the film in joint {joint.name} is squeezed out at t = {t:.9g} s: e/c = {ratio:.7g}\n"
                "  its law is singular at e = c: use an oil of higher viscosity, or add a dry contact to the joint",
                t,
            )
            error.outside_model = True
            return error
    return None


def build_findings(source: KernelSource, values: Array, t: Array, indices: NDArray[np.intc]) -> tuple[Finding, ...]:
    """Build the audit findings from C's results of each check: largest value, time (s), and index of a joint or row.

    The arrays are (n_checks,). Negative values mark checks that were not made; they are left out.
    """
    rows = zip(CHECKS, values.tolist(), t.tolist(), indices.tolist(), strict=True)
    return tuple(
        Finding(check.name, value, time, _get_location_name(source, check, k))
        for check, value, time, k in rows
        if value >= 0.0
    )


def _get_location_name(source: KernelSource, check: Check, index: int) -> str:
    """Return the name of the joint, row, event, friction or coordinate with this index; "" if it is negative.

    `check.place` is the kind of object that the index counts, "" for none. Other kinds give "kind index".
    """
    if index < 0 or not check.place:
        return ""
    if check.place == "joint":
        return source.clearances[index].name
    if check.place == "row":
        return source.start_equations[index].name
    if check.place == "event":
        return source.events[index].name
    if check.place == "friction":
        return source.frictions[index]
    return source.coordinates[index] if check.place == "coordinate" else f"{check.place} {index}"


def build_audit_error(findings: tuple[Finding, ...]) -> AuditError:
    """Build the error of a run that its audit ended: the worst finding with its time, and a remedy."""
    worst = max(findings, key=lambda one: one.worst)
    return AuditError(f"{format_finding(worst)}\n  {REMEDY}", worst.t)


def build_audit_notes(findings: tuple[Finding, ...]) -> tuple[str, ...]:
    """Return a note, as text, for each audit finding whose value is above its limit or NaN."""
    return tuple(format_finding(finding) for finding in findings if not finding.worst <= 1.0)


def format_finding(finding: Finding) -> str:
    """Return a finding as text: the check, what it compares, its value relative to the limit, time (s) and place."""
    check = next(candidate for candidate in (*CHECKS, *SAMPLE_CHECKS) if candidate.name == finding.check)
    location = f" at {check.place} {finding.place}" if finding.place else ""
    return (
        f"audit: check {check.name} of {check.compares} exceeds its limit {finding.worst:.3g} times at"
        f" t = {finding.t:.9g} s{location}"
    )
