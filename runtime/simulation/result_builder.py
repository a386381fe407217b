"""Build the Result of a finished run from samples and counts, with diagnostics and notes; after Ctrl-C without slow
ones.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import cached_property
from time import monotonic
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gudgeon.assembly.journals import find_eccentricity
from gudgeon.assembly.linkage import compute_mechanism_size
from gudgeon.assembly.rank import find_constraint_violation, find_dependent_equations
from gudgeon.contract.audit import Finding
from gudgeon.contract.boundary import PEAK_F, PEAK_e_max, PEAK_t
from gudgeon.contract.clearance_info import ClearanceInfo
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.contract.methods import ADAPTIVE
from gudgeon.errors import SolverError
from gudgeon.integrators.adaptive import select_explicit_method, select_stiff_method
from gudgeon.integrators.failure import build_audit_error, build_audit_notes
from gudgeon.integrators.times import compute_last_step
from gudgeon.integrators.trajectory import Counts, Envelope, Problem, Trajectory
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.contours import compute_corner_penetration, compute_max_clearance
from gudgeon.model.deferred_fields import find_deferred_function, make_with_deferred_fields
from gudgeon.model.evaluation import Evaluation
from gudgeon.model.file_expressions import find_unbounded_drive
from gudgeon.model.left_limit import find_evaluation_times
from gudgeon.model.period_jumps import iterate_period_jump_warnings
from gudgeon.results.diagnostics import Diagnostics, Peak, collect_provenance, get_run_date
from gudgeon.results.peaks import describe_zeno_points, find_first_contact_force
from gudgeon.results.results import Result
from gudgeon.results.samples import split_off_start
from gudgeon.results.series import explain_missing_masses
from gudgeon.simulation.audit import has_failed_finding
from gudgeon.simulation.passing_audit import passes_audit
from gudgeon.simulation.sample_checks import CheckedSamples, check_samples
from gudgeon.waiting.cancellation import POLL_INTERVAL_S
from gudgeon.waiting.ctrl_c import DelayedCtrlC

INTERRUPTED_NOTE = "interrupted: samples after the last one, and what is computed from all of them, are missing"
ROUNDING = 1e-9  # relative difference of a residual that C and Python compute
MAX_DRIFT_OVER_SIZE = 0.01  # of the mechanism's size: constraint violations that are too large for drift
MAX_EXPLICIT_STEPS = 10_000  # steps of an explicit method that indicate a stiff film
MAX_FILM_RATIO = 0.9999  # e/c at which a film's law is capped (generator/equations/contact_steps.py)
MAX_DEPTH_OVER_CLEARANCE, MAX_DEPTH_OVER_RADIUS = (
    0.5,
    0.01,
)  # penetrations beyond these fractions of c and of R are outside the model
MAX_BALANCE_TIME_S = 0.1  # s: time limit for the energy balance of an interrupted run; without it the residual is NaN


def _build_diagnostics(problem: Problem, trajectory: Trajectory, checked: CheckedSamples | None) -> Diagnostics:
    """Build the Diagnostics of a run from its problem, its trajectory and its `checked` samples, if they were checked.

    Quantities that do not apply are NaN, such as the step of an adaptive method. For "auto", the method's name lists
    the methods that made steps.
    """
    compiled, method, counts = problem.compiled, problem.method, trajectory.counts
    residual, throughput = checked.balance if checked else (math.nan, math.nan)
    findings = (*trajectory.audit, *checked.findings) if checked else trajectory.audit
    duration, step, last = float(problem.t[-1] - problem.t[0]), problem.step, math.nan
    if math.isfinite(step) and duration > 0.0:
        last = compute_last_step(duration, step)
        step = max(last, min(step, duration))
    simulated = float(trajectory.t[-1] - trajectory.t[0]) if len(trajectory.t) else 0.0
    if method == ADAPTIVE:
        methods = [select(compiled.source, problem.rtol) for select in (select_explicit_method, select_stiff_method)]
        method = "+".join(methods) if 0 < counts.stiff_steps < counts.steps else methods[counts.stiff_steps > 0]
    return Diagnostics(
        method=method,
        step=step if math.isfinite(problem.step) else math.nan,
        steps=counts.steps,
        last_step=last if last != step else math.nan,
        t_end=float(problem.t[-1]) if len(trajectory.t) and trajectory.t[-1] < problem.t[-1] else math.nan,
        rtol=problem.rtol if math.isinf(problem.step) and method != "kinematic" else math.nan,
        rejected=counts.rejected,
        stiff_steps=counts.stiff_steps,
        jacobians=counts.jacobians,
        right_hand_sides=counts.right_hand_sides,
        onsets=counts.onsets,
        phi_max=counts.phi_max,
        phi_dot_max=counts.phi_dot_max,
        energy_residual=residual,
        energy_turned_over=throughput,
        ratio_min=counts.ratio_min,
        ratio_max=counts.ratio_max,
        ratio_outside=counts.ratio_outside,
        peaks=_build_peaks(compiled, trajectory),
        seconds=trajectory.seconds,
        seconds_per_simulated_second=trajectory.seconds / simulated if simulated > 0 else math.nan,
        interrupted=trajectory.interrupted,
        notes=_build_notes(compiled, problem, trajectory, findings) + (checked.notes if checked else ()),
        audit=findings,
    )


def _build_notes(
    compiled: CompiledModel, problem: Problem, trajectory: Trajectory, findings: tuple[Finding, ...]
) -> tuple[str, ...]:
    """Return the notes of a run for its diagnostics: warnings on start, events, model and audit, in a fixed order.

    `findings`: of its audit.
    """
    p, notes, counts = problem.p, list(problem.remarks), trajectory.counts
    if problem.state is None and (dependent := find_dependent_equations(compiled, p, float(problem.t[0]), problem.q)):
        notes.append(
            f"the start is a dead centre: constraint equations {', '.join(dependent)} depend on each other there;"
            " velocities that drives and start.rates do not determine have the smallest norm: give a rate of each body"
            " that may move"
        )
    notes += yield_missing_mass_note(compiled.source)
    if problem.stop and len(trajectory.events):
        last = compiled.source.events[trajectory.events["event"][-1]]
        if last.action == "stop":
            notes.append(f"event {last.name} ended the run at t = {trajectory.events['t'][-1]:.9g} s")
    if trajectory.interrupted:
        notes.append(INTERRUPTED_NOTE)
    for event, t in trajectory.undefined_events:
        name = compiled.source.events[event].name
        notes.append(f"event {name} is NaN at t = {t:.9g} s: where it is NaN, no zeros are found")
    if compiled.source.events and ":" in problem.method:
        notes.append(f"method {problem.method} does not locate events")
    n_passed, first = trajectory.change_points
    if n_passed and not explain_missing_masses(compiled.source):
        notes.append(
            f"{n_passed} samples are at or near a change point (the first at t = {first:.9g} s): positions and"
            " velocities continue on the smooth branch; the constraint equations do not determine forces and torques"
            " there"
        )
    notes += _yield_unbounded_sample_note(compiled, problem, trajectory)
    notes += iterate_period_jump_warnings(compiled.source, p, float(problem.t[0]), float(trajectory.t[-1]))
    notes += yield_range_notes(compiled, p, float(problem.t[0]), problem.q, counts, trajectory.peaks)
    if compiled.source.rigid_joints:
        notes += describe_zeno_points([joint.name for joint in compiled.source.clearances], trajectory.impacts)
        notes += _yield_stiff_film_note(compiled.source, problem, counts)
    notes += build_audit_notes(findings)
    notes += yield_redundancy_note(compiled.source)
    return tuple(notes)


def yield_missing_mass_note(source: KernelSource) -> Iterator[str]:
    """Yield a note that forces and energies are not known, if masses are missing."""
    if why := explain_missing_masses(source):
        yield f"{why}: reactions, torques, energies and works are not known"


def yield_redundancy_note(source: KernelSource) -> Iterator[str]:
    """Yield a note that names the joints with undetermined reactions, if the scene has redundant constraints."""
    if source.indeterminate:
        owners = ", ".join(source.indeterminate)
        yield f"constraints are redundant: the reactions of {owners} are not determined by rigid bodies (NaN)"


def _yield_stiff_film_note(source: KernelSource, problem: Problem, counts: Counts) -> Iterator[str]:
    """Yield a note if a stiff film needed more than MAX_EXPLICIT_STEPS adaptive steps in a scene with rigid contacts.

    No implicit method fits such a scene. Called for scenes with rigid contacts only.
    """
    films = [joint.name for joint in source.clearances if joint.film]
    if films and counts.steps > MAX_EXPLICIT_STEPS and math.isinf(problem.step):
        yield (
            f"{counts.steps} steps: the film in {', '.join(films)} is stiff, and no implicit method fits a scene whose"
            f" contact in {source.rigid_joints[0]} is a constraint (newton_restitution): with an elastic contact law"
            " there (hertz with a stiffness), method auto makes long steps"
        )


def _yield_unbounded_sample_note(compiled: CompiledModel, problem: Problem, trajectory: Trajectory) -> Iterator[str]:
    """Yield a note on the sample of a kinematic run at which the second rate of a drive is unbounded.

    Nothing is yielded for other scenes, without samples, and if no acceleration exceeds a hundred times the median.
    """
    if compiled.source.methods != ("kinematic",) or not len(trajectory.t) or trajectory.a is None:
        return
    largest = np.maximum(trajectory.a.max(axis=1), -trajectory.a.min(axis=1))  # |q̈|, without arrays of its size
    largest[np.isnan(largest)] = math.inf
    t = float(trajectory.t[largest.argmax()])
    if largest.max() > 100.0 * np.median(largest) and (drive := find_unbounded_drive(compiled, problem.p, t)):
        yield (
            f"the second rate of drive {drive} is unbounded at t = {t:.9g} s: accelerations, forces and torques of that"
            " sample are not meaningful: write the drive with powers of 2 and more, or request samples at other times"
        )


def may_exceed_validity_range(source: KernelSource, p: Array, size: Array, phi_max: Array, peaks: Array) -> Any:
    """Return a mask (n_runs,) of the runs of a batch that may have left the range of validity of their model.

    A run may have left it if its constraint error exceeds MAX_DRIFT_OVER_SIZE of the mechanism's size, or if the peak
    eccentricity of a joint exceeds its clearance (MAX_FILM_RATIO of it for a joint with a film only).
    `yield_range_notes` then tests the run. Shapes: parameter values p (n_runs, …), mechanism sizes and `phi_max`
    (n_runs,), peaks (n_runs, n_clearances, 3).
    """
    c, e_max = p[:, [joint.clearance for joint in source.clearances]], peaks[:, :, PEAK_e_max]
    least = np.array([MAX_FILM_RATIO if joint.film and not joint.dry else 1.0 for joint in source.clearances])
    return (phi_max > MAX_DRIFT_OVER_SIZE * size) | (e_max > least * c).any(axis=1)


def yield_range_notes(
    compiled: CompiledModel, p: Array, t0: float, q0: Array, counts: Counts, peaks: Array
) -> Iterator[str]:
    """Yield notes on a run outside the validity of its model: large constraint violations, or invalid contact laws.

    `t0`, `q0`: time (s) and coordinates of the start. `peaks` (n_clearances, 3). A violation by a given start, which
    the reduced equations correct and another note reports, is left out.
    """
    is_violated = counts.phi_max > MAX_DRIFT_OVER_SIZE * compute_mechanism_size(compiled, p)
    if is_violated and compiled.source.formulation != "full":
        is_violated = not counts.phi_max <= (1.0 + ROUNDING) * float(np.abs(compiled.phi(t0, q0, p)).max())
    if is_violated:
        yield (
            f"constraint equations are violated by up to {counts.phi_max:.3g}: results from then on are not"
            " meaningful; the cause is a step that is too long, or a drive that pushes the links through a dead centre"
        )
    yield from _yield_law_range_notes(compiled, p, t0, q0, peaks)


def _yield_law_range_notes(compiled: CompiledModel, p: Array, t0: float, q0: Array, peaks: Array) -> Iterator[str]:
    """Yield notes for each joint with play whose largest eccentricity left the range of its contact or film law.

    The notes are on squeezed-out films (e/c above MAX_FILM_RATIO), penetrations of joints with a film only, and
    penetrations above MAX_DEPTH_OVER_CLEARANCE or MAX_DEPTH_OVER_RADIUS. `t0`, `q0`: the start, which may be too deep
    already. `peaks` (n_clearances, 3).
    """
    for k, (joint, e_max) in enumerate(zip(compiled.source.clearances, peaks[:, PEAK_e_max], strict=True)):
        c, radius = float(p[joint.clearance]), float(p[joint.constants["R_i"]])
        penetration = float(e_max) - compute_max_clearance(compiled.source, p, joint)
        ratio = float(e_max) / float(p[joint.film_clearance])
        if joint.film and not joint.dry and ratio > MAX_FILM_RATIO:
            yield (
                f"{joint.name}: the film is squeezed out, e/c = {ratio:.7g}: its law, singular at e = c, is"
                " capped there: add a dry contact to the joint, or use an oil of higher viscosity"
            )
        elif joint.film and not joint.dry and penetration > (1.0 - MAX_FILM_RATIO) * c:
            yield (
                f"{joint.name}: the journal penetrates its bearing by up to {1e3 * penetration:.3g} mm"
                f" (c = {1e3 * c:.3g} mm), where the film still has a force by extra_clearance:"
                " add a dry contact to the joint"
            )
        if penetration > (limit := min(MAX_DEPTH_OVER_CLEARANCE * c, MAX_DEPTH_OVER_RADIUS * radius)):
            begins_deep = _compute_penetration(compiled, p, t0, q0, k, joint) > limit
            location = (
                "corner penetrates its wall by {} mm (gap"
                if joint.is_corner
                else "journal penetrates its bearing by {} mm (c"
            )
            yield (
                f"{joint.name}: the {location.format(f'{1e3 * penetration:.3g}')} {1e3 * c:.3g} mm,"
                f" {'half the width' if joint.is_corner else 'radius'} {1e3 * radius:.3g} mm): outside "
                "the validity of contact laws; "
                + ("the start is that deep" if begins_deep else "a step that is too long has this effect too")
            )


def _compute_penetration(compiled: CompiledModel, p: Array, t: float, q: Array, k: int, joint: ClearanceInfo) -> float:
    """Return the penetration (m) of joint k at time t and coordinates q (n,); it is negative without contact.

    For a journal in its bearing it is e − c, without the depth of a measured contour; for a slider's corner it is δ.
    """
    if joint.is_corner:
        return compute_corner_penetration(compiled, p, t, q, np.zeros_like(q), k)[0]
    return float(np.hypot(*find_eccentricity(compiled, p, t, q, joint)[1])) - float(p[joint.clearance])


def _build_peaks(compiled: CompiledModel, trajectory: Trajectory) -> tuple[Peak, ...]:
    """Return the peak force and eccentricity of each joint with play, with time and force of its first contact (NaN
    if none).
    """
    peaks = []
    for i, joint in enumerate(compiled.source.clearances):
        contacts = trajectory.impacts
        contacts = contacts[contacts["joint"] == i] if len(contacts) else contacts
        first = (
            (float(contacts["t_on"][0]), find_first_contact_force(contacts)) if len(contacts) else (math.nan, math.nan)
        )
        F, t, e_max = (float(trajectory.peaks[i, k]) for k in (PEAK_F, PEAK_t, PEAK_e_max))
        peaks.append(Peak(joint.name, F, t, e_max, *first))
    return tuple(peaks)


class _TimeLimitReached(Exception):
    """Signal that the evaluation of an interrupted run has used its time limit and ends."""


def build_result(
    problem: Problem, trajectory: Trajectory, given: Array, is_given: Array, is_time_limited: bool = True
) -> Result:
    """Return the Result of a run with its diagnostics, after evaluating all samples for energy balance, audit and
    notes.

    The evaluation is left out if Ctrl-C or a lack of memory ends it. If Ctrl-C ended the run and `is_time_limited`, it
    is left out after MAX_BALANCE_TIME_S seconds. It is stored with the Result of a short run. A start that is not a
    requested sample is removed from the samples.
    """
    compiled, is_unsolvable = problem.compiled, False
    trajectory = _clear_undefined_works(compiled, trajectory)
    checked: CheckedSamples | None = None
    try:
        is_left_limit_needed = compiled.may_drive_acceleration_jump
        times = trajectory.t
        if is_left_limit_needed:
            times = find_evaluation_times(compiled, times, trajectory.q, trajectory.v, problem.p)
        problem.poll_cancellation()
        if passes_audit(problem, trajectory, times):
            values = {"compiled": compiled, "source": compiled.source, "given": given, "is_given": is_given}
            values |= {"stored": {}, "start_row": None, "given_start": problem.resumed_state}
            result = make_with_deferred_fields(Result, values, _DeferredFieldsOfPassingRun(problem, trajectory, times))
            return result if problem.start_is_sample else split_off_start(result)
        poll = _make_poll_function(problem, trajectory.interrupted, is_time_limited)
        checked = check_samples(problem, trajectory, times, poll)
    except SolverError:
        is_unsolvable = True
    except (
        _TimeLimitReached,
        MemoryError,
    ):  # the samples are there; what follows from them is evaluated on request
        pass
    except KeyboardInterrupt:
        trajectory = replace(trajectory, interrupted=True)
    is_nan = trajectory.a is None and is_unsolvable
    values = {
        "compiled": compiled,
        "source": compiled.source,
        "p": problem.p.copy(),
        "given": given,
        "is_given": is_given,
        "t": trajectory.t,
        "q": trajectory.q,
        "v": trajectory.v,
        "state": trajectory.state,
        "memory": trajectory.memory,
        "work": trajectory.work,
        "impacts": trajectory.impacts,
        "accelerations": np.full_like(trajectory.q, np.nan) if is_nan else checked.a if checked else trajectory.a,
        "diagnostics": _build_diagnostics(problem, trajectory, checked),
        "stored": {},
        "start_row": None,
        "given_start": problem.resumed_state,
    }
    if checked and checked.evaluation:
        values["evaluation"] = checked.evaluation  # a cached property: not computed again
    result = make_with_deferred_fields(Result, values, _DeferredFields(problem, trajectory))
    return result if problem.start_is_sample else split_off_start(result)


class _DeferredFields:
    """Build fields of a Result at their first access, for make_with_deferred_fields."""

    fields: tuple[str, ...] = ("events", "event_states", "trace", "provenance")

    def __init__(self, problem: Problem, trajectory: Trajectory) -> None:
        self.problem, self.trajectory, self.date = problem, trajectory, get_run_date()

    def events(self) -> NDArray[Any]:
        """Return the user events of the run."""
        return self.trajectory.events

    def event_states(self) -> NDArray[Any] | None:
        """Return the user events with states."""
        return self.trajectory.event_states

    def trace(self) -> Envelope | None:
        """Return the envelope of forces and paths."""
        return self.trajectory.trace

    def provenance(self) -> dict[str, str]:
        """Return the provenance of the run."""
        return collect_provenance(self.problem.compiled, self.date)


_COPIED = ("t", "q", "v", "state", "memory", "work", "impacts")  # arrays of a trajectory


class _DeferredFieldsOfPassingRun(_DeferredFields):
    """Build fields of a Result whose samples pass the audit: arrays are copies, as the caller may change them before
    the diagnostics are built. `times` (N,): times (s) at which the samples are evaluated.
    """

    fields = (
        *_DeferredFields.fields,
        *_COPIED,
        *("p", "evaluation", "accelerations", "diagnostics"),
    )

    def __init__(self, problem: Problem, trajectory: Trajectory, times: Array) -> None:
        super().__init__(problem, trajectory)
        self.times = times

    def p(self) -> Array:
        """Return the parameter values."""
        return self.problem.p.copy()

    def __getattr__(self, name: str) -> Callable[[], Array]:
        """Return the function that copies an array of the trajectory."""
        if name not in _COPIED:
            raise AttributeError(name)
        copy: Callable[[], Array] = getattr(self.trajectory, name).copy
        return copy

    @cached_property
    def _evaluation(self) -> Evaluation:
        """Evaluate the samples once."""
        x, problem = self.trajectory, self.problem
        return problem.compiled.evaluate(self.times, x.q, x.v, x.memory, problem.values_of_motion)

    def evaluation(self) -> Evaluation:
        """Return the evaluation of the samples."""
        return self._evaluation

    def accelerations(self) -> Array:
        """Return q̈ (N, n)."""
        return self._evaluation.a.copy()

    def diagnostics(self) -> Diagnostics:
        """Check the samples, and build the diagnostics with the findings and notes."""
        checked = check_samples(self.problem, self.trajectory, self.times, lambda: None)
        return _build_diagnostics(self.problem, self.trajectory, checked)


def _add_notes(run: Result, notes_to_add: Sequence[str]) -> Result:
    """Return a copy of the run with more notes in its diagnostics; the same object if there are none."""
    notes = (*run.diagnostics.notes, *notes_to_add)
    return replace(run, diagnostics=replace(run.diagnostics, notes=notes)) if notes_to_add else run


def _clear_undefined_works(compiled: CompiledModel, trajectory: Trajectory) -> Trajectory:
    """Return the trajectory with works of NaN if the scene has no masses; otherwise the same object."""
    if not compiled.source.massless_bodies:
        return trajectory
    return replace(trajectory, work=np.full_like(trajectory.work, np.nan))


def _make_poll_function(problem: Problem, is_interrupted: bool, is_time_limited: bool) -> Callable[[], None]:
    """Return a function without arguments that polls for Ctrl-C, for the evaluation of samples to call often.

    It also reports progress, and raises _TimeLimitReached MAX_BALANCE_TIME_S seconds from now if the run
    `is_interrupted` and the evaluation `is_time_limited`.
    """
    time_at_begin = last_report = monotonic()

    def poll() -> None:
        """Poll for Ctrl-C and report progress. Raise _TimeLimitReached if an interrupted run takes too long."""
        nonlocal last_report
        problem.poll_cancellation()
        now = monotonic()
        if problem.progress and not is_interrupted and now - last_report > POLL_INTERVAL_S:
            last_report = now
            problem.progress(1.0, "balancing energy")
        if is_interrupted and is_time_limited and now - time_at_begin > MAX_BALANCE_TIME_S:
            raise _TimeLimitReached

    return poll


def check_result(problem: Problem, trajectory: Trajectory, result: Result) -> tuple[Result, SolverError | None]:
    """Return the run, and the SolverError that ends it after its samples, or None.

    Such errors are the failure of the time loop, contradictory constraints, or a failed audit of the samples. If Ctrl-C
    comes meanwhile, the run is marked as interrupted.
    """
    findings = (
        () if find_deferred_function(result, "diagnostics") else result.diagnostics.audit
    )  # () if they have passed
    try:
        failure = find_constraint_violation(problem, trajectory) or (
            build_audit_error(findings) if has_failed_finding(findings) else None
        )
    except KeyboardInterrupt:
        result, failure = (
            _mark_as_interrupted(result),
            find_constraint_violation(problem, replace(trajectory, interrupted=True)),
        )
    return result, trajectory.stopped or failure


def mark_result_if_interrupted(ctrl_c: DelayedCtrlC, result: Result) -> Result:
    """Poll for Ctrl-C; return the result, marked as interrupted if Ctrl-C came while it was being built."""
    try:
        ctrl_c.raise_delayed()
    except KeyboardInterrupt:
        return _mark_as_interrupted(result)
    return result


def _mark_as_interrupted(result: Result) -> Result:
    """Return a copy of the result marked as interrupted, with a note unless it was marked before."""
    marked = _add_notes(result, () if result.diagnostics.interrupted else (INTERRUPTED_NOTE,))
    return replace(marked, diagnostics=replace(marked.diagnostics, interrupted=True))
